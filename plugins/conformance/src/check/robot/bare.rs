//! Checks of robots by their bare table: motions that no host asks for.

#![expect(
    unsafe_code,
    reason = "the functions of the device are called as no host does"
)]

use taceva_abi as abi;
use taceva_core::{DriverError, ErrorKind, SiPose};

use super::{facts, here, open};
use crate::check::subject::{Ending, SOON, Subject, ensure, expect_failure, timed};
use taceva_host::bare::Opened;

pub(super) type Bare = Opened<abi::RobotCalls>;

pub(super) fn bare_move(robot: &Bare, target: abi::Pose, speed: f64) -> Result<u64, DriverError> {
    let move_to = robot.handle.needs(robot.calls.move_to, "move_to")?;
    let motion = abi::Motion {
        size: u32::try_from(size_of::<abi::Motion>()).expect("a small struct"),
        reserved: 0,
        target,
        speed_m_per_s: speed,
    };
    let mut token = 0;
    robot.handle.call("move", |raw, error| {
        // SAFETY: [owner & open], with a motion, a place for the token and an error that outlive the call.
        unsafe { move_to(raw, &raw const motion, &raw mut token, error) }
    })?;
    Ok(token)
}

pub(super) fn bare_pose(subject: &Subject) -> Result<abi::Pose, Ending> {
    let mut robot = open(subject)?;
    let SiPose {
        position_m: [x, y, z],
        quaternion: [qw, qx, qy, qz],
    } = here(&mut *robot)?.into();
    Ok(abi::Pose {
        x,
        y,
        z,
        qw,
        qx,
        qy,
        qz,
    })
}

pub(super) fn no_targets(subject: &Subject) -> Result<(), Ending> {
    let pose = bare_pose(subject)?;
    let robot: Bare = subject.open()?;
    let none = f64::NAN;
    let targets = [
        abi::Pose { x: none, ..pose },
        abi::Pose {
            z: f64::INFINITY,
            ..pose
        },
        abi::Pose { qw: none, ..pose },
        abi::Pose {
            qw: 0.0,
            qx: 0.0,
            qy: 0.0,
            qz: 0.0,
            ..pose
        },
    ];
    for target in targets {
        let answer = bare_move(&robot, target, 0.001);
        expect_failure(
            "a target that is none",
            answer,
            &[ErrorKind::InvalidArgument],
        )?;
    }
    Ok(())
}

pub(super) fn no_speeds(subject: &Subject) -> Result<(), Ending> {
    let pose = bare_pose(subject)?;
    let robot: Bare = subject.open()?;
    for speed in [0.0, -0.001, f64::NAN, f64::INFINITY] {
        let answer = bare_move(&robot, pose, speed);
        let kinds = [ErrorKind::InvalidArgument, ErrorKind::OutOfRange];
        expect_failure(&format!("a speed of {speed} m/s"), answer, &kinds)?;
    }
    Ok(())
}

pub(super) fn outside(subject: &Subject) -> Result<(), Ending> {
    let Some(workspace) = facts(subject)?.workspace else {
        return Err(Ending::Skipped("it declares no workspace".to_owned()));
    };
    let pose = bare_pose(subject)?;
    let robot: Bare = subject.open()?;
    let beyond = [workspace.least.x.0 - 1.0, workspace.greatest.x.0 + 1.0];
    for x_mm in beyond {
        let target = abi::Pose {
            x: x_mm / 1e3,
            ..pose
        };
        let answer = bare_move(&robot, target, 0.001);
        expect_failure(
            &format!("a target at x = {x_mm} mm"),
            answer,
            &[ErrorKind::OutOfRange],
        )?;
    }
    Ok(())
}

pub(super) fn wait_without(subject: &Subject) -> Result<(), Ending> {
    let robot: Bare = subject.open()?;
    let wait = robot.handle.needs(robot.calls.wait, "wait")?;
    let mut stamp = abi::Stamp::default();
    for token in [0, 77, u64::MAX] {
        let (_, took) = timed(|| {
            robot.handle.call("wait", |raw, error| {
                // SAFETY: [owner & open], with a place for the stamp and an error that outlive the call.
                unsafe { wait(raw, token, &raw mut stamp, 100_000_000, error) }
            })
        });
        ensure(took < SOON + SOON, || {
            format!("waiting for no motion took {took:?}")
        })?;
    }
    Ok(())
}
