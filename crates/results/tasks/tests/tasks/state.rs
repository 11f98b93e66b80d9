//! States of whole tasks, and their merges.

use std::collections::BTreeSet;

use taceva_tasks::depth::{DepthMap, DepthState, DepthTask};
use taceva_tasks::events::{EventRule, EventState};
use taceva_tasks::pose::{EulerErrors, Pose, PoseState, PoseTask};
use taceva_tasks::shape::{ShapeState, ShapeTask};
use taceva_tasks::{Classes, Probabilities, Ranking, TaskError, TaskScore, TaskState, TopK};

/// State of one clip with two samples.
fn clip(name: &str, predicted: &str, score: f64) -> TaskState {
    let mut classes = Classes::new(["lost", "held"], Some("held")).expect("two names");
    let mut ranking = Ranking::default();
    for truth in ["lost", "held"] {
        classes.push(name, truth, predicted).expect("a class");
        ranking.push(name, score, truth == "held").expect("a score");
    }
    let mut state = TaskState::new("grasp", "outcome", "clip");
    state.classes = Some(classes);
    state.ranking = Some(ranking);
    state.unlabelled = 1;
    state
}

#[test]
fn every_order_of_merges_gives_the_same_bytes() {
    let [a, b, c] = [("a", "held"), ("b", "lost"), ("c", "held")]
        .map(|(name, predicted)| clip(name, predicted, 0.25));
    let merged = |one: &TaskState, two: &TaskState, three: &TaskState| {
        let both = one.clone().merge(two.clone()).expect("one task");
        let all = both.merge(three.clone()).expect("one task");
        serde_json::to_string(&all).expect("JSON")
    };
    let first = merged(&a, &b, &c);
    assert_eq!(first, merged(&c, &a, &b));
    assert_eq!(first, merged(&b, &c, &a));
    let read: TaskState = serde_json::from_str(&first).expect("a state");
    let scores = read.scores();
    assert_eq!(scores.clusters, ["a", "b", "c"]);
    assert_eq!(scores.notes, ["3 rows without a label, left out"]);
    assert_eq!(scores.scores[0].estimate.value, Ok(0.5));
}

#[test]
fn remarks_of_both_states_stand_in_one_order() {
    let noted = |words: &str| {
        let mut state = clip("a", "held", 0.5);
        state.notes.push(words.to_owned());
        state
    };
    let notes = |one: &str, other: &str| {
        let both = noted(one).merge(noted(other)).expect("one task");
        both.notes
    };
    assert_eq!(notes("x", "x"), ["x"]);
    assert_eq!(notes("y", "x"), ["x", "y"]);
    assert_eq!(notes("x", "y"), ["x", "y"]);
}

#[test]
fn scores_that_only_one_state_has_are_refused() {
    let mut without = clip("b", "held", 0.5);
    without.ranking = None;
    let refused = clip("a", "held", 0.5)
        .merge(without)
        .expect_err("other scores");
    let expected = "states of different scores of the positive class do not merge: some and none; score both parts with the same scores of the positive class";
    assert_eq!(refused.to_string(), expected);
}

#[test]
fn a_divided_sequence_is_refused_and_divided_frames_are_not() {
    let with = |is_sequence| {
        let mut state = clip("a", "held", 0.5);
        state.is_sequence = is_sequence;
        state
    };
    assert!(with(false).merge(with(false)).is_ok());
    let refused = with(false).merge(with(true)).expect_err("one sequence");
    assert!(matches!(refused, TaskError::DividedSequence { cluster } if cluster == "a"));
}

#[test]
fn poses_without_points_have_no_distances_of_points() {
    let mut poses = PoseState::new(PoseTask::default());
    poses.push("a", &Pose::ZERO, &Pose::ZERO);
    let mut state = TaskState::new("moved", "pose", "clip");
    state.pose = Some(poses);
    let scores = state.scores();
    assert!(
        scores
            .scores
            .iter()
            .all(|score| !score.metric.starts_with("add"))
    );
    assert!(
        scores
            .scores
            .iter()
            .any(|score| score.metric == "pose_rotation")
    );
    assert_eq!(scores.clusters, ["a"]);
}

#[test]
fn a_stored_number_of_angles_that_no_poses_give_is_refused() {
    let mut euler = EulerErrors::default();
    euler.push(&Pose::ZERO, &Pose::ZERO);
    let mut state = TaskState::new("moved", "pose", "clip");
    state.euler = Some(euler);
    let mut stored = serde_json::to_value(&state).expect("JSON");
    let read: TaskState = serde_json::from_value(stored.clone()).expect("a state");
    assert_eq!(read, state);
    stored["euler"][1][0] = (1_u64 << 60).into();
    let refused = serde_json::from_value::<TaskState>(stored).expect_err("too many poses");
    assert!(refused.to_string().contains("2^53"), "{refused}");
}

#[test]
fn maps_of_two_parts_have_the_scores_of_all_and_their_counts_in_words() {
    let part = |press: &str, mm: [f64; 2]| {
        let map = |mm: [f64; 2]| DepthMap::new(1, 2, mm.to_vec()).expect("a map");
        let mut maps = DepthState::new(DepthTask::default());
        maps.push(press, 1, &map([0.5, 0.5]), &map(mm))
            .expect("one size");
        let mut state = TaskState::new("shape", "depth", "press");
        state.depth = Some(maps);
        state
    };
    let both = part("a", [0.5, 0.25]).merge(part("b", [-0.5, 0.5]));
    let scores = both.expect("one task").scores();
    let mae = scores
        .scores
        .iter()
        .find(|score| score.metric == "depth_mae" && score.variant.is_none());
    // (0 + 0.25 + 1 + 0) / 4.
    assert_eq!(mae.expect("maps").estimate.value, Ok(0.3125));
    assert_eq!(scores.clusters, ["a", "b"]);
    assert_eq!(scores.notes, ["1 valid pixel with a negative depth, kept"]);
}

#[test]
fn the_list_of_metrics_has_the_metric_of_every_score_and_no_other() {
    let classes = Classes::new(["lost", "held"], Some("held")).expect("two names");
    let mut probabilities = Probabilities::new(["lost", "held"], Some("held")).expect("two names");
    let pushed = probabilities.push("cup", "held", &[0.25, 0.75]);
    pushed.expect("two probabilities");
    let mut places = TopK::new(["a", "b", "c"]).expect("three names");
    let pushed = places.push("cup", "a", &[0.5, 0.25, 0.25]);
    pushed.expect("three scores");
    let map = DepthMap::new(1, 1, vec![0.5]).expect("a map");
    let mut maps = DepthState::new(DepthTask::default());
    maps.push("cup", 1, &map, &map).expect("one size");
    let mut shapes = ShapeState::new(ShapeTask::default());
    let point = [[0.0; 3]];
    shapes.push("cup", 1, &point, &point).expect("a point");
    let scores = [
        classes.scores(),
        Ranking::default().scores(),
        probabilities.scores(),
        places.scores(2),
        EventState::new(EventRule::default()).scores(),
        PoseState::new(PoseTask::default()).scores(),
        maps.scores(),
        shapes.scores(),
    ];
    let found: BTreeSet<&str> = scores.iter().flatten().map(|score| score.metric).collect();
    let listed: BTreeSet<&str> = TaskScore::METRICS.iter().copied().collect();
    assert_eq!(found, listed);
    assert_eq!(listed.len(), TaskScore::METRICS.len());
}
