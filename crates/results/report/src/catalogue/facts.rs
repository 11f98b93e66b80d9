//! Facts about a sensor other than scores: construction, limits and outer dimensions.

use serde::Deserialize;

/// Construction of a sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Intrinsic {
    /// Id of the source.
    pub source: String,
    /// Camera resolution, in megapixels.
    #[serde(rename = "camera_MP")]
    pub camera_mp: f64,
    /// Thickness, in mm.
    pub thickness_mm: f64,
    /// Area of the sensing surface, in mm².
    pub field_of_view_mm2: f64,
    /// Frame rate, in Hz.
    #[serde(rename = "frame_rate_Hz")]
    pub frame_rate_hz: f64,
}

/// Limits of a sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Id of the source.
    pub source: String,
    /// Greatest indentation, in mm.
    #[serde(rename = "Pz_max_mm")]
    pub pz_max_mm: f64,
    /// Greatest normal force, in N.
    #[serde(rename = "Fz_max_N")]
    pub fz_max_n: f64,
    /// Greatest distance of a contact from the centre, in mm.
    pub radius_max_mm: f64,
}

/// Outer dimensions of a sensor.
///
/// ```
/// let digit = taceva_report::catalogue::find("DIGIT").expect("there");
/// assert_eq!(digit.size.map(|size| size.shown()).as_deref(), Some("20 × 27 × 18"));
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Size {
    /// Width, depth and height in mm in the order of the source; or a diameter and a length; or a diameter.
    pub mm: Vec<f64>,
    /// Id of the source.
    pub source: String,
    /// Place in the source: `table`, `figure` or `text`.
    pub read_from: String,
    /// Measured part: `housing`, `fingertip`.
    pub conditions: String,
}

impl Size {
    /// Dimensions in mm: `20 × 27 × 18`.
    pub fn shown(&self) -> String {
        let sides = self.mm.iter().map(f64::to_string);
        sides.collect::<Vec<_>>().join(" × ")
    }

    /// True for one to three positive dimensions.
    pub(super) fn is_possible(&self) -> bool {
        let is_length = |side: &f64| side.is_finite() && *side > 0.0;
        (1..=3).contains(&self.mm.len()) && self.mm.iter().all(is_length)
    }
}
