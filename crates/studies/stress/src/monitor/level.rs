//! Brightness of untouched pictures. A mean over the newest pictures is compared, because a single picture flickers.
//!
//! Real flicker is not independent: lamps beat with the exposure. Means of successive pictures, taken while the limit is set, measure this flicker.

use std::collections::VecDeque;

use taceva_metrics::distributions::student_t;

use super::limit::{LEARNT, RUNS, WINDOW};

/// Minimum difference of two mean brightnesses that counts as a change, in standard errors of this difference.
const ERRORS: f64 = 6.5;
/// Minimum difference of mean brightness that counts as a change, as a ratio to the change by contact.
const LEAST: f64 = 0.1;
/// Greatest change that one picture contributes to the mean, in multiples of the limit. A few outliers thus cause no alarm.
const MOST: f64 = 5.0;

/// Brightness of the newest untouched pictures, and the limit that the first pictures set.
#[derive(Clone, Debug)]
pub(super) struct Level {
    /// Number of untouched pictures that set the limit, at least [`WINDOW`].
    wanted: usize,
    learnt: Vec<f64>,
    usual: Option<Usual>,
    newest: VecDeque<f64>,
}

#[derive(Clone, Copy, Debug)]
struct Usual {
    mean: f64,
    /// Minimum change of the mean brightness that is found, as a ratio to the change by contact.
    limit: f64,
}

impl Default for Level {
    fn default() -> Level {
        Level {
            wanted: LEARNT,
            learnt: Vec::new(),
            usual: None,
            newest: VecDeque::new(),
        }
    }
}

impl Level {
    /// Sets the number of pictures that set the limit. Call it before the first picture.
    pub(super) fn want(&mut self, pictures: usize) {
        self.wanted = pictures;
    }

    /// Minimum change of the mean brightness that is found, as a ratio to the change by contact. `None` before the limit is set.
    pub(super) fn smallest(&self) -> Option<f64> {
        self.usual.map(|of| of.limit)
    }

    /// Takes the brightness of the next picture. If the mean change of the newest pictures exceeds the limit, returns the median change of those that
    /// exceed it, otherwise `None`.
    pub(super) fn push(&mut self, brightness: f64) -> Option<f64> {
        if self.newest.len() == WINDOW {
            self.newest.pop_front();
        }
        self.newest.push_back(brightness);
        let Some(Usual { mean, limit }) = self.usual else {
            self.learnt.push(brightness);
            if self.learnt.len() == self.wanted {
                self.usual = Some(self.usual_of_learnt());
            }
            return None;
        };
        let changes = self.newest.iter().map(|of| of - mean);
        let most = MOST * limit;
        let bounded = changes.clone().map(|change| change.clamp(-most, most));
        let change = bounded.sum::<f64>() / self.newest.len() as f64;
        if change.abs() <= limit {
            return None;
        }
        let beyond = changes.map(|of| of * change.signum());
        let mut beyond: Vec<f64> = beyond.filter(|of| *of > limit).collect();
        beyond.sort_unstable_by(f64::total_cmp);
        beyond.get(beyond.len() / 2).copied()
    }

    fn usual_of_learnt(&self) -> Usual {
        let count = self.learnt.len() as f64;
        let mean = self.learnt.iter().sum::<f64>() / count;
        let squares = self.learnt.iter().map(|of| (of - mean).powi(2));
        let variance = squares.sum::<f64>() / (count - 1.0);
        let error = (variance * (1.0 / WINDOW as f64 + 1.0 / count)).sqrt();
        let runs = self.learnt.windows(WINDOW);
        let runs = runs.map(|run| (run.iter().sum::<f64>() / WINDOW as f64 - mean).abs());
        let farthest = runs.fold(0.0, f64::max);
        Usual {
            mean,
            limit: LEAST.max(ERRORS * error).max(RUNS * farthest),
        }
    }
}

/// Upper bound of the expected number of false alarms in `pictures` untouched pictures with normal, independent flicker: a sum over all runs of
/// [`WINDOW`] pictures.
pub(super) fn false_alarms(pictures: u64) -> f64 {
    2.0 * student_t::above(ERRORS, LEARNT as f64 - 1.0) * pictures as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flicker_hides_small_changes_and_no_large_ones() {
        let mut level = Level::default();
        for number in 0..LEARNT {
            // A standard deviation of 0.2.
            let brightness = if number % 2 == 0 { 0.2 } else { -0.2 };
            assert_eq!(level.push(brightness), None);
        }
        let smallest = level.smallest().expect("a limit");
        assert!((smallest - 0.255).abs() < 0.002, "{smallest}");
        let mut steady = level.clone();
        for _ in 0..WINDOW {
            assert_eq!(steady.push(0.25), None);
        }
        let changes = (0..WINDOW).map(|_| level.push(0.3));
        let found: Vec<f64> = changes.flatten().collect();
        assert!(found.len() > 2, "{found:?}");
        assert!(found.iter().all(|of| (of - 0.3).abs() < 1e-9), "{found:?}");
    }

    /// Level whose limit was set by pictures of almost constant brightness.
    fn steady() -> Level {
        let mut level = Level::default();
        for _ in 0..LEARNT {
            assert_eq!(level.push(0.0), None);
        }
        level
    }

    #[test]
    fn the_strength_of_a_sudden_change_is_that_of_the_change() {
        let mut level = steady();
        let mut changes = (0..WINDOW).filter_map(|_| level.push(-3.0));
        assert_eq!(changes.next(), Some(3.0));
    }

    #[test]
    fn four_accidental_pictures_among_thirty_are_no_change() {
        let mut level = steady();
        for number in 0..300 {
            let is_accident = number % WINDOW < 4;
            assert_eq!(level.push(if is_accident { 40.0 } else { 0.0 }), None);
        }
    }

    #[test]
    fn slow_flicker_that_was_there_while_the_limit_was_set_is_no_change() {
        let mut level = Level::default();
        for number in 0..5000 {
            let brightness = 0.2 * (f64::from(number) * std::f64::consts::TAU / 200.0).sin();
            assert_eq!(level.push(brightness), None, "{number}");
        }
    }
}
