//! Search for the first contact in steps. The tip rests after each step, so that the gel is detected in its resting state.
//!
//! After the first contact, the gel is expected at a similar height elsewhere. With guard threads, one motion replaces the steps that end well above this
//! height, and the guard halts it at a collision. This saves the rest after each step. The remaining steps have the same heights as in a search without guard.
//!
//! The readings near the contact are kept, because depths may count from a surface that is fitted to them. Without guard threads, readings
//! are one segment apart. With guard threads, motions are longer, so the tip repeats the last steps segment by segment if a metric reads depths.

use taceva_core::Millimetre;

use super::align::Look;
use super::depth_zero::DepthZero;
use super::error::StopCause;
use super::halt_reason::Trip;
use super::supervisor::MotionStage;
use super::surface_fit::DepthForce;
use super::tip::{Step, Tip};

/// Greatest height of the gel above its highest known contact, in mm. A slope of 1 mm in 20 mm is 3 degrees.
const UNEVEN_MM: f64 = 0.4;
/// Number of steps above the first contact in which readings are used to fit the height of the gel.
const FITTED_STEPS: f64 = 6.0;
/// Number of the last steps that a guarded tip repeats segment by segment.
const PASSED_AGAIN_STEPS: f64 = 2.0;

/// First contact of a press, with the readings of the search.
#[derive(Clone, Debug)]
pub(super) struct Contact {
    /// First reading in contact.
    pub(super) look: Look,
    /// Depths and forces that were read during the search.
    readings: Vec<DepthForce>,
}

