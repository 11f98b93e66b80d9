//! Poses, matrices and thresholds that are refused.

use taceva_tasks::pose::{Pose, PoseError, PoseState, PoseTask, Rotation, Thresholds};

use super::bench;

#[test]
fn a_quaternion_of_norm_0_is_refused_by_row() {
    let refused = Rotation::of_quaternion(12, [0.0; 4]);
    assert_eq!(refused, Err(PoseError::Norm { row: 12, norm: 0.0 }));
}

#[test]
fn a_quaternion_of_norm_0_9_is_refused_by_row_and_norm() {
    let refused = Rotation::of_quaternion(3, [0.9, 0.0, 0.0, 0.0]).expect_err("norm 0.9");
    assert_eq!(
        refused.to_string(),
        "row 3: the quaternion has norm 0.9, expected 1 within 1e-6; divide it by its norm in the file"
    );
}

#[test]
fn a_norm_within_a_millionth_is_taken_and_two_millionths_are_refused() {
    for (off, is_taken) in [
        (0.9e-6, true),
        (-0.9e-6, true),
        (2e-6, false),
        (-2e-6, false),
    ] {
        let found = Rotation::of_quaternion(1, [0.0, 0.0, 0.0, 1.0 + off]);
        assert_eq!(found.is_ok(), is_taken, "{off}");
    }
    assert!(Rotation::of_quaternion(1, [f64::NAN, 0.0, 0.0, 1.0]).is_err());
    assert!(Rotation::of_quaternion(1, [f64::INFINITY, 0.0, 0.0, 1.0]).is_err());
}

#[test]
fn a_rotation_matrix_with_determinant_minus_1_is_refused_by_row() {
    let mirror = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]];
    let refused = Rotation::of_matrix(5, mirror);
    assert_eq!(refused, Err(PoseError::Mirror { row: 5 }));
}

#[test]
fn a_matrix_that_scales_or_holds_nan_is_no_rotation() {
    for entry in [1.1, f64::NAN] {
        let rows = [[entry, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let refused = Rotation::of_matrix(6, rows).expect_err("no rotation");
        assert!(
            matches!(refused, PoseError::NoRotation { row: 6, .. }),
            "{refused}"
        );
    }
}

#[test]
fn a_translation_that_is_not_finite_is_refused_by_row_and_axis() {
    for value in [f64::NAN, f64::INFINITY, 1e10] {
        let refused = Pose::new(9, [0.0, value, 0.0], Rotation::IDENTITY);
        let text = refused.expect_err("no number").to_string();
        assert!(text.starts_with("row 9: y is "), "{text}");
    }
    let point = PoseTask::default().with_points(vec![[0.0; 3], [f64::NAN, 0.0, 0.0]]);
    let text = point.expect_err("no number").to_string();
    assert!(text.starts_with("row 2: x is NaN"), "{text}");
}

#[test]
fn a_threshold_that_is_no_decimal_above_0_is_refused_by_its_text() {
    for text in [
        "",
        "-1",
        "0",
        "0.0",
        "1e-3",
        ".5",
        "0.0000001",
        "1000000",
        "+1",
    ] {
        let refused = Thresholds::new(&[text], &["1"]);
        let text = text.to_owned();
        assert_eq!(refused, Err(PoseError::Threshold { text }));
    }
}

#[test]
fn thresholds_that_do_not_ascend_or_lack_are_refused() {
    for list in [["1", "0.5"], ["1", "1.0"]] {
        let refused = Thresholds::new(&["1"], &list);
        let text = list[1].to_owned();
        assert_eq!(refused, Err(PoseError::Order { text }));
    }
    let refused = Thresholds::new(&["1"], &[]);
    assert_eq!(refused, Err(PoseError::NoThreshold { axis: "rotation" }));
}

#[test]
fn states_of_other_thresholds_or_points_do_not_merge() {
    let plain = PoseState::new(PoseTask::default());
    let binned = PoseState::new(PoseTask::default().with_thresholds(bench()));
    let text = plain
        .clone()
        .merge(binned)
        .expect_err("other thresholds")
        .to_string();
    assert!(
        text.starts_with("states of different thresholds do not merge: none and t 0.1"),
        "{text}"
    );
    let points = PoseTask::default()
        .with_points(vec![[0.0; 3]])
        .expect("finite");
    let text = plain
        .merge(PoseState::new(points))
        .expect_err("other points")
        .to_string();
    assert!(
        text.starts_with("states of different points do not merge: 0 points and 1 point"),
        "{text}"
    );
}
