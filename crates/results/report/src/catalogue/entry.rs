//! A sensor of the catalogue.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::facts::{Intrinsic, Limits, Size};
use super::offer::{Availability, Price};
use super::published::{Missing, Published, Source};

/// A sensor, or a study of sensors, as the catalogue knows it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sensor {
    /// 1.
    pub(super) catalogue_version: u32,
    /// Its name.
    pub name: String,
    /// Other names that stand for it, whatever their case.
    #[serde(default)]
    pub aliases: Vec<String>,
    /// `sensor`, or `study` of an evaluation of others.
    pub kind: Kind,
    /// IMM (intensity mapping), MDM (marker displacement), MFM (modality fusion) of a sensor with a camera; `magnetic`, `capacitive`, `resistive` or
    /// `optical` of taxels.
    pub mechanism: Vec<String>,
    /// Its form.
    pub shape: Option<String>,
    /// Whether no light from outside reaches the camera.
    pub opaque: Option<bool>,
    /// Whether its gel carries markers.
    pub markers: Option<bool>,
    /// Its construction.
    pub intrinsic: Option<Intrinsic>,
    /// Its limits.
    pub limits: Option<Limits>,
    /// Its outer dimensions.
    pub size: Option<Size>,
    /// Prices that were seen.
    #[serde(default, rename = "price")]
    pub prices: Vec<Price>,
    /// Ways to get one.
    #[serde(default)]
    pub availability: Vec<Availability>,
    /// Where the numbers are from.
    #[serde(default, rename = "source")]
    pub sources: Vec<Source>,
    /// What was published of it.
    #[serde(default, rename = "result")]
    pub results: Vec<Published>,
    /// What was not published, and why.
    #[serde(default)]
    pub missing: Vec<Missing>,
    /// Which properties the work itself reports: `yes`, `no` or `partial`; and the `source` that says so.
    #[serde(default)]
    pub reported: BTreeMap<String, String>,
    /// What it was evaluated on, by theme.
    #[serde(default)]
    pub applications: BTreeMap<String, Vec<String>>,
}

/// The kind of an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A sensor.
    Sensor,
    /// A study of sensors.
    Study,
}

impl Sensor {
    /// The published number of a metric and channel, if it is stated exactly.
    pub fn result(&self, metric: &str, channel: &str) -> Option<&Published> {
        let exact = self.results.iter().filter(|result| result.bound.is_none());
        let mut named = exact.filter(|result| result.metric == metric);
        named.find(|result| result.channel == channel)
    }

    /// Pictures a second, in Hz, where that is known.
    pub fn frame_rate_hz(&self) -> Option<f64> {
        let built = self.intrinsic.as_ref().map(|of| of.frame_rate_hz);
        built.or_else(|| Some(self.result("intrinsic", "frame_rate")?.value))
    }

    /// The area of the sensing surface, in mm², where that is known.
    pub fn field_of_view_mm2(&self) -> Option<f64> {
        let built = self.intrinsic.as_ref().map(|of| of.field_of_view_mm2);
        built.or_else(|| Some(self.result("intrinsic", "field_of_view")?.value))
    }

    /// How many numbers are known of it: of its construction, its limits and its published results.
    pub fn known(&self) -> usize {
        let built = if self.intrinsic.is_some() { 4 } else { 0 };
        let limits = if self.limits.is_some() { 3 } else { 0 };
        built + limits + self.results.len()
    }

    /// The source called `id`.
    pub fn source(&self, id: &str) -> Option<&Source> {
        self.sources.iter().find(|source| source.id == id)
    }

    /// Its name in file names and links: ASCII letters in lower case and digits as they are, `-` for every other character.
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
