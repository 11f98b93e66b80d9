//! Sensing surface of a gel, as a scene or a rig file states it.

use serde::Deserialize;
use taceva_core::Footprint;

/// Sensing surface, seen from above.
///
/// # Units
/// mm.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `shape`")]
pub struct FootprintSpec {
    /// Shape of the outline.
    pub shape: Shape,
    /// Radius of a disc, mm; `None` for a rectangle.
    pub radius_mm: Option<f64>,
    /// Half the width of a rectangle, mm; `None` for a disc.
    pub half_x_mm: Option<f64>,
    /// Half the height of a rectangle, mm; `None` for a disc.
    pub half_y_mm: Option<f64>,
}

/// Kinds of outline of a sensing surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// A disc.
    Disc,
    /// A rectangle.
    Rect,
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
