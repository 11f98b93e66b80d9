//! A changer that moves to mount what a press needs: the robot is halted away from the gel for as long as it does.

use std::time::Duration;

use taceva_core::{Deadline, Specimen};

use super::error::{Left, RunError, StopCause};
use super::event::Event;
use super::session::Run;
use super::tip::Step;
use crate::plan::PlannedPress;

/// Why a changer that moves did not mount a specimen.
enum Unmounted {
    /// The changer itself failed: the robot is halted, and nobody knows what is mounted.
    Failed(StopCause),
    /// The robot did not come out of the way, or could not be let move again.
    Robot(StopCause),
}

impl Run<'_> {
    /// Has the changer mount the specimen of `planned`, where it must move to do so and holds it. Why not, where somebody is there who can do
    /// it instead: from then on the changer is out of use.
    ///
    /// # Errors
    /// [`RunError`] where it failed and nobody is there, or the specimen is one that it does not hold and nobody is there. The tip is above
    /// the gel, halted.
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
                    "somebody who mounts a {specimen}, which the changer does not hold"
                )))),
            };
        }
        match self.mount_by_changer(specimen, patience) {
            Ok(()) => Ok(None),
            Err(Unmounted::Robot(cause)) => Err(self.abandoned(Some(planned.id), cause)),
            Err(Unmounted::Failed(cause)) => {
                // Nobody knows what it holds up: what stands under the robot is a matter for a person.
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

    /// Whether there is a changer, and it holds `specimen`.
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

    /// Something else is on the robot now.
    pub(super) fn has_mounted(&mut self, specimen: Specimen) {
        self.mounted = Some(specimen);
        // Another specimen is another load on the transducer.
        self.tip.is_zero_known = false;
        // And it may be longer.
        self.tip.surface_mm = None;
        (self.events)(&Event::Mounted(specimen));
    }

    /// Brings the tip to the height of travel, where it stands lower, and halts the robot there.
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