impl Tip<'_> {
    /// Descends until a contact is detected at the end of a step, and returns this contact. `None` if the search ends without contact.
    pub(super) fn search(&mut self) -> Step<Option<Contact>> {
        let (look, readings) = self.recorded(Vec::new(), Self::search_by_steps)?;
        Ok(look.map(|look| Contact { look, readings }))
    }

    /// Returns the depth zero of a press after the first contact. From now on, the depth limit counts from this zero.
    ///
    /// If `is_depth_read`, a guarded tip repeats the last steps segment by segment.
    pub(super) fn depth_zero(&mut self, contact: Contact, is_depth_read: bool) -> Step<DepthZero> {
        let contact_mm = contact.look.pose.position.z.0;
        let readings = match self.is_guarded && is_depth_read {
            true => self.recorded(contact.readings, Self::pass_again)?.1,
            false => contact.readings,
        };
        let window_mm = FITTED_STEPS * self.pace.step_mm;
        let zero = DepthZero::of(&readings, contact_mm, window_mm);
        let height_mm = zero.height.0;
        self.watch(MotionStage::Press { height_mm });
        Ok(zero)
    }

    /// Calls `act`. Returns the result, and `readings` with every reading during the call appended.
    fn recorded<T>(
        &mut self,
        readings: Vec<DepthForce>,
        act: impl FnOnce(&mut Self) -> Step<T>,
    ) -> Step<(T, Vec<DepthForce>)> {
        self.readings = Some(readings);
        let done = act(self);
        let readings = self.readings.take().unwrap_or_default();
        Ok((done?, readings))
    }

    /// Rises [`PASSED_AGAIN_STEPS`] steps in one motion, then descends segment by segment to the starting height.
    fn pass_again(&mut self) -> Step<()> {
        let end_mm = self.target.position.z.0;
        let mut above = self.target;
        above.position.z = Millimetre(end_mm - PASSED_AGAIN_STEPS * self.pace.step_mm);
        self.go(above, self.pace.contact)?;
        self.descend(end_mm)
    }

    fn search_by_steps(&mut self) -> Step<Option<Look>> {
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

    /// Raises the highest known height of the gel if a contact at `height_mm` is higher.
    pub(super) fn is_felt_at(&mut self, height_mm: f64) {
        let highest_mm = self.surface_mm.unwrap_or(height_mm);
        self.surface_mm = Some(height_mm.min(highest_mm));
    }

    /// Descends from `start_mm` in one motion that replaces all steps that end more than [`UNEVEN_MM`] above the known gel. Returns the number of
    /// these steps. After an unexpected contact, the tip retreats and the search makes every step.
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
                // The tip touched something other than the gel.
                self.readings = Some(Vec::new());
                Ok(0)
            }
            Err(cause) => Err(cause),
        }
    }

    /// Height of the tip at the end of step number `step` from `start_mm`, in mm.
    fn height_of_step(&self, start_mm: f64, step: u32) -> f64 {
        start_mm + f64::from(step) * self.pace.step_mm
    }

    /// Descends through air to `z_mm` in one motion. A robot with expiring motions stops by itself if this host stops sending commands.
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
    use crate::run::rig::{CONTACT_MM, Draws, Motion, Rig, with_tip};

    /// Test rig over a gel that pushes back below its surface. No two readings are equal.
    fn over_a_gel() -> Rig {
        Rig::new(-2.0, |question, height_mm| {
            let pressed_mm = (height_mm - CONTACT_MM).max(0.0);
            Some(0.5 * pressed_mm + f64::from(question) * 1e-9)
        })
    }

    /// Contact height and motions of a search. `know` sets the known height of the gel before the search.
    fn found(know: impl FnOnce(&mut Tip<'_>, &Rig)) -> (f64, Vec<Motion>) {
        let rig = over_a_gel();
        let contact = with_tip(&rig, |tip| {
            tip.release()?;
            tip.find_pose()?;
            know(tip, &rig);
            tip.search()
        });
        let contact = contact.expect("no fault").expect("a gel");
        (contact.look.pose.position.z.0, rig.motions())
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

    /// Depth zero of a press on a gel of 2 N/mm, and the stage of motion afterwards. Readings have 4 mN of noise, and segments are 15 µm.
    ///
    /// The seed determines the heights of the steps relative to the gel, as over a tilted gel.
    fn zero_of(seed: u32, is_guarded: bool) -> (DepthZero, MotionStage) {
        let seed = u64::from(seed);
        let start_mm = -2.0 + 0.1 * Draws::new(seed).fraction();
        let rig = Rig::new(start_mm, move |question, height_mm| {
            let noise = Draws::new((seed << 32) | u64::from(question)).normal();
            Some(2.0 * (height_mm - CONTACT_MM).max(0.0) + 0.004 * noise)
        });
        let found = with_tip(&rig, |tip| {
            tip.pace.segment_mm = 0.015;
            tip.is_guarded = is_guarded;
            tip.release()?;
            tip.find_pose()?;
            let contact = tip.search()?.expect("a gel");
            let zero = tip.depth_zero(contact, true)?;
            Ok::<_, StopCause>((zero, tip.stage))
        });
        found.expect("no fault")
    }

    #[test]
    fn over_a_noisy_tilted_gel_depths_count_from_its_surface_within_their_uncertainty() {
        for is_guarded in [false, true] {
            let (mut sum, mut squares, mut held) = (0.0, 0.0, 0.0);
            let mut lowest_mm = f64::NEG_INFINITY;
            for seed in 0..100 {
                let (zero, stage) = zero_of(seed, is_guarded);
                let error_mm = zero.height.0 - CONTACT_MM;
                let deviation = zero.uncertainty.expect("readings enough");
                sum += error_mm;
                squares += error_mm * error_mm;
                lowest_mm = lowest_mm.max(error_mm);
                held += f64::from(u8::from(error_mm.abs() <= 1.96 * deviation.0));
                // The limit of depth counts from there too.
                let height_mm = zero.height.0;
                assert_eq!(stage, MotionStage::Press { height_mm });
            }
            let mean_mm: f64 = sum / 100.0;
            let deviation_mm = (squares / 100.0 - mean_mm * mean_mm).sqrt();
            assert!(mean_mm.abs() < 0.005, "{mean_mm}");
            assert!(deviation_mm < 0.01, "{deviation_mm}");
            assert!(held >= 95.0, "{held}");
            // The true depth at the limit exceeds it by this error.
            assert!(lowest_mm <= 0.02, "{lowest_mm}");
        }
    }

    #[test]
    fn a_guarded_tip_passes_the_last_steps_again_only_where_depths_are_read() {
        for is_depth_read in [false, true] {
            let rig = over_a_gel();
            let (before, contact_mm) = with_tip(&rig, |tip| {
                tip.is_guarded = true;
                tip.release()?;
                tip.find_pose()?;
                let contact = tip.search()?.expect("a gel");
                let contact_mm = contact.look.pose.position.z.0;
                let before = rig.motions().len();
                tip.depth_zero(contact, is_depth_read)?;
                Ok::<_, StopCause>((before, contact_mm))
            })
            .expect("no fault");
            let again = &rig.motions()[before..];
            assert_eq!(again.is_empty(), !is_depth_read);
            if let [first, .., last] = again {
                let up_mm = first.from_mm - first.to_mm;
                assert!((up_mm - 0.2).abs() < 1e-9, "{again:?}");
                assert_eq!(last.to_mm.to_bits(), contact_mm.to_bits());
            }
        }
    }

    #[test]
    fn without_threads_the_zero_costs_no_motion() {
        let rig = over_a_gel();
        let before = with_tip(&rig, |tip| {
            tip.release()?;
            tip.find_pose()?;
            let contact = tip.search()?.expect("a gel");
            let before = rig.motions().len();
            tip.depth_zero(contact, true)?;
            Ok::<_, StopCause>(before)
        });
        assert_eq!(rig.motions().len(), before.expect("no fault"));
    }
}
