//! Robot whose poses follow its commands at once, with one flaw.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use taceva_core::{
    Deadline, DriverError, ErrorKind, Guard, GuardedMotion, GuardedStop, Halt, Pose, Robot, Speed,
    Stamp, check_pose,
};

use super::{Flaw, Toy, error};

/// Halts a toy.
struct Latch {
    halted: Arc<AtomicBool>,
    flaw: Flaw,
}

impl Halt for Latch {
    fn halt(&self) -> Result<(), DriverError> {
        assert!(self.flaw != Flaw::Panics, "the toy is broken");
        if self.flaw != Flaw::IgnoresHandle {
            self.halted.store(true, Ordering::Release);
        }
        Ok(())
    }
}

impl Robot for Toy {
    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        self.ready("say where it stands", deadline)?;
        if self.flaw == Flaw::Creeps {
            self.pose.position.x.0 += 0.01;
        }
        Ok((self.pose, self.stamp()))
    }
    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        const DOING: &str = "move";
        self.ready(DOING, deadline)?;
        let flaw = self.flaw;
        if check_pose(&target).is_err() && flaw != Flaw::TakesNaN {
            return Err(error(ErrorKind::InvalidArgument, DOING));
        }
        let side = target.position.x.0.abs().max(target.position.y.0.abs());
        let too_far = side > 20.0 && flaw != Flaw::LeavesWorkspace;
        let too_fast = speed.mm_per_s() > 10.0 && flaw != Flaw::TakesAnySpeed;
        if too_far || too_fast {
            return Err(error(ErrorKind::OutOfRange, DOING));
        }
        if self.halted.load(Ordering::Acquire) {
            if flaw == Flaw::ForgetsHalt {
                self.halted.store(false, Ordering::Release);
            }
            return Err(error(ErrorKind::Interrupted, DOING));
        }
        let way_mm = (target.position.z.0 - self.pose.position.z.0).abs();
        let takes_s = way_mm / speed.mm_per_s();
        let patience_s = deadline.remaining().as_secs_f64();
        if takes_s > patience_s && flaw != Flaw::IgnoresDeadline {
            return Err(error(ErrorKind::Timeout, DOING));
        }
        self.pose = target;
        if flaw == Flaw::Overshoots {
            self.pose.position.z.0 -= 0.01;
        }
        Ok(self.stamp())
    }
    fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::new(Latch {
            halted: Arc::clone(&self.halted),
            flaw: self.flaw,
        })
    }
    fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
        self.halted.store(false, Ordering::Release);
        Ok(())
    }
    fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
        Some(self)
    }
}

impl GuardedMotion for Toy {
    fn move_guarded(
        &mut self,
        target: Pose,
        speed: Speed,
        guard: Guard,
        deadline: Deadline,
    ) -> Result<GuardedStop, DriverError> {
        let is_guard = guard.force.0 > 0.0;
        if !is_guard && self.flaw != Flaw::TakesAnyGuard {
            return Err(error(ErrorKind::InvalidArgument, "move guarded"));
        }
        let stamp = self.move_to(target, speed, deadline)?;
        Ok(GuardedStop::Arrived { stamp })
    }
}
