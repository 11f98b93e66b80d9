//! Families without intervals keep their sums once instead of by contact point, with the same scores and reasons.

use crate::support::rows::{Row, batch};
use taceva_core::{Channel, Channels, FieldSet};
use taceva_metrics::{
    Clusters, Evaluator, Interval, MetricPlan, State, UndefinedReason, catalogue,
};

/// Schemas of these families.
const WHOLE: [&str; 2] = ["taceva.joint/2", "taceva.levels/2"];

fn plan(channels: &[Channel]) -> MetricPlan {
    let channels = Channels::new(channels.iter().cloned()).expect("channels");
    let names = ["linearity", "crosstalk", "bias_level", "tolerance"];
    let wanted = catalogue::select(names).expect("known names");
    MetricPlan::new(&wanted, channels, FieldSet::PAIRS)
}

fn of_shear() -> Evaluator {
    Evaluator::new(&plan(&[Channel::FX, Channel::FY]))
}

/// Samples of `points` contact points, five of each.
fn rows(points: u32) -> Vec<Row> {
    let value = |row: u32, step: u32| f64::from(row * step % 101) * 0.02 - 1.0;
    let row = |row: u32| Row {
        truth: [Some(value(row, 37)), Some(value(row, 53))],
        prediction: [
            Some(value(row, 37) * 0.9 + 0.01),
            Some(value(row, 53) + value(row, 29) * 0.1),
        ],
        point: Some(row / 5),
    };
    (0..5 * points).map(row).collect()
}

fn states_of(rows: &[Row]) -> Vec<State> {
    let mut evaluator = of_shear();
    evaluator.update(&batch(rows)).expect("the plan's channels");
    evaluator.states().expect("nothing collected")
}

#[test]
fn greatest_values_are_kept_once_however_many_contact_points_there_are() {
    for points in [3, 400] {
        for state in states_of(&rows(points)) {
            let clusters = match state.clusters() {
                Clusters::Named(cells) => cells.len(),
                Clusters::Hashed(cells) => cells.len(),
                Clusters::Pooled(_) => panic!("every sample names its contact point"),
            };
            let expected = match WHOLE.contains(&state.schema()) {
                true => 1,
                false => points.min(32) as usize,
            };
            assert_eq!(clusters, expected, "{}", state.schema());
        }
    }
}

#[test]
fn why_a_greatest_value_has_no_interval_still_depends_on_contact_points() {
    let mut rows = rows(20);
    let reasons = |rows: &[Row]| {
        let mut evaluator = of_shear();
        rows.chunks(7)
            .for_each(|rows| evaluator.update(&batch(rows)).expect("the plan's channels"));
        let scores = evaluator.finish().expect("nothing collected");
        let of = |metric, channel| scores.score(metric, channel).map(|score| score.interval);
        [
            of("crosstalk", "all"),
            of("bias_level", "Fx"),
            of("linearity", "Fx"),
        ]
    };
    let undefined = |reason| [Some(Interval::Undefined(reason)); 3];
    assert_eq!(reasons(&rows), undefined(UndefinedReason::Greatest));
    for position in [0, 50, 99] {
        let point = rows[position].point.take();
        assert_eq!(reasons(&rows), undefined(UndefinedReason::NoClusters));
        rows[position].point = point;
    }
}
