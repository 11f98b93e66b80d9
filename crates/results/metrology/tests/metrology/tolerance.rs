//! Tolerance factors of the NIST e-Handbook and of printed tables.

use taceva_metrology::tolerance::{
    ToleranceInterval, least_n_one_sided, least_n_two_sided, one_sided_factor, two_sided_factor,
};

use crate::support::{case, close, number};

const ROWS: [(&str, f64, f64, f64); 6] = [
    ("n=43,P=0.9,conf=0.99", 43.0, 0.90, 0.99),
    ("n=10,P=0.95,conf=0.95", 10.0, 0.95, 0.95),
    ("n=20,P=0.95,conf=0.95", 20.0, 0.95, 0.95),
    ("n=30,P=0.99,conf=0.95", 30.0, 0.99, 0.95),
    ("n=46,P=0.95,conf=0.95", 46.0, 0.95, 0.95),
    ("n=100,P=0.99,conf=0.95", 100.0, 0.99, 0.95),
];

#[test]
fn two_sided_factors_are_exact() {
    let case = case("normal tolerance");
    for (name, n, share, confidence) in ROWS {
        let found = two_sided_factor(n, n - 1.0, share, confidence).expect("valid");
        // The reference stops at 1e-9.
        close(
            found,
            number(&case["own"][name], "/two_sided_exact"),
            1e-9,
            name,
        );
    }
}

#[test]
fn two_sided_factors_agree_with_a_calculation_in_thirty_digits() {
    for (n, share, confidence, expected) in [
        (43.0, 0.90, 0.99, 2.222_825_173_791_124),
        (10.0, 0.95, 0.95, 3.393_429_478_712_609),
    ] {
        let found = two_sided_factor(n, n - 1.0, share, confidence).expect("valid");
        close(found, expected, 1e-12, "k");
    }
}

#[test]
fn one_sided_factors_are_exact() {
    let case = case("normal tolerance");
    for (name, n, share, confidence) in ROWS {
        let found = one_sided_factor(n, n - 1.0, share, confidence).expect("valid");
        close(found, number(&case["own"][name], "/one_sided"), 1e-12, name);
    }
}

#[test]
fn a_factor_of_a_thousand_values_has_no_overflow() {
    let one = one_sided_factor(1e4, 9999.0, 0.99, 0.95).expect("valid");
    let two = two_sided_factor(1e4, 9999.0, 0.99, 0.95).expect("valid");
    assert!((2.32..2.40).contains(&one), "{one}");
    assert!((2.57..2.62).contains(&two), "{two}");
}

#[test]
fn extremes_need_as_many_values_as_tables_say() {
    let case = case("normal tolerance");
    for (share, name) in [(0.95, "two .95/.95"), (0.9, "two .90/.95")] {
        assert_eq!(
            least_n_two_sided(share, 0.95),
            case["nonparametric"][name].as_u64()
        );
    }
    assert_eq!(
        least_n_one_sided(0.95, 0.95),
        case["nonparametric"]["one .95/.95"].as_u64()
    );
    // One value has half of the distribution below it with a confidence of one half.
    assert_eq!(least_n_one_sided(0.5, 0.5), Some(1));
}

#[test]
fn arguments_out_of_range_have_no_factor() {
    assert_eq!(two_sided_factor(10.0, 9.0, 1.0, 0.95), None);
    assert_eq!(one_sided_factor(10.0, 0.0, 0.9, 0.95), None);
    assert_eq!(least_n_two_sided(0.95, f64::NAN), None);
    assert_eq!(ToleranceInterval::of(&[1.0], 0.95, 0.95), None);
    assert_eq!(ToleranceInterval::of(&[1.0, f64::NAN], 0.95, 0.95), None);
}

#[test]
fn equal_values_have_an_interval_of_no_width() {
    let found = ToleranceInterval::of(&[0.1; 5], 0.95, 0.95).expect("five values");
    assert_eq!((found.low, found.high, found.sd), (0.1, 0.1, 0.0));
}

#[test]
fn a_confidence_within_rounding_of_one_has_no_factor_and_ends() {
    let found = two_sided_factor(10.0, 9.0, 0.95, 1.0 - f64::EPSILON / 2.0);
    assert!(found.is_none_or(f64::is_finite), "{found:?}");
}
