//! Limit of a measured value, set by untouched pictures, and the newest pictures that exceed the limit.

use std::collections::VecDeque;

/// Number of pictures that set a limit.
pub(super) const LEARNT: usize = 200;
/// Number of newest pictures that are compared with the limit.
pub(super) const WINDOW: usize = 30;

/// Minimum limit, in multiples of the greatest excess of a run of [`WINDOW`] pictures while the limit is set. It matters if flicker is slow.
pub(super) const RUNS: f64 = 3.0;

/// Numbers of pictures that determine the limit, and that show a change.
#[derive(Clone, Copy, Debug)]
struct Rule {
    /// Minimum number of pictures among the newest [`WINDOW`] that must exceed the limit to show a change.
    beyond: usize,
    /// Rank of the picture, from the greatest value in a run of [`WINDOW`] pictures, whose excess over the median is the excess of the run.
    reach: usize,
    /// Rank of the value that becomes the limit, from the greatest value of [`LEARNT`] pictures.
    rank: usize,
}

/// Rule for a change after which most pictures exceed the limit.
const MOST: Rule = Rule {
    beyond: 19,
    reach: 19,
    rank: 20,
};
/// Rule for a change after which a few pictures exceed all pictures that set the limit by far.
const SOME: Rule = Rule {
    beyond: 3,
    reach: 1,
    rank: 1,
};

/// Value that is measured in each untouched picture, with its limit.
#[derive(Clone, Debug)]
pub(super) struct Limited {
    rule: Rule,
    /// Minimum distance of the limit from the median.
    least: f64,
    /// Number of untouched pictures that set the limit, at least [`WINDOW`].
    wanted: usize,
    learnt: Vec<f64>,
    /// Limit; `None` until `wanted` pictures were taken.
    limit: Option<Limit>,
    newest: VecDeque<f64>,
}

#[derive(Clone, Copy, Debug)]
struct Limit {
    median: f64,
    limit: f64,
}

impl Limited {
    /// Creates a limit. A change is found if most of the newest pictures exceed it.
    pub(super) fn by_most(least: f64) -> Limited {
        Limited::new(MOST, least)
    }

    /// Creates a limit. A change is found if at least three of the newest pictures exceed it.
    pub(super) fn by_some(least: f64) -> Limited {
        Limited::new(SOME, least)
    }

    fn new(rule: Rule, least: f64) -> Limited {
        Limited {
            rule,
            least,
            wanted: LEARNT,
            learnt: Vec::new(),
            limit: None,
            newest: VecDeque::new(),
        }
    }

    /// Sets the number of pictures that set the limit. Call it before the first picture.
    pub(super) fn want(&mut self, pictures: usize) {
        self.wanted = pictures;
    }

    /// Number of pictures that are still needed to set the limit.
    pub(super) fn missing(&self) -> usize {
        self.wanted.saturating_sub(self.learnt.len())
    }

    /// Distance of the limit from the median, which is the smallest excess that is found. `None` before the limit is set.
    pub(super) fn smallest(&self) -> Option<f64> {
        self.limit.map(|of| of.limit - of.median)
    }

    /// Takes the value of the next picture. Returns the median excess over the median of the newest pictures that exceed the limit; `None` if they
    /// are too few.
    pub(super) fn push(&mut self, number: f64) -> Option<f64> {
        let Some(Limit { median, limit }) = self.limit else {
            self.learnt.push(number);
            if self.missing() == 0 {
                self.limit = Some(self.limit_of_learnt());
            }
            return None;
        };
        if self.newest.len() == WINDOW {
            self.newest.pop_front();
        }
        self.newest.push_back(number);
        let beyond = self.newest.iter().copied();
        let mut beyond: Vec<f64> = beyond.filter(|number| *number > limit).collect();
        beyond.sort_unstable_by(f64::total_cmp);
        (beyond.len() >= self.rule.beyond).then(|| beyond[beyond.len() / 2] - median)
    }

