//! Load cycles that wear the gel between measured stages.

use std::fmt;

use serde::Deserialize;

use crate::text::Setting;

/// Kind of load of a cycle that wears the gel. Callers only read it, and need a `_` arm to match it.
///
/// ```
/// use taceva_protocol::WearLoad;
///
/// assert_eq!(WearLoad::from_name("abrasion"), Some(WearLoad::Abrasion));
/// assert_eq!(WearLoad::Shear.to_string(), "shear");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum WearLoad {
    /// A press straight down.
    Compression,
    /// A press, followed by motions to both sides and back.
    Shear,
    /// A press, followed by a stroke along x.
    Abrasion,
}

impl WearLoad {
    /// All kinds of load.
    pub const ALL: [WearLoad; 3] = [WearLoad::Compression, WearLoad::Shear, WearLoad::Abrasion];

    /// Name of the kind of load in scenes.
    pub const fn name(self) -> &'static str {
        match self {
            WearLoad::Compression => "compression",
            WearLoad::Shear => "shear",
            WearLoad::Abrasion => "abrasion",
        }
    }

    /// Finds a kind of load by `name`; `None` for an unknown name.
    pub fn from_name(name: &str) -> Option<WearLoad> {
        WearLoad::ALL.into_iter().find(|load| load.name() == name)
    }

    /// Greatest distance of the tip from the middle of the sensing area in a cycle, in mm. The sideways travel is `travel_mm`.
    pub(crate) fn reach_mm(self, travel_mm: f64) -> f64 {
        match self {
            WearLoad::Compression => 0.0,
            WearLoad::Shear => travel_mm,
            WearLoad::Abrasion => travel_mm / 2.0,
        }
    }
}

impl fmt::Display for WearLoad {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Load cycles that wear the gel between measured stages.
///
/// The table `[protocol.wear]` of a scene sets them; callers only read them.
///
/// ```
/// use taceva_protocol::Scene;
/// let text = r#"
/// scene_version = 1
/// name = "gel"
/// sensor = { driver = "sim/gelsight" }
/// [protocol.wear]
/// load = "compression"
/// cycles = [0, 100]
/// force_N = 1.0
/// "#;
/// let scene = Scene::parse("worn.toml", text)?;
/// let names: Vec<&str> = scene.studies.iter().map(|study| study.name.as_str()).collect();
/// assert_eq!(names, ["gel after 0 cycles", "gel after 100 cycles"]);
/// # Ok::<(), taceva_protocol::SceneError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "a table with `load`, `cycles` and `force_N`"
)]
#[non_exhaustive]
pub struct WearSpec {
    /// Name of the kind of load: `compression`, `shear` or `abrasion`.
    pub load: Setting<String>,
    /// Total number of cycles on the gel before each stage, ascending.
    pub cycles: Setting<Vec<u32>>,
    /// Normal force at which the tip ends its descent, in N.
    #[serde(rename = "force_N")]
    pub force_n: Setting<f64>,
    /// Sideways travel of the tip, in mm; `None` for compression.
    pub travel_mm: Option<Setting<f64>>,
    /// Number of presses on the gel before the run.
    #[serde(default)]
    pub presses_since_gel: u32,
}

impl WearSpec {
    /// Sideways travel of the tip, in mm; 0 for compression.
    pub fn travel_mm(&self) -> f64 {
        self.travel_mm.as_ref().map_or(0.0, |travel| travel.value)
    }

    /// Stages of wear of the study with the name `study`, in order.
    pub(crate) fn stages(&self, study: &str) -> Vec<WearStage> {
        let cycles = &self.cycles.value;
        let before = std::iter::once(&0).chain(cycles);
        let stages = (0..).zip(cycles).zip(before);
        let stages = stages.map(|((number, &cycles), before)| WearStage {
            sensor: study.to_owned(),
            number,
            cycles,
            added: cycles.saturating_sub(*before),
        });
        stages.collect()
    }
}

/// Stage of a study with wear: load cycles, followed by measured presses.
///
/// ```
/// use taceva_protocol::Scene;
/// let text = r#"
/// scene_version = 1
/// name = "gel"
/// sensor = { driver = "sim/gelsight" }
/// protocol = { wear = { load = "shear", cycles = [10, 100], force_N = 1.0, travel_mm = 0.5 } }
/// "#;
/// let scene = Scene::parse("worn.toml", text)?;
/// let last = scene.studies[1].wear.as_ref().expect("a stage");
/// assert_eq!((last.number, last.cycles, last.added), (1, 100, 90));
/// # Ok::<(), taceva_protocol::SceneError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct WearStage {
    /// Name of the study in the scene, common to all stages.
    pub sensor: String,
    /// Number of the stage, from 0.
    pub number: u32,
    /// Total number of cycles on the gel before the measured presses.
    pub cycles: u32,
    /// Number of cycles since the previous stage.
    pub added: u32,
}
