//! Power of a family of tests: computes the number of sign flips, and detects families that cannot show a difference.

use taceva_metrics::{Difference, SignFlip};

/// Significance level of the family.
const LEVEL: f64 = 0.05;
/// Number of sign flips of a test, divided by the number of tests. The least p value is then half of the first step of Holm's procedure, which is
/// `LEVEL` divided by the number of tests.
const FLIPS_A_TEST: usize = 40;
/// Limit on the flips of all tests together. Each flip takes 16 bytes until the family is decided.
const MOST_FLIPS: usize = 1 << 24;

/// Number of sign flips for each of `tests` tests: enough for the first step of Holm's procedure, but limited by `MOST_FLIPS`.
pub(super) fn flips_of(tests: usize) -> u32 {
    let wanted = tests
        .saturating_mul(FLIPS_A_TEST)
        .max(SignFlip::default().flips as usize);
    let most = (MOST_FLIPS / tests.max(1)).max(1);
    u32::try_from(wanted.min(most)).unwrap_or(u32::MAX)
}

/// Message for a family in which no test can have a p value below the first step of Holm's procedure; otherwise `None`. Only sign-flip tests have a least p
/// value.
pub(super) fn out_of_reach(family: &[Difference]) -> Option<String> {
    let step = LEVEL / family.len() as f64;
    let least = family.iter().map(|difference| difference.test.least_p());
    let least = least.min_by(f64::total_cmp)?;
    (least > step).then(|| {
        format!(
            "No difference can be shown here: the first of {} tests needs p ≤ {step:.2e}, but the smallest p with so few contact points \
             or flips is {least:.2e}. Sweep fewer configurations, press more points, or compare two results with taceva compare.",
            family.len()
        )
    })
}

#[cfg(test)]
mod tests {
    use taceva_metrics::{ClusterSums, Sides, decide};

    use super::*;

    fn sums(points: u32, errors: impl Fn(u32) -> f64) -> ClusterSums {
        let mut sums = ClusterSums::default();
        for point in 0..points {
            sums.try_add(&format!("p{point}"), errors(point))
                .expect("finite");
        }
        sums
    }

    fn family(tests: usize, points: u32) -> Vec<Difference> {
        let (a, b) = (
            sums(points, |_| 1.0),
            sums(points, |point| 2.0 + f64::from(point)),
        );
        let test = SignFlip::default().with_flips(flips_of(tests));
        let one = test.test(Sides { a: &a, b: &b }).expect("a test");
        let mut family = vec![one; tests];
        decide(&mut family);
        family
    }

    #[test]
    fn a_larger_family_has_more_flips_so_that_a_plain_difference_is_shown() {
        assert_eq!(flips_of(1), 10_000);
        assert_eq!(flips_of(600), 24_000);
        let family = family(600, 40);
        assert!(family.iter().all(|difference| difference.is_shown));
        assert_eq!(out_of_reach(&family), None);
    }

    #[test]
    fn a_family_in_which_nothing_can_be_shown_says_so() {
        // With 2^8 sign patterns, the least p is 2/256. Holm's first step of ten tests requires 0.005.
        let family = family(10, 8);
        assert!(family.iter().all(|difference| !difference.is_shown));
        let words = out_of_reach(&family).expect("out of reach");
        assert!(words.contains("No difference can be shown"), "{words}");
        assert_eq!(out_of_reach(&[]), None);
    }
}
