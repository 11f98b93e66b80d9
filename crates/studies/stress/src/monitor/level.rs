//! Brightness of untouched pictures, as a mean over the newest ones, because a single picture flickers.

use std::collections::VecDeque;

use taceva_metrics::distributions::student_t;

use super::limit::{LEARNT, WINDOW};

/// Standard errors of the difference of two means that show a change.
const ERRORS: f64 = 6.5;
/// Least change that counts.
const LEAST: f64 = 0.1;

/// Brightness of each untouched picture, with the mean and the spread of the first [`LEARNT`] ones.
#[derive(Clone, Debug, Default)]
pub(super) struct Level {
    learnt: Vec<f64>,
    usual: Option<Usual>,
    newest: VecDeque<f64>,
}

#[derive(Clone, Copy, Debug)]
struct Usual {
    mean: f64,
    /// Least change that is found.
    limit: f64,
}

impl Level {
    /// Least change that is found. `None` before the limit is set.
    pub(super) fn smallest(&self) -> Option<f64> {
        self.usual.map(|of| of.limit)
    }

    /// Takes the brightness of the next picture. Returns the change of the mean of the newest pictures, if it is beyond the limit.
    pub(super) fn push(&mut self, brightness: f64) -> Option<f64> {
        if self.newest.len() == WINDOW {
            self.newest.pop_front();
        }
        self.newest.push_back(brightness);
        let Some(Usual { mean, limit }) = self.usual else {
            self.learnt.push(brightness);
            if self.learnt.len() == LEARNT {
                self.usual = Some(self.usual_of_learnt());
            }
            return None;
        };
        let sum: f64 = self.newest.iter().sum();
        let change = (sum / self.newest.len() as f64 - mean).abs();
        (change > limit).then_some(change)
    }

    fn usual_of_learnt(&self) -> Usual {
        let count = LEARNT as f64;
        let mean = self.learnt.iter().sum::<f64>() / count;
        let squares = self.learnt.iter().map(|of| (of - mean).powi(2));
        let variance = squares.sum::<f64>() / (count - 1.0);
        let error = (variance * (1.0 / WINDOW as f64 + 1.0 / count)).sqrt();
        Usual {
            mean,
            limit: LEAST.max(ERRORS * error),
        }
    }
}

/// Expected number of false alarms in `pictures` untouched pictures with normal, independent flicker. The sum over all windows is an upper bound.
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
    }
}
