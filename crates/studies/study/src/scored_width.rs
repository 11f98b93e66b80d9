//! Width of the interval of a score, and the width expected with another number of contact points or of samples at each point.

use std::collections::BTreeMap;
use std::ops::Range;

use taceva_metrics::distributions::student_t;
use taceva_metrics::{HASHED_CLUSTERS, LEAST_CLUSTERS, NAMED_CLUSTERS, OneWay, plane_axes};
use taceva_protocol::{PhaseKind, WantedWidth};
use taceva_results::{EvaluationReport, Interval, SampleChannel, Samples};

/// Least degrees of freedom that are assumed for an interval by contact point.
const LEAST_FREEDOM: f64 = 3.0;
/// Probability below the upper end of a 95 % interval, for which the quantile of Student's t is taken.
const UPPER: f64 = 0.975;

/// Number of contact points from which a score is computed, and of samples at each point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestedPoints {
    /// Number of contact points.
    pub points: usize,
    /// Mean number of samples at a contact point.
    pub samples: f64,
}

/// Width of the 95 % interval of one score: upper end / lower end − 1. The variances of errors predict the width for other numbers of points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScoredWidth {
    tested: TestedPoints,
    /// Upper end / lower end of the interval.
    ratio: f64,
    freedom: f64,
    /// Variance of errors between contact points. Only the ratio to `within` matters.
    between: f64,
    /// Variance of errors among the samples of one contact point.
    within: f64,
}

/// Reason why a result has no width for a score.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NoWidth {
    /// The result lacks the score.
    #[error("no score `{0}`")]
    NoScore(String),
    /// The score has no interval.
    #[error("`{score}` has no interval: {reason}")]
    NoInterval {
        /// Name of the score, such as `mae.Fz`.
        score: String,
        /// Reason why the interval is missing.
        reason: String,
    },
    /// The lower end of the interval is 0, so the interval has no relative width.
    #[error("the interval of `{0}` reaches 0")]
    ReachesZero(String),
    /// The samples of the result were not found, or name no contact points.
    #[error("the result has no table of samples, or the table names no contact points")]
    NoSamples,
}

impl ScoredWidth {
    /// Width of the interval of the score `wanted` in `report`, with the variances of errors.
    ///
    /// # Errors
    /// [`NoWidth`] if `report` lacks the score, its interval or its samples.
    pub fn of(report: &EvaluationReport, wanted: &WantedWidth) -> Result<ScoredWidth, NoWidth> {
        let (ratio, freedom) = ratio(report, wanted)?;
        let freedom = freedom
            .ok_or_else(|| no_interval(wanted, "the result states no degrees of freedom"))?;
        let samples = report.samples.as_ref().ok_or(NoWidth::NoSamples)?;
        let axes = axes(samples, &wanted.channel);
        let errors = errors(samples, &axes, &wanted.metric);
        let readings: usize = errors.values().map(Vec::len).sum();
        if readings == 0 {
            return Err(NoWidth::NoSamples);
        }
        let of_sample = axes.len() as f64;
        // Without points of several samples, the spread within a point is unknown, so more samples count as useless.
        let [between, within] = OneWay::of(errors.values().map(Vec::as_slice))
            .map_or([1.0, 0.0], |model| {
                [model.between, model.within].map(|deviation| deviation * deviation)
            });
        Ok(ScoredWidth {
            tested: TestedPoints {
                points: errors.len(),
                samples: readings as f64 / of_sample / errors.len() as f64,
            },
            ratio,
            freedom,
            between,
            within: within / of_sample,
        })
    }

    /// Width of the interval of the score `wanted` in `report`: upper end / lower end − 1. The samples of the report are not needed.
    ///
    /// # Errors
    /// [`NoWidth`] if `report` lacks the score or its interval.
    pub fn reached(report: &EvaluationReport, wanted: &WantedWidth) -> Result<f64, NoWidth> {
        ratio(report, wanted).map(|(ratio, _)| ratio - 1.0)
    }

    /// Contact points from which the score was computed.
    pub fn tested(&self) -> TestedPoints {
        self.tested
    }

    /// Width of the interval: upper end / lower end − 1.
    pub fn width(&self) -> f64 {
        self.ratio - 1.0
    }

