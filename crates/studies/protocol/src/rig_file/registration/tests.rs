use super::*;

fn place(x: f64, y: f64, z: f64) -> Point {
    let [x, y, z] = [x, y, z].map(Millimetre);
    Point { x, y, z }
}

fn turned(x: f64, y: f64, z: f64) -> Rotation {
    let [x, y, z] = [x, y, z].map(Degree);
    Rotation { x, y, z }
}

fn registration(carries: Carried, turn: Rotation) -> Registration {
    Registration {
        carries,
        origin_mm: [300.0, 0.0, 251.3],
        axes: SignedAxes::read(["x", "-y", "-z"]).expect("axes"),
        turned: turn,
    }
}

#[test]
fn an_arm_that_points_down_stands_over_the_gel_where_it_is_sent() {
    let arm = registration(Carried::Indenter, turned(180.0, 0.0, 0.0));
    let tip = Pose {
        position: place(1.0, 2.0, -20.0),
        rotation: turned(0.0, 0.0, 30.0),
    };
    let base = arm.to_base(&tip);
    assert_eq!(base.position, place(301.0, -2.0, 271.3));
    // A rotation about z of the sensor is opposite to one about z of the base.
    assert_eq!(base.rotation, turned(180.0, 0.0, -30.0));
    assert_eq!(arm.to_sensor(&base), tip);
}

#[test]
fn an_arm_that_carries_the_sensor_goes_the_other_way() {
    let arm = registration(Carried::Sensor, Rotation::default());
    let deep = Pose {
        position: place(1.0, 2.0, 0.5),
        ..Pose::default()
    };
    // The tip rests. The sensor moves by −1 along its x, by −2 along its y and towards the tip, which is up in the base frame.
    let base = arm.to_base(&deep);
    assert_eq!(base.position, place(299.0, 2.0, 251.8));
    assert_eq!(arm.to_sensor(&base), deep);
}

#[test]
fn every_pose_comes_back_to_the_nanometre_turned_or_not() {
    for carries in [Carried::Indenter, Carried::Sensor] {
        for reference in [turned(180.0, 0.0, 0.0), turned(-179.5, 3.0, 45.0)] {
            let arm = registration(carries, reference);
            for step in 0..40 {
                let part = f64::from(step) - 20.0;
                let tip = Pose {
                    position: place(0.37 * part, -0.11 * part, 0.05 * part),
                    rotation: turned(0.0, 0.0, 8.5 * part),
                };
                let found = arm.to_sensor(&arm.to_base(&tip));
                let far = coordinates(&found.position);
                for (found, meant) in far.iter().zip(coordinates(&tip.position)) {
                    assert!((found - meant).abs() < 2e-6, "{carries:?} {found} {meant}");
                }
                assert!(
                    (found.rotation.z.0 - tip.rotation.z.0).abs() < 1e-6,
                    "{found:?}"
                );
            }
        }
    }
}

#[test]
fn a_quarter_turn_about_y_is_kept_as_a_turn() {
    let arm = registration(Carried::Indenter, turned(10.0, 90.0, 20.0));
    let tip = Pose {
        position: place(0.0, 0.0, -5.0),
        ..Pose::default()
    };
    let base = arm.to_base(&tip);
    let [meant, found] = [turned(10.0, 90.0, 20.0), base.rotation].map(|turn| matrix(&turn));
    for (meant, found) in meant.iter().flatten().zip(found.iter().flatten()) {
        assert!((meant - found).abs() < 1e-9, "{base:?}");
    }
}
