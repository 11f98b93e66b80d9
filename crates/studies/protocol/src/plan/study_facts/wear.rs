//! Checks that a load that wears the gel is within its limits of force, and on the sensing area.

use taceva_core::{Axes, Axis, Footprint, Nanometre};

use super::Gather;
use crate::limits::RigLimits;
use crate::scene::WearLoad;
use crate::text::{SceneError, SceneProblem};

impl Gather<'_> {
    /// Rejects a force of `[protocol.wear]` beyond `limits`, a travel that leaves `footprint`, and a travel whose shear force the transducer does not
    /// measure along `axes`.
    pub(super) fn wear(
        &self,
        limits: &RigLimits,
        footprint: &Footprint,
        axes: Option<Axes>,
    ) -> Result<(), SceneError> {
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
        let load = WearLoad::from_name(&spec.load.value);
        let (Some(load), Some(travel)) = (load, &spec.travel_mm) else {
            return Ok(());
        };
        let shows_shear =
            axes.is_some_and(|axes| axes.contains(Axis::Fx) && axes.contains(Axis::Fy));
        if !shows_shear {
            let problem = format!(
                "the load `{load}` moves sideways in contact, but no transducer measures Fx and Fy, so shear has no limit: use such a transducer, or load = \"compression\""
            );
            return Err(self.refusal(spec.load.at(), SceneProblem::Contradiction(problem)));
        }
        let [half_x_mm, _] = footprint.half_extent().map(Nanometre::to_millimetres);
        if load.reach_mm(travel.value) > half_x_mm {
            // The reach is proportional to the travel.
            let problem = format!(
                "`travel_mm` is {}, and the load `{load}` then leaves the sensing area, which ends {half_x_mm} mm from its middle along x: expected at most {}",
                travel.value,
                half_x_mm / load.reach_mm(1.0)
            );
            return Err(self.refusal(travel.at(), SceneProblem::Contradiction(problem)));
        }
        Ok(())
    }
}
