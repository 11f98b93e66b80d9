//! Mounts specimens by a changer that moves. The robot is halted away from the gel during the change.

use std::time::Duration;

use taceva_core::{Deadline, Specimen};

use super::error::{Left, RunError, StopCause};
use super::event::Event;
use super::session::Run;
use super::tip::Step;
use crate::plan::PlannedPress;

/// Reasons why a moving changer did not mount a specimen.
enum Unmounted {
    /// The changer failed. The robot is halted, and the mounted specimen is unknown.
    Failed(StopCause),
    /// The robot did not retreat, or its halt could not be lifted.
    Robot(StopCause),
}

impl Run<'_> {
    /// Mounts the specimen of `planned` with the changer, if the changer holds it and has moving parts. If the changer fails and an operator is
    /// present, returns the reason, and the changer is not used again.
    ///
    /// # Errors
    /// [`RunError`] without an operator if the changer fails or does not contain the specimen. The robot is halted above the gel.
    pub(super) fn change(&mut self, planned: &PlannedPress) -> Result<Option<String>, RunError> {
        let specimen = planned.press.specimen;
        let Some(patience) = self
            .specimens
            .as_ref()
            .and_then(|changer| changer.patience())
            .filter(|_| self.mounted != Some(specimen))
        else {
            return Ok(None);
        };
        let halted = |cause| RunError {
            press: Some(planned.id),
            cause,
            left: Left::Clear,
        };
        if !self.is_held_by_changer(specimen) {
            return match self.operator {
                Some(_) => Ok(None),
                None => Err(halted(StopCause::Missing(format!(
                    "a person to mount a {specimen}, which the changer does not hold"
                )))),
            };
        }
        match self.mount_by_changer(specimen, patience) {
            Ok(()) => Ok(None),
            Err(Unmounted::Robot(cause)) => Err(self.abandoned(Some(planned.id), cause)),
            Err(Unmounted::Failed(cause)) => {
                // After a failure, the state of the changer is unknown, so the operator must check it.
                self.specimens = None;
                self.mounted = None;
                if self.tip.cancel.is_cancelled() {
                    return Err(halted(StopCause::Cancelled));
                }
                match self.operator {
                    Some(_) => Ok(Some(cause.to_string())),
                    None => Err(halted(cause)),
                }
            }
        }
    }

    /// True if the changer holds `specimen`.
    pub(super) fn is_held_by_changer(&self, specimen: Specimen) -> bool {
        let changer = self.specimens.as_ref();
        changer.is_some_and(|changer| changer.holds(specimen))
    }

    fn mount_by_changer(
        &mut self,
        specimen: Specimen,
        patience: Duration,
    ) -> Result<(), Unmounted> {
        self.stand_out_of_the_way().map_err(Unmounted::Robot)?;
        let Some(changer) = &mut self.specimens else {
            return Ok(());
        };
        changer
            .mount(specimen, Deadline::after(patience))
            .map_err(|error| Unmounted::Failed(error.into()))?;
        self.tip.release().map_err(Unmounted::Robot)?;
        self.has_mounted(specimen);
        Ok(())
    }

    /// Records the mounted specimen, and forgets the zero of the force and the surface height.
    pub(super) fn has_mounted(&mut self, specimen: Specimen) {
        self.mounted = Some(specimen);
        // Another specimen changes the load on the transducer.
        self.tip.is_zero_known = false;
        // Another specimen may be longer.
        self.tip.surface_mm = None;
        (self.events)(&Event::Mounted(specimen));
    }

    /// Raises the tip to the travel height if it is lower, and halts the robot there.
    pub(super) fn stand_out_of_the_way(&mut self) -> Step<()> {
        if !self.tip.is_high() {
            self.wait_until_held()?;
            self.tip.retreat()?;
        }
        self.tip.hold()
    }
}

#[cfg(test)]
mod tests;
