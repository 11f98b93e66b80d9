//! Tests of task comparisons against direct tests of the counts behind the scores.

use taceva_metrics::{ClusterSums, Sides, SignFlip};
use taceva_report::{TaskComparison, TaskResult};
use taceva_tasks::pose::{Pose, PoseState, PoseTask, Rotation};
use taceva_tasks::{Classes, TaskReport, TaskState};

/// Number of samples of each object that models A and B predict wrongly. For two objects, both numbers are equal.
const WRONG: [[usize; 2]; 10] = [
    [1, 2],
    [1, 3],
    [2, 2],
    [0, 1],
    [1, 4],
    [2, 1],
    [1, 2],
    [0, 3],
    [1, 1],
    [0, 2],
];

/// Number of samples of the object at position `at`. Half of them are of each class.
fn samples(at: usize) -> usize {
    20 + 2 * at
}

fn result(name: &str, state: TaskState) -> TaskResult {
    let mut report = TaskReport::new("0.2.0", "by `id`");
    report.tables = [("truth".to_owned(), "sha256:1".to_owned())].into();
    report.tasks.push(state.scores());
    TaskResult::of(name, &report).expect("a report")
}

/// Result of the model at position `model`, and its number of right samples by object.
fn grasps(model: usize) -> (TaskResult, ClusterSums) {
    let mut classes = Classes::new(["lost", "held"], Some("held")).expect("two names");
    let mut hits = ClusterSums::default();
    for (at, wrong) in WRONG.iter().enumerate() {
        let object = format!("object {at}");
        for sample in 0..samples(at) {
            let (truth, other) = match sample % 2 {
                0 => ("lost", "held"),
                _ => ("held", "lost"),
            };
            let is_wrong = sample < wrong[model];
            let predicted = if is_wrong { other } else { truth };
            classes.push(&object, truth, predicted).expect("a class");
            let hit = if is_wrong { 0.0 } else { 1.0 };
            hits.try_add(&object, hit).expect("finite");
        }
    }
    let mut state = TaskState::new("grasp", "outcome", "object");
    state.classes = Some(classes);
    (result(["A", "B"][model], state), hits)
}

#[test]
fn the_test_of_a_share_is_that_of_its_counts_to_the_bit() {
    let [(a, hits_a), (b, hits_b)] = [grasps(0), grasps(1)];
    let expected = SignFlip::default()
        .test(Sides {
            a: &hits_a,
            b: &hits_b,
        })
        .expect("ten objects");
    let metrics = ["class_accuracy".to_owned()];
    let comparison = TaskComparison::of(&[a, b], &metrics, 0);
    let [answer] = comparison.answers.as_slice() else {
        panic!("one score: {:?}", comparison.answers);
    };
    let found = answer.difference.as_ref().expect("ten objects");
    // Ties of patterns are exact, also with objects that both models predict equally well.
    assert_eq!(found.p.to_bits(), expected.p.to_bits());
    assert!((found.value - expected.value).abs() < 1e-9, "{found:?}");
    assert!(answer.is_paired() && comparison.notes.is_empty());
}

#[test]
fn poses_are_compared_in_their_units_and_the_smaller_error_is_better() {
    let model = |name: &str, scale: f64| {
        let mut poses = PoseState::new(PoseTask::default());
        for trial in 0..12_u32 {
            let error = scale * (1.0 + f64::from(trial % 3) * 0.1);
            let turn = Rotation::IDENTITY;
            let truth = Pose::new(1, [5.0, 0.0, 0.0], turn).expect("near");
            let found = Pose::new(1, [5.0 + error, 0.0, 0.0], turn).expect("near");
            poses.push(&format!("trial {trial:02}"), &truth, &found);
        }
        let mut state = TaskState::new("moved", "pose", "trial");
        state.pose = Some(poses);
        result(name, state)
    };
    let results = [model("fine", 0.1), model("coarse", 0.4)];
    let metrics = ["pose_translation".to_owned()];
    let comparison = TaskComparison::of(&results, &metrics, 0);
    let answer = &comparison.answers[0];
    assert_eq!((answer.unit.as_str(), answer.winner), ("mm", Some(0)));
    let text = comparison.text(100);
    assert!(
        text.contains("moved pose_translation: fine better than coarse by 0.33 mm"),
        "{text}"
    );
    assert!(comparison.values().text().contains("pose_translation (mm)"));
}

#[test]
fn scores_that_one_result_lacks_are_shown_and_not_compared() {
    let (a, _) = grasps(0);
    let mut without = Classes::new(["lost", "held"], None).expect("two names");
    without.push("object 0", "held", "held").expect("a class");
    let mut state = TaskState::new("grasp", "outcome", "object");
    state.classes = Some(without);
    let comparison = TaskComparison::of(&[a, result("B", state)], &[], 0);
    let names: Vec<&str> = comparison
        .answers
        .iter()
        .map(|of| of.score.as_str())
        .collect();
    assert!(
        names.contains(&"class_accuracy") && !names.contains(&"f1"),
        "{names:?}"
    );
    let values = comparison.values().text();
    assert!(
        values.contains("f1") && values.contains("not scored"),
        "{values}"
    );
}
