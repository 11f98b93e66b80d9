//! Functions with which the host calls a robot.

#![expect(unsafe_code, reason = "functions that a host calls")]

use std::ffi::c_void;

use taceva_abi::ext::{
    EXPIRING_MOTION, ExpiringMotionCalls, GUARDED_MOTION, GuardedMotionCalls,
    GuardedStop as AbiGuardedStop,
};
use taceva_abi::{Error, Motion, Pose as AbiPose, RobotCalls, Stamp, Status, Text};
use taceva_core::{
    ErrorKind, Facts, Guard, GuardedStop, Newton, Point, Pose, Robot, RobotFacts, Speed,
};

use super::{Kind, call, device_calls, extended};
use crate::convert::{self, deadline};
use crate::driver_lists::{Drivers, Loaded};
use crate::failure::Failure;
use crate::guard::guard;
use crate::handles::{self, Handle};
use crate::memory;

/// Open robot with its limits, and the motion that the host has requested and not yet started.
pub(crate) struct Opened {
    robot: Box<dyn Robot>,
    limits: RobotFacts,
    accepted: Option<(u64, Pose, Speed)>,
    motions: u64,
}

impl Kind for dyn Robot {
    type Opened = Opened;
    type Calls = RobotCalls;
    const CALLS: &'static RobotCalls = &CALLS;

    fn drivers(loaded: &Loaded) -> &Drivers<dyn Robot> {
        &loaded.robots
    }

    fn handle(robot: Box<dyn Robot>, facts: &Facts) -> Handle<Opened> {
        let halt = robot.halt_handle();
        let opened = Opened {
            robot,
            limits: match facts {
                Facts::Robot(facts) => *facts,
                _ => RobotFacts::default(),
            },
            accepted: None,
            motions: 0,
        };
        Handle::new(opened).halted_by(halt)
    }
}

impl Opened {
    /// Target and speed of the motion `asked`. Fails if the target is outside the declared workspace, or if the speed exceeds its limit.
    fn asked(&self, asked: &Motion) -> Result<(Pose, Speed), Failure> {
        let (target, speed) = convert::motion(asked)?;
        let refused = |message| Err(Failure::new(ErrorKind::OutOfRange, message));
        let Point { x, y, z } = target.position;
        match (self.limits.workspace, self.limits.speed_max) {
            (Some(workspace), _) if !workspace.contains(&target.position) => {
                refused(format!("{x}, {y}, {z} is outside the workspace"))
            }
            (_, Some(most)) if speed > most => {
                refused(format!("the speed is {speed}, expected at most {most}"))
            }
            _ => Ok((target, speed)),
        }
    }
}

static CALLS: RobotCalls = RobotCalls {
    device: device_calls::<RobotCalls, Opened>(extension),
    pose: Some(pose),
    move_to: Some(move_to),
    wait: Some(wait),
    halt: Some(halt),
    clear_halt: Some(clear_halt),
};

static GUARDED: GuardedMotionCalls = GuardedMotionCalls {
    #[expect(clippy::cast_possible_truncation, reason = "sixteen bytes")]
    size: size_of::<GuardedMotionCalls>() as u32,
    reserved: 0,
    move_guarded: Some(move_guarded),
};

static EXPIRING: ExpiringMotionCalls = ExpiringMotionCalls {
    #[expect(clippy::cast_possible_truncation, reason = "sixteen bytes")]
    size: size_of::<ExpiringMotionCalls>() as u32,
    reserved: 0,
    move_expiring: Some(move_expiring),
};

unsafe extern "C" fn extension(handle: *mut c_void, id: Text) -> *const c_void {
    let has = |opened: &mut Opened| opened.robot.guarded_motion().is_some();
    // SAFETY: the host lends the text for the call.
    let guarded = unsafe { extended(handle, id, GUARDED_MOTION, &GUARDED, has) };
    if !guarded.is_null() {
        return guarded;
    }
    let expires = |opened: &mut Opened| opened.robot.expiring_motion().is_some();
    // SAFETY: as above.
    unsafe { extended(handle, id, EXPIRING_MOTION, &EXPIRING, expires) }
}

