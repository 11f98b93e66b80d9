//! Waits until the enabling switch is held; nothing moves meanwhile.

use std::time::Duration;

use super::error::{Left, RunError, StopCause};
use super::event::Event;
use super::halt_reason::Trip;
use super::operator::Operator;
use super::session::Run;
use super::tip::{Step, Tip};
use crate::content_id::ContentId;

/// Interval between readings of the switch.
const LOOK: Duration = Duration::from_millis(20);

/// Operator who holds the enabling switch, and the longest time to wait for it.
pub(super) struct Attendant<'c> {
    pub(super) operator: Option<&'c mut dyn Operator>,
    pub(super) events: &'c mut dyn FnMut(&Event),
    /// Longest time to wait for the switch, in s. Ignored on a rig without a switch.
    pub(super) patience_s: f64,
}

impl Tip<'_> {
    /// Waits until the enabling switch is held, for at most `patience_s`. Returns immediately if the rig has no switch.
    pub(super) fn wait_until_held(&mut self, attendant: &mut Attendant<'_>) -> Step<()> {
        let withheld = |tip: &Tip<'_>| tip.supervisor.lock().withheld();
        if withheld(self).is_none() {
            return Ok(());
        }
        (attendant.events)(&Event::Unheld);
        let patience_s = attendant.patience_s;
        if let Some(operator) = &mut attendant.operator {
            operator.call_to_hold(patience_s);
        }
        let until_s = self.clock.now_s() + patience_s;
        loop {
            match withheld(self) {
                None => return Ok(()),
                Some(lost @ Trip::SwitchLost) => return Err(StopCause::Tripped(lost)),
                Some(_) if self.cancel.is_cancelled() => return Err(StopCause::Cancelled),
                Some(_) if self.clock.now_s() > until_s => {
                    return Err(StopCause::Unheld { patience_s });
                }
                Some(_) => self.clock.rest(LOOK),
            }
        }
    }

    /// Raises the tip above the gel if possible, and returns the error that ends the run. The tip moves only while the enabling switch is held. After
    /// each release, the wait and the attempt are repeated.
    pub(super) fn abandoned(&mut self, cause: StopCause, mut attendant: Attendant<'_>) -> RunError {
        if let StopCause::Tripped(trip) = cause {
            (attendant.events)(&Event::Halted(trip));
        }
        let (cause, left) = self.leave(cause, &mut attendant);
        // The tip is where it was before the run if nothing moved and the tip is above the gel.
        let is_untouched = left == Left::InPlace
            && !self.has_moved
            && self.find_pose().is_ok()
            && self.is_about_high();
        let left = match is_untouched {
            true => Left::Untouched,
            false => left,
        };
        RunError {
            press: None,
            cause,
            left,
        }
    }

    /// Raises the tip after a halt. Returns the cause that ends the run, and the place of the tip.
    fn leave(&mut self, cause: StopCause, attendant: &mut Attendant<'_>) -> (StopCause, Left) {
        if self.stands_clear {
            // Hands may be at the tip, so a robot that stands clear is not released.
            let _ = self.robot.halt();
            // The operator may have moved the tip down by hand during a question.
            let left = match self.find_pose().is_ok() && self.is_about_high() {
                true => Left::Clear,
                false => Left::InPlace,
            };
            return (cause, left);
        }
        loop {
            let _ = self.robot.halt();
            match self.wait_until_held(attendant) {
                Ok(()) => {}
                // The original cause is more informative than the missing hold.
                Err(_) if !cause.is_release() => return (cause, Left::InPlace),
                Err(unheld) => return (unheld, Left::InPlace),
            }
            if self.abandon() {
                (attendant.events)(&Event::Retracted);
                return (cause, Left::Clear);
            }
            if self.supervisor.lock().withheld() != Some(Trip::Released) {
                return (cause, Left::InPlace);
            }
        }
    }
}

impl Run<'_> {
    /// Like [`Tip::wait_until_held`], for the tip of this run.
    pub(super) fn wait_until_held(&mut self) -> Step<()> {
        let mut attendant = Attendant {
            operator: match &mut self.operator {
                Some(operator) => Some(&mut **operator),
                None => None,
            },
            events: &mut *self.events,
            patience_s: self.patience_s,
        };
        self.tip.wait_until_held(&mut attendant)
    }

    /// Waits until the enabling switch is held, before a motion begins.
    pub(super) fn hold(&mut self, press: Option<ContentId>) -> Result<(), RunError> {
        let left = match self.tip.contact_mm {
            None => Left::Clear,
            Some(_) => Left::InPlace,
        };
        self.wait_until_held()
            .map_err(|cause| RunError { press, cause, left })
    }

    /// Raises the tip above the gel if possible, and returns the error that ends the run.
    pub(super) fn abandoned(&mut self, press: Option<ContentId>, cause: StopCause) -> RunError {
        let attendant = Attendant {
            operator: match &mut self.operator {
                Some(operator) => Some(&mut **operator),
                None => None,
            },
            events: &mut *self.events,
            patience_s: self.patience_s,
        };
        let error = self.tip.abandoned(cause, attendant);
        RunError { press, ..error }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::rig::{CONTACT_MM, Rig, nothing, with_tip};

    #[test]
    fn a_tip_that_never_moved_is_only_left_in_place_if_it_may_be_in_the_gel() {
        for (height_mm, expected) in [(-3.0, Left::Untouched), (CONTACT_MM + 0.5, Left::InPlace)] {
            let rig = Rig::new(height_mm, nothing);
            rig.state().unheard = u32::MAX;
            let error = with_tip(&rig, |tip| {
                let cause = tip.find().expect_err("it is never made ready");
                let attendant = Attendant {
                    operator: None,
                    events: &mut |_| {},
                    patience_s: 0.0,
                };
                tip.abandoned(cause, attendant)
            });
            assert_eq!(error.left, expected, "{height_mm} mm");
            let said = error.to_string();
            assert_eq!(
                said.contains("perhaps in the gel"),
                expected == Left::InPlace,
                "{said}"
            );
            assert!(rig.motions().is_empty());
        }
    }

    #[test]
    fn after_a_stop_at_a_question_the_robot_is_halted_and_never_made_ready() {
        for (height_mm, expected) in [(-3.0, Left::Clear), (CONTACT_MM + 0.5, Left::InPlace)] {
            let rig = Rig::new(height_mm, nothing);
            rig.state().halted = false;
            let error = with_tip(&rig, |tip| {
                tip.stands_clear = true;
                let attendant = Attendant {
                    operator: None,
                    events: &mut |_| {},
                    patience_s: 0.0,
                };
                tip.abandoned(StopCause::Cancelled, attendant)
            });
            assert_eq!(error.left, expected, "{height_mm} mm");
            assert!(rig.motions().is_empty());
            let state = rig.state();
            assert!(state.halted, "{height_mm} mm");
            assert_eq!(state.readied, 0, "{height_mm} mm");
        }
    }
}
