//! Laws for any samples: scaling by powers of two is exact, and the sign of an error does not matter.

use crate::support::rows::{Row, evaluate};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use taceva_metrics::{Interval, Value};

fn rows() -> impl Strategy<Value = Vec<Row>> {
    let row = (-2.0..2.0, -2.0..2.0, 0_u32..40);
    let row = row.prop_map(|(truth, prediction, point)| Row::same(truth, prediction, point));
    prop::collection::vec(row, 2..120)
}

fn value(rows: &[Row], metric: &str) -> f64 {
    let evaluation = evaluate(rows);
    let score = evaluation.score(metric, "Fx").expect("a score");
    score.value.scalar().expect("the samples determine it")
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 100,
        rng_seed: RngSeed::Fixed(2026),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_power_of_two_scales_errors_and_leaves_shares_alone(rows in rows(), power in -300..300) {
        let scale = 2.0_f64.powi(power);
        let scaled: Vec<Row> = rows
            .iter()
            .map(|row| Row {
                truth: row.truth.map(|value| value.map(|value| value * scale)),
                prediction: row.prediction.map(|value| value.map(|value| value * scale)),
                ..row.clone()
            })
            .collect();
        for (metric, factor) in [("mae", scale), ("bias", scale), ("rmse", scale), ("r2", 1.0)] {
            let expected = value(&rows, metric) * factor;
            prop_assert_eq!(value(&scaled, metric).to_bits(), expected.to_bits(), "{}", metric);
        }
    }

    #[test]
    fn swapping_truth_and_estimate_keeps_the_size_of_errors(rows in rows()) {
        let swapped: Vec<Row> = rows
            .iter()
            .map(|row| Row {
                truth: row.prediction,
                prediction: row.truth,
                point: row.point,
            })
            .collect();
        for metric in ["mae", "rmse", "smape"] {
            prop_assert_eq!(value(&swapped, metric).to_bits(), value(&rows, metric).to_bits());
        }
        prop_assert_eq!(value(&swapped, "bias").to_bits(), (-value(&rows, "bias")).to_bits());
    }

    #[test]
    fn a_plane_of_two_equal_axes_scores_like_one_axis(rows in rows()) {
        let evaluation = evaluate(&rows);
        for (metric, _, single) in evaluation.scores().filter(|(_, label, _)| *label == "Fx") {
            let plane = evaluation.score(metric.id, "Fxy").expect("a score of the plane");
            prop_assert_eq!(&plane.value, &single.value);
            prop_assert_eq!(plane.n, single.n);
            prop_assert_eq!(&plane.of, &["Fx", "Fy"]);
            // Both axes have the same clusters and shares, so the interval is the same, bit for bit.
            prop_assert_eq!(plane.interval, single.interval);
        }
    }

    #[test]
    fn an_interval_holds_its_value(rows in rows()) {
        for (_, _, score) in evaluate(&rows).scores() {
            if let (Value::Scalar(value), Interval::Jackknife { low, high, .. }) =
                (&score.value, &score.interval)
            {
                prop_assert!(low <= value && value <= high);
            }
        }
    }
}
