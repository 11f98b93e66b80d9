//! Intervals of scores for limits, with the variance between trainings.

use taceva_metrics::{TrainingSpread, catalogue};
use taceva_results::{Interval, Score};

use crate::compare::estimate_of;
use crate::results::Study;

/// Interval of a score for a limit.
#[derive(Clone, Copy, Debug)]
pub(super) struct LimitInterval {
    /// Both ends; `None` without an interval.
    pub(super) ends: Option<[f64; 2]>,
    /// Number of trainings whose variance it contains; 0 without any.
    pub(super) trainings: usize,
}

impl LimitInterval {
    /// Interval of `score`, whose value and interval are those of `variant` if there is one. The variance between the trainings of the model is
    /// added to that between clusters.
    pub(super) fn of(study: &Study, score: &Score, variant: Option<&str>) -> LimitInterval {
        let values = study.values_of_trainings(&score.metric, variant, &score.channel);
        let spread = TrainingSpread::of_one(&values).filter(TrainingSpread::varies);
        let Some(spread) = spread else {
            return LimitInterval {
                ends: score.interval.as_ref().and_then(Interval::ends),
                trainings: 0,
            };
        };
        let range = catalogue::find(&score.metric).filter(|_| variant.is_none());
        let [least, most] = range.map_or([f64::NEG_INFINITY, f64::INFINITY], |metric| {
            metric.range.ends()
        });
        let estimate = estimate_of(score).ok();
        let ends = estimate.map(|estimate| estimate.over_trainings(spread).ends());
        LimitInterval {
            ends: ends.map(|[low, high]| [low.max(least), high.min(most)]),
            trainings: ends.map_or(0, |_| values.len()),
        }
    }
}
