//! Numbers that public programs print, beside the correct numbers.

use super::{SLIP, slip};
use crate::support::Bench;

#[test]
fn the_f1_of_sparsh_stands_beside_the_right_one_with_the_reason() {
    let bench = Bench::new();
    slip(&bench);
    let report = bench.json(&format!("{SLIP} --as sparsh"));
    crate::schema::check("tasks", &report);
    let numbers = report["tasks"][0]["as_published"]
        .as_array()
        .expect("a list");
    let f1 = &numbers[0];
    // The strokes s1 to s4 have 24 frames that slip, of which 20 are found.
    assert_eq!(f1["number"], "f1");
    assert_eq!(f1["value"], 40.0 / 44.0);
    assert_eq!(f1["right"], 50.0 / 61.0);
    let text = bench.ok(&format!("{SLIP} --as sparsh"));
    assert!(text.contains("f1 as sparsh computes it is 0.909"), "{text}");
    // Without the option there is no such number.
    assert!(!bench.json(SLIP).to_string().contains("as_published"));
}

#[test]
fn a_half_turn_is_near_its_negative_though_euler_angles_are_not() {
    let bench = Bench::new();
    let head = "id,point_id,moved.x,moved.y,moved.z,moved.qx,moved.qy,moved.qz,moved.qw\n";
    let [sine, cosine] = [89.5_f64.to_radians().sin(), 89.5_f64.to_radians().cos()];
    bench.write(
        "truth.csv",
        &format!("{head}1,a,0,0,0,0,0,{sine},{cosine}\n"),
    );
    bench.write(
        "pred.csv",
        &format!("{head}1,a,0,0,0,0,0,-{sine},{cosine}\n"),
    );
    let report =
        bench.json("score --truth truth.csv --pred pred.csv --task moved=pose --as normalflow");
    let about_z = &report["tasks"][0]["as_published"][2];
    let [value, right] = ["value", "right"].map(|key| about_z[key].as_f64().expect("a number"));
    assert!(
        (value - 358.0).abs() < 1e-9 && (right - 2.0).abs() < 1e-9,
        "{about_z:#}"
    );
}

#[test]
fn a_program_without_numbers_of_the_task_is_refused() {
    let bench = Bench::new();
    slip(&bench);
    bench.refused(
        &format!("{SLIP} --as normalflow"),
        2,
        "expected a task of poses",
    );
    let ran = bench.run(&format!("{SLIP} --as sparch"));
    assert_eq!(ran.code, 2, "{}", ran.err);
    assert!(ran.err.contains("did you mean sparsh?"), "{}", ran.err);
}
