//! Retreat from the gel: after a press, after a halt, and after a fault if the signals are reliable again.

use std::time::Duration;

use taceva_core::{Millimetre, Point, Pose};

use super::supervisor::MotionStage;
use super::tip::{Step, Tip};

/// Height above the first contact at which the tip counts as in the air, in mm.
const AIR_MM: f64 = 0.5;
/// Greatest number of attempts to recover after a fault. Each attempt checks force and pose, then retreats.
const RECOVERY_TRIES: u32 = 10;
/// Rest before each attempt to recover after a fault.
const RECOVERY_REST: Duration = Duration::from_millis(20);

impl Tip<'_> {
    /// Retreats along the path of the approach, under supervision, to the travel height above the target.
    pub(super) fn retreat(&mut self) -> Step<()> {
        self.turn_back()?;
        let Point { x, y, z } = self.target.position;
        let height = -self.pace.clearance_mm;
        let air = self
            .contact_mm
            .map_or(height, |contact| (contact - AIR_MM).max(height));
        if z.0 > air {
            self.approach([x.0, y.0, air])?;
        }
        let z = Millimetre(height.min(z.0));
        let up = Pose {
            position: Point { x, y, z },
            ..self.target
        };
        self.go(up, self.pace.travel)?;
        self.contact_mm = None;
        Ok(())
    }

    /// Moves straight up by segments after a halt at a limit. Stops as soon as the tip may rest, at the latest at the first contact or at depth 0.
    /// Then resumes the supervision of the press, with depths measured from `height_mm`.
    pub(super) fn draw_back(&mut self, height_mm: f64) -> Step<()> {
        self.turn_back()?;
        let contact_mm = self.contact_mm.unwrap_or(height_mm);
        // A waypoint may be above the first contact. The tip then draws back to the height of depth 0.
        let least_mm = match self.here().position.z.0 >= contact_mm {
            true => contact_mm,
            false => height_mm,
        };
        loop {
            let Point { x, y, z } = self.here().position;
            let up = (z.0 - self.pace.segment_mm).max(least_mm);
            self.approach([x.0, y.0, up])?;
            let wrench = self.look()?.wrench;
            let depth_mm = self.at.position.z.0 - height_mm;
            if up <= least_mm || self.supervisor.lock().lets_rest(depth_mm, &wrench) {
                break;
            }
        }
        self.watch(MotionStage::Press { height_mm });
        Ok(())
    }

    /// Ends a halt. The supervisor then allows the present normal force, or its limit if that is greater.
    fn turn_back(&mut self) -> Step<()> {
        self.release()?;
        self.find_pose()?;
        let force_n = self.look()?.wrench.force[2].0;
        self.watch(MotionStage::Retreat { force_n });
        Ok(())
    }

    /// Leaves the gel after a fault, if force and pose are reliable; otherwise the robot remains halted. Returns true if the tip is in the air.
    pub(super) fn abandon(&mut self) -> bool {
        let _ = self.robot.halt();
        if self.robot_failed {
            return false;
        }
        for _ in 0..RECOVERY_TRIES {
            self.clock.rest(RECOVERY_REST);
            let retreated = self.is_trustworthy() && self.go_clear().is_ok();
            if retreated {
                return true;
            }
            let _ = self.robot.halt();
            if self.robot_failed {
                return false;
            }
        }
        false
    }

    fn go_clear(&mut self) -> Step<()> {
        // Cancellation must not interrupt the retreat.
        self.ignores_cancel = true;
        let done = self.retreat();
        self.ignores_cancel = false;
        done
    }

    /// True if two readings of the resting tip are healthy and differ as those of a working transducer do.
    fn is_trustworthy(&mut self) -> bool {
        if self.release().is_err() || self.find_pose().is_err() {
            return false;
        }
        match (self.look(), self.look()) {
            (Ok(one), Ok(other)) => self.supervisor.lock().is_live(&one, &other),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests;
