//! Quantiles, compared with golden values of 18 to 25 digits.

use serde_json::Value;
use taceva_metrics::distributions::{chi_square, f_ratio, noncentral_t, normal, student_t};

use crate::support::{close, golden};

/// Arguments of a quantile, and its golden value.
fn row(row: &Value) -> (Vec<f64>, f64) {
    let cells = row.as_array().expect("a row");
    let arguments = cells.iter().map_while(Value::as_f64).collect();
    let golden = cells.iter().find_map(Value::as_str).expect("digits");
    (arguments, golden.parse().expect("a number"))
}

/// Compares each row of `table` with `found`.
fn hold(table: &str, rows: usize, relative: f64, found: impl Fn(&[f64]) -> f64) {
    let file = golden(include_str!("../golden/quantiles.json"));
    let all = file[table].as_array().expect("a table");
    assert_eq!(all.len(), rows, "{table}");
    for (arguments, expected) in all.iter().map(row) {
        close(
            found(&arguments),
            expected,
            relative,
            &format!("{table} {arguments:?}"),
        );
    }
}

#[test]
fn chi_square_quantiles_have_twelve_digits() {
    hold("chi2", 8, 1e-12, |at| chi_square::quantile(at[0], at[1]));
}

#[test]
fn student_quantiles_have_twelve_digits_up_to_a_million_degrees() {
    hold("t", 8, 1e-12, |at| student_t::quantile(at[0], at[1]));
}

#[test]
fn f_quantiles_have_twelve_digits() {
    hold("F", 4, 1e-12, |at| f_ratio::quantile(at[0], at[1], at[2]));
}

#[test]
fn detection_factors_have_twelve_digits() {
    hold("delta_noncentral_t", 6, 1e-12, |at| {
        noncentral_t::detection_factor(at[2], at[0], at[1])
    });
}

#[test]
fn one_sided_tolerance_factors_have_twelve_digits() {
    hold("k_one_sided", 3, 1e-12, |at| {
        let root = at[0].sqrt();
        noncentral_t::quantile(at[2], at[0] - 1.0, normal::quantile(at[1]) * root) / root
    });
}
