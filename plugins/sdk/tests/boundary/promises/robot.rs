//! Guarantees of robots: poses, motions, guards and halts.

#![expect(unsafe_code, reason = "the tables of a plugin are called")]

use std::thread;
use std::time::{Duration, Instant};

use taceva_core::{Degree, Millimetre, SiPose};
use taceva_plugin::abi::ext::{
    EXPIRING_MOTION, ExpiringMotionCalls, GUARDED_MOTION, GuardedMotionCalls, GuardedStop,
};
use taceva_plugin::abi::{Motion, Pose, ROBOT_FACTORY, RobotCalls, Stamp, Status};

use super::{AT_ONCE, SECOND};
use crate::fake_host::{Open, ended};
use crate::places::motion;

#[test]
fn a_pose_goes_out_as_it_came_in_to_the_bit() {
    let robot = Open::new(ROBOT_FACTORY, "well");
    let calls = robot.calls::<RobotCalls>();
    let mut there = taceva_core::Pose::default();
    there.position.z = Millimetre(12.345_678);
    there.rotation.z = Degree(90.0);
    let SiPose {
        position_m: [x, y, z],
        quaternion: [qw, qx, qy, qz],
    } = there.into();
    let target = Pose {
        x,
        y,
        z,
        qw,
        qx,
        qy,
        qz,
    };
    let asked = Motion {
        target,
        ..motion(0.0)
    };
    let moved = robot
        .move_to(&asked)
        .and_then(|token| robot.wait(token, SECOND));
    let mut stamp = moved.expect("it moves");
    assert_eq!(stamp.valid_ns, 2 * SECOND, "the driver was told 2 mm/s");
    let mut pose = asked.target;
    // SAFETY: all places live for the call.
    unsafe {
        assert_eq!(
            ended(|error| calls.pose.expect("a function")(
                robot.handle(),
                &raw mut pose,
                &raw mut stamp,
                SECOND,
                error
            ))
            .0,
            Status::OK
        );
    }
    assert_eq!(pose, asked.target);
    assert_eq!(
        (stamp.valid_ns, stamp.received_ns),
        (2 * SECOND, 2 * SECOND)
    );
}

#[test]
fn a_motion_beyond_what_the_robot_says_of_itself_is_refused_before_it_begins() {
    let robot = Open::new(ROBOT_FACTORY, "well");
    let refused = |asked: Motion| robot.move_to(&asked).expect_err("refused");
    let (status, message) = refused(motion(0.9));
    assert_eq!(status, Status::OUT_OF_RANGE);
    assert_eq!(message, "0 mm, 0 mm, 900 mm is outside the workspace");
    let fast = Motion {
        speed_m_per_s: 0.2,
        ..motion(0.0)
    };
    let (status, message) = refused(fast);
    assert_eq!(status, Status::OUT_OF_RANGE);
    assert_eq!(message, "the speed is 200 mm/s, expected at most 100 mm/s");
}

#[test]
fn a_guarded_motion_says_where_it_ended_and_why() {
    let robot = Open::new(ROBOT_FACTORY, "well");
    let calls = robot
        .extension::<GuardedMotionCalls>(GUARDED_MOTION)
        .expect("it can");
    let asked = motion(0.01);
    let mut stop = GuardedStop {
        size: u32::try_from(size_of::<GuardedStop>()).expect("small"),
        is_guarded: 7,
        pose: asked.target,
        stamp: Stamp::default(),
    };
    for (guard_n, is_guarded, z) in [(2.0, 1, 0.005), (9.0, 0, 0.01)] {
        // SAFETY: both places live for the call.
        let (status, _) = ended(|error| unsafe {
            calls.move_guarded.expect("a function")(
                robot.handle(),
                &raw const asked,
                guard_n,
                &raw mut stop,
                SECOND,
                error,
            )
        });
        assert_eq!(
            (status, stop.is_guarded, stop.pose.z.to_bits()),
            (Status::OK, is_guarded, f64::to_bits(z))
        );
    }
    // SAFETY: as above.
    let (status, _) = ended(|error| unsafe {
        calls.move_guarded.expect("a function")(
            robot.handle(),
            &raw const asked,
            f64::NAN,
            &raw mut stop,
            SECOND,
            error,
        )
    });
    assert_eq!(status, Status::INVALID_ARGUMENT);
}

#[test]
fn a_halt_from_another_thread_stops_a_motion_and_latches() {
    let robot = Open::new(ROBOT_FACTORY, "block");
    let calls = robot.calls::<RobotCalls>();
    let go = |timeout_ns| {
        let moved = robot.move_to(&motion(0.001));
        let ended = moved.and_then(|token| robot.wait(token, timeout_ns));
        ended.map_or_else(|(status, _)| status, |_| Status::OK)
    };
    thread::scope(|scope| {
        let blocked = scope.spawn(|| (go(60 * SECOND), Instant::now()));
        thread::sleep(Duration::from_millis(20));
        let asked = Instant::now();
        // SAFETY: allowed from any thread while the device is open.
        let answer =
            ended(|error| unsafe { calls.halt.expect("a function")(robot.handle(), error) });
        assert_eq!(answer.0, Status::OK);
        let (status, at) = blocked.join().expect("it answers");
        assert_eq!(status, Status::INTERRUPTED);
        assert!(at - asked < AT_ONCE, "{:?}", at - asked);
    });
    assert_eq!(go(SECOND), Status::INTERRUPTED, "latched");
    // SAFETY: the device is open.
    let answer = ended(|error| unsafe {
        calls.clear_halt.expect("a function")(robot.handle(), SECOND, error)
    });
    assert_eq!(answer.0, Status::OK);
    assert_eq!(go(1_000_000), Status::TIMEOUT);
}

#[test]
fn an_expiring_motion_keeps_to_what_the_robot_says_of_itself_and_is_absent_where_it_has_none() {
    let none = Open::new(ROBOT_FACTORY, "nan");
    assert!(
        none.extension::<ExpiringMotionCalls>(EXPIRING_MOTION)
            .is_none()
    );
    let robot = Open::new(ROBOT_FACTORY, "well");
    let calls = robot.extension::<ExpiringMotionCalls>(EXPIRING_MOTION);
    let go = calls.expect("it has it").move_expiring.expect("a function");
    let mut stamp = Stamp::default();
    // The workspace reaches to half a metre.
    for (z, expected) in [
        (0.01, Status::OK),
        (0.6, Status::OUT_OF_RANGE),
        (f64::NAN, Status::INVALID_ARGUMENT),
    ] {
        let asked = motion(z);
        // SAFETY: both places live for the call.
        let (status, _) = ended(|error| unsafe {
            go(
                robot.handle(),
                &raw const asked,
                &raw mut stamp,
                SECOND,
                error,
            )
        });
        assert_eq!(status, expected, "{z}");
    }
    assert_eq!(stamp.valid_ns, 4_000_000_000);
}
