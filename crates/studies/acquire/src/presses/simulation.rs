//! Checks that a scene uses only the simulated bench.

use taceva_core::shown;
use taceva_drivers::Drivers;

use crate::error::AcquireError;
use crate::scene::{PlannedScene, StudySource};

impl PlannedScene {
    /// Rejects a scene that does not press on the simulated bench. Used by unattended acquisition; opens no device.
    ///
    /// # Errors
    /// [`AcquireError::Request`] for a study with a real device, and for a study of an existing recording, which acquires nothing.
    pub fn check_simulated(&self, drivers: &Drivers) -> Result<(), AcquireError> {
        for study in &self.studies {
            let problem = match &study.source {
                StudySource::Rig(rig) if rig.is_only_simulated(drivers) => continue,
                StudySource::Rig(_) => "uses a real rig, which a person must supervise",
                StudySource::Recording(_) => "uses a recording and acquires no data",
            };
            let name = shown(&study.plan.name);
            return Err(AcquireError::Request(format!("study `{name}` {problem}")));
        }
        Ok(())
    }
}
