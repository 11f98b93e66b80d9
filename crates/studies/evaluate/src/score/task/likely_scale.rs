//! Detection of predictions that are probably in another unit than the truth: about a thousand times as large, or a thousandth.

use taceva_core::shown;
use taceva_tasks::pose::Pose;

use super::TaskSpec;

/// Minimum number of pairs of truth and prediction for a decision.
const LEAST_PAIRS: usize = 5;

/// Ratio of units with neighbouring prefixes, such as m and mm.
const THOUSAND: f64 = 1000.0;

/// Greatest factor between the median ratio and a thousand, or a thousandth.
const FACTOR: f64 = 1.5;

/// Least correlation of predictions that follow the truth. Noise near zero has no correlation.
const LEAST_CORRELATION: f64 = 0.7;

/// Truth and prediction of a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct VectorPair {
    pub(super) truth: [f64; 3],
    pub(super) predicted: [f64; 3],
}

impl VectorPair {
    /// Translations of a true and a predicted pose, mm.
    pub(super) fn of_poses(truth: &Pose, predicted: &Pose) -> VectorPair {
        VectorPair {
            truth: truth.translation_mm(),
            predicted: predicted.translation_mm(),
        }
    }
}

/// Ratio of predictions to the truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LikelyScale {
    /// Predictions are a thousandth of the truth.
    Thousandth,
    /// Predictions are a thousand times the truth.
    Thousand,
}

impl LikelyScale {
    /// Detects predictions that follow the truth, but are about 1000 times as large or 1/1000 as large. `None` for any other `pairs`.
    ///
    /// The median ratio ignores pairs in which the truth or the prediction is zero.
    pub(super) fn of(pairs: &[VectorPair]) -> Option<LikelyScale> {
        let ratios = pairs
            .iter()
            .map(|pair| length(pair.predicted) / length(pair.truth));
        let ratios: Vec<f64> = ratios
            .filter(|ratio| ratio.is_finite() && *ratio > 0.0)
            .collect();
        let median = median(ratios)?;
        let is_near = |scale: f64| (scale / FACTOR..=scale * FACTOR).contains(&median);
        let scale = match () {
            () if is_near(THOUSAND.recip()) => LikelyScale::Thousandth,
            () if is_near(THOUSAND) => LikelyScale::Thousand,
            () => return None,
        };
        (correlation(pairs) > LEAST_CORRELATION).then_some(scale)
    }

    /// Remark on the columns of `task`, with the option that states the unit.
    pub(super) fn remark(self, task: &TaskSpec) -> String {
        let name = shown(&task.name);
        let (size, units, unit) = match self {
            LikelyScale::Thousandth => ("a thousandth of the truth", "m beside mm", "m"),
            LikelyScale::Thousand => (
                "a thousand times the truth",
                "um beside mm, or mm beside m",
                "um",
            ),
        };
        let remedy = match &task.unit {
            None => format!(
                "state the unit of the predictions with --task {name}={}:unit={unit}, and write the truth in mm",
                task.kind.name()
            ),
            Some(stated) => format!(
                "correct :unit={} of --task {name}, and write the truth in mm",
                shown(stated)
            ),
        };
        format!(
            "the predictions in `{name}.x`, `{name}.y` and `{name}.z` follow the truth at about {size}, as {units} do: {remedy}"
        )
    }
}

fn length(vector: [f64; 3]) -> f64 {
    let squares = vector.map(|part| part * part);
    squares.iter().sum::<f64>().sqrt()
}

/// Median of `numbers`; `None` for fewer than [`LEAST_PAIRS`].
fn median(mut numbers: Vec<f64>) -> Option<f64> {
    if numbers.len() < LEAST_PAIRS {
        return None;
    }
    let middle = numbers.len() / 2;
    let (_, middle, _) = numbers.select_nth_unstable_by(middle, f64::total_cmp);
    Some(*middle)
}

/// Correlation of truth and prediction over all three axes, relative to the mean of each axis; NaN if either is constant.
fn correlation(pairs: &[VectorPair]) -> f64 {
    let n = pairs.len() as f64;
    let mut products = [0.0; 3];
    for axis in 0..3 {
        let mean = |of: fn(&VectorPair) -> [f64; 3]| {
            pairs.iter().map(|pair| of(pair)[axis]).sum::<f64>() / n
        };
        let of_truth = mean(|pair| pair.truth);
        let of_prediction = mean(|pair| pair.predicted);
        for pair in pairs {
            let truth = pair.truth[axis] - of_truth;
            let predicted = pair.predicted[axis] - of_prediction;
            products[0] += truth * truth;
            products[1] += predicted * predicted;
            products[2] += truth * predicted;
        }
    }
    products[2] / (products[0] * products[1]).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twenty places along a curve, each predicted by `predict` from its number and its truth.
    fn pairs(predict: impl Fn(u32, f64) -> f64) -> Vec<VectorPair> {
        let pair = |at: u32| {
            let at_mm = f64::from(at);
            let truth = [at_mm * 0.5 - 5.0, f64::from(at * 7 % 20), 0.1 * at_mm];
            VectorPair {
                truth,
                predicted: truth.map(|part| predict(at, part)),
            }
        };
        (0..20).map(pair).collect()
    }

    #[test]
    fn predictions_in_another_unit_follow_the_truth_at_a_thousand_times_its_size_or_a_thousandth() {
        let metres = pairs(|at, part| part / 1000.0 + f64::from(at % 3) * 1e-5);
        assert_eq!(LikelyScale::of(&metres), Some(LikelyScale::Thousandth));
        let micrometres = pairs(|_, part| part * 900.0);
        assert_eq!(LikelyScale::of(&micrometres), Some(LikelyScale::Thousand));
    }

    #[test]
    fn ordinary_predictions_noise_near_zero_and_few_rows_have_no_likely_scale() {
        let ordinary = pairs(|at, part| part * 0.9 + f64::from(at % 5) * 0.1);
        assert_eq!(LikelyScale::of(&ordinary), None);
        // As small as metres would be, but no sign follows the truth.
        let near_zero = pairs(|at, part| {
            let sign = if at * 13 % 7 < 3 { 1.0 } else { -1.0 };
            sign * part.abs() / 1000.0
        });
        assert_eq!(LikelyScale::of(&near_zero), None);
        let constant = pairs(|_, _| 0.008);
        assert_eq!(LikelyScale::of(&constant), None);
        let centimetres = pairs(|_, part| part / 10.0);
        assert_eq!(LikelyScale::of(&centimetres), None);
        let few = pairs(|_, part| part / 1000.0);
        assert_eq!(LikelyScale::of(&few[..4]), None);
    }
}
