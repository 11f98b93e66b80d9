//! Periodic angles: an error is the shortest difference over all whole periods.

use std::collections::BTreeMap;

use taceva_core::{Channel, Channels, FieldSet, Unit};
use taceva_metrics::{Evaluator, MetricError, MetricPlan, Rows, catalogue};

fn yaw() -> Channel {
    Channel::named("yaw", Unit::Degree).expect("a plain name")
}

fn scalar(evaluator: &mut Evaluator, metric: &str, channel: &str) -> f64 {
    let scores = evaluator.score().expect("scored");
    let score = scores.score(metric, channel).expect("a score");
    score.value.scalar().expect("a number")
}

const TRUTH: [f64; 4] = [179.0, -179.0, 90.0, 10.0];
const PREDICTION: [f64; 4] = [-178.0, 178.0, 92.0, 371.0];

#[test]
fn errors_of_an_angle_with_a_period_are_the_short_way_round() {
    let periodic = yaw().with_period(360).expect("an angle");
    let mut evaluator = Evaluator::of_channels([periodic]).expect("a plan");
    evaluator
        .update_pairs(periodic, TRUTH, PREDICTION)
        .expect("taken in");
    // Errors of 3, -3, 2 and 1 degrees.
    for (metric, expected) in [("mae", 2.25), ("bias", -0.75), ("rmse", 5.75_f64.sqrt())] {
        let found = scalar(&mut evaluator, metric, "yaw");
        assert!((found - expected).abs() < 1e-12, "{metric} {found}");
    }
    let mut plain = Evaluator::of_channels([yaw()]).expect("a plan");
    plain
        .update_pairs(yaw(), TRUTH, PREDICTION)
        .expect("taken in");
    assert!(scalar(&mut plain, "mae", "yaw") > 200.0);
}

#[test]
fn other_channels_beside_an_angle_with_a_period_are_as_they_were_to_the_bit() {
    let periodic = yaw().with_period(360).expect("an angle");
    let forces = [0.1, 0.7, 1.3, 2.9];
    let answers = [0.15, 0.65, 1.9, 500.3];
    let of = |channel: Channel| {
        let mut evaluator = Evaluator::of_channels([Channel::FZ, channel]).expect("a plan");
        let rows = Rows::new()
            .pairs(Channel::FZ, forces, answers)
            .pairs(channel, TRUTH, PREDICTION);
        evaluator.update_rows(rows).expect("taken in");
        ["mae", "rmse", "r2", "bias"].map(|metric| scalar(&mut evaluator, metric, "Fz").to_bits())
    };
    assert_eq!(of(periodic), of(yaw()));
}

#[test]
fn an_angle_that_never_leaves_half_a_period_scores_as_without_one_to_the_bit() {
    let periodic = yaw().with_period(180).expect("an angle");
    let truth = [1.0, 20.5, 33.3, 47.1];
    let prediction = [1.7, 19.9, 36.4, 44.0];
    let of = |channel: Channel| {
        let mut evaluator = Evaluator::of_channels([channel]).expect("a plan");
        evaluator
            .update_pairs(channel, truth, prediction)
            .expect("taken in");
        ["mae", "rmse", "r2", "bias"].map(|metric| scalar(&mut evaluator, metric, "yaw").to_bits())
    };
    assert_eq!(of(periodic), of(yaw()));
}

#[test]
fn states_with_and_without_a_period_do_not_merge() {
    let periodic = yaw().with_period(360).expect("an angle");
    let mut one = Evaluator::of_channels([periodic]).expect("a plan");
    let mut other = Evaluator::of_channels([yaw()]).expect("a plan");
    let states = other.states().expect("states");
    let refused = one.merge_states(&states).expect_err("refused");
    assert!(
        matches!(refused, MetricError::Parameter { .. }),
        "{refused}"
    );
}

#[test]
fn the_spread_of_an_angle_about_a_known_mean_is_that_of_its_directions() {
    let periodic = yaw().with_period(360).expect("an angle");
    let truth = [170.0, -170.0, 176.0, -176.0];
    let prediction = [172.0, -172.0, -179.0, 179.0];
    let metrics = ["mae", "r2"].map(|id| catalogue::find(id).expect("in the catalogue"));
    let channels = Channels::new([periodic]).expect("one");
    let plan = MetricPlan::new(&metrics, channels, FieldSet::PAIRS);
    let centre = BTreeMap::from([("yaw".to_owned(), 180.0)]);
    let plan = plan.with_constants(centre).expect("known channels");
    let mut evaluator = Evaluator::new(&plan);
    evaluator
        .update_pairs(periodic, truth, prediction)
        .expect("taken in");
    assert!((scalar(&mut evaluator, "mae", "yaw") - 3.5).abs() < 1e-12);
    // Errors 2, -2, 5, -5; truth -10, 10, -4, 4 about 180.
    let r2 = 1.0 - 58.0 / 232.0;
    assert!((scalar(&mut evaluator, "r2", "yaw") - r2).abs() < 1e-12);
}
