//! Finds tests that cannot show any difference, because they have too few groups.

use taceva_metrics::{Difference, DifferenceTest, SignFlip, holm};

use crate::number::significant;

/// Significance level of a family of tests.
const LEVEL: f64 = 0.05;

/// Reason, for each test of `family`, why it cannot show any difference; `None` if it can.
///
/// An adjusted p value increases with each p value of the family. The least possible p values therefore give the least adjusted p values.
pub(super) fn out_of_reach(family: &[Difference]) -> Vec<Option<String>> {
    let tests = family.iter().map(|difference| difference.test);
    let tests: Vec<DifferenceTest> = tests.collect();
    let least: Vec<f64> = tests.iter().map(|test| test.least_p()).collect();
    // Without an adjustment there is no claim either.
    let adjusted = holm(&least).unwrap_or_else(|_| vec![0.0; least.len()]);
    let each = tests.iter().zip(adjusted);
    each.map(|(test, adjusted)| words(*test, adjusted, tests.len()))
        .collect()
}

/// Reason as text: `5 groups cannot show a difference: the smallest possible p is 0.0625; 6 groups or more can`.
fn words(test: DifferenceTest, adjusted: f64, tests: usize) -> Option<String> {
    let DifferenceTest::SignFlip { clusters, .. } = test else {
        return None;
    };
    if adjusted <= LEVEL {
        return None;
    }
    let of_family = match tests {
        1 => String::new(),
        _ => format!(", {} by Holm over {tests} tests", significant(adjusted)),
    };
    let can = |groups: &usize| sign_flips(*groups).least_p() * tests as f64 <= LEVEL;
    let remedy = match (5..32).find(can) {
        Some(groups) => format!("{groups} groups or more can"),
        None => "compare fewer results".to_owned(),
    };
    Some(format!(
        "{clusters} groups cannot show a difference: the smallest possible p is {}{of_family}; {remedy}",
        significant(test.least_p())
    ))
}

/// Sign-flip test over `clusters` groups, fewer than 32.
fn sign_flips(clusters: usize) -> DifferenceTest {
    let (patterns, most) = (1_u32 << clusters, SignFlip::default().flips);
    DifferenceTest::SignFlip {
        clusters,
        flips: patterns.min(most),
        exhaustive: patterns <= most,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(clusters: usize) -> DifferenceTest {
        DifferenceTest::SignFlip {
            clusters,
            flips: 1 << clusters,
            exhaustive: true,
        }
    }

    #[test]
    fn the_groups_that_a_larger_family_needs_are_named() {
        assert_eq!(
            words(of(5), 0.125, 2).as_deref(),
            Some(
                "5 groups cannot show a difference: the smallest possible p is 0.0625, 0.125 by Holm over 2 tests; 7 groups or more can"
            )
        );
        assert_eq!(words(of(7), 0.03125, 2), None);
    }

    #[test]
    fn a_family_that_no_number_of_groups_helps_is_to_be_smaller() {
        let words = words(of(12), 1.0, 2000).expect("out of reach");
        assert!(words.ends_with("; compare fewer results"), "{words}");
    }
}
