//! Confidence intervals and uncertainties of scores for limit checks, including the variance between trainings.

use taceva_metrics::{Scale, TrainingSpread, catalogue};
use taceva_metrology::conformity::Measurement;
use taceva_results::{Interval, Score};

use crate::compare::estimate_of;
use crate::results::Study;

/// Confidence interval of a score for a limit check.
#[derive(Clone, Debug)]
pub(super) struct LimitInterval {
    /// Both ends of the interval; `None` if the score has no interval.
    pub(super) ends: Option<[f64; 2]>,
    /// Number of trainings whose variance the interval includes; 0 if none.
    pub(super) trainings: usize,
    /// Value and its uncertainty on the scale of the interval, or the reason why the uncertainty is unknown.
    pub(super) measured: Result<Measurement, String>,
}

impl LimitInterval {
    /// Interval of `score`, or of its `variant` if given. Includes the variance between clusters and between trainings of the model.
    pub(super) fn of(study: &Study, score: &Score, variant: Option<&str>) -> LimitInterval {
        let values = study.values_of_trainings(&score.metric, variant, &score.channel);
        let spread = TrainingSpread::of_one(&values).filter(TrainingSpread::varies);
        let range = catalogue::find(&score.metric).filter(|_| variant.is_none());
        let [least, most] = range.map_or([f64::NEG_INFINITY, f64::INFINITY], |metric| {
            metric.range.ends()
        });
        let stated = score.interval.as_ref();
        let estimate = estimate_of(score).map(|estimate| match spread {
            Some(spread) => estimate.over_trainings(spread),
            None => estimate,
        });
        let ends = match (spread, &estimate) {
            (None, _) => stated.and_then(Interval::ends),
            (Some(_), Ok(estimate)) => {
                let [low, high] = estimate.ends();
                Some([low.max(least), high.min(most)])
            }
            (Some(_), Err(_)) => None,
        };
        let scale = stated.map_or(Scale::Own, Interval::scale);
        let measured = estimate.and_then(|estimate| {
            let known = score.value.number().zip(ends);
            let (value, ends) = known.ok_or_else(|| "no interval".to_owned())?;
            Measurement::of_interval(value, ends, estimate.freedom(), scale)
                .map_err(|error| error.to_string())
        });
        LimitInterval {
            ends,
            trainings: spread.and(ends).map_or(0, |_| values.len()),
            measured,
        }
    }
}
