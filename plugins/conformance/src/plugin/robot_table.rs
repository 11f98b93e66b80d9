//! Promises of the function table of a robot, tested with motions that a host would never request.

#![expect(
    unsafe_code,
    reason = "the test calls functions of the device with arguments that no host passes"
)]

use taceva_abi as abi;
use taceva_core::{DriverError, DriverKind, ErrorKind, SiPose};
use taceva_host::Session;

use super::subject::{PATIENT, SOON, Subject, timed};
use super::{Check, Of};
use crate::promise::{Unmet, expect, refused, skipped};
use taceva_host::bare::Opened;

const OF: Of = Of::Kind(DriverKind::Robot);

pub(super) const CHECKS: &[Check] = &[
    OF.check("robot/refuses-targets-that-are-none", no_targets),
    OF.check("robot/refuses-speeds-that-are-none", no_speeds),
    OF.check("robot/refuses-what-lies-outside", outside),
    OF.check("robot/wait-without-a-motion", wait_without),
    OF.check("robot/dropped-in-motion", dropped_in_motion),
];

type Bare = Opened<abi::RobotCalls>;

fn bare_move(robot: &Bare, target: abi::Pose, speed: f64) -> Result<u64, DriverError> {
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

fn bare_pose(subject: &Subject) -> Result<abi::Pose, Unmet> {
    let session = &subject.session;
    let mut robot = subject.opened(session.robot(subject.key()?, &subject.args()?))?;
    let SiPose {
        position_m: [x, y, z],
        quaternion: [qw, qx, qy, qz],
    } = robot.pose(PATIENT)?.0.into();
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

fn no_targets(subject: &Subject) -> Result<(), Unmet> {
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
        refused(
            "moving to an invalid target",
            answer,
            &[ErrorKind::InvalidArgument],
        )?;
    }
    Ok(())
}

fn no_speeds(subject: &Subject) -> Result<(), Unmet> {
    let pose = bare_pose(subject)?;
    let robot: Bare = subject.open()?;
    for speed in [0.0, -0.001, f64::NAN, f64::INFINITY] {
        let answer = bare_move(&robot, pose, speed);
        let kinds = [ErrorKind::InvalidArgument, ErrorKind::OutOfRange];
        refused(&format!("a speed of {speed} m/s"), answer, &kinds)?;
    }
    Ok(())
}

fn outside(subject: &Subject) -> Result<(), Unmet> {
    let said = subject.said()?;
    let Some(workspace) = said.robot().and_then(|facts| facts.workspace) else {
        return Err(skipped("it declares no workspace"));
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
        refused(
            &format!("moving to x = {x_mm} mm"),
            answer,
            &[ErrorKind::OutOfRange],
        )?;
    }
    Ok(())
}

fn wait_without(subject: &Subject) -> Result<(), Unmet> {
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
        expect(took < SOON + SOON, || {
            format!("waiting for an unknown motion took {took:?}")
        })?;
    }
    Ok(())
}

fn dropped_in_motion(subject: &Subject) -> Result<(), Unmet> {
    subject.may_move()?;
    let pose = bare_pose(subject)?;
    let robot: Bare = subject.open()?;
    let z = pose.z - 1e-4;
    bare_move(&robot, abi::Pose { z, ..pose }, 0.001)?;
    drop(robot);
    bare_pose(subject).map(drop)
}
