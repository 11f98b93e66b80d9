//! Sensing area of a sensor, as stored in files.

use serde::{Deserialize, Serialize};

/// Area of the gel that the sensor can sense.
///
/// # Units
/// Lengths in mm.
///
/// ```
/// use taceva_dataset::Footprint;
///
/// let footprint = Footprint::disc(10.0).with_depth_max(2.5);
/// let whole = footprint.to_core()?;
/// assert_eq!(whole.depth_max().map(|depth| depth.0), Some(2_500_000));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Footprint {
    /// Shape of the outline. Determines which of the other lengths are present.
    pub shape: Shape,
    /// Radius of a disc, mm; `None` for a rectangle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_mm: Option<f64>,
    /// Half width of a rectangle along x, mm; `None` for a disc.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub half_x_mm: Option<f64>,
    /// Half width of a rectangle along y, mm; `None` for a disc.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub half_y_mm: Option<f64>,
    /// Maximum indentation of the gel, mm; `None` if unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth_max_mm: Option<f64>,
}

/// Shape of an outline.
///
/// ```
/// use taceva_dataset::{Footprint, Shape};
///
/// assert_eq!(Footprint::rectangle(8.0, 10.0).shape, Shape::Rect);
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// All points within a radius of the centre.
    Disc,
    /// All points within a half width of the centre, along x and along y.
    Rect,
}

impl Footprint {
    /// Disc with the radius `radius_mm`, mm.
    pub fn disc(radius_mm: f64) -> Footprint {
        Footprint {
            shape: Shape::Disc,
            radius_mm: Some(radius_mm),
            half_x_mm: None,
            half_y_mm: None,
            depth_max_mm: None,
        }
    }

    /// Rectangle with the half widths `half_x_mm` along x and `half_y_mm` along y, mm.
    pub fn rectangle(half_x_mm: f64, half_y_mm: f64) -> Footprint {
        Footprint {
            shape: Shape::Rect,
            radius_mm: None,
            half_x_mm: Some(half_x_mm),
            half_y_mm: Some(half_y_mm),
            depth_max_mm: None,
        }
    }

    /// The same area with the maximum indentation of the gel, mm.
    #[must_use]
    pub fn with_depth_max(self, depth_max_mm: f64) -> Footprint {
        Footprint {
            depth_max_mm: Some(depth_max_mm),
            ..self
        }
    }

    /// The same area in whole nanometres, the unit in which metrics bin positions.
    ///
    /// # Errors
    /// Error message if a length is missing, unexpected, not positive or above 10 m.
    pub fn to_core(&self) -> Result<taceva_core::Footprint, String> {
        if let Some(problem) = self.problem() {
            return Err(problem);
        }
        let length = |side: Option<f64>| side.unwrap_or_default();
        match self.shape {
            Shape::Disc => taceva_core::Footprint::disc(length(self.radius_mm), self.depth_max_mm),
            Shape::Rect => taceva_core::Footprint::rectangle(
                length(self.half_x_mm),
                length(self.half_y_mm),
                self.depth_max_mm,
            ),
        }
        .map_err(|error| error.to_string())
    }

    /// Error message if a length is missing, unexpected or not positive; `None` if all lengths are valid.
    pub fn problem(&self) -> Option<String> {
        let is_disc = self.shape == Shape::Disc;
        let sides = [
            ("radius_mm", self.radius_mm, is_disc),
            ("half_x_mm", self.half_x_mm, !is_disc),
            ("half_y_mm", self.half_y_mm, !is_disc),
        ];
        let side = sides.iter().find_map(|(name, side, wanted)| {
            (side.is_some() != *wanted).then(|| {
                let verb = if *wanted { "needs" } else { "has no" };
                format!("a footprint of this shape {verb} `{name}`")
            })
        });
        let lengths = [
            self.radius_mm,
            self.half_x_mm,
            self.half_y_mm,
            self.depth_max_mm,
        ];
        let is_length = |length: &f64| length.is_finite() && *length > 0.0;
        side.or_else(|| {
            let wrong = lengths.iter().flatten().find(|length| !is_length(length))?;
            Some(format!(
                "{wrong} mm is not a length of a footprint, expected a finite number above 0"
            ))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_footprint_has_the_lengths_of_its_shape() {
        let disc = Footprint {
            shape: Shape::Disc,
            radius_mm: Some(17.0),
            half_x_mm: None,
            half_y_mm: None,
            depth_max_mm: Some(3.5),
        };
        assert_eq!(disc.problem(), None);
        let rect = Footprint {
            shape: Shape::Rect,
            ..disc
        };
        assert!(rect.problem().expect("no half_x").contains("radius_mm"));
        let flat = Footprint {
            radius_mm: Some(0.0),
            ..disc
        };
        assert!(flat.problem().is_some());
    }
}
