//! The devices that a scene names, and the facts it states about a sensor.

use std::collections::BTreeMap;

use serde::Deserialize;
use taceva_core::Footprint;

use crate::text::Setting;

/// A device by the name of its driver.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver`")]
pub struct DeviceSpec {
    /// A selector, `kind/name` or `kind/name:key=value;key=value`.
    pub driver: Setting<String>,
}

/// The light around a sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver` or `scenes`")]
pub struct LightingSpec {
    /// A selector, as of every device; without one the sensor's own light is set, and where that has none somebody sets it by hand.
    pub driver: Option<Setting<String>>,
    /// The scenes of light to visit; all that the driver has when absent, which light that is set by hand must not. The first is the one of
    /// calibration.
    pub scenes: Option<Setting<Vec<String>>>,
}

/// A sensor: a driver, or a recording of one.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver` or `dataset`")]
pub struct SensorSpec {
    /// A selector, as of every device.
    pub driver: Option<Setting<String>>,
    /// The folder of a recording, instead of a driver; relative to the scene.
    pub dataset: Option<Setting<String>>,
    /// The units of the sensor model that are measured, by name; one that is called `1` when absent.
    pub units: Option<Setting<Vec<String>>>,
    /// Whether ambient light cannot reach the camera.
    pub opaque: Option<Setting<bool>>,
    /// Whether the gel carries markers.
    pub markers: Option<Setting<bool>>,
    /// The outline of the surface that senses, seen from above.
    pub footprint: Option<Setting<FootprintSpec>>,
}

/// The sensing surface seen from above.
///
/// # Units
/// mm.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `shape`")]
pub struct FootprintSpec {
    /// Its outline.
    pub shape: Shape,
    /// Of a disc.
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

/// The model that turns pictures into positions and forces: one to fit, or a finished one.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `name` or `file`")]
pub struct ModelSpec {
    /// The name of an estimator: `ridge`, `pls`, `forest` and so on.
    pub name: Option<Setting<String>>,
    /// A finished model, instead of a name; relative to the scene.
    pub file: Option<Setting<String>>,
    /// Its settings, by name.
    #[serde(default)]
    pub set: BTreeMap<String, toml::Value>,
}

/// The key of a selector: what stands before its arguments.
pub(crate) fn key_of(selector: &str) -> &str {
    selector.split_once(':').map_or(selector, |(key, _)| key)
}

impl FootprintSpec {
    /// The footprint it says, or what is missing or too much.
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
