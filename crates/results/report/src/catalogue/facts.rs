//! Facts about a sensor that are no scores: construction and limits.

use serde::Deserialize;

/// The construction of a sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Intrinsic {
    /// The id of the source.
    pub source: String,
    /// Millions of pixels of the camera.
    #[serde(rename = "camera_MP")]
    pub camera_mp: f64,
    /// Thickness, in mm.
    pub thickness_mm: f64,
    /// Area of the sensing surface, in mm².
    pub field_of_view_mm2: f64,
    /// Frames a second, in Hz.
    #[serde(rename = "frame_rate_Hz")]
    pub frame_rate_hz: f64,
}

/// The limits of a sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// The id of the source.
    pub source: String,
    /// The greatest indentation, in mm.
    #[serde(rename = "Pz_max_mm")]
    pub pz_max_mm: f64,
    /// The greatest normal force, in N.
    #[serde(rename = "Fz_max_N")]
    pub fz_max_n: f64,
    /// The greatest distance of a contact from the centre, in mm.
    pub radius_max_mm: f64,
}
