//! Waiting for somebody to hold the enabling switch, while nothing moves.

use std::time::Duration;

use super::error::{Left, RunError, StopCause};
use super::event::Event;
use super::session::Run;
use super::tip::Step;
use super::trip::Trip;
use crate::content_id::ContentId;

/// From one look at the switch to the next.
const LOOK: Duration = Duration::from_millis(20);

impl Run<'_> {
    /// Waits until the enabling switch is held, at most for as long as the rig file says; returns at once on a rig without one.
    pub(super) fn wait_until_held(&mut self) -> Step<()> {
        let withheld = |run: &Run<'_>| run.tip.supervisor.lock().withheld();
        if withheld(self).is_none() {
            return Ok(());
        }
        (self.events)(&Event::Unheld);
        if let Some(operator) = &mut self.operator {
            operator.call_to_hold(self.patience_s);
        }
        let until_s = self.tip.clock.now_s() + self.patience_s;
        loop {
            match withheld(self) {
                None => return Ok(()),
                Some(lost @ Trip::SwitchLost) => return Err(StopCause::Tripped(lost)),
                Some(_) if self.tip.cancel.is_cancelled() => return Err(StopCause::Cancelled),
                Some(_) if self.tip.clock.now_s() > until_s => {
                    let patience_s = self.patience_s;
                    return Err(StopCause::Unheld { patience_s });
                }
                Some(_) => self.tip.clock.rest(LOOK),
            }
        }
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

    /// Brings the tip above the gel after a halt: never while nobody holds the enabling switch, and again each time that it is held anew.
    /// Whether it is there, and the cause that ends the run.
    pub(super) fn leave(&mut self, cause: StopCause) -> (StopCause, Left) {
        loop {
            let _ = self.tip.robot.halt();
            match self.wait_until_held() {
                Ok(()) => {}
                // Why it was to leave the gel says more than that nobody lets it.
                Err(_) if !cause.is_release() => return (cause, Left::InPlace),
                Err(unheld) => return (unheld, Left::InPlace),
            }
            if self.tip.abandon() {
                (self.events)(&Event::Retracted);
                return (cause, Left::Clear);
            }
            if self.tip.supervisor.lock().withheld() != Some(Trip::Released) {
                return (cause, Left::InPlace);
            }
        }
    }
}
