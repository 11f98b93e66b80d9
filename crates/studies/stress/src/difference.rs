//! Differences of two mean errors, with tests of significance.

use serde::Serialize;

use taceva_metrics::{Difference, decide};

/// Difference of two errors, with its test. Holm's procedure adjusts the test for the number of differences that are tested together.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ErrorDifference {
    /// Difference, in the unit of the channel, such as N for a force.
    pub value: Option<f64>,
    /// Ends of the interval of the difference; `None` if an end is infinite.
    pub interval: Option<[f64; 2]>,
    /// Confidence of the interval: 0.95 for one difference, and more if several are tested together.
    pub confidence: Option<f64>,
    /// p value, adjusted for the number of differences that are tested together.
    pub p: Option<f64>,
    /// True if the test shows that the difference is not 0.
    pub is_shown: bool,
    /// Reason why no difference was computed; `None` if there is one.
    pub reason: Option<String>,
}

/// Tests all differences in `tested` together by Holm's procedure. An entry that is a reason instead of a difference stays at its position.
pub(crate) fn decided(tested: Vec<Result<Difference, String>>) -> Vec<ErrorDifference> {
    let known = tested.iter().filter_map(|of| of.as_ref().ok());
    let mut family: Vec<Difference> = known.cloned().collect();
    decide(&mut family);
    let mut family = family.iter();
    let each = tested.into_iter().map(|of| match of {
        Ok(_) => family.next().map_or_else(ErrorDifference::default, shown),
        Err(reason) => ErrorDifference {
            reason: Some(reason),
            ..ErrorDifference::default()
        },
    });
    each.collect()
}

fn shown(of: &Difference) -> ErrorDifference {
    let interval = of.interval.iter().all(|end| end.is_finite());
    let interval = interval.then_some(of.interval);
    ErrorDifference {
        value: Some(of.value),
        interval,
        confidence: interval.map(|_| of.confidence),
        p: Some(of.adjusted_p),
        is_shown: of.is_shown,
        reason: None,
    }
}

#[cfg(test)]
mod tests {
    use taceva_metrics::{Estimate, Sides, by_intervals};

    use super::*;

    fn apart(b: f64) -> Result<Difference, String> {
        let of = |value| Estimate::try_new(value, 0.003, 32).expect("an estimate");
        let sides = Sides {
            a: of(0.041),
            b: of(b),
        };
        by_intervals(sides).map_err(|reason| reason.to_string())
    }

    #[test]
    fn reasons_keep_their_places_and_p_values_are_adjusted_for_tested_differences_alone() {
        let p = apart(0.055).expect("a difference").p;
        let all = decided(vec![apart(0.055), Err("no skill".to_owned()), apart(0.041)]);
        assert_eq!(all[0].p, Some(2.0 * p));
        assert!(all[0].is_shown && all[0].value < Some(0.0), "{all:?}");
        assert_eq!(all[1].reason.as_deref(), Some("no skill"));
        assert!(all[1].p.is_none() && !all[1].is_shown);
        assert!(all[2].reason.is_none() && !all[2].is_shown);
    }
}
