//! A scene: which sensors, on which rig, measured how, as a TOML text says it.

mod boards;
mod builtin;
mod check;
mod classifier;
mod counts;
mod devices;
mod metrics;
mod study;

pub use builtin::BuiltinScene;
pub use classifier::GratingClassifier;
pub use counts::{
    Calibration, Contact, Gratings, Hysteresis, Idle, LightSweep, Protocol, Repeatability, Spatial,
    SurfaceMap,
};
pub use devices::{DeviceSpec, FootprintSpec, LightingSpec, ModelSpec, SensorSpec, Shape};
pub use metrics::{MetricSettings, MetricsSpec, ReportSpec};
pub use study::Study;

pub(crate) use boards::spacings;

use std::sync::Arc;

use taceva_core::DriverKind;

use crate::rig_file::RigFile;
use crate::text::{SceneError, SceneProblem, Setting, Text};

/// Who says which devices there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NamedBy {
    /// The scene.
    Scene,
    /// A rig file.
    Rig,
}

/// A scene that was read and is whole in itself: what devices can do is asked by [`plan`](crate::plan).
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
    /// What the scene is called.
    pub name: String,
    /// The seed of every draw.
    pub seed: u64,
    /// Its sensors, each with the rig it is measured on; never empty.
    pub studies: Vec<Study>,
    /// What is to be computed, and how.
    pub metrics: MetricsSpec,
    /// The rig file that it is carried out on, if it names one; relative to the scene.
    pub rig: Option<Setting<String>>,
    /// How many presses of which kind.
    pub protocol: Protocol,
    /// How results are written.
    pub report: ReportSpec,
    pub(crate) text: Text,
}

impl Scene {
    /// The scene that `text` says; `source_name` is what errors call it.
    ///
    /// # Errors
    /// [`SceneError`] with the line: no TOML, an unknown key or name with the nearest known one, a count of nothing, a number that
    /// is none, two statements that exclude each other, a limit of a study above that of its scene.
    pub fn parse(source_name: &str, text: &str) -> Result<Scene, SceneError> {
        check::checked(Text::new(source_name, text)?, NamedBy::Scene)
    }

    /// The scene that `text` says, to be put on a rig: whether it names devices or not.
    ///
    /// # Errors
    /// As [`parse`](Scene::parse).
    pub fn parse_for_rig(source_name: &str, text: &str) -> Result<Scene, SceneError> {
        check::checked(Text::new(source_name, text)?, NamedBy::Rig)
    }

    /// Puts every study that presses on `rig`, whose devices stand in the place of those that the scene names.
    ///
    /// # Errors
    /// [`SceneError`] of the rig file, if it has no sensor.
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

    /// The drivers it names, study by study.
    pub fn drivers(&self) -> impl Iterator<Item = (DriverKind, &Setting<String>)> {
        self.studies.iter().flat_map(Study::drivers)
    }

    /// Refuses a driver that is not among `known`, pairs of a kind and a key such as `sim/gelsight`.
    ///
    /// # Errors
    /// [`SceneProblem::UnknownName`] with the line and the nearest key.
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
