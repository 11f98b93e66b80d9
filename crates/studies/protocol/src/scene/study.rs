//! One sensor of a scene, with its rig.

use std::sync::Arc;

use taceva_core::DriverKind;

use super::Scene;
use super::devices::{DeviceSpec, LightingSpec, ModelSpec, SensorSpec};
use super::wear::WearStage;
use crate::frame_size::FrameSize;
use crate::limit_spec::LimitSpec;
use crate::rig_file::RigFile;
use crate::text::Setting;
use crate::text::Text;

/// A sensor with its rig, limits and model.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// Name of the study in the report. A scene with one sensor gives it the name of the scene by default.
    pub name: String,
    /// The sensor.
    pub sensor: SensorSpec,
    /// Robot that moves the indenter, if any.
    pub robot: Option<DeviceSpec>,
    /// Force transducer, if any.
    pub force: Option<DeviceSpec>,
    /// Light around the sensor; `None` if the scene states no light.
    pub lighting: Option<LightingSpec>,
    /// Limits of the study. The limits of the scene are the defaults.
    pub limits: LimitSpec,
    /// Model of the study; `None` for no predictions.
    pub model: Option<ModelSpec>,
    /// Size of stored frames; `None` stores full frames.
    pub frames: Option<Setting<FrameSize>>,
    /// Rig file that names the devices, if any.
    pub rig: Option<Arc<RigFile>>,
    /// Stage of wear; `None` without `[protocol.wear]`.
    pub wear: Option<WearStage>,
}

impl Study {
    /// Text with the names of sensor, robot and force transducer: that of the rig file if there is one, otherwise that of `scene`.
    pub(crate) fn device_text<'a>(&'a self, scene: &'a Scene) -> &'a Text {
        match &self.rig {
            Some(rig) => &rig.text,
            None => &scene.text,
        }
    }

    /// True if the rig file names the lighting.
    pub(crate) fn is_lit_by_rig(&self) -> bool {
        let rig = self.rig.as_ref();
        rig.is_some_and(|rig| rig.changers.light.is_some())
    }

    /// Drivers of the study, with the changers of its rig file.
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

    /// Names of the units to measure.
    pub fn units(&self) -> Vec<String> {
        match &self.sensor.units {
            Some(units) => units.value.clone(),
            None => vec!["1".to_owned()],
        }
    }
}
