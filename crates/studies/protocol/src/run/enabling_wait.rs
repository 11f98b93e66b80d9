//! Waiting for somebody to hold the enabling switch, while nothing moves.

use std::time::Duration;

use super::error::{Left, RunError, StopCause};
use super::event::Event;
use super::halt_reason::Trip;
use super::operator::Operator;
use super::session::Run;
use super::tip::{Step, Tip};
use crate::content_id::ContentId;

/// From one look at the switch to the next.
const LOOK: Duration = Duration::from_millis(20);

/// Who is called to hold the enabling switch, and for how long that is waited for.
pub(super) struct Attendant<'c> {
    pub(super) operator: Option<&'c mut dyn Operator>,
    pub(super) events: &'c mut dyn FnMut(&Event),
    /// In s; of a rig without a switch never waited.
    pub(super) patience_s: f64,
}

impl Tip<'_> {
    /// Waits until the enabling switch is held, at most for as long as the rig file says; returns at once on a rig without one.
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

    /// The error that ends a run, after the tip was brought above the gel: never while nobody holds the enabling switch, and again each time that it
    /// is held anew.
    pub(super) fn abandoned(&mut self, cause: StopCause, mut attendant: Attendant<'_>) -> RunError {
        if let StopCause::Tripped(trip) = cause {
            (attendant.events)(&Event::Halted(trip));
        }
        let (cause, left) = self.leave(cause, &mut attendant);
        RunError {
            press: None,
            cause,
            left,
        }
    }

    /// Whether the tip is above the gel after a halt, and the cause that ends the run.
    fn leave(&mut self, cause: StopCause, attendant: &mut Attendant<'_>) -> (StopCause, Left) {
        loop {
            let _ = self.robot.halt();
            match self.wait_until_held(attendant) {
                Ok(()) => {}
                // Why it was to leave the gel says more than that nobody lets it.
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
    /// As [`Tip::wait_until_held`].
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

    /// The same, before a motion of which nothing has begun.
    pub(super) fn hold(&mut self, press: Option<ContentId>) -> Result<(), RunError> {
        let left = match self.tip.contact_mm {
            None => Left::Clear,
            Some(_) => Left::InPlace,
        };
        self.wait_until_held()
            .map_err(|cause| RunError { press, cause, left })
    }

    /// The error that ends the run, after the tip was brought to where it can be left.
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
