//! What no score has an interval of is kept once and not by contact point: scores, reasons and states of before stay what they were.

mod support;

use serde_json::Value;
use support::{Row, batch};
use taceva_core::{Channel, Channels, FieldSet};
use taceva_metrics::{
    Clusters, Evaluator, Interval, MetricPlan, State, UndefinedReason, catalogue,
};

/// The schemas of what is kept once.
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

/// Samples of so many contact points, five of each.
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

fn scores_of(evaluator: Evaluator) -> Value {
    let evaluation = evaluator.finish().expect("nothing collected");
    serde_json::to_value(&evaluation).expect("scores")
}

#[test]
fn states_that_an_earlier_version_wrote_give_the_scores_that_it_gave() {
    let text = include_str!("golden/earlier_states.json");
    let earlier: Value = serde_json::from_str(text).expect("JSON");
    let states: Vec<State> = serde_json::from_value(earlier["states"].clone()).expect("states");
    let schemas: Vec<&str> = states.iter().map(State::schema).collect();
    assert!(schemas.contains(&"taceva.joint/1") && schemas.contains(&"taceva.levels/1"));
    let mut evaluator = Evaluator::new(&plan(&Channel::SIX));
    evaluator.merge_states(&states).expect("states of the plan");
    let again = evaluator.states().expect("nothing collected");
    assert_eq!(scores_of(evaluator), earlier["evaluation"]);
    let mut merged = Evaluator::new(&plan(&Channel::SIX));
    merged.merge_states(&again).expect("states of the plan");
    assert_eq!(scores_of(merged), earlier["evaluation"]);
}

#[test]
fn a_state_of_clusters_by_hash_joins_a_later_one_to_the_state_of_all() {
    let rows = rows(100);
    let (some, others) = rows.split_at(230);
    let earlier = |state: State| {
        let mut text = serde_json::to_value(&state).expect("a state");
        let (schema, before) = match state.schema() {
            "taceva.joint/2" => ("taceva.joint/2", "taceva.joint/1"),
            "taceva.levels/2" => ("taceva.levels/2", "taceva.levels/1"),
            _ => return state,
        };
        assert_eq!(text["schema"], schema);
        // As it was kept before: 32 clusters, here all samples in one of them.
        let all = text["clusters"]["named"]["all"].clone();
        let empty = empty_of(&all);
        let mut cells = vec![empty; 31];
        cells.insert(7, all);
        text["schema"] = before.into();
        text["clusters"] = serde_json::json!({ "hashed": cells });
        serde_json::from_value(text).expect("a state")
    };
    let mut evaluator = of_shear();
    let before: Vec<State> = states_of(some).into_iter().map(earlier).collect();
    evaluator.merge_states(&before).expect("states of before");
    evaluator
        .update(&batch(others))
        .expect("the plan's channels");
    assert_eq!(
        evaluator.states().expect("nothing collected"),
        states_of(&rows)
    );
}

/// Records of nothing in place of these.
fn empty_of(records: &Value) -> Value {
    let records = records.as_array().expect("records").iter();
    let empty = records.map(|record| {
        let zeros = |key: &str, zero: Value| {
            let length = record[key].as_array().map_or(0, Vec::len);
            vec![zero; length]
        };
        let zero = serde_json::to_value(taceva_metrics::ExactSum::default()).expect("a sum");
        serde_json::json!({ "counts": zeros("counts", 0.into()), "sums": zeros("sums", zero) })
    });
    empty.collect::<Vec<_>>().into()
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
