//! A study whose planned presses are repeated on a worn gel of the simulated bench.

use std::collections::BTreeSet;

use taceva_drivers::Drivers;

use super::{PlannedStudy, StudySource};

impl PlannedStudy {
    /// The study with a simulated gel that has `fault` at `severity`, and with only the planned presses whose ids are in `presses`. `None` for a
    /// recording, for real devices, and for a sensor without this fault.
    pub fn worn(
        &self,
        fault: &str,
        severity: u8,
        presses: &BTreeSet<String>,
        drivers: &Drivers,
    ) -> Option<PlannedStudy> {
        let StudySource::Rig(rig) = &self.source else {
            return None;
        };
        if !rig.is_only_simulated(drivers) {
            return None;
        }
        let rig = rig.worn(fault, severity);
        let units = self.study.units();
        let unit = units.first()?;
        let described = rig.describe(&drivers.sensors, rig.sensor.as_ref(), unit);
        described.ok()??;
        let mut plan = self.plan.clone();
        plan.presses
            .retain(|planned| presses.contains(&planned.id.to_string()));
        plan.units.retain(|unit| {
            let mut left = plan.presses.iter();
            left.any(|planned| planned.press.unit == *unit)
        });
        let mut study = self.study.clone();
        study.sensor.driver = rig.sensor.clone();
        Some(PlannedStudy {
            plan,
            study,
            source: StudySource::Rig(rig),
        })
    }
}
