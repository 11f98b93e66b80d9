//! Faulty robot.

use std::sync::Arc;

use taceva_core::{
    Deadline, DriverError, DriverKey, ExpiringMotion, GuardedMotion, Halt, Millimetre, Pose, Robot,
    Speed, Stamp,
};

use super::link::Link;
use super::{FaultKind, FaultPlan};
use taceva_drivers::Pace;

/// Robot whose poses and motions fail according to a plan. A halt always reaches the robot.
pub struct FaultyRobot {
    inner: Box<dyn Robot>,
    link: Link,
    last: Option<Pose>,
}

impl FaultyRobot {
    /// Wraps the robot `inner`, whose driver key is `driver`. The link has the faults of `plan` and the clock `pace`.
    pub fn new(
        inner: Box<dyn Robot>,
        driver: DriverKey,
        plan: FaultPlan,
        pace: Box<dyn Pace>,
    ) -> FaultyRobot {
        FaultyRobot {
            inner,
            link: Link::new(driver, plan, pace),
            last: None,
        }
    }
}

impl Robot for FaultyRobot {
    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let read = |deadline| self.inner.pose(deadline);
        let ((mut pose, stamp), fault) = self.link.read("say where it stands", deadline, read)?;
        match (fault, self.last) {
            (Some(FaultKind::Freeze), Some(last)) => {
                pose = last;
                self.link.note(FaultKind::Freeze);
            }
            (Some(FaultKind::NotANumber), _) => {
                pose.position.z = Millimetre(f64::NAN);
                self.link.note(FaultKind::NotANumber);
            }
            _ => self.last = Some(pose),
        }
        Ok((pose, self.link.stamped(stamp, fault)))
    }

    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        mut deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        const DOING: &str = "move";
        let fault = self.link.next_fault();
        match fault {
            // The answer is lost, not the command: the robot moves, but the caller gets no answer.
            Some(FaultKind::Silence) => {
                self.inner.move_to(target, speed, deadline)?;
                return self.link.silence(DOING, deadline);
            }
            Some(FaultKind::Drop) => {
                self.link.note(FaultKind::Drop);
                return Err(self.link.timeout(DOING, deadline));
            }
            Some(FaultKind::SlowLink) => deadline = self.link.slow(DOING, deadline)?,
            _ => {}
        }
        let stamp = self.inner.move_to(target, speed, deadline)?;
        Ok(self.link.stamped(stamp, fault))
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        self.inner.halt_handle()
    }

    fn clear_halt(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.inner.clear_halt(deadline)
    }

    fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
        self.inner.guarded_motion()
    }

    fn expiring_motion(&mut self) -> Option<&mut dyn ExpiringMotion> {
        self.inner.expiring_motion()
    }
}
