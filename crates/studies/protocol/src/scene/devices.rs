//! Devices of a scene, and facts of a sensor that the scene states.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::footprint_spec::FootprintSpec;
use crate::text::Setting;

/// A device of a scene, named by the selector of its driver.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver`")]
pub struct DeviceSpec {
    /// Selector of the driver: `kind/name` or `kind/name:key=value;key=value`.
    pub driver: Setting<String>,
}

/// Light around a sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver` or `scenes`")]
pub struct LightingSpec {
    /// Selector of the lighting device. Without one, the sensor sets the light, or else the operator does.
    pub driver: Option<Setting<String>>,
    /// Light scenes to use, the calibration scene first. The default is all scenes of the driver. Required if the operator sets the light.
    pub scenes: Option<Setting<Vec<String>>>,
}

/// A sensor: a driver or a recording.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver` or `dataset`")]
pub struct SensorSpec {
    /// Selector of the driver of the sensor; `None` for a recording.
    pub driver: Option<Setting<String>>,
    /// Folder of a recording instead of a driver, relative to the scene.
    pub dataset: Option<Setting<String>>,
    /// Names of the units to measure. If `None`, a single unit `1` is measured.
    pub units: Option<Setting<Vec<String>>>,
    /// True if ambient light cannot reach the camera; `None` if not stated.
    pub opaque: Option<Setting<bool>>,
    /// True if the gel has markers; `None` if not stated.
    pub markers: Option<Setting<bool>>,
    /// Outline of the sensing surface, seen from above; `None` if not stated.
    pub footprint: Option<Setting<FootprintSpec>>,
}

/// Model that predicts positions and forces from frames: an estimator to fit, or a fitted model.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `name` or `file`")]
pub struct ModelSpec {
    /// Name of an estimator, such as `ridge`, `pls` or `forest`; `None` for a fitted model.
    pub name: Option<Setting<String>>,
    /// Path of a fitted model instead of a name, relative to the scene.
    pub file: Option<Setting<String>>,
    /// Settings of the estimator, by name.
    #[serde(default)]
    pub set: BTreeMap<String, toml::Value>,
    /// Number of folds of the calibration points. A model fitted on other points predicts each point. `None` predicts only a test part.
    pub folds: Option<Setting<u32>>,
    /// Split of calibration points or of a recording, such as `by-point 40/10/50`. `None` gives 70 % training, 20 % validation, 10 % test.
    pub split: Option<Setting<String>>,
}

/// Driver key of a selector: the text before its arguments.
pub(crate) fn key_of(selector: &str) -> &str {
    selector.split_once(':').map_or(selector, |(key, _)| key)
}
