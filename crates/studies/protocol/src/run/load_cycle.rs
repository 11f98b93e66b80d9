//! One cycle of a load that wears the gel, under the same supervision as every press.
//!
//! The tip descends segment by segment from the first contact until the force is reached, then keeps its height. A limit of the gel ends the cycle.

use taceva_core::{Millimetre, Nanometre};

use super::halt_reason::Trip;
use super::tip::{SPARE_SEGMENTS, Step, Tip};
use crate::press::LoadCycle;

/// Tolerance for the rounding error of a depth, in mm.
const ROUNDING_MM: f64 = 1e-9;

impl Tip<'_> {
    /// Makes the load cycle `cycle` at `place`, from the first contact at `contact_mm` to the last motion under load.
    pub(super) fn load(
        &mut self,
        place: [Nanometre; 2],
        cycle: &LoadCycle,
        contact_mm: f64,
    ) -> Step<()> {
        self.press_until(cycle.force_n(), contact_mm)?;
        let height_mm = self.here().position.z.0;
        self.stroke(place, cycle, height_mm)
    }

    /// Makes the sideways motions of `cycle` at `height_mm`.
    pub(super) fn stroke(
        &mut self,
        place: [Nanometre; 2],
        cycle: &LoadCycle,
        height_mm: f64,
    ) -> Step<()> {
        for offset in cycle.offsets() {
            let target = Tip::waypoint(place, offset, height_mm, Nanometre(0));
            self.approach(target)?;
        }
        Ok(())
    }

    /// Descends by segments, each followed by a reading, until the normal force is at least `force_n`. At the greatest depth, the tip halts.
    fn press_until(&mut self, force_n: f64, contact_mm: f64) -> Step<()> {
        let segment_mm = self.pace.segment_mm;
        let limit_mm = self.pace.bearing.depth_max_mm;
        let mut patience = SPARE_SEGMENTS + 2.0 * limit_mm / segment_mm;
        while self.felt.normal_n < force_n {
            let here_mm = self.here().position.z.0;
            let left_mm = (limit_mm - (here_mm - contact_mm)).max(0.0);
            let mut below = self.target;
            below.position.z = Millimetre(here_mm + segment_mm.min(left_mm));
            self.go(below, self.pace.contact)?;
            let here_mm = self.here().position.z.0;
            // In the last segment the tip may lag, as in every motion in contact.
            if left_mm <= segment_mm + ROUNDING_MM && self.felt.normal_n < force_n {
                let depth_mm = here_mm - contact_mm;
                return Err(self.halt_for(Trip::Depth { depth_mm, limit_mm }));
            }
            patience -= 1.0;
            if patience < 0.0 {
                let distance_mm = (self.target.position.z.0 - here_mm).abs();
                return Err(self.halt_for(Trip::Diverged { distance_mm }));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use taceva_core::{Limit, PressOutcome};

    use super::*;
    use crate::press::Motion;
    use crate::run::error::StopCause;
    use crate::run::one_press::OnePress;
    use crate::run::rig::{CONTACT_MM, Rig, SEGMENT_MM, nothing, with_tip};
    use crate::scene::WearLoad;

    /// Compresses a gel of `stiffness_n_mm` once to `force` µN. Returns the outcome of the press, and the greatest depth of the tip, in mm.
    fn compressed(stiffness_n_mm: f64, force: u32) -> (PressOutcome, f64) {
        let deepest_mm = Arc::new(Mutex::new(0.0_f64));
        let seen = Arc::clone(&deepest_mm);
        let felt = move |question: u32, height_mm: f64| {
            let depth_mm = (height_mm - CONTACT_MM).max(0.0);
            let mut deepest_mm = seen.lock().expect("whole");
            *deepest_mm = deepest_mm.max(depth_mm);
            Some(stiffness_n_mm * depth_mm + f64::from(question) * 1e-6)
        };
        let press = OnePress::to(Nanometre(0), felt, |plan| {
            plan.presses[0].press.motion = Motion::Load(LoadCycle {
                load: WearLoad::Compression,
                force,
                travel: Nanometre(0),
            });
        });
        press.done.expect("a load is no fault");
        let [record] = &press.log.records[..] else {
            panic!("{} presses", press.log.records.len());
        };
        assert_eq!(record.samples.len(), 0);
        let deepest_mm = *deepest_mm.lock().expect("whole");
        (record.outcome, deepest_mm)
    }

    #[test]
    fn a_load_ends_within_a_segment_of_its_force_and_gives_no_sample() {
        let (outcome, deepest_mm) = compressed(0.5, 200_000);
        assert_eq!(outcome, PressOutcome::Complete);
        let greatest_mm = 0.4 + SEGMENT_MM + 1e-9;
        assert!((0.399..greatest_mm).contains(&deepest_mm), "{deepest_mm}");
    }

    #[test]
    fn a_gel_too_soft_for_the_force_ends_the_load_at_the_limit_of_depth() {
        let (outcome, deepest_mm) = compressed(0.25, 1_000_000);
        assert_eq!(outcome, PressOutcome::Limited(Limit::Depth));
        // The depth of 1 mm counts from the first contact, at most two steps of 0.1 mm below the gel.
        assert!((1.0..1.2).contains(&deepest_mm), "{deepest_mm}");
    }

    #[test]
    fn a_tip_that_stays_above_its_target_reaches_the_limit_of_depth_too() {
        let rig = Rig::new(CONTACT_MM, nothing);
        rig.state().lag_mm = SEGMENT_MM / 8.0;
        let cycle = LoadCycle {
            load: WearLoad::Compression,
            force: 1_000_000,
            travel: Nanometre(0),
        };
        let ended = with_tip(&rig, |tip| {
            tip.release()?;
            tip.find_pose()?;
            tip.load([Nanometre(0); 2], &cycle, CONTACT_MM)
        });
        let is_limit = matches!(ended, Err(StopCause::Tripped(Trip::Depth { .. })));
        assert!(is_limit, "{ended:?}");
    }
}
