//! Checks that a load that wears the gel is within its limit of force, and on the sensing area.

use taceva_core::{Footprint, Nanometre};

use super::Gather;
use crate::limits::RigLimits;
use crate::scene::WearLoad;
use crate::text::{SceneError, SceneProblem};

impl Gather<'_> {
    /// Rejects a force of `[protocol.wear]` beyond `limits`, and a travel that leaves `footprint`.
    pub(super) fn wear(&self, limits: &RigLimits, footprint: &Footprint) -> Result<(), SceneError> {
        let Some(spec) = &self.scene.protocol.wear else {
            return Ok(());
        };
        let force = &spec.force_n;
        if force.value > limits.normal_max.0 {
            let problem = SceneProblem::BeyondLimit {
                key: "force_N",
                found: force.value,
                limit_key: "Fz_max_N",
                limit: limits.normal_max.0,
                who: format!("study `{}`", self.study.name),
            };
            return Err(self.refusal(force.at(), problem));
        }
        let [half_x_mm, _] = footprint.half_extent().map(Nanometre::to_millimetres);
        match (WearLoad::from_name(&spec.load.value), &spec.travel_mm) {
            (Some(load), Some(travel)) if load.reach_mm(travel.value) > half_x_mm => {
                // The reach is proportional to the travel.
                let problem = format!(
                    "`travel_mm` is {}, and the load `{load}` then leaves the sensing area, which ends {half_x_mm} mm from its middle along x: expected at most {}",
                    travel.value,
                    half_x_mm / load.reach_mm(1.0)
                );
                Err(self.refusal(travel.at(), SceneProblem::Contradiction(problem)))
            }
            _ => Ok(()),
        }
    }
}
