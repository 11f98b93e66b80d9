//! Facts about a sensor other than scores: construction and limits.

use serde::Deserialize;

/// Construction of a sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Intrinsic {
    /// Id of the source.
    pub source: String,
    /// Camera resolution, megapixels.
    #[serde(rename = "camera_MP")]
    pub camera_mp: f64,
    /// Thickness, mm.
    pub thickness_mm: f64,
    /// Area of the sensing surface, mm².
    pub field_of_view_mm2: f64,
    /// Frame rate, Hz.
    #[serde(rename = "frame_rate_Hz")]
    pub frame_rate_hz: f64,
}

/// Limits of a sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Id of the source.
    pub source: String,
    /// Greatest indentation, mm.
    #[serde(rename = "Pz_max_mm")]
    pub pz_max_mm: f64,
    /// Greatest normal force, N.
    #[serde(rename = "Fz_max_N")]
    pub fz_max_n: f64,
    /// Greatest distance of a contact from the centre, mm.
    pub radius_max_mm: f64,
}
