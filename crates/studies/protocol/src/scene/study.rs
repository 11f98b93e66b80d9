//! One sensor of a scene, with the rig it is measured on.

use std::sync::Arc;

use taceva_core::DriverKind;

use super::Scene;
use super::devices::{DeviceSpec, LightingSpec, ModelSpec, SensorSpec};
use crate::frame_size::FrameSize;
use crate::limit_spec::LimitSpec;
use crate::rig_file::RigFile;
use crate::text::Setting;
use crate::text::Text;

/// What one sensor is measured with.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// What it is called in the report; the name of the scene if the scene has one sensor.
    pub name: String,
    /// The sensor.
    pub sensor: SensorSpec,
    /// The robot that carries the indenter.
    pub robot: Option<DeviceSpec>,
    /// The force transducer.
    pub force: Option<DeviceSpec>,
    /// The light around the sensor.
    pub lighting: Option<LightingSpec>,
    /// Its limits, with those of the scene where it has none.
    pub limits: LimitSpec,
    /// The model; without one nothing is predicted.
    pub model: Option<ModelSpec>,
    /// The size to which frames are reduced before they are kept; as they come without one.
    pub frames: Option<Setting<FrameSize>>,
    /// The rig file that names its devices, where one does.
    pub rig: Option<Arc<RigFile>>,
}

impl Study {
    /// The text that names its sensor, its robot and its force transducer: that of a rig file, or that of `scene`.
    pub(crate) fn device_text<'a>(&'a self, scene: &'a Scene) -> &'a Text {
        match &self.rig {
            Some(rig) => &rig.text,
            None => &scene.text,
        }
    }

    /// Whether the rig file names the lighting.
    pub(crate) fn is_lit_by_rig(&self) -> bool {
        let rig = self.rig.as_ref();
        rig.is_some_and(|rig| rig.changers.light.is_some())
    }

    /// The drivers it names, with the changers of its rig file.
    pub fn drivers(&self) -> impl Iterator<Item = (DriverKind, &Setting<String>)> {
        let changers = self.rig.as_ref().map(|rig| &rig.changers);
        [
            (DriverKind::Sensor, self.sensor.driver.as_ref()),
            (
                DriverKind::Robot,
                self.robot.as_ref().map(|robot| &robot.driver),
            ),
            (
                DriverKind::Force,
                self.force.as_ref().map(|force| &force.driver),
            ),
            (
                DriverKind::Lighting,
                self.lighting
                    .as_ref()
                    .and_then(|lighting| lighting.driver.as_ref()),
            ),
            (
                DriverKind::Changer,
                changers.and_then(|changers| changers.specimen.as_ref()),
            ),
            (
                DriverKind::Changer,
                changers.and_then(|changers| changers.unit.as_ref()),
            ),
        ]
        .into_iter()
        .filter_map(|(kind, driver)| Some((kind, driver?)))
    }

    /// The names of the units that are measured.
    pub fn units(&self) -> Vec<String> {
        match &self.sensor.units {
            Some(units) => units.value.clone(),
            None => vec!["1".to_owned()],
        }
    }
}
