//! A robot of a child.

use std::sync::Arc;

use taceva_core::{
    Deadline, DriverError, Guard, GuardedMotion, GuardedStop, Halt, Pose, Robot, Speed, Stamp,
    check_pose,
};

use super::link::Link;
use crate::child::wire::{Answer, Call};

const MOVE: &str = "move";
const POSE: &str = "say where it is";

pub(super) struct RobotProxy {
    link: Link,
    guarded: bool,
}

impl RobotProxy {
    pub(super) fn new(link: Link, guarded: bool) -> RobotProxy {
        RobotProxy { link, guarded }
    }

    fn checked(&self, pose: Pose, doing: &'static str) -> Result<Pose, DriverError> {
        match check_pose(&pose) {
            Ok(()) => Ok(pose),
            Err(error) => Err(self.link.fault(doing, error)),
        }
    }
}

impl Robot for RobotProxy {
    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        match self.link.call(&Call::Pose { deadline }, POSE, deadline)? {
            Answer::At { pose, stamp } => {
                Ok((self.checked(pose, POSE)?, self.link.checked(stamp, POSE)?))
            }
            _ => Err(self.link.other_answer(POSE)),
        }
    }

    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let call = Call::MoveTo {
            target,
            speed,
            deadline,
        };
        match self.link.call(&call, MOVE, deadline)? {
            Answer::Stamped { stamp } => self.link.checked(stamp, MOVE),
            _ => Err(self.link.other_answer(MOVE)),
        }
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        self.link.halt_handle()
    }

    fn clear_halt(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.link
            .done(&Call::ClearHalt { deadline }, "end the halt", deadline)
    }

    fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
        if self.guarded { Some(self) } else { None }
    }
}

impl GuardedMotion for RobotProxy {
    fn move_guarded(
        &mut self,
        target: Pose,
        speed: Speed,
        guard: Guard,
        deadline: Deadline,
    ) -> Result<GuardedStop, DriverError> {
        let call = Call::MoveGuarded {
            target,
            speed,
            guard,
            deadline,
        };
        let stop = match self.link.call(&call, MOVE, deadline)? {
            Answer::Stopped { stop } => stop,
            _ => return Err(self.link.other_answer(MOVE)),
        };
        Ok(match stop {
            GuardedStop::Arrived { stamp } => GuardedStop::Arrived {
                stamp: self.link.checked(stamp, MOVE)?,
            },
            GuardedStop::Guarded { pose, stamp } => GuardedStop::Guarded {
                pose: self.checked(pose, MOVE)?,
                stamp: self.link.checked(stamp, MOVE)?,
            },
        })
    }
}
