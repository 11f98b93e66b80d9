//! Checks of the load cycles that wear a gel.

use super::protocol::GREATEST_COUNT;
use super::{Check, Checked};
use crate::scene::study::Study;
use crate::scene::wear::{WearLoad, WearSpec};
use crate::text::{SceneError, SceneProblem};

impl Check<'_> {
    pub(super) fn wear(&self, wear: Option<&WearSpec>) -> Checked {
        let Some(wear) = wear else {
            return Ok(());
        };
        let Some(load) = WearLoad::from_name(&wear.load.value) else {
            let known = WearLoad::ALL.map(WearLoad::name).to_vec();
            return Err(self
                .text
                .unknown_name(wear.load.at(), "load", &wear.load.value, known));
        };
        self.cycles(wear)?;
        self.length("force_N", &wear.force_n)?;
        match (load, &wear.travel_mm) {
            (WearLoad::Compression, Some(travel)) => self.contradiction(
                travel.at(),
                "`travel_mm` with `load = \"compression\"`, which has no travel: remove `travel_mm`, or write the load `shear` or `abrasion`",
            ),
            (WearLoad::Compression, None) => Ok(()),
            (_, Some(travel)) => self.length("travel_mm", travel),
            (_, None) => {
                let problem = format!(
                    "the load `{load}` has no `travel_mm`: write it under [protocol.wear], such as travel_mm = 0.5"
                );
                self.refuse(wear.load.at(), SceneProblem::Incomplete(problem))
            }
        }
    }

    fn cycles(&self, wear: &WearSpec) -> Checked {
        let cycles = &wear.cycles;
        let Some(greatest) = cycles.value.iter().copied().max() else {
            return self.contradiction(
                cycles.at(),
                "`cycles` is empty: expected the cycles before each stage, such as [0, 100, 1000]",
            );
        };
        let mut pairs = cycles.value.windows(2);
        if let Some(pair) = pairs.find(|pair| pair[0] >= pair[1]) {
            let problem = format!(
                "`cycles` has {} after {}: expected ascending numbers, such as [0, 100, 1000]",
                pair[1], pair[0]
            );
            return self.contradiction(cycles.at(), &problem);
        }
        let greatest = cycles.clone().map(|_| greatest);
        self.count("cycles", &greatest, 0, GREATEST_COUNT)
    }

    /// Replaces each study by one study for each stage of `wear`, named after the number of cycles.
    pub(super) fn stages(
        &self,
        studies: Vec<Study>,
        wear: Option<&WearSpec>,
    ) -> Result<Vec<Study>, SceneError> {
        let Some(wear) = wear else {
            return Ok(studies);
        };
        let mut stages = Vec::new();
        for study in &studies {
            if let Some(dataset) = &study.sensor.dataset {
                return self.contradiction(
                    dataset.at(),
                    "`dataset` with [protocol.wear]: a recording cannot be loaded; name a `driver`, or compare recordings with `taceva wear`",
                );
            }
            if let Some(units) = &study.sensor.units
                && units.value.len() > 1
            {
                return self.contradiction(
                    units.at(),
                    "several `units` with [protocol.wear]: expected one unit for each study, since a recording states the presses of one gel",
                );
            }
            stages.extend(wear.stages(&study.name).into_iter().map(|stage| Study {
                name: format!("{} after {} cycles", study.name, stage.cycles),
                wear: Some(stage),
                ..study.clone()
            }));
        }
        for stage in &stages {
            let name = wear.load.clone().map(|_| stage.name.clone());
            self.name("a stage of wear", &name)?;
        }
        Ok(stages)
    }
}
