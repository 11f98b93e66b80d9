//! Scores compared with fractions of small integers, rounded by long division, and the text of a report.

use crate::support::rows::{Row, evaluate};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// The binary64 nearest to a fraction, ties to even, by plain long division.
fn nearest(numerator: i128, denominator: i128) -> f64 {
    let negative = (numerator < 0) != (denominator < 0);
    let (numerator, denominator) = (numerator.unsigned_abs(), denominator.unsigned_abs());
    if numerator == 0 {
        return 0.0;
    }
    // Scale the fraction into 2^52..2^53 and count the powers of two.
    let (mut top, mut bottom, mut exponent) = (numerator, denominator, 0);
    while top / bottom < 1 << 52 {
        top *= 2;
        exponent -= 1;
    }
    while top / bottom >= 1 << 53 {
        bottom *= 2;
        exponent += 1;
    }
    let (whole, rest) = (top / bottom, top % bottom);
    let up = rest * 2 > bottom || (rest * 2 == bottom && whole % 2 == 1);
    let mantissa = (whole + u128::from(up)) as f64;
    let magnitude = mantissa * 2.0_f64.powi(exponent);
    if negative { -magnitude } else { magnitude }
}

/// True if `root` is the binary64 nearest to √(squared / n): the root is between the midpoints to both neighbours.
fn is_nearest_root(root: f64, squared: i128, n: i128) -> bool {
    if squared == 0 {
        return root.to_bits() == 0;
    }
    let field = i32::try_from(root.to_bits() >> 52).expect("a positive number");
    let mantissa = i128::from(root.to_bits() & ((1 << 52) - 1) | 1 << 52);
    // root = mantissa × 2^exponent; the exponent is negative for roots below 2^53.
    let places = 2 * (1075 - field);
    let scaled = (4 * squared) << places;
    let half = |doubled: i128| n * doubled * doubled;
    half(2 * mantissa - 1) <= scaled && scaled <= half(2 * mantissa + 1)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300,
        rng_seed: RngSeed::Fixed(2027),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn scores_of_integers_are_their_fractions_rounded_once(
        pairs in prop::collection::vec((-5000_i32..5000, -5000_i32..5000), 2..60),
    ) {
        let rows: Vec<Row> = pairs
            .iter()
            .map(|&(truth, prediction)| Row::same(truth.into(), prediction.into(), 0))
            .collect();
        let evaluation = evaluate(&rows);
        let value = |metric| {
            let score = evaluation.score(metric, "Fx").expect("a score");
            score.value.scalar()
        };
        let sum = |term: fn(i128, i128) -> i128| -> i128 {
            pairs.iter().map(|&(truth, prediction)| term(truth.into(), prediction.into())).sum()
        };
        let n = pairs.len() as i128;
        let squared = sum(|y, p| (y - p) * (y - p));
        let spread = n * sum(|y, _| y * y) - sum(|y, _| y) * sum(|y, _| y);
        let same = |found: Option<f64>, expected: Option<f64>| {
            found.map(f64::to_bits) == expected.map(f64::to_bits)
        };
        prop_assert!(same(value("mae"), Some(nearest(sum(|y, p| (y - p).abs()), n))));
        prop_assert!(same(value("bias"), Some(nearest(sum(|y, p| y - p), n))));
        prop_assert!(value("rmse").is_some_and(|root| is_nearest_root(root, squared, n)));
        let r2 = (spread != 0).then(|| nearest(spread - n * squared, spread));
        prop_assert!(same(value("r2"), r2));
    }
}

#[test]
fn a_hand_calculation_in_three_samples() {
    // Truth 1, 2, 3; prediction 1.5, 2, 2: errors .5, 0, 1.
    let rows = [(1.0, 1.5), (2.0, 2.0), (3.0, 2.0)];
    let rows: Vec<Row> = rows.map(|(y, p)| Row::same(y, p, 0)).to_vec();
    let evaluation = evaluate(&rows);
    let value = |metric, label| {
        let score = evaluation.score(metric, label).expect("a score");
        score.value.scalar().expect("a number")
    };
    let close = |found: f64, expected: f64| {
        assert!((found - expected).abs() < 1e-7, "{found} is not {expected}");
    };
    close(value("mae", "Fx"), 0.5);
    close(value("bias", "Fx"), 0.5 / 3.0);
    close(value("rmse", "Fx"), (1.25_f64 / 3.0).sqrt());
    close(value("r2", "Fx"), 1.0 - 1.25 / 2.0);
    close(value("smape", "Fx"), (0.4 + 0.0 + 0.4) / 3.0);
    close(value("mae_euclid", "Fxy"), 0.5 * 2.0_f64.sqrt());
}

#[test]
fn a_report_has_the_keys_that_scripts_rely_on() {
    let rows: Vec<Row> = (0_u32..5)
        .map(|row| Row::same(f64::from(row), f64::from(row) + 0.25, row))
        .collect();
    let report = serde_json::to_value(evaluate(&rows)).expect("a report");
    assert_eq!(
        report["metrics"]["mae"]["Fxy"],
        serde_json::json!({
            "value": 0.25, "unit": "N", "of": ["Fx", "Fy"], "n": 5, "n_invalid": 0,
            "ci95": [0.25, 0.25], "method": "jackknife by point_id, G=5, logarithmic",
            "standard_error": 0.0, "clusters": 5, "degrees_of_freedom": 4.0, "definition": "mae/1", "better": "lower",
            "flags": ["equal clusters"], "standing": "skill unknown"
        })
    );
    assert_eq!(
        report["metrics"]["smape_gated"]["Fx"]["parameters"],
        serde_json::json!({"eps": 1e-8, "gate": 0.02})
    );
    assert_eq!(report["skipped"], serde_json::json!([]));
    let undefined = serde_json::to_value(evaluate(&rows[..1])).expect("a report");
    assert_eq!(
        undefined["metrics"]["r2"]["Fx"],
        serde_json::json!({
            "undefined": "fewer than 2 samples", "n": 1, "n_invalid": 0, "definition": "r2/1",
            "better": "higher", "standing": "skill unknown"
        })
    );
    assert_eq!(
        undefined["metrics"]["mae"]["Fx"]["ci95"],
        serde_json::json!({"undefined": "1 cluster, 5 are needed"})
    );
}
