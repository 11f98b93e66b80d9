//! Search for the first contact by steps, each followed by rest, so that the gel is found in its resting state.
//!
//! Once felt, a gel begins at a similar height elsewhere. Guard threads allow one motion through the steps that end well above it, and halt
//! it at a collision. This saves the rest after each step. The remaining steps have the same heights as in a search without guard.

use taceva_core::Millimetre;

use super::align::Look;
use super::error::StopCause;
use super::halt_reason::Trip;
use super::supervisor::MotionStage;
use super::tip::{Step, Tip};

/// Greatest rise of the gel above the highest height felt so far, in mm: a millimetre on 20 is 3 degrees.
const UNEVEN_MM: f64 = 0.4;

impl Tip<'_> {
    /// Descends until the gel is felt at the end of a step. Returns the reading there; `None` at the end of the search.
    pub(super) fn search(&mut self) -> Step<Option<Look>> {
        let start_mm = self.target.position.z.0;
        let passed = self.pass_air(start_mm)?;
        self.watch(MotionStage::Search);
        // Until contact, the gel may be at any height below.
        self.contact_mm = Some(start_mm);
        for step in passed + 1.. {
            let z_mm = self.height_of_step(start_mm, step);
            if z_mm > self.pace.search_mm {
                break;
            }
            self.descend(z_mm)?;
            // A gel relaxes at rest: a force below the threshold before the rest stays below.
            if self.is_guarded && self.felt.normal_n < self.pace.threshold_n {
                continue;
            }
            let look = self.settle()?;
            if look.wrench.force[2].0 >= self.pace.threshold_n {
                let height_mm = look.pose.position.z.0;
                self.contact_mm = Some(height_mm);
                self.is_felt_at(height_mm);
                self.watch(MotionStage::Press { height_mm });
                return Ok(Some(look));
            }
        }
        Ok(None)
    }

    /// Updates the highest known height of the gel.
    pub(super) fn is_felt_at(&mut self, height_mm: f64) {
        let highest_mm = self.surface_mm.unwrap_or(height_mm);
        self.surface_mm = Some(height_mm.min(highest_mm));
    }

    /// Descends from `start_mm` in one motion through all steps that end well above the known gel. Returns their number. After an
    /// unexpected contact the tip retreats and the search makes every step.
    fn pass_air(&mut self, start_mm: f64) -> Step<u32> {
        let Some(surface_mm) = self.surface_mm.filter(|_| self.is_guarded) else {
            return Ok(0);
        };
        let lowest_mm = surface_mm - UNEVEN_MM;
        let passes = |step: &u32| self.height_of_step(start_mm, *step) <= lowest_mm;
        let steps = (1..).take_while(passes).last().unwrap_or(0);
        if steps < 2 {
            return Ok(0);
        }
        self.contact_mm = Some(start_mm);
        self.watch_way()?;
        match self.descend_through_air(self.height_of_step(start_mm, steps)) {
            Ok(()) => Ok(steps),
            Err(StopCause::Tripped(Trip::UnexpectedContact { .. })) => {
                self.surface_mm = None;
                self.retreat()?;
                Ok(0)
            }
            Err(cause) => Err(cause),
        }
    }

    /// Height of the tip at the end of a step, in mm.
    fn height_of_step(&self, start_mm: f64, step: u32) -> f64 {
        start_mm + f64::from(step) * self.pace.step_mm
    }

    /// Descends through air in one motion, which a robot with expiring motions stops by itself if this host falls silent.
    fn descend_through_air(&mut self, z_mm: f64) -> Step<()> {
        if self.robot.expiring_motion().is_none() {
            return self.descend(z_mm);
        }
        let mut target = self.target;
        target.position.z = Millimetre(z_mm);
        self.go_expiring(target)
    }

    /// Descends straight to `z_mm`.
    fn descend(&mut self, z_mm: f64) -> Step<()> {
        let place = self.target.position;
        self.approach([place.x.0, place.y.0, z_mm])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::rig::{CONTACT_MM, Motion, Rig, with_tip};

    /// A gel that pushes back below its surface; readings differ.
    fn over_a_gel() -> Rig {
        Rig::new(-2.0, |question, height_mm| {
            let pressed_mm = (height_mm - CONTACT_MM).max(0.0);
            Some(0.5 * pressed_mm + f64::from(question) * 1e-9)
        })
    }

    /// Height of contact, and the motions of the search, after `know` has set the knowledge of the gel.
    fn found(know: impl FnOnce(&mut Tip<'_>, &Rig)) -> (f64, Vec<Motion>) {
        let rig = over_a_gel();
        let look = with_tip(&rig, |tip| {
            tip.release()?;
            tip.find_pose()?;
            know(tip, &rig);
            tip.search()
        });
        let look = look.expect("no fault").expect("a gel");
        (look.pose.position.z.0, rig.motions())
    }

    #[test]
    fn where_a_gel_was_felt_before_the_way_through_the_air_is_one_motion_and_contact_the_same() {
        let (contact_mm, every) = found(|_, _| {});
        let (again_mm, few) = found(|tip, _| {
            tip.is_guarded = true;
            tip.surface_mm = Some(CONTACT_MM);
        });
        assert_eq!(again_mm.to_bits(), contact_mm.to_bits());
        // To 0.4 mm above it in motions of a millimetre at most, from there step by step.
        assert_eq!((few[0].from_mm, few[0].to_mm), (-2.0, -1.0));
        assert!((few[1].to_mm + 0.2).abs() < 1e-12, "{few:?}");
        assert!(few.len() < 9 && every.len() > 20, "{few:?}");
    }

    #[test]
    fn without_threads_that_look_on_every_step_is_made() {
        let (_, every) = found(|_, _| {});
        let (_, again) = found(|tip, _| tip.surface_mm = Some(CONTACT_MM));
        assert_eq!(every, again);
    }

    #[test]
    fn what_is_touched_in_the_air_is_left_and_every_step_is_made() {
        let (contact_mm, every) = found(|tip, _| tip.is_guarded = true);
        let (again_mm, motions) = found(|tip, rig| {
            tip.is_guarded = true;
            tip.surface_mm = Some(CONTACT_MM);
            tip.supervisor
                .lock()
                .call_zero(taceva_core::Wrench::default());
            tip.is_zero_known = true;
            rig.state().obstacle = Some((-1.5, tip.supervisor.clone()));
        });
        assert_eq!(again_mm.to_bits(), contact_mm.to_bits());
        let up = motions
            .iter()
            .position(|motion| motion.to_mm < motion.from_mm)
            .expect("it leaves what it touched");
        let from_above = &motions[up..];
        let begins = from_above
            .iter()
            .position(|motion| motion.to_mm > motion.from_mm)
            .expect("it comes down again");
        assert_eq!(from_above[begins..], every[..]);
    }
}
