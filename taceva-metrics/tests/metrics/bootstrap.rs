//! The Poisson bootstrap depends only on the set of samples, the seed and the number of replicates.

use crate::support::rows::{Row, batch, plan};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use taceva_metrics::{
    BootstrapEnds, Evaluation, Evaluator, Interval, IntervalMethod, PoissonBootstrap, Score,
    UndefinedReason,
};

const BOOTSTRAP: PoissonBootstrap = PoissonBootstrap::DEFAULT
    .with_replicates(200)
    .with_seed(1)
    .with_ends(BootstrapEnds::Percentile);

fn evaluator(bootstrap: PoissonBootstrap, rows: &[Row]) -> Evaluator {
    let method = IntervalMethod::PoissonBootstrap(bootstrap);
    let mut evaluator = Evaluator::new(&plan().with_interval_method(method));
    evaluator.update(&batch(rows)).expect("the plan's channels");
    evaluator
}

fn finish(evaluator: Evaluator) -> Evaluation {
    evaluator.finish().expect("the plan's channels")
}

fn intervals(evaluator: Evaluator) -> Vec<Interval> {
    let evaluation = finish(evaluator);
    evaluation
        .scores()
        .map(|(_, _, score)| score.interval)
        .collect()
}

fn score(evaluation: &Evaluation, metric: &str) -> Score {
    evaluation.score(metric, "Fx").cloned().expect("a score")
}

/// Rows of few locations, clustered by name, or of many, clustered by hash.
fn rows() -> impl Strategy<Value = Vec<Row>> {
    prop_oneof![Just(12_u32), Just(300_u32)].prop_flat_map(|points| {
        let row = (-2.0..2.0, -2.0..2.0, 0..points);
        let row = row.prop_map(|(truth, prediction, point)| Row::same(truth, prediction, point));
        prop::collection::vec(row, 5..200)
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 24,
        rng_seed: RngSeed::Fixed(2028),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn orders_and_merges_change_nothing(
        (rows, shuffled) in rows().prop_flat_map(|rows| (Just(rows.clone()), Just(rows).prop_shuffle())),
        cut in 0_usize..200,
    ) {
        // A weight that depends on the order of samples is in every replicate.
        let few = BOOTSTRAP.with_replicates(60);
        let expected = intervals(evaluator(few, &rows));
        let (left, right) = shuffled.split_at(cut.min(shuffled.len()));
        for [first, second] in [[left, right], [right, left]] {
            let mut merged = evaluator(few, first);
            merged.merge(evaluator(few, second)).expect("one plan");
            prop_assert_eq!(&intervals(merged), &expected);
        }
    }
}

/// Rows of `points` locations, with errors that depend on the location.
fn uneven(points: u32) -> Vec<Row> {
    let row = |row: u32| {
        let point = row % points;
        let error = f64::from(point * 37 % 11) * 0.1 + f64::from(row % 7) * 0.02;
        Row::same(f64::from(row % 23), f64::from(row % 23) + error, point)
    };
    (0..1200).map(row).collect()
}

#[test]
fn it_agrees_with_the_jackknife_on_a_smooth_score() {
    let many = BOOTSTRAP.with_replicates(2000);
    for points in [60, 600] {
        let rows = uneven(points);
        let jackknife = crate::support::rows::evaluate(&rows);
        let bootstrap = finish(evaluator(many, &rows));
        for metric in ["mae", "rmse", "r2"] {
            let errors = [&jackknife, &bootstrap].map(|of| match score(of, metric).interval {
                Interval::Jackknife { standard_error, .. }
                | Interval::Bootstrap { standard_error, .. } => standard_error,
                other => panic!("{metric}: {other:?}"),
            });
            // The deviation of 2,000 replicates is known to 1.6 %. With 32 clusters the two methods differ by a few per cent more.
            let quotient = errors[1] / errors[0];
            assert!(
                (quotient - 1.0).abs() < 0.1,
                "{metric} of {points}: {quotient}"
            );
        }
    }
}

#[test]
fn another_seed_gives_other_ends_and_the_same_value() {
    let rows = uneven(60);
    let first = score(&finish(evaluator(BOOTSTRAP, &rows)), "mae");
    let reseeded = BOOTSTRAP.with_seed(2);
    let second = score(&finish(evaluator(reseeded, &rows)), "mae");
    assert_eq!(first.value, second.value);
    assert_ne!(first.interval, second.interval);
}

#[test]
fn a_report_says_how_the_interval_was_found() {
    let evaluation = finish(evaluator(BOOTSTRAP, &uneven(600)));
    let method = score(&evaluation, "mae").interval.method();
    assert_eq!(
        method.as_deref(),
        Some("Poisson bootstrap by point_id (percentile), G=32, B=200, seed=1")
    );
    let normal = BOOTSTRAP.with_ends(BootstrapEnds::Normal);
    let interval = score(&finish(evaluator(normal, &uneven(60))), "mae").interval;
    let expected = "Poisson bootstrap by point_id (normal), G=60, B=200, seed=1, logarithmic";
    assert_eq!(interval.method().as_deref(), Some(expected));
}

#[test]
fn a_score_that_many_replicates_lack_has_no_interval_and_says_so() {
    // The truth varies at one of five locations only. R² has no value in replicates without that location, e⁻¹ of them.
    let rows: Vec<Row> = (0..50)
        .map(|row| {
            Row::same(
                if row % 5 == 0 { f64::from(row) } else { 1.0 },
                0.5,
                row % 5,
            )
        })
        .collect();
    let evaluation = finish(evaluator(BOOTSTRAP, &rows));
    let Interval::Undefined(reason) = score(&evaluation, "r2").interval else {
        panic!("an interval of what is often undefined");
    };
    let UndefinedReason::TooFewReplicates { defined, drawn } = reason else {
        panic!("{reason}");
    };
    // Within four standard deviations of 126.4, the expected number of 200.
    assert!(drawn == 200 && defined.abs_diff(126) <= 28, "{defined}");
    assert_eq!(
        reason.to_string(),
        format!("{defined} of 200 replicates have a value, 95 % and at least 39 are needed")
    );
    // All five clusters are left out in e⁻⁵ = 0.7 % of the replicates; the mean error has a value in the others.
    assert!(matches!(
        score(&evaluation, "mae").interval,
        Interval::Bootstrap { .. }
    ));
}

#[test]
fn samples_without_locations_have_no_bootstrap_either() {
    let mut rows = uneven(60);
    rows[7].point = None;
    let interval = score(&finish(evaluator(BOOTSTRAP, &rows)), "mae").interval;
    assert_eq!(interval, Interval::Undefined(UndefinedReason::NoClusters));
}
