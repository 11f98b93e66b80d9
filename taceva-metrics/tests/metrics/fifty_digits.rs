//! Scores of sixty ordinary tables, compared with true values of fifty digits.
//!
//! The tables are recipes. `tests/golden/make_tables.py` computes the digits in rational arithmetic.

use std::collections::BTreeMap;

use serde_json::Value;
use taceva_metrics::bench::{Case, Kind, Order};
use taceva_metrics::{Channel, Evaluator};

/// Distance of a score from the rounded true value, in units in the last place.
fn apart(found: f64, truth: f64) -> u64 {
    found.to_bits().abs_diff(truth.to_bits())
}

/// Compared scores: the least number of the sixty that equal the rounded true value, and the greatest distance of the others, in units in the
/// last place.
const BOUNDS: [(&str, usize, u64); 4] = [
    ("mae", 50, 1),
    ("rmse", 50, 1),
    ("r2", 50, 1),
    ("smape", 40, 1),
];

#[test]
fn scores_of_sixty_tables_are_the_true_values_rounded_once_or_their_neighbours() {
    let text = include_str!("../golden/tables.json");
    let file: Value = serde_json::from_str(text).expect("a golden file");
    let tables = file["tables"].as_array().expect("a list");
    assert_eq!(tables.len(), 60);
    let mut found: BTreeMap<&str, Vec<u64>> = BTreeMap::new();
    for table in tables {
        let number = |key: &str| table[key].as_f64().expect("a number");
        let count = |key: &str| table[key].as_u64().expect("a count");
        // The digits of a decimal beyond binary64 decide its rounding.
        let truth = |key: &str| -> f64 {
            let digits = table[key].as_str().expect("digits");
            digits.parse().expect("a number")
        };
        let columns = Case {
            kind: Kind::Lab {
                low: number("low"),
                high: number("high"),
                noise: number("noise"),
            },
            rows: usize::try_from(count("rows")).expect("small"),
            seed: count("seed"),
            order: Order::AsMade,
        }
        .columns();
        let mut evaluator = Evaluator::of_channels([Channel::FZ]).expect("one channel");
        evaluator
            .update_pairs(Channel::FZ, &columns.reference, &columns.estimate)
            .expect("one length");
        let evaluation = evaluator.finish().expect("finished");
        let score = |metric: &str| {
            let score = evaluation.score(metric, "Fz").expect("scored");
            score.value.scalar().expect("a number")
        };
        for (metric, _, _) in BOUNDS {
            let off = apart(score(metric), truth(metric));
            found.entry(metric).or_default().push(off);
        }
        // A mean of errors of both signs cancels: its error is the rounding of a residual.
        let off = (score("bias") - truth("bias")).abs();
        assert!(off <= f64::EPSILON / 2.0 * 12.5, "bias {off:e}");
        let once = u64::from(score("bias").to_bits() != truth("bias").to_bits());
        found.entry("bias").or_default().push(once);
    }
    for (metric, all) in &found {
        let right = all.iter().filter(|off| **off == 0).count();
        let most = all.iter().max().expect("sixty");
        println!("{metric}: {right} of 60 are the true value rounded once, {most} off at most");
    }
    for (metric, least, most) in BOUNDS {
        let all = &found[metric];
        let right = all.iter().filter(|off| **off == 0).count();
        assert!(right >= least, "{metric}: {right} of 60");
        assert!(all.iter().all(|off| *off <= most), "{metric}: {all:?}");
    }
}

#[test]
fn a_root_of_squares_that_no_binary64_holds_is_a_number() {
    for (scale, error) in [(1e-310, 0.5e-310), (1e300, 0.5e300), (1e-200, 0.25e-200)] {
        let mut evaluator = Evaluator::of_channels([Channel::FZ]).expect("one channel");
        let truth = [scale, 2.0 * scale, 3.0 * scale];
        let estimate = truth.map(|value| value - error);
        evaluator
            .update_pairs(Channel::FZ, truth, estimate)
            .expect("one length");
        let evaluation = evaluator.finish().expect("finished");
        let score = |metric: &str| {
            let score = evaluation.score(metric, "Fz").expect("scored");
            score.value.scalar().unwrap_or(f64::NAN)
        };
        let (rmse, mae) = (score("rmse"), score("mae"));
        assert!(
            (rmse / mae - 1.0).abs() < 1e-9,
            "{scale:e}: {rmse:e} {mae:e}"
        );
    }
}

#[test]
fn values_that_are_too_large_for_a_millionth_are_said_to_be_so_and_not_to_be_absent() {
    let mut evaluator = Evaluator::of_channels([Channel::FZ]).expect("one channel");
    evaluator
        .update_pairs(Channel::FZ, [1e16, 2e16, 3e16], [1e16, 2e16, 3.5e16])
        .expect("one length");
    let evaluation = evaluator.finish().expect("finished");
    for metric in ["tolerance", "bias_level"] {
        let score = evaluation.score(metric, "Fz").expect("scored");
        let taceva_metrics::Value::Undefined(reason) = score.value else {
            panic!("{metric}: {:?}", score.value);
        };
        let said = "no value is known to a millionth of its unit";
        assert_eq!(reason.to_string(), said, "{metric}");
    }
}
