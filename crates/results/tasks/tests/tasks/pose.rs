//! Scores of poses.

mod refusals;
mod rotations;

use taceva_metrics::{Interval, UndefinedReason};
use taceva_tasks::Undefined;
use taceva_tasks::pose::{Pose, PoseState, PoseTask, Rotation, Thresholds};

use super::cases::{case, close, number, numbers, points, score, value};

/// Pose shifted along x, in mm.
fn shifted(x: f64) -> Pose {
    Pose::new(1, [x, 0.0, 0.0], Rotation::IDENTITY).expect("finite")
}

/// Pose rotated about z, in degrees.
fn turned(degrees: f64) -> Pose {
    let (sine, cosine) = (degrees / 2.0).to_radians().sin_cos();
    let rotation = Rotation::of_quaternion(1, [0.0, 0.0, sine, cosine]);
    Pose::new(1, [0.0; 3], rotation.expect("a unit quaternion")).expect("finite")
}

/// Thresholds of a published benchmark, in mm and degrees.
fn bench() -> Thresholds {
    let rotation = ["0.03", "0.2", "0.5", "1", "2"];
    Thresholds::new(&["0.1", "0.5", "1", "2", "5"], &rotation).expect("ascending decimals")
}

#[test]
fn translations_and_axes_are_mean_distances_beside_those_of_zero_motion() {
    let mut state = PoseState::new(PoseTask::default());
    let pose = |place| Pose::new(1, place, Rotation::IDENTITY).expect("finite");
    state.push("a", &pose([0.0, 3.0, 4.0]), &pose([0.0, 0.0, 0.0]));
    state.push("b", &pose([0.0, 0.0, 2.0]), &pose([0.0, 0.0, 1.0]));
    let scores = state.scores();
    let translation = score(&scores, "pose_translation", None);
    assert_eq!(translation.estimate.value, Ok(3.0));
    assert_eq!(translation.estimate.of_constant, Some(3.5));
    assert_eq!(translation.unit, Some("mm"));
    let axes = ["x", "y", "z"].map(|axis| value(&scores, "pose_axis", Some(axis)));
    assert_eq!(axes.map(Some), [0.0, 1.5, 2.5].map(Some));
}

#[test]
fn rotations_are_mean_angles_in_degrees_beside_those_of_zero_motion() {
    let mut state = PoseState::new(PoseTask::default());
    state.push("a", &turned(30.0), &turned(40.0));
    state.push("b", &turned(-10.0), &turned(10.0));
    let scores = state.scores();
    let rotation = score(&scores, "pose_rotation", None);
    close(
        value(&scores, "pose_rotation", None),
        15.0,
        1e-14,
        "rotation",
    );
    let still = rotation.estimate.of_constant.expect("zero motion");
    close(still, 20.0, 1e-14, "zero motion");
    assert_eq!(rotation.unit, Some("deg"));
}

#[test]
fn bins_at_their_edges_are_those_of_the_published_bench() {
    let case = case("pose", "TacBench bins");
    let expected = case["classes"].as_array().expect("classes");
    for (mm, expected) in numbers(&case["values"]).into_iter().zip(expected) {
        let found = bench().bin_of_mm(mm);
        assert_eq!(Some(found as u64), expected.as_u64(), "{mm} mm");
    }
}

#[test]
fn decimals_at_a_threshold_are_in_the_upper_bin_on_both_sides() {
    let cuts = Thresholds::new(&["0.3"], &["0.3"]).expect("decimals");
    // 0.3 is below the decimal 0.3 as a binary number, and 0.1 + 0.2 is above.
    for near in [0.3, 0.1 + 0.2] {
        assert_eq!(cuts.bin_of_mm(near), 2);
        assert_eq!(cuts.bin_of_degrees(-near), 1);
    }
    assert_eq!(cuts.bin_of_mm(0.299_999_999), 1);
    assert_eq!(cuts.bin_of_mm(-0.300_000_001), 0);
}

#[test]
fn pose_class_is_the_mean_share_of_right_bins_beside_the_most_frequent() {
    let mut state = PoseState::new(PoseTask::default().with_thresholds(bench()));
    // Bins of x: 5 and 6; the yaw is right in both.
    for (cluster, truth, prediction) in [("a", 0.0, 0.05), ("b", 0.0, 0.1), ("c", 0.2, 0.3)] {
        state.push(cluster, &shifted(truth), &shifted(prediction));
    }
    let scores = state.scores();
    let mean = score(&scores, "pose_class", None);
    assert_eq!(mean.estimate.value, Ok(8.0 / 9.0));
    assert_eq!(mean.estimate.of_constant, Some(8.0 / 9.0));
    let x = score(&scores, "pose_class", Some("x"));
    assert_eq!(x.estimate.value, Ok(2.0 / 3.0));
    assert_eq!(x.estimate.of_constant, Some(2.0 / 3.0));
    assert!(x.if_frames_were_independent.is_some());
    assert_eq!(
        value(&scores, "pose_class", Some("yaw")).to_bits(),
        1.0_f64.to_bits()
    );
    assert!(
        x.definition
            .ends_with("t 0.1 0.5 1 2 5 mm, r 0.03 0.2 0.5 1 2 deg, lower end included")
    );
}

