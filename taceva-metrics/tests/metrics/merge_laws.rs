//! Splitting, order and merging change nothing: states are equal, and reports are equal byte by byte.

use crate::support::laws::{self, states};
use crate::support::rows::{Row, evaluator, plan};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use taceva_metrics::{Evaluator, ExactSum, MetricError, State};

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(2025),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Typical values, values of any magnitude, and NaN.
fn value() -> impl Strategy<Value = Option<f64>> {
    prop_oneof![
        6 => (-2.0..2.0).prop_map(Some),
        2 => any::<f64>().prop_map(Some),
        1 => Just(Some(f64::NAN)),
        1 => Just(None),
    ]
}

/// Rows of few or many locations; sometimes a row without a location.
fn rows() -> impl Strategy<Value = Vec<Row>> {
    let points = prop_oneof![Just(3_u32), Just(80_u32), Just(1000_u32)];
    (points, prop::bool::weighted(0.8)).prop_flat_map(|(points, all_named)| {
        let named = prop::bool::weighted(0.9).prop_map(move |named| named || all_named);
        let row = ([value(), value()], [value(), value()], 0..points, named);
        let row = row.prop_map(|(truth, prediction, point, named)| Row {
            truth,
            prediction,
            point: named.then_some(point),
        });
        prop::collection::vec(row, 0..150)
    })
}

proptest! {
    #![proptest_config(config(80))]

    #[test]
    fn a_whole_equals_its_merged_parts(rows in rows(), cut in any::<prop::sample::Index>()) {
        laws::a_whole_equals_its_merged_parts(&rows, cut.index(rows.len() + 1), evaluator);
    }

    #[test]
    fn one_by_one_and_backwards_is_the_same(rows in rows()) {
        let mut single = Evaluator::new(&plan());
        for row in rows.iter().rev() {
            single.update(&crate::support::rows::batch(std::slice::from_ref(row))).expect("the plan's channels");
        }
        prop_assert_eq!(states(single), states(evaluator(&rows)));
    }

    #[test]
    fn merging_is_commutative_and_associative_and_nothing_is_its_identity(
        a in rows(), b in rows(), c in rows(),
    ) {
        laws::merging_is_commutative_and_associative_and_nothing_is_its_identity([&a, &b, &c], evaluator);
    }

    #[test]
    fn a_state_that_was_written_and_read_is_the_same(rows in rows()) {
        laws::a_state_that_was_written_and_read_is_the_same(&rows, evaluator);
    }
}

proptest! {
    #![proptest_config(config(200))]

    #[test]
    fn what_was_merged_can_be_taken_away_again(
        kept in prop::collection::vec(-1e300..1e300, 0..20),
        moved in prop::collection::vec(any::<f64>().prop_filter("finite", |x| x.is_finite()), 0..20),
    ) {
        let sum = |values: &[f64]| {
            let mut sum: ExactSum = values.iter().copied().collect();
            values.windows(2).for_each(|pair| sum.add_product(pair[0], pair[1]));
            sum
        };
        let mut total = sum(&kept);
        total.merge(&sum(&moved));
        total.subtract(&sum(&moved));
        prop_assert_eq!(&total, &sum(&kept));
        prop_assert_eq!(total.to_canonical(), sum(&kept).to_canonical());
    }
}

#[test]
fn a_state_of_another_seed_is_refused() {
    let mut other = Evaluator::new(&plan().with_seed(7));
    let states = other.states().expect("nothing collected");
    let error = Evaluator::new(&plan())
        .merge_states(&states)
        .expect_err("another seed");
    assert!(
        matches!(error, MetricError::Parameter { .. }),
        "{error:?}: {error}"
    );
}

#[test]
fn a_broken_state_is_refused_and_changes_nothing() {
    let rows = [Row::same(1.0, 1.5, 0), Row::same(2.0, 1.5, 1)];
    let whole = serde_json::to_string(&states(evaluator(&rows))).expect("a state");
    let edits = [
        (
            r#""schema":"taceva.pairs/1""#,
            r#""schema":"taceva.pairs/9""#,
        ),
        (r#"["Fx","N"]"#, r#"["Fz","N"]"#),
        (r#""counts":[1,0,1]"#, r#""counts":[1,0]"#),
        (r#""named":{"#, r#""hashed":[],"x":{"#),
        (r#"["+","#, r#"["*","#),
        (r#"["+",68,[1]]"#, r#"["+",68,[0]]"#),
    ];
    for (from, to) in edits {
        let broken = whole.replacen(from, to, 1);
        assert_ne!(broken, whole, "{from} is in the state");
        let mut fresh = Evaluator::new(&plan());
        let refused = match serde_json::from_str::<Vec<State>>(&broken) {
            Ok(read) => fresh.merge_states(&read[..1]).is_err(),
            Err(_) => true,
        };
        assert!(refused, "{to} was taken");
        assert_eq!(states(fresh), states(Evaluator::new(&plan())), "{to}");
    }
}
