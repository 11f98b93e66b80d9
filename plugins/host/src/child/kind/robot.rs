//! Robot: proxy in the host and server in the child.

use std::os::fd::OwnedFd;
use std::sync::Arc;

use taceva_core::{
    Deadline, DriverError, DriverKind, ExpiringMotion, Guard, GuardedMotion, GuardedStop, Halt,
    Pose, Robot, Speed, Stamp,
};

use super::{Kind, Server, answered, answered_if_able, unsupported};
use crate::child::link::Link;
use crate::child::wire::{Answer, Call, Failure, OpenedDevice};

const MOVE: &str = "move";

struct RobotProxy {
    link: Link,
    guarded: bool,
    expires: bool,
}

impl Kind for dyn Robot {
    const KIND: DriverKind = DriverKind::Robot;

    fn server(self: Box<dyn Robot>) -> Box<dyn Server> {
        Box::new(self)
    }

    fn proxy(link: Link, opened: OpenedDevice) -> Result<Box<dyn Robot>, DriverError> {
        match opened {
            OpenedDevice::Robot { guarded, expires } => Ok(Box::new(RobotProxy {
                link,
                guarded,
                expires,
            })),
            _ => Err(link.broke("it opened no robot")),
        }
    }
}

impl Server for Box<dyn Robot> {
    fn opened(&mut self) -> OpenedDevice {
        OpenedDevice::Robot {
            guarded: self.guarded_motion().is_some(),
            expires: self.expiring_motion().is_some(),
        }
    }

    fn halt(&self) -> Option<Arc<dyn Halt>> {
        Some(self.halt_handle())
    }

    fn answer(&mut self, call: Call, _: Vec<OwnedFd>) -> Result<Answer, Failure> {
        match call {
            Call::Pose { deadline } => answered(self.pose(deadline)),
            Call::MoveTo {
                target,
                speed,
                deadline,
            } => answered(self.move_to(target, speed, deadline)),
            Call::MoveGuarded {
                target,
                speed,
                guard,
                deadline,
            } => {
                let motion = self.guarded_motion();
                answered_if_able(
                    motion.map(|motion| motion.move_guarded(target, speed, guard, deadline)),
                )
            }
            Call::MoveExpiring {
                target,
                speed,
                deadline,
            } => {
                let motion = self.expiring_motion();
                answered_if_able(motion.map(|motion| motion.move_expiring(target, speed, deadline)))
            }
            Call::ClearHalt { deadline } => answered(self.clear_halt(deadline)),
            _ => Err(unsupported()),
        }
    }
}

impl Robot for RobotProxy {
    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let call = Call::Pose { deadline };
        self.link.ask(&call, "read the pose", deadline)
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
        self.link.ask(&call, MOVE, deadline)
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        self.link.halt_handle()
    }

    fn clear_halt(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let call = Call::ClearHalt { deadline };
        self.link.ask(&call, "end the halt", deadline)
    }

    fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
        if self.guarded { Some(self) } else { None }
    }

    fn expiring_motion(&mut self) -> Option<&mut dyn ExpiringMotion> {
        if self.expires { Some(self) } else { None }
    }
}

/// The child process renews the motion, so the motion stops if the child ends.
impl ExpiringMotion for RobotProxy {
    fn move_expiring(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let call = Call::MoveExpiring {
            target,
            speed,
            deadline,
        };
        self.link.ask(&call, MOVE, deadline)
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
        self.link.ask(&call, MOVE, deadline)
    }
}
