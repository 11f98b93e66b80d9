//! States of poses, maps, clouds and events in files.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use taceva_tasks::depth::{DepthMap, DepthState, DepthTask};
use taceva_tasks::events::{EventRule, EventState, Frame};
use taceva_tasks::pose::{Pose, PoseState, PoseTask, Thresholds};
use taceva_tasks::shape::{ShapeState, ShapeTask};

/// Error message for reading the JSON of `state` with `part` at the JSON pointer `pointer`.
fn damage<S: Serialize + DeserializeOwned>(state: &S, pointer: &str, part: Value) -> String {
    let text = serde_json::to_string(state).expect("JSON");
    let mut stored: Value = serde_json::from_str(&text).expect("JSON");
    *stored.pointer_mut(pointer).expect("a part") = part;
    match serde_json::from_str::<S>(&stored.to_string()) {
        Ok(_) => panic!("accepted: {pointer}"),
        Err(error) => error.to_string(),
    }
}

/// State with one pose and bins.
fn poses() -> PoseState {
    let thresholds = Thresholds::new(&["0.1"], &["0.03"]).expect("decimals");
    let task = PoseTask::default().with_thresholds(thresholds);
    let mut state = PoseState::new(task.with_points(vec![[1.0; 3]]).expect("a point"));
    state.push("a", &Pose::ZERO, &Pose::ZERO);
    state
}

#[test]
fn thresholds_are_stored_as_decimals() {
    let stored = serde_json::to_value(poses()).expect("JSON");
    let expected = json!({"translation": ["0.1"], "rotation": ["0.03"]});
    assert_eq!(stored["task"]["thresholds"], expected);
}

#[test]
fn a_stored_state_of_poses_that_no_samples_give_is_refused() {
    let state = poses();
    let damaged = |pointer, part| damage(&state, pointer, part);
    assert!(damaged("/task/thresholds/rotation/0", json!("-1")).contains("threshold `-1`"));
    assert!(damaged("/task/points/0/0", json!(1e10)).contains("row 1: x is"));
    assert!(damaged("/clusters/a/1", json!([1, 1])).contains("expected 7 sums and 4 counts"));
    assert!(damaged("/clusters/a/1/1", json!(2)).contains("more right bins than poses"));
    assert!(damaged("/still/1/0", json!(2)).contains("another number of poses"));
    assert!(
        damaged("/bins/0/0", json!(1))
            .contains("the bins of the state differ from those of the task")
    );
    assert!(
        damaged("/bins/2", json!([1]))
            .contains("the bins of the state differ from those of the task")
    );
    assert!(damaged("/clusters/a/1/0", json!(1_u64 << 60)).contains("2^53"));
}

#[test]
fn a_stored_state_of_maps_that_no_samples_give_is_refused() {
    let map = |mm: Vec<f64>| DepthMap::new(1, 2, mm).expect("a map");
    let task = DepthTask::default().with_constant(map(vec![0.5, f64::NAN]));
    let mut state = DepthState::new(task);
    let pair = map(vec![0.5, 0.0]);
    state.push("a", 1, &pair, &pair).expect("one size");
    let damaged = |pointer, part| damage(&state, pointer, part);
    assert!(damaged("/task/gate_mm", json!(-1.0)).contains("the gate is -1 mm"));
    assert!(damaged("/task/constant/rows", json!(2)).contains("the map has 2 pixels"));
    assert!(damaged("/clusters/a/1/3", json!(2)).contains("in both maps than in either"));
    assert!(damaged("/clusters/a/1/2", json!(2)).contains("than maps"));
    assert!(damaged("/constant/1/0", json!(1_u64 << 60)).contains("2^53"));
}

#[test]
fn a_stored_state_of_clouds_that_no_samples_give_is_refused() {
    let task = ShapeTask::default().with_tau_mm(0.5).expect("tau");
    let mut state = ShapeState::new(task);
    state
        .push("a", 1, &[[0.0; 3]], &[[1.0; 3]])
        .expect("clouds");
    assert!(damage(&state, "/task/tau_mm", json!(-0.5)).contains("tau -0.5 mm"));
    assert!(damage(&state, "/clusters/a/1/0", json!(1_u64 << 60)).contains("2^53"));
}

#[test]
fn a_stored_state_of_events_that_no_samples_give_is_refused() {
    let mut state = EventState::new(EventRule::default());
    let frames = [
        Frame::new(1, Some(0.0), false, 0.0),
        Frame::new(2, Some(0.1), true, 1.0),
    ];
    state.push("a", &frames).expect("frames");
    let damaged = |pointer, part| damage(&state, pointer, part);
    assert!(damaged("/rule/debounce", json!(0)).contains("debounce is 0"));
    assert!(damaged("/delays", json!([0.0, 0.1])).contains("another number of delays"));
    assert!(damaged("/clusters/a/1/2", json!(0)).contains("more matched onsets"));
}