    fn limit_of_learnt(&self) -> Limit {
        let mut sorted = self.learnt.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let count = sorted.len();
        let median = sorted[count / 2];
        // Excess that `reach` pictures of the run exceed or reach.
        let runs = self.learnt.windows(WINDOW).map(|run| {
            let mut run = run.to_vec();
            run.sort_unstable_by(f64::total_cmp);
            run[WINDOW - self.rule.reach] - median
        });
        let farthest = runs.fold(0.0, f64::max);
        let excess = self.least.max(RUNS * farthest);
        Limit {
            median,
            // The share of untouched pictures beyond the limit does not depend on the number of pictures.
            limit: sorted[count - (self.rule.rank * count / LEARNT).max(1)].max(median + excess),
        }
    }
}

/// Upper bound of the expected number of false alarms of one measured value in `pictures` untouched pictures. They must be exchangeable with the
/// pictures that set the limit.
///
/// The fraction of pictures above the k-th greatest of n values follows Beta(k, n + 1 − k), whatever their distribution. The number of pictures above
/// it in a window of [`WINDOW`] pictures is thus beta-binomial. The sum over all windows is an upper bound, because windows overlap.
pub(super) fn false_alarms(pictures: u64) -> f64 {
    let chance: f64 = (MOST.beyond..=WINDOW).map(chance_of).sum();
    pictures as f64 * chance
}

/// Probability that exactly `beyond` of [`WINDOW`] successive pictures exceed the limit.
fn chance_of(beyond: usize) -> f64 {
    let within = WINDOW - beyond;
    let rising = |from: usize, factors: usize| -> f64 {
        let factors = from..from + factors;
        factors.map(|factor| factor as f64).product()
    };
    let choices = rising(within + 1, beyond) / rising(1, beyond);
    let rank = MOST.rank;
    choices * rising(rank, beyond) * rising(LEARNT + 1 - rank, within) / rising(LEARNT + 1, WINDOW)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chances_of_all_numbers_of_pictures_add_up_to_one() {
        let sum: f64 = (0..=WINDOW).map(chance_of).sum();
        assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    }

    #[test]
    fn a_change_is_nineteen_of_thirty_pictures_beyond_the_limit() {
        let mut limited = Limited::by_most(0.05);
        for number in 0_u16..200 {
            assert_eq!(limited.missing(), 200 - usize::from(number));
            let number = number * 7 % 200;
            assert_eq!(limited.push(f64::from(number) / 2000.0), None);
        }
        let smallest = limited.smallest().expect("a limit");
        assert!((smallest - 0.05).abs() < 1e-12, "{smallest}");
        for _ in 1..MOST.beyond {
            assert_eq!(limited.push(0.3), None);
        }
        let excess = limited.push(0.3).expect("a change");
        assert!((excess - 0.25).abs() < 1e-12, "{excess}");
        // The first of them leaves the window at last.
        for _ in MOST.beyond..WINDOW {
            assert!(limited.push(0.09).is_some());
        }
        assert_eq!(limited.push(0.09), None);
    }

    #[test]
    fn slow_flicker_that_was_there_while_the_limit_was_set_is_no_change() {
        let mut limited = Limited::by_most(0.05);
        for number in 0..5000 {
            let flicker = 0.2 * (f64::from(number) * std::f64::consts::TAU / 200.0).sin();
            assert_eq!(limited.push(flicker), None, "{number}");
        }
    }

    #[test]
    fn three_strange_pictures_among_thirty_are_a_change_and_two_are_none() {
        let mut limited = Limited::by_some(0.1);
        for number in 0..200_u8 {
            assert_eq!(limited.push(f64::from(number % 5) / 100.0), None);
        }
        let smallest = limited.smallest().expect("a limit");
        assert!((smallest - 0.1).abs() < 1e-12, "{smallest}");
        for _ in 0..100 {
            let newest = [0.5, 0.5].into_iter().chain([0.04; 28]);
            let found: Vec<f64> = newest.filter_map(|number| limited.push(number)).collect();
            assert!(found.is_empty(), "{found:?}");
        }
        let found = [0.5, 0.5, 0.04, 0.5].map(|number| limited.push(number));
        let excess = found[3].expect("a change");
        assert!((excess - 0.48).abs() < 1e-12, "{excess}");
    }
}
