//! Holm's procedure on families worked out by hand, in powers of 1/2 so that every product is exact.

use taceva_metrics::holm;

/// 1/64.
const PART: f64 = 0.015_625;

fn adjusted(p_values: &[f64]) -> Vec<f64> {
    holm(p_values).expect("p values")
}

#[test]
fn each_p_value_is_multiplied_by_the_tests_that_are_left() {
    let found = adjusted(&[4.0 * PART, PART, 2.0 * PART]);
    assert_eq!(found, [4.0 * PART, 3.0 * PART, 4.0 * PART]);
    let found = adjusted(&[PART, 16.0 * PART, 4.0 * PART, 2.0 * PART]);
    assert_eq!(found, [4.0 * PART, 16.0 * PART, 8.0 * PART, 6.0 * PART]);
}

#[test]
fn the_first_test_that_is_kept_keeps_all_after_it_though_they_alone_would_not_be() {
    // 2 × 0.04 exceeds a level of 0.05; 1 × 0.045 does not.
    let found = adjusted(&[0.045, 0.04]);
    assert_eq!(found, [0.08, 0.08]);
    // The smallest is rejected. The next one is kept, and so are the larger ones.
    let found = adjusted(&[PART / 4.0, 4.0 * PART, 4.0 * PART, 5.0 * PART]);
    assert_eq!(found, [PART, 12.0 * PART, 12.0 * PART, 12.0 * PART]);
}

#[test]
fn ties_share_the_factor_of_their_first() {
    let found = adjusted(&[PART, PART, PART, PART]);
    assert_eq!(found, [4.0 * PART; 4]);
    let found = adjusted(&[8.0 * PART, PART, 8.0 * PART]);
    assert_eq!(found, [16.0 * PART, 3.0 * PART, 16.0 * PART]);
}

#[test]
fn zero_stays_zero_one_stays_one_and_nothing_goes_beyond() {
    assert_eq!(adjusted(&[0.0, 1.0, 0.0]), [0.0, 1.0, 0.0]);
    assert_eq!(adjusted(&[0.5, 0.75]), [1.0, 1.0]);
    assert!(holm(&[0.0, 1.0_f64.next_up()]).is_err());
    assert!(holm(&[-f64::MIN_POSITIVE]).is_err());
}

#[test]
fn the_order_in_which_tests_are_named_changes_nothing() {
    let p_values = [PART, 3.0 * PART, PART, 0.5, 2.0 * PART];
    let expected = adjusted(&p_values);
    for turn in 0..p_values.len() {
        let mut turned = p_values;
        turned.rotate_left(turn);
        let mut found = adjusted(&turned);
        found.rotate_right(turn);
        assert_eq!(found, expected);
    }
}

#[test]
fn a_family_of_more_tests_never_makes_one_of_them_surer() {
    let family = [PART, 2.0 * PART, 6.0 * PART, 7.0 * PART];
    for length in 1..family.len() {
        let (fewer, more) = (adjusted(&family[..length]), adjusted(&family[..=length]));
        for (before, after) in fewer.iter().zip(more) {
            assert!(*before <= after, "{before} {after}");
        }
    }
}
