//! A Python robot. A latch halts it before Python is called, so that hanging code cannot start another motion.

use std::sync::Arc;
use std::time::Duration;

use pyo3::prelude::*;
use taceva_core::{
    Deadline, Descriptor, DriverError, ErrorKind, ExpiringMotion, Guard, GuardedMotion,
    GuardedStop, Halt, Pose, Robot, Speed, Stamp,
};
use taceva_plugin::HaltLatch;

use super::objects::{Object, Stopper};
use super::poses::{placed, pose_of, python_pose};
use super::sensor::stamp;
use crate::errors::value_error;

const MOVE: &str = "move";

/// Robot that is a Python object with `pose(deadline)`, `move_to(target, speed, deadline)`, `halt()` and `clear_halt(deadline)`; `move_guarded` and
/// `move_expiring` are optional.
pub(super) struct PythonRobot {
    object: Object,
    latch: Arc<HaltLatch>,
    can_guard: bool,
    can_expire: bool,
}

impl PythonRobot {
    pub(super) fn new(object: Object, descriptor: &Descriptor) -> Result<PythonRobot, DriverError> {
        let can_guard = descriptor.robot().is_some_and(|facts| facts.guarded_motion);
        if can_guard && !object.has("move_guarded") {
            let why = "its class declares `guarded_motion=True` but has no method move_guarded(target, speed, force, deadline)";
            let refused = DriverError::new(ErrorKind::Unsupported, object.key(), "open the device");
            return Err(refused.because(why));
        }
        Ok(PythonRobot {
            latch: Arc::default(),
            can_guard,
            can_expire: object.has("move_expiring"),
            object,
        })
    }

    fn failed(&self, kind: ErrorKind, why: impl Into<String>) -> DriverError {
        DriverError::new(kind, self.object.key(), MOVE).because(why.into())
    }

    /// Runs a motion. If the motion fails, stops the robot before it returns the error. A halt during the motion is an error.
    fn motion<T>(
        &self,
        deadline: Deadline,
        work: impl FnOnce(&Bound<'_, PyAny>, Bound<'_, super::waiting::Deadline>) -> PyResult<T>,
    ) -> Result<T, DriverError> {
        if self.is_halted() {
            let why = "the robot is halted: clear the halt before the next motion";
            return Err(self.failed(ErrorKind::Interrupted, why));
        }
        let moved = self
            .object
            .call_until_halted(MOVE, deadline, &self.latch, work);
        match moved {
            Ok(_) if self.is_halted() => {
                Err(self.failed(ErrorKind::Interrupted, "it was halted on its way"))
            }
            Ok(arrived) => Ok(arrived),
            Err(error) => Err(self.stopped(error)),
        }
    }

    /// Stops the robot, and returns the error of the motion.
    fn stopped(&self, error: DriverError) -> DriverError {
        let kind = match self.is_halted() {
            // Devices report a stopped motion with various error kinds.
            true if error.fault().is_none() => ErrorKind::Interrupted,
            _ => error.kind(),
        };
        let cause = std::error::Error::source(&error).map(ToString::to_string);
        let mut why = cause.unwrap_or_else(|| error.kind().to_string());
        if let Err(unstopped) = self.object.stopper().stop() {
            why.push_str(&format!("; and it could not be stopped: {unstopped}"));
        }
        let mut failed = self.failed(kind, why);
        if let Some(fault) = error.fault() {
            failed = failed.with_fault(fault);
        }
        failed
    }

    fn is_halted(&self) -> bool {
        self.latch.rest(Duration::ZERO).is_err()
    }
}

/// Handle that halts the robot from any thread.
struct Handle {
    latch: Arc<HaltLatch>,
    stopper: Stopper,
}

impl Halt for Handle {
    fn halt(&self) -> Result<(), DriverError> {
        self.latch.halt()?;
        self.stopper.stop().map_err(|why| {
            DriverError::new(ErrorKind::DeviceFault, self.stopper.key(), "halt").because(why)
        })
    }
}

impl Robot for PythonRobot {
    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        self.object
            .call("read the pose", deadline, |object, deadline| {
                placed(&object.call_method1("pose", (deadline,))?, "pose")
            })
    }

    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        self.motion(deadline, |object, deadline| {
            let target = python_pose(object.py(), &target)?;
            let said = object.call_method1("move_to", (target, speed.mm_per_s(), deadline))?;
            stamp(&said, "move_to")
        })
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::new(Handle {
            latch: Arc::clone(&self.latch),
            stopper: self.object.stopper(),
        })
    }

    fn clear_halt(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.object
            .method("clear_halt", "clear the halt", deadline)?;
        self.latch.clear();
        Ok(())
    }

    fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
        if self.can_guard { Some(self) } else { None }
    }

    fn expiring_motion(&mut self) -> Option<&mut dyn ExpiringMotion> {
        if self.can_expire { Some(self) } else { None }
    }
}

impl GuardedMotion for PythonRobot {
    fn move_guarded(
        &mut self,
        target: Pose,
        speed: Speed,
        guard: Guard,
        deadline: Deadline,
    ) -> Result<GuardedStop, DriverError> {
        self.motion(deadline, |object, deadline| {
            let target = python_pose(object.py(), &target)?;
            let (speed, force) = (speed.mm_per_s(), guard.force.0);
            let said = object.call_method1("move_guarded", (target, speed, force, deadline))?;
            stop(&said)
        })
    }
}

/// Parses the result of `move_guarded`: a time after arrival, or a pose and a time after a stop at the force limit.
fn stop(said: &Bound<'_, PyAny>) -> PyResult<GuardedStop> {
    if let Ok((place, time)) = said.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>()
        && place.extract::<f64>().is_err()
    {
        let (pose, stamp) = (
            pose_of(&place, "move_guarded")?,
            stamp(&time, "move_guarded")?,
        );
        return Ok(GuardedStop::Guarded { pose, stamp });
    }
    let stamp = stamp(said, "move_guarded").map_err(|_| {
        value_error(
            "move_guarded returned neither a time nor (pose, time), expected the time of arrival, or the pose and time of the stop at the \
                force",
        )
    })?;
    Ok(GuardedStop::Arrived { stamp })
}

impl ExpiringMotion for PythonRobot {
    fn move_expiring(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        self.motion(deadline, |object, deadline| {
            let target = python_pose(object.py(), &target)?;
            let said =
                object.call_method1("move_expiring", (target, speed.mm_per_s(), deadline))?;
            stamp(&said, "move_expiring")
        })
    }
}
