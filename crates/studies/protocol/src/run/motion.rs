//! One motion of the tip: checked, executed under supervision, and followed by a reading of force and pose.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, Pose, Robot, Speed, Stamp};

use super::error::StopCause;
use super::tip::{Step, Tip};
use super::way::{distance, is_straight_up};

impl Tip<'_> {
    /// Makes one straight motion, then reads force and pose.
    pub(super) fn go(&mut self, target: Pose, speed: Speed) -> Step<()> {
        self.go_by(target, speed, |robot, deadline| {
            robot.move_to(target, speed, deadline)
        })
    }

    /// Makes one straight motion at the contact speed. If the robot supports it, the motion is expiring: it stops by itself if the host fails.
    pub(super) fn go_expiring(&mut self, target: Pose) -> Step<()> {
        let speed = self.pace.contact;
        self.go_by(target, speed, |robot, deadline| {
            match robot.expiring_motion() {
                Some(expiring) => expiring.move_expiring(target, speed, deadline),
                None => robot.move_to(target, speed, deadline),
            }
        })
    }

    fn go_by(
        &mut self,
        target: Pose,
        speed: Speed,
        motion: impl FnOnce(&mut dyn Robot, Deadline) -> Result<Stamp, DriverError>,
    ) -> Step<()> {
        if self.cancel.is_cancelled() && !self.ignores_cancel {
            return Err(StopCause::Cancelled);
        }
        let here = self.here();
        if !is_straight_up(&here, &target) {
            self.bounds.admit(&target)?;
        }
        let seconds = 1.0 + 2.0 * distance(&here, &target) / speed.mm_per_s();
        let deadline = Deadline::after(Duration::from_secs_f64(seconds));
        let sent = self.supervisor.lock().sent(here, target);
        sent.map_err(StopCause::Tripped)?;
        self.target = target;
        self.has_moved = true;
        let moved = motion(self.robot, deadline);
        self.supervisor.lock().rests();
        if let Err(error) = moved {
            return Err(self.failed(error));
        }
        self.look().map(drop)
    }
}
