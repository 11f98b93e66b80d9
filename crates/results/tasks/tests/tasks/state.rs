//! States of whole tasks, and their merges.

use taceva_tasks::pose::{Pose, PoseState, PoseTask};
use taceva_tasks::{Classes, Ranking, TaskError, TaskState};

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