unsafe extern "C" fn pose(
    handle: *mut c_void,
    pose: *mut AbiPose,
    stamp: *mut Stamp,
    timeout_ns: u64,
    error: *mut Error,
) -> Status {
    let work = |opened: &mut Opened| {
        // SAFETY: the host provides memory for both.
        let (pose, stamp) =
            unsafe { (memory::place("pose", pose)?, memory::place("stamp", stamp)?) };
        let (stands, at) = opened.robot.pose(deadline(timeout_ns))?;
        (*pose, *stamp) = (convert::pose(&stands)?, convert::stamp(&at)?);
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}

/// Stores a motion that `wait` executes later, because the method `move_to` of core blocks until the end of the motion.
unsafe extern "C" fn move_to(
    handle: *mut c_void,
    target: *const Motion,
    token: *mut u64,
    error: *mut Error,
) -> Status {
    let work = |opened: &mut Opened| {
        // SAFETY: the host lends the motion for the call and provides the memory.
        let (target, token) = unsafe {
            (
                memory::sized("motion", target)?,
                memory::place("token", token)?,
            )
        };
        let (target, speed) = opened.asked(target)?;
        opened.motions += 1;
        opened.accepted = Some((opened.motions, target, speed));
        *token = opened.motions;
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}

unsafe extern "C" fn wait(
    handle: *mut c_void,
    token: u64,
    stamp: *mut Stamp,
    timeout_ns: u64,
    error: *mut Error,
) -> Status {
    let work = |opened: &mut Opened| {
        // SAFETY: the host provides memory for the stamp.
        let stamp = unsafe { memory::place("stamp", stamp) }?;
        let accepted = opened.accepted.take_if(|(accepted, ..)| *accepted == token);
        let (_, target, speed) = accepted.ok_or_else(|| {
            Failure::argument(format!(
                "motion {token} was not accepted, or its end was reported before"
            ))
        })?;
        let arrived = opened.robot.move_to(target, speed, deadline(timeout_ns))?;
        *stamp = convert::stamp(&arrived)?;
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}

/// Halts the robot without waiting for its pending call.
unsafe extern "C" fn halt(handle: *mut c_void, error: *mut Error) -> Status {
    let work = || {
        let handle = handles::find::<Handle<Opened>>(handle)?;
        match &handle.halt {
            Some(halt) => Ok(halt.halt()?),
            None => Err(Failure::new(
                ErrorKind::Internal,
                "the robot has no halt handle",
            )),
        }
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { guard(error, work) }
}

unsafe extern "C" fn clear_halt(handle: *mut c_void, timeout_ns: u64, error: *mut Error) -> Status {
    let work = |opened: &mut Opened| Ok(opened.robot.clear_halt(deadline(timeout_ns))?);
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}

unsafe extern "C" fn move_guarded(
    handle: *mut c_void,
    target: *const Motion,
    guard_n: f64,
    stop: *mut AbiGuardedStop,
    timeout_ns: u64,
    error: *mut Error,
) -> Status {
    let work = |opened: &mut Opened| {
        // SAFETY: the host lends the motion for the call. The memory of the stop belongs to the host and begins with its size.
        let (target, stop) = unsafe {
            (
                memory::sized("motion", target)?,
                memory::sized_place("stop", stop)?,
            )
        };
        let (target, speed) = opened.asked(target)?;
        if !(guard_n > 0.0 && guard_n.is_finite()) {
            let message =
                format!("the guard force is {guard_n} N, expected a finite number above 0");
            return Err(Failure::argument(message));
        }
        let guard = Guard::at(Newton(guard_n));
        let robot = opened.robot.guarded_motion().ok_or_else(|| {
            Failure::new(
                ErrorKind::Unsupported,
                "the robot does not support guarded motions",
            )
        })?;
        let (is_guarded, pose, at) =
            match robot.move_guarded(target, speed, guard, deadline(timeout_ns))? {
                GuardedStop::Arrived { stamp } => (0, target, stamp),
                GuardedStop::Guarded { pose, stamp } => (1, pose, stamp),
            };
        stop.is_guarded = is_guarded;
        (stop.pose, stop.stamp) = (convert::pose(&pose)?, convert::stamp(&at)?);
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}

unsafe extern "C" fn move_expiring(
    handle: *mut c_void,
    target: *const Motion,
    stamp: *mut Stamp,
    timeout_ns: u64,
    error: *mut Error,
) -> Status {
    let work = |opened: &mut Opened| {
        // SAFETY: the host lends the motion for the call and provides the memory.
        let (target, stamp) = unsafe {
            (
                memory::sized("motion", target)?,
                memory::place("stamp", stamp)?,
            )
        };
        let (target, speed) = opened.asked(target)?;
        let robot = opened.robot.expiring_motion().ok_or_else(|| {
            Failure::new(
                ErrorKind::Unsupported,
                "the robot does not support expiring motions",
            )
        })?;
        let arrived = robot.move_expiring(target, speed, deadline(timeout_ns))?;
        *stamp = convert::stamp(&arrived)?;
        Ok(())
    };
    // SAFETY: the host guarantees that `error` is valid.
    unsafe { call(handle, error, work) }
}