#[test]
fn yaw_counts_its_bin_whatever_the_sign_of_the_quaternion() {
    let mut state = PoseState::new(PoseTask::default().with_thresholds(bench()));
    let [x, y, z, w] = turned(1.5).rotation().quaternion();
    let negative = Rotation::of_quaternion(1, [-x, -y, -z, -w]).expect("a unit quaternion");
    let negative = Pose::new(1, [0.0; 3], negative).expect("finite");
    state.push("a", &turned(1.2), &negative);
    state.push("a", &turned(1.2), &turned(-1.2));
    let yaw = value(&state.scores(), "pose_class", Some("yaw"));
    assert_eq!(yaw.to_bits(), 0.5_f64.to_bits());
}

#[test]
fn add_and_add_s_are_the_golden_distances() {
    let case = case("pose", "ADD and ADD-S");
    let task = PoseTask::default().with_points(points(&case["points"]));
    let mut state = PoseState::new(task.expect("finite points"));
    let prediction = Pose::new(1, [0.1, 0.0, 0.0], turned(90.0).rotation()).expect("finite");
    state.push("a", &Pose::ZERO, &prediction);
    let scores = state.scores();
    close(
        value(&scores, "add", None),
        number(&case, "ADD"),
        1e-15,
        "ADD",
    );
    close(
        value(&scores, "add_s", None),
        number(&case, "ADD_S"),
        1e-15,
        "ADD-S",
    );
}

#[test]
fn without_thresholds_and_points_their_scores_are_undefined_by_name() {
    let mut state = PoseState::new(PoseTask::default());
    state.push("a", &Pose::ZERO, &Pose::ZERO);
    let scores = state.scores();
    let reason = |metric| score(&scores, metric, None).estimate.value;
    assert_eq!(reason("pose_class"), Err(Undefined::NoThresholds));
    assert_eq!(reason("add"), Err(Undefined::NoPoints));
    assert_eq!(reason("add_s"), Err(Undefined::NoPoints));
}

#[test]
fn four_clusters_have_no_interval_and_five_have_one_about_the_value() {
    let mut state = PoseState::new(PoseTask::default());
    for (cluster, off) in [("a", 1.0), ("b", 1.2), ("c", 0.9), ("d", 1.1)] {
        state.push(cluster, &Pose::ZERO, &shifted(off));
        state.push(cluster, &Pose::ZERO, &shifted(off));
    }
    let of = |state: &PoseState| score(&state.scores(), "pose_translation", None).clone();
    let few = UndefinedReason::TooFewClusters { have: 4 };
    assert_eq!(of(&state).estimate.interval, Interval::Undefined(few));
    state.push("e", &Pose::ZERO, &shifted(0.8));
    let found = of(&state).estimate;
    let [low, high] = found.interval.ends().expect("five clusters");
    assert!(
        0.7 < low && low < 1.0 && 1.0 < high && high < 1.3,
        "{low} {high}"
    );
    assert_eq!((found.n, found.clusters), (9, 5));
}

#[test]
fn a_small_error_beats_zero_motion_with_its_whole_interval() {
    let mut state = PoseState::new(PoseTask::default());
    for (cluster, off) in [
        ("a", 0.1),
        ("b", 0.12),
        ("c", 0.09),
        ("d", 0.11),
        ("e", 0.1),
    ] {
        state.push(cluster, &shifted(2.0), &shifted(2.0 + off));
    }
    let scores = state.scores();
    assert!(score(&scores, "pose_translation", None).beats_constant());
    // Zero motion along y is right, so no error is below it.
    assert!(!score(&scores, "pose_axis", Some("y")).beats_constant());
}

#[test]
fn order_and_merges_do_not_change_a_bit_of_the_state() {
    let task = || {
        let points = vec![[0.0, 0.0, 1.0], [0.3, 0.1, 0.2]];
        let task = PoseTask::default().with_thresholds(bench());
        task.with_points(points).expect("finite points")
    };
    let rows: Vec<[f64; 2]> = (0..60)
        .map(|at| [f64::from(at * 7 % 13) * 0.1, f64::from(at * 5 % 11) * 0.3])
        .collect();
    let push = |state: &mut PoseState, at: usize| {
        let [truth, prediction] = rows[at];
        let cluster = ["a", "b", "c", "d", "e", "f"][at % 6];
        state.push(cluster, &turned(truth), &shifted(prediction));
    };
    let mut whole = PoseState::new(task());
    (0..60).for_each(|at| push(&mut whole, at));
    let [mut left, mut right] = [PoseState::new(task()), PoseState::new(task())];
    (0..60_usize)
        .rev()
        .filter(|at| at.is_multiple_of(3))
        .for_each(|at| push(&mut left, at));
    (0..60_usize)
        .rev()
        .filter(|at| at % 3 > 0)
        .for_each(|at| push(&mut right, at));
    let merged = right.merge(left).expect("one task");
    let bytes = |state: &PoseState| serde_json::to_string(state).expect("a state");
    assert_eq!(bytes(&merged), bytes(&whole));
    assert_eq!(merged.scores(), whole.scores());
}
