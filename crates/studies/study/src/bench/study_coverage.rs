//! Coverage of intervals: the share of repetitions with other seeds whose interval contains the expected error.

use serde::Serialize;
use taceva_metrics::Interval;

/// Number of repetitions whose interval contains the mean error of the other repetitions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct StudyCoverage {
    /// Mean over all repetitions of the mean absolute error, in the unit of the channel.
    pub mean: f64,
    /// Number of intervals that contain the mean error of the other repetitions.
    pub contained: u64,
    /// Number of repetitions with an interval.
    pub intervals: u64,
    /// 95 % interval (Wilson) of the coverage, `contained / intervals`.
    pub ci95: [f64; 2],
}

impl StudyCoverage {
    /// Coverage of `errors`, which has the error and the interval of each repetition. `None` without an interval, or with fewer than two repetitions.
    ///
    /// The mean of the other repetitions stands for the expected error. A mean that includes the repetition itself would lie closer to its interval.
    pub(super) fn of(errors: &[(f64, Option<[f64; 2]>)]) -> Option<StudyCoverage> {
        let others = errors.len().checked_sub(1).filter(|others| *others > 0)?;
        let sum: f64 = errors.iter().map(|(error, _)| error).sum();
        let (mut contained, mut intervals) = (0, 0);
        for (error, ends) in errors {
            let Some([low, high]) = ends else {
                continue;
            };
            let expected = (sum - error) / others as f64;
            intervals += 1;
            contained += u64::from((*low..=*high).contains(&expected));
        }
        let ci95 = (intervals > 0).then(|| Interval::wilson(contained, intervals).ends())?;
        Some(StudyCoverage {
            mean: sum / errors.len() as f64,
            contained,
            intervals,
            ci95: ci95?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_is_compared_with_the_mean_of_the_other_repetitions() {
        // Means of the others: 3, 2.5, 2, 1.5.
        let errors = [
            (0.0, Some([0.0, 2.9])),
            (1.5, Some([1.4, 2.5])),
            (3.0, None),
            (4.5, Some([1.5, 5.0])),
        ];
        let found = StudyCoverage::of(&errors).expect("three intervals");
        assert_eq!((found.contained, found.intervals), (2, 3));
        assert!((found.mean - 2.25).abs() < 1e-12, "{found:?}");
        assert!(found.ci95[0] < 2.0 / 3.0 && found.ci95[1] > 2.0 / 3.0);
    }

    #[test]
    fn one_repetition_and_repetitions_without_an_interval_have_no_coverage() {
        assert_eq!(StudyCoverage::of(&[(1.0, Some([0.5, 2.0]))]), None);
        assert_eq!(StudyCoverage::of(&[(1.0, None), (2.0, None)]), None);
        assert_eq!(StudyCoverage::of(&[]), None);
    }
}
