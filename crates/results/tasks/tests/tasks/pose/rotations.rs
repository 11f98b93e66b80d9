//! Rotations, and the angle between two rotations.

use taceva_tasks::pose::Rotation;

use crate::cases::{case, close, number, numbers};

/// The quaternion of a list, divided by its norm.
fn unit(list: &serde_json::Value) -> Rotation {
    let parts = numbers(list);
    let norm = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
    let parts: Vec<f64> = parts.iter().map(|part| part / norm).collect();
    let parts = parts.try_into().expect("four parts");
    Rotation::of_quaternion(1, parts).expect("a unit quaternion")
}

/// Matrix of a rotation by `degrees` about z.
fn about_z(degrees: f64) -> [[f64; 3]; 3] {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    [[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]]
}

#[test]
fn the_angle_is_that_of_every_golden_pair() {
    let names = [
        "identity",
        "1e-9 rad about z",
        "90 deg about x",
        "180 deg about y",
        "q and -q",
        "generic",
        "pi-1e-9",
    ];
    for name in names {
        let case = case("pose", name);
        let [truth, prediction] = ["q_true_xyzw", "q_pred_xyzw"].map(|key| unit(&case[key]));
        let expected = number(&case, "angle_rad_atan2").to_degrees();
        close(truth.degrees_to(prediction), expected, 1e-15, name);
        close(prediction.degrees_to(truth), expected, 1e-15, name);
        let scipy = number(&case, "angle_rad_scipy").to_degrees();
        close(truth.degrees_to(prediction), scipy, 1e-15, name);
    }
}

#[test]
fn the_arc_cosine_of_a_trace_loses_a_small_angle_that_atan2_keeps() {
    let case = case("pose", "1e-9 rad about z");
    assert!(number(&case, "angle_rad_trace_acos") <= 0.0);
    let [truth, prediction] = ["q_true_xyzw", "q_pred_xyzw"].map(|key| unit(&case[key]));
    close(
        truth.degrees_to(prediction).to_radians(),
        1e-9,
        1e-15,
        "angle",
    );
}

#[test]
fn two_degrees_across_the_half_turn_are_two_degrees() {
    let case = case("pose", "Euler angles subtracted");
    let of = |key: &str| {
        let about = numbers(&case[key])[2];
        Rotation::of_matrix(1, about_z(about)).expect("a rotation")
    };
    let found = of("true_deg").degrees_to(of("pred_deg"));
    close(found, number(&case, "geodesic_deg"), 1e-13, "angle");
    let subtracted = (of("true_deg").yaw_degrees() - of("pred_deg").yaw_degrees()).abs();
    close(
        subtracted,
        number(&case, "abs_difference_of_euler_deg"),
        1e-13,
        "yaw",
    );
}

#[test]
fn a_matrix_gives_its_quaternion_in_all_four_cases() {
    // Half turns about x, y and z make one diagonal entry the greatest; the identity makes the trace the greatest.
    let diagonals = [
        [1.0, 1.0, 1.0],
        [1.0, -1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
    ];
    let quaternions = [
        [0.0, 0.0, 0.0, 1.0],
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
    ];
    for ([x, y, z], expected) in diagonals.into_iter().zip(quaternions) {
        let rows = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
        let found = Rotation::of_matrix(1, rows).expect("a rotation");
        assert_eq!(found.quaternion().map(Some), expected.map(Some));
    }
    // The cyclic exchange of axes is a third of a turn about (1, 1, 1).
    let cyclic = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let found = Rotation::of_matrix(1, cyclic).expect("a rotation");
    close(found.degrees_to(Rotation::IDENTITY), 120.0, 1e-14, "angle");
    assert_eq!(found.quaternion().map(Some), [Some(0.5); 4]);
}

#[test]
fn a_matrix_near_a_half_turn_keeps_its_axis() {
    // About (0.6, 0.8, 0): 2 a aᵀ − 1.
    let rows = [[-0.28, 0.96, 0.0], [0.96, 0.28, 0.0], [0.0, 0.0, -1.0]];
    let [x, y, z, w] = Rotation::of_matrix(1, rows)
        .expect("a rotation")
        .quaternion();
    close(x, 0.6, 1e-15, "x");
    close(y, 0.8, 1e-15, "y");
    assert_eq!([z, w].map(Some), [Some(0.0); 2]);
}