    /// Expected width with the number of points and samples in `tested`; `None` if the points are too few for an interval. Infinitely many samples at
    /// each point give the lower limit of the width for further presses at the same places.
    ///
    /// The interval is symmetric on a logarithmic scale. Its standard error is that of a mean over points with the variance s_b² + s_w²/m. Here s_b²
    /// is the variance between points, s_w² the variance within a point, and m the number of samples at each point.
    ///
    /// If the errors of points differ in size, g clusters leave ν < g − 1 degrees of freedom. The difference 1/ν − 1/(g − 1) is inversely
    /// proportional to the number of points.
    pub fn expected(&self, tested: TestedPoints) -> Option<f64> {
        if tested.points < LEAST_CLUSTERS {
            return None;
        }
        let growth = tested.points as f64 / self.tested.points as f64;
        let [least, own] =
            [tested, self.tested].map(|tested| 1.0 / (clusters(tested.points) as f64 - 1.0));
        let excess = (1.0 / self.freedom - own).max(0.0);
        let freedom = (1.0 / (least + excess / growth)).max(LEAST_FREEDOM);
        let variance = |samples: f64| self.between + self.within / samples;
        let share = match variance(self.tested.samples) {
            own if own > 0.0 => variance(tested.samples) / own,
            _ => 1.0,
        };
        let steps = [freedom, self.freedom].map(|freedom| student_t::quantile(UPPER, freedom));
        let factor = steps[0] / steps[1] * (share / growth).sqrt();
        Some(self.ratio.powf(factor) - 1.0)
    }

    /// Least number of contact points for an expected interval width of at most `width`. Each point has `samples` samples. `None` if `most` points do not suffice.
    pub fn needed(&self, width: f64, samples: f64, most: usize) -> Option<usize> {
        let reaches = |points: usize| {
            let expected = self.expected(TestedPoints { points, samples });
            expected.is_some_and(|expected| expected <= width)
        };
        // With one point more than `NAMED_CLUSTERS`, points share clusters, which gives fewer clusters and a wider interval.
        let named = LEAST_CLUSTERS..most.min(NAMED_CLUSTERS) + 1;
        let hashed = NAMED_CLUSTERS + 1..most + 1;
        let mut ranges = [named, hashed].into_iter();
        ranges.find_map(|range| first(range, reaches))
    }
}

/// Upper end / lower end of the interval of the score `wanted` in `report`, with the degrees of freedom if the report states them.
fn ratio(report: &EvaluationReport, wanted: &WantedWidth) -> Result<(f64, Option<f64>), NoWidth> {
    let score = report.score(&wanted.metric, &wanted.channel);
    let score = score.ok_or_else(|| NoWidth::NoScore(wanted.to_string()))?;
    match &score.interval {
        Some(Interval::Ends {
            ends: [low, high],
            degrees_of_freedom,
            ..
        }) if *low > 0.0 && high.is_finite() => Ok((high / low, *degrees_of_freedom)),
        Some(Interval::Ends { .. }) => Err(NoWidth::ReachesZero(wanted.to_string())),
        Some(Interval::Absent(reason)) => Err(no_interval(wanted, reason)),
        None => Err(no_interval(wanted, "the result states no interval")),
    }
}

fn no_interval(wanted: &WantedWidth, reason: &str) -> NoWidth {
    NoWidth::NoInterval {
        score: wanted.to_string(),
        reason: reason.to_owned(),
    }
}

/// Number of clusters into which an interval groups `points` contact points.
fn clusters(points: usize) -> usize {
    match points {
        ..=NAMED_CLUSTERS => points,
        _ => HASHED_CLUSTERS,
    }
}

/// First number in `range` for which `holds` is true; `None` without one. `holds` must then be true for every greater number.
fn first(range: Range<usize>, holds: impl Fn(usize) -> bool) -> Option<usize> {
    let (mut least, mut found) = (range.start, range.end.checked_sub(1)?);
    if found < least || !holds(found) {
        return None;
    }
    while least < found {
        let middle = least + (found - least) / 2;
        match holds(middle) {
            true => found = middle,
            false => least = middle + 1,
        }
    }
    Some(found)
}

/// Sample columns of `channel`, or of both axes if `channel` is a plane.
fn axes<'a>(samples: &'a Samples, channel: &str) -> Vec<SampleChannel<'a>> {
    match plane_axes(channel) {
        Some(axes) => axes
            .iter()
            .filter_map(|axis| samples.channel(axis))
            .collect(),
        None => samples.channel(channel).into_iter().collect(),
    }
}

/// Errors of the calibration presses by contact point, squared for `rmse` and absolute otherwise. The metric is their mean or its root.
fn errors<'a>(
    samples: &'a Samples,
    axes: &[SampleChannel<'_>],
    metric: &str,
) -> BTreeMap<&'a str, Vec<f64>> {
    let mut errors: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for row in samples.of_protocol(PhaseKind::Calibration.name()) {
        let Some(point) = samples.word("point_id", row) else {
            continue;
        };
        for [truth, prediction] in axes.iter().filter_map(|axis| axis.pair(row)) {
            let error = (truth - prediction).abs();
            let size = match metric {
                "rmse" => error * error,
                _ => error,
            };
            if size.is_finite() {
                errors.entry(point).or_default().push(size);
            }
        }
    }
    errors
}

#[cfg(test)]
mod tests;
