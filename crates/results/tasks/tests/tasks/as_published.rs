//! Numbers of public programs, computed by hand.

use taceva_tasks::pose::{EulerErrors, Pose, PoseState, PoseTask, Rotation};
use taceva_tasks::{Classes, PublicProgram, TaskState, TopK};

/// State of a task of classes.
fn of_classes(classes: Classes) -> TaskState {
    let mut state = TaskState::new("slip", "event", "trajectory");
    state.classes = Some(classes);
    state
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "{found}, not {expected}");
}

#[test]
fn sparsh_leaves_out_the_first_and_the_last_trajectory() {
    let mut classes = Classes::new(["no_slip", "slip"], Some("slip")).expect("two names");
    for (trajectory, predicted) in [
        ("t1", "no_slip"),
        ("t2", "slip"),
        ("t3", "slip"),
        ("t4", "no_slip"),
    ] {
        classes
            .push(trajectory, "no_slip", "no_slip")
            .expect("a class");
        classes
            .push(trajectory, "slip", predicted)
            .expect("a class");
    }
    let numbers = of_classes(classes).as_published(PublicProgram::Sparsh);
    // Of all four, two of four slips are found: 4 / (4 + 2).
    let f1 = &numbers[0];
    assert_eq!(
        (f1.number.as_str(), f1.value, f1.right),
        ("f1", 1.0, Some(2.0 / 3.0))
    );
    assert_eq!(
        f1.difference,
        "its loop leaves out the first and the last trajectory, `t1` and `t4`; its rule is threshold 0.4 strict, debounce 3, and the right number has no rule"
    );
    let balanced = &numbers[1];
    assert_eq!(
        (balanced.number.as_str(), balanced.value, balanced.right),
        ("balanced_accuracy", 1.0, Some(0.75))
    );
}

#[test]
fn the_interval_of_tacbench_should_be_22_7_times_as_wide() {
    let mut classes = Classes::new(["lost", "held"], None).expect("two names");
    // 1,229 of 1,500, as printed for MAE.
    for (set, hits) in [200, 205, 210, 195, 215, 204].into_iter().enumerate() {
        let predicted: Vec<u32> = (0..250).map(|at| u32::from(at < hits)).collect();
        classes
            .push_positions(&format!("set {set}"), &[1; 250], &predicted)
            .expect("positions");
    }
    let numbers = of_classes(classes).as_published(PublicProgram::Sparsh);
    let [half_width] = numbers.as_slice() else {
        panic!("no positive class, so no F1: {numbers:?}");
    };
    // Squares of the distances from the mean 1229 / 6: 1505 / 6.
    let sd = (1505.0_f64 / 36.0).sqrt() / 250.0;
    close(half_width.value, 1.96 * sd / 1500.0_f64.sqrt());
    let right = half_width.right.expect("six sets");
    close(right / half_width.value, 22.716_216_042_529_418);
    assert!(
        half_width.difference.ends_with("and is 22.7 times as wide"),
        "{}",
        half_width.difference
    );
}

#[test]
fn the_top_5_of_touch_and_go_is_its_top_1() {
    let names = ["brick", "cloth", "glass", "grass", "stone", "wood"];
    let mut classes = Classes::new(names, None).expect("names");
    let mut places = TopK::new(names).expect("names");
    for clip in ["a", "b"] {
        classes.push(clip, "wood", "brick").expect("a class");
        classes.push(clip, "brick", "brick").expect("a class");
        for truth in ["wood", "brick"] {
            places
                .push(clip, truth, &[0.3, 0.1, 0.15, 0.12, 0.13, 0.2])
                .expect("scores");
        }
    }
    let mut state = of_classes(classes);
    let without = state.as_published(PublicProgram::TouchAndGo);
    assert_eq!((without[0].value, without[0].right), (0.5, None));
    state.places = Some(places);
    let with = state.as_published(PublicProgram::TouchAndGo);
    assert_eq!((with[0].value, with[0].right), (0.5, Some(1.0)));
}

/// Pose with the translation `x` and a turn about z.
fn pose(x: f64, degrees: f64) -> Pose {
    let half = degrees.to_radians() / 2.0;
    let turn = Rotation::of_quaternion(1, [0.0, 0.0, half.sin(), half.cos()]).expect("norm 1");
    Pose::new(1, [x, 0.0, 0.0], turn).expect("near")
}

#[test]
fn euler_angles_as_numbers_differ_by_358_degrees_instead_of_2() {
    let mut state = TaskState::new("moved", "pose", "trial");
    let mut euler = EulerErrors::default();
    euler.push(&pose(0.0, 179.0), &pose(0.0, -179.0));
    state.euler = Some(euler);
    let numbers = state.as_published(PublicProgram::NormalFlow);
    let names: Vec<&str> = numbers.iter().map(|of| of.number.as_str()).collect();
    assert_eq!(
        names,
        ["rotation about x", "rotation about y", "rotation about z"]
    );
    close(numbers[0].value, 0.0);
    close(numbers[2].value, 358.0);
    close(numbers[2].right.expect("a pose"), 2.0);
    assert_eq!(numbers[2].unit, Some("deg"));
}

#[test]
fn euler_angles_are_those_about_fixed_axes_in_their_order() {
    // 30 degrees about x, then 40 about y: each angle is found again, beside no rotation.
    let [x, y] = [30.0_f64, 40.0].map(|degrees| degrees.to_radians() / 2.0);
    let quaternion = [
        x.sin() * y.cos(),
        x.cos() * y.sin(),
        -x.sin() * y.sin(),
        x.cos() * y.cos(),
    ];
    let turned = Rotation::of_quaternion(1, quaternion).expect("norm 1");
    let turned = Pose::new(1, [0.0; 3], turned).expect("near");
    let mut euler = EulerErrors::default();
    euler.push(&Pose::ZERO, &turned);
    for (axis, expected) in [30.0, 40.0, 0.0].into_iter().enumerate() {
        let [as_numbers, shorter] = euler.mean_degrees(axis).expect("a pose");
        close(as_numbers, expected);
        close(shorter, expected);
    }
}

#[test]
fn object_folder_averages_objects_and_not_contacts() {
    let mut poses = PoseState::new(PoseTask::default());
    for _ in 0..3 {
        poses.push("cup", &pose(0.0, 0.0), &pose(0.0, 0.0));
    }
    poses.push("bowl", &pose(0.0, 0.0), &pose(2.0, 0.0));
    let mut state = TaskState::new("contact", "pose", "object");
    state.pose = Some(poses);
    let numbers = state.as_published(PublicProgram::ObjectFolder);
    assert_eq!((numbers[0].value, numbers[0].right), (1.0, Some(0.5)));
}

#[test]
fn a_program_without_numbers_of_a_task_computes_none() {
    let classes = Classes::new(["a", "b"], None).expect("two names");
    let state = of_classes(classes);
    for program in PublicProgram::ALL {
        assert!(state.as_published(program).is_empty(), "{program}");
    }
}
