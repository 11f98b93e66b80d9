//! Devices of a scene, and facts of a sensor that the scene states.

use std::collections::BTreeMap;

use serde::Deserialize;
use taceva_core::Footprint;

use crate::text::Setting;

/// A device, named by its driver.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver`")]
pub struct DeviceSpec {
    /// Selector, `kind/name` or `kind/name:key=value;key=value`.
    pub driver: Setting<String>,
}

/// Light around a sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver` or `scenes`")]
pub struct LightingSpec {
    /// Selector. Without one, the sensor sets the light; if it cannot, the operator does.
    pub driver: Option<Setting<String>>,
    /// Light scenes to visit, the one of calibration first. By default all scenes of the driver; required if the operator sets the light.
    pub scenes: Option<Setting<Vec<String>>>,
}

/// A sensor: a driver or a recording.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver` or `dataset`")]
pub struct SensorSpec {
    /// Selector of the driver.
    pub driver: Option<Setting<String>>,
    /// Folder of a recording instead of a driver, relative to the scene.
    pub dataset: Option<Setting<String>>,
    /// Names of the units to measure; by default a single unit `1`.
    pub units: Option<Setting<Vec<String>>>,
    /// True if ambient light cannot reach the camera.
    pub opaque: Option<Setting<bool>>,
    /// True if the gel has markers.
    pub markers: Option<Setting<bool>>,
    /// Outline of the sensing surface, seen from above.
    pub footprint: Option<Setting<FootprintSpec>>,
}

/// Sensing surface, seen from above.
///
/// # Units
/// mm.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `shape`")]
pub struct FootprintSpec {
    /// Shape of the outline.
    pub shape: Shape,
    /// Radius of a disc.
    pub radius_mm: Option<f64>,
    /// Half the width of a rectangle.
    pub half_x_mm: Option<f64>,
    /// Half the height of a rectangle.
    pub half_y_mm: Option<f64>,
}

/// An outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// A disc.
    Disc,
    /// A rectangle.
    Rect,
}

/// Model from frames to positions and forces: an estimator to fit, or a fitted model.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `name` or `file`")]
pub struct ModelSpec {
    /// Name of an estimator, such as `ridge`, `pls` or `forest`.
    pub name: Option<Setting<String>>,
    /// Path of a fitted model instead of a name, relative to the scene.
    pub file: Option<Setting<String>>,
    /// Settings of the estimator, by name.
    #[serde(default)]
    pub set: BTreeMap<String, toml::Value>,
}

/// Key of a selector: the text before its arguments.
pub(crate) fn key_of(selector: &str) -> &str {
    selector.split_once(':').map_or(selector, |(key, _)| key)
}

impl FootprintSpec {
    /// Builds the footprint; the error names the missing or superfluous length.
    pub(crate) fn footprint(&self, depth_max_mm: Option<f64>) -> Result<Footprint, String> {
        let FootprintSpec {
            shape,
            radius_mm,
            half_x_mm,
            half_y_mm,
        } = *self;
        let footprint = match (shape, radius_mm, half_x_mm, half_y_mm) {
            (Shape::Disc, Some(radius), None, None) => Footprint::disc(radius, depth_max_mm),
            (Shape::Rect, None, Some(half_x), Some(half_y)) => {
                Footprint::rectangle(half_x, half_y, depth_max_mm)
            }
            (Shape::Disc, ..) => {
                return Err("a disc has `radius_mm` and no other length".to_owned());
            }
            (Shape::Rect, ..) => {
                return Err("a rect has `half_x_mm` and `half_y_mm` and no other length".to_owned());
            }
        };
        footprint.map_err(|error| error.to_string())
    }
}
