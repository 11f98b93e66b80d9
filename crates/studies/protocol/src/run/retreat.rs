//! The way out of the gel: after a press, after a halt, and after a fault whose signals must first be trusted again.

use std::time::Duration;

use taceva_core::{Millimetre, Point, Pose};

use super::supervisor::MotionStage;
use super::tip::{Step, Tip};

/// Above the first contact by this much the tip is in the air again, in mm.
const AIR_MM: f64 = 0.5;
/// Looks that must find force and pose healthy before the tip moves again after a fault.
const RECOVERY_TRIES: u32 = 10;
const RECOVERY_REST: Duration = Duration::from_millis(20);

impl Tip<'_> {
    /// Leaves the gel along the way it came, under watch, up to the height of travel, over the place where it was sent.
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

    /// After a halt at a limit: goes straight up, segment by segment, until a limit no longer keeps it from resting; at most to the height
    /// of the first contact. From there the press is watched again.
    pub(super) fn draw_back(&mut self, height_mm: f64) -> Step<()> {
        self.turn_back()?;
        loop {
            let Point { x, y, z } = self.here().position;
            let up = (z.0 - self.pace.segment_mm).max(height_mm);
            self.approach([x.0, y.0, up])?;
            let wrench = self.look()?.wrench;
            let depth_mm = self.at.position.z.0 - height_mm;
            if up <= height_mm || self.supervisor.lock().lets_rest(depth_mm, &wrench) {
                break;
            }
        }
        self.watch(MotionStage::Press { height_mm });
        Ok(())
    }

    /// Ends a halt, and begins to watch that the force does not rise above what it is now.
    fn turn_back(&mut self) -> Step<()> {
        self.release()?;
        self.find_pose()?;
        let force_n = self.look()?.wrench.force[2].0;
        self.watch(MotionStage::Retreat { force_n });
        Ok(())
    }

    /// After a fault: leaves the gel if force and pose can be trusted again, else stays halted. Whether it is in the air.
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
        // Cancellation must not interrupt the retraction.
        self.ignores_cancel = true;
        let done = self.retreat();
        self.ignores_cancel = false;
        done
    }

    /// Whether two looks at the resting tip are healthy and differ, as those of a live transducer do.
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
