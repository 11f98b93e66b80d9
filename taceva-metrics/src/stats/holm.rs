//! Multiple tests: Holm's procedure.

use super::error::ComparisonError;
use crate::exact::number_key::ranked;

/// Level of a family of tests: greatest probability that any test shows a difference by chance.
pub(super) const LEVEL: f64 = 0.05;

/// Adjusts the p values of a family of tests and returns them in the given order. If all adjusted values up to α are rejected, the probability of any
/// false rejection in the family is at most α.
///
/// The j-th smallest of m p values has the adjusted value max over i ≤ j of min(1, (m − i + 1) p₍ᵢ₎). Here p₍ᵢ₎ is the i-th smallest.
/// Adjusted values increase with p, and equal p values have equal adjusted values.
///
/// ```
/// let adjusted = taceva_metrics::holm(&[0.01, 0.04, 0.03])?;
/// assert_eq!(adjusted, [0.03, 0.06, 0.06]);
/// # Ok::<(), taceva_metrics::ComparisonError>(())
/// ```
///
/// # Errors
/// [`ComparisonError::Probability`] if a value is not in 0..=1.
///
/// # Reference
/// Holm, A simple sequentially rejective multiple test procedure, Scandinavian Journal of Statistics 6 (1979).
pub fn holm(p_values: &[f64]) -> Result<Vec<f64>, ComparisonError> {
    let steps = steps(p_values, LEVEL)?;
    Ok(steps.iter().map(|step| step.adjusted_p).collect())
}

/// Decision of Holm's procedure on one test of a family.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// Adjusted p value.
    pub(super) adjusted_p: f64,
    /// True if the null hypothesis is rejected. Verdict, p value and interval follow this decision.
    pub(super) is_rejected: bool,
    /// Level of the decision and of the interval.
    pub(super) level: f64,
}

/// Decision on each test, in the given order. The probability of any false rejection in the family is at most `level`.
///
/// The i-th smallest of m p values is decided at level / (m − i + 1). After the first test that is not rejected, all tests get the level of that
/// test. They are not rejected either, because their p values are larger.
///
/// # Errors
/// The errors of [`holm`].
pub(super) fn steps(p_values: &[f64], level: f64) -> Result<Vec<Step>, ComparisonError> {
    let outside = |p: &f64| !(0.0..=1.0).contains(p);
    if let Some(position) = p_values.iter().position(outside) {
        return Err(ComparisonError::Probability {
            position,
            value: p_values[position],
        });
    }
    let order = ranked(p_values.len(), &|left, right| {
        p_values[left].total_cmp(&p_values[right])
    });
    let undecided = Step {
        adjusted_p: 1.0,
        is_rejected: false,
        level,
    };
    let mut steps = vec![undecided; p_values.len()];
    let mut least = 0.0_f64;
    let mut tests_left = p_values.iter().fold(0.0, |tests, _| tests + 1.0);
    let mut level_of_the_first_kept = None;
    for position in order {
        least = least.max(tests_left * p_values[position]).min(1.0);
        let is_rejected = least <= level;
        let own = level / tests_left;
        if !is_rejected {
            level_of_the_first_kept.get_or_insert(own);
        }
        steps[position] = Step {
            adjusted_p: least,
            is_rejected,
            level: level_of_the_first_kept.unwrap_or(own),
        };
        tests_left -= 1.0;
    }
    Ok(steps)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn adjusted(p_values: &[f64]) -> Vec<f64> {
        holm(p_values).expect("p values")
    }

    #[test]
    fn a_worked_example_is_met() {
        // By hand: 4 × .005, 3 × .01, 2 × .03, then 1 × .04 = .04, which may not fall below .06.
        let expected = [0.03, 0.06, 0.06, 0.02];
        for (found, expected) in adjusted(&[0.01, 0.04, 0.03, 0.005]).iter().zip(expected) {
            assert!((found - expected).abs() < 1e-16, "{found}");
        }
    }

    #[test]
    fn each_test_has_the_level_of_its_step_and_the_first_that_is_kept_ends_them() {
        // .05 / 4, .05 / 3, then .03 > .05 / 2: kept, and .04 with it.
        let steps = steps(&[0.01, 0.04, 0.03, 0.005], 0.05).expect("p values");
        let found = steps.iter().map(|step| (step.is_rejected, step.level));
        let expected = [
            (true, 0.05 / 3.0),
            (false, 0.05 / 2.0),
            (false, 0.05 / 2.0),
            (true, 0.05 / 4.0),
        ];
        assert!(found.eq(expected), "{steps:?}");
    }

    #[test]
    fn a_p_value_of_just_the_level_is_rejected() {
        let found = steps(&[0.05], 0.05).expect("a p value");
        assert!(found[0].is_rejected);
        let found = steps(&[0.025, 0.05], 0.05).expect("p values");
        assert!(found[0].is_rejected && found[1].is_rejected);
        let above = f64::from_bits(0.05_f64.to_bits() + 1);
        assert!(!steps(&[above], 0.05).expect("a p value")[0].is_rejected);
    }

    #[test]
    fn ties_stay_ties_and_nothing_exceeds_one() {
        let found = adjusted(&[0.5, 0.02, 0.5, 0.02]);
        assert_eq!(found[0].to_bits(), 1.0_f64.to_bits());
        assert_eq!(found[1].to_bits(), found[3].to_bits());
        assert_eq!(found[1].to_bits(), 0.08_f64.to_bits());
    }

    #[test]
    fn no_test_and_one_test_are_as_they_were() {
        assert!(adjusted(&[]).is_empty());
        assert_eq!(adjusted(&[0.3])[0].to_bits(), 0.3_f64.to_bits());
    }

    #[test]
    fn what_is_no_probability_is_refused_by_its_place() {
        for value in [-0.1, 1.1, f64::NAN] {
            let error = holm(&[0.5, value]).expect_err("no probability");
            assert!(
                error
                    .to_string()
                    .ends_with("at position 1, expected 0 to 1"),
                "{error}"
            );
        }
    }
}
