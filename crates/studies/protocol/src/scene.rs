//! Scene in TOML: the sensors, their rigs, and the measurements to make.

mod boards;
mod builtin;
mod check;
mod classifier;
mod counts;
mod depth_origin;
mod devices;
mod metrics;
mod stress;
mod study;
mod task_metrics;
mod wanted_width;
mod wear;

pub use builtin::BuiltinScene;
pub use classifier::GratingClassifier;
pub use counts::{
    Calibration, Contact, Gratings, Hysteresis, Idle, LightSweep, PosePairs, Protocol,
    Repeatability, ShapePresses, Slip, Spatial, SurfaceMap,
};
pub use depth_origin::DepthOrigin;
pub use devices::{DeviceSpec, LightingSpec, ModelSpec, SensorSpec};
pub use metrics::{MetricSettings, MetricsSpec, ReportSpec};
pub use stress::{PluginFaultSpec, StressSpec};
pub use study::Study;
pub use wanted_width::WantedWidth;
pub use wear::{WearLoad, WearSpec, WearStage};

pub(crate) use boards::{spacing_of, spacings};
pub(crate) use task_metrics::phase_of_task;

use std::sync::Arc;

use taceva_core::DriverKind;

use crate::rig_file::RigFile;
use crate::text::{SceneError, SceneProblem, Setting, Text};

/// File that names the devices of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NamedBy {
    /// The scene.
    Scene,
    /// A rig file.
    Rig,
}

/// A checked scene. [`plan`](crate::plan) compares it with the capabilities of the devices.
///
/// ```
/// use taceva_protocol::Scene;
/// let text = r#"
/// scene_version = 1
/// name = "my gel"
/// sensor = { driver = "sim/gelsight" }
/// robot = { driver = "sim/robot" }
/// force = { driver = "sim/force-transducer" }
/// metrics = { want = ["sensitivty"] }
/// "#;
/// let error = Scene::parse("my.toml", text).unwrap_err();
/// assert!(error.to_string().starts_with("my.toml, line 7: `sensitivty`: unknown metric"));
/// ```
#[derive(Clone, Debug)]
pub struct Scene {
    /// Name of the scene.
    pub name: String,
    /// Seed of all random draws.
    pub seed: u64,
    /// Sensors, each with its rig; never empty.
    pub studies: Vec<Study>,
    /// Metrics to compute, and their settings.
    pub metrics: MetricsSpec,
    /// Path of the rig file, relative to the scene, if the scene names a rig file.
    pub rig: Option<Setting<String>>,
    /// Settings of each phase of the protocol, such as counts of presses.
    pub protocol: Protocol,
    /// Formats and files of the report.
    pub report: ReportSpec,
    /// Faults that the run adds to pictures, to test the model; `None` if the run tests none.
    pub stress: Option<StressSpec>,
    /// Additional faults of pictures, which plugins make.
    pub faults: Vec<PluginFaultSpec>,
    pub(crate) text: Text,
}

impl Scene {
    /// Parses the scene `text`; `source_name` is its name in errors.
    ///
    /// # Errors
    /// [`SceneError`] with the line:
    ///
    /// - invalid TOML, or an unknown key or name, with the most similar known name;
    /// - a count or number out of range, or two contradictory statements;
    /// - a limit of a study above the limit of its scene.
    pub fn parse(source_name: &str, text: &str) -> Result<Scene, SceneError> {
        check::checked(Text::new(source_name, text)?, NamedBy::Scene)
    }

    /// Parses a scene whose devices a rig file names. The scene itself may name no devices.
    pub fn parse_for_rig(source_name: &str, text: &str) -> Result<Scene, SceneError> {
        check::checked(Text::new(source_name, text)?, NamedBy::Rig)
    }

    /// Replaces the devices of every study by those of `rig`, except in studies of a recording.
    pub fn put_on(&mut self, rig: &Arc<RigFile>) -> Result<(), SceneError> {
        let pressed = |study: &&mut Study| study.sensor.dataset.is_none();
        for study in self.studies.iter_mut().filter(pressed) {
            let Some(sensor) = &rig.sensor else {
                let problem = SceneProblem::MissingKey("sensor".to_owned());
                return Err(rig.error(None, problem));
            };
            let device = |driver: &Setting<String>| DeviceSpec {
                driver: driver.clone(),
            };
            study.sensor.driver = Some(sensor.driver.clone());
            study.robot = rig.robot.as_ref().map(|robot| device(&robot.driver));
            study.force = rig.force.as_ref().map(|force| device(&force.driver));
            if let (Some(light), Some(lighting)) = (&rig.changers.light, &mut study.lighting) {
                lighting.driver = Some(light.clone());
            }
            study.rig = Some(Arc::clone(rig));
        }
        Ok(())
    }

    /// Drivers that the scene and its rig file name, study by study.
    pub fn drivers(&self) -> impl Iterator<Item = (DriverKind, &Setting<String>)> {
        self.studies.iter().flat_map(Study::drivers)
    }

    /// Rejects a driver that is not in `known`, a list of kinds with keys such as `sim/gelsight`.
    ///
    /// # Errors
    /// [`SceneProblem::UnknownName`] with the line and the most similar key.
    pub fn check_drivers(&self, known: &[(DriverKind, &str)]) -> Result<(), SceneError> {
        let named = self
            .studies
            .iter()
            .flat_map(|study| study.drivers().map(move |named| (study, named)));
        for (study, (kind, selector)) in named {
            let of_kind: Vec<&str> = known
                .iter()
                .filter(|(known, _)| *known == kind)
                .map(|(_, key)| *key)
                .collect();
            let key = devices::key_of(&selector.value);
            if !of_kind.contains(&key) {
                let what = match kind {
                    DriverKind::Sensor => "driver of a sensor",
                    DriverKind::Robot => "driver of a robot",
                    DriverKind::Force => "driver of a force transducer",
                    DriverKind::Changer => "driver of a changer",
                    _ => "driver of lighting",
                };
                let text = match kind {
                    DriverKind::Lighting if !study.is_lit_by_rig() => &self.text,
                    _ => study.device_text(self),
                };
                return Err(text.unknown_name(selector.at(), what, key, of_kind));
            }
        }
        Ok(())
    }
}
