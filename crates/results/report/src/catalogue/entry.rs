//! Catalogue entry of a sensor.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::facts::{Intrinsic, Limits, Size};
use super::offer::{Availability, Price};
use super::published::{Missing, Published, Source};

/// Catalogue entry of a sensor, or of a study of sensors.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sensor {
    /// Version of the file; always 1.
    pub(super) catalogue_version: u32,
    /// Name of the sensor.
    pub name: String,
    /// Other names of the sensor; case is ignored.
    #[serde(default)]
    pub aliases: Vec<String>,
    /// `sensor`, or `study` for an evaluation of several sensors.
    pub kind: Kind,
    /// IMM (intensity mapping), MDM (marker displacement) or MFM (modality fusion) for a sensor with a camera; `magnetic`, `capacitive`, `resistive`
    /// or `optical` for taxels.
    pub mechanism: Vec<String>,
    /// Shape of the sensor.
    pub shape: Option<String>,
    /// True if no ambient light reaches the camera.
    pub opaque: Option<bool>,
    /// True if the gel has markers.
    pub markers: Option<bool>,
    /// Construction.
    pub intrinsic: Option<Intrinsic>,
    /// Limits.
    pub limits: Option<Limits>,
    /// Outer dimensions.
    pub size: Option<Size>,
    /// Prices with their dates.
    #[serde(default, rename = "price")]
    pub prices: Vec<Price>,
    /// Ways to get one.
    #[serde(default)]
    pub availability: Vec<Availability>,
    /// Sources of the numbers.
    #[serde(default, rename = "source")]
    pub sources: Vec<Source>,
    /// Published numbers.
    #[serde(default, rename = "result")]
    pub results: Vec<Published>,
    /// Numbers that are not published, with the reason.
    #[serde(default)]
    pub missing: Vec<Missing>,
    /// Properties that the work reports, each `yes`, `no` or `partial`; the key `source` names their source.
    #[serde(default)]
    pub reported: BTreeMap<String, String>,
    /// Applications in its evaluation, by theme.
    #[serde(default)]
    pub applications: BTreeMap<String, Vec<String>>,
}

/// Kind of an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A sensor.
    Sensor,
    /// A study of sensors.
    Study,
}

impl Sensor {
    /// Published number of a metric and channel, if it is stated exactly.
    pub fn result(&self, metric: &str, channel: &str) -> Option<&Published> {
        let exact = self.results.iter().filter(|result| result.bound.is_none());
        let mut named = exact.filter(|result| result.metric == metric);
        named.find(|result| result.channel == channel)
    }

    /// Frame rate in Hz; `None` if unknown.
    pub fn frame_rate_hz(&self) -> Option<f64> {
        let built = self.intrinsic.as_ref().map(|of| of.frame_rate_hz);
        built.or_else(|| Some(self.result("intrinsic", "frame_rate")?.value))
    }

    /// Area of the sensing surface in mm²; `None` if unknown.
    pub fn field_of_view_mm2(&self) -> Option<f64> {
        let built = self.intrinsic.as_ref().map(|of| of.field_of_view_mm2);
        built.or_else(|| Some(self.result("intrinsic", "field_of_view")?.value))
    }

    /// Number of known values among construction, limits and published results.
    pub fn known(&self) -> usize {
        let built = if self.intrinsic.is_some() { 4 } else { 0 };
        let limits = if self.limits.is_some() { 3 } else { 0 };
        built + limits + self.results.len()
    }

    /// Source called `id`.
    pub fn source(&self, id: &str) -> Option<&Source> {
        self.sources.iter().find(|source| source.id == id)
    }

    /// Name for files and links: lower-case ASCII letters and digits; `-` for any other character.
    pub fn slug(&self) -> String {
        let letters = self.name.chars().map(|letter| {
            if letter.is_ascii_alphanumeric() {
                letter.to_ascii_lowercase()
            } else {
                '-'
            }
        });
        letters.collect()
    }
}
