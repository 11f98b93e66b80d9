//! Facts about the gel that the scene, the rig file, and the driver or recording may state.

use super::Gather;
use crate::rig_file::RigSensor;
use crate::text::{SceneError, SceneProblem, Setting};

impl Gather<'_> {
    /// True if ambient light cannot reach the camera; `None` if unknown. `stated` is the statement of the source.
    pub(super) fn opaque(&self, stated: Option<bool>) -> Result<Option<bool>, SceneError> {
        let on_rig = self.gel().and_then(|gel| gel.opaque);
        self.agreed("opaque", [self.study.sensor.opaque, on_rig], stated)
    }

    /// True if the gel has markers; `None` if unknown. `stated` is the statement of the source.
    pub(super) fn markers(&self, stated: Option<bool>) -> Result<Option<bool>, SceneError> {
        let on_rig = self.gel().and_then(|gel| gel.markers);
        self.agreed("markers", [self.study.sensor.markers, on_rig], stated)
    }

    /// Sensor in the rig file, if any.
    pub(super) fn gel(&self) -> Option<&RigSensor> {
        self.study.rig.as_ref()?.sensor.as_ref()
    }

    /// Merges the statements of the scene, the rig file and the source about a fact; `None` without a statement. Rejects a contradiction.
    fn agreed(
        &self,
        key: &str,
        [in_scene, on_rig]: [Option<Setting<bool>>; 2],
        stated: Option<bool>,
    ) -> Result<Option<bool>, SceneError> {
        let contradiction = |written: Setting<bool>, who: &str, stated: bool| {
            SceneProblem::Contradiction(format!(
                "`{key}` is {}, but {who} states {stated}: correct one of them",
                written.value
            ))
        };
        let of_sensor = |written: &Setting<bool>| {
            let other = stated.filter(|stated| *stated != written.value)?;
            Some(contradiction(*written, "the sensor", other))
        };
        if let (Some(rig), Some(on_rig)) = (&self.study.rig, on_rig) {
            if let Some(written) = in_scene.filter(|written| written.value != on_rig.value) {
                let place = rig.text.place(on_rig.at());
                let problem = contradiction(written, &place, on_rig.value);
                return Err(self.refusal(written.at(), problem));
            }
            if let Some(problem) = of_sensor(&on_rig) {
                return Err(rig.error(on_rig.at(), problem));
            }
        }
        if let Some(written) = in_scene
            && let Some(problem) = of_sensor(&written)
        {
            return Err(self.refusal(written.at(), problem));
        }
        let written = in_scene.or(on_rig).map(|written| written.value);
        Ok(written.or(stated))
    }
}
