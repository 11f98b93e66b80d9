//! Catalogue entry of a sensor.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::bundle_row::{Measured, Origin};
use super::facts::{Limits, Size};
use super::offer::{Availability, Price, Way};
use super::published::{Missing, Published, Source};
use crate::faults::FaultResult;

/// Catalogue entry of a sensor, or of a study of sensors.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sensor {
    /// Version of the file: 2, or 1 without values from bundles.
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
    /// Shape of the sensor, such as `fingertip`; `None` if unknown.
    pub shape: Option<String>,
    /// True if no ambient light reaches the camera; `None` if unknown.
    pub opaque: Option<bool>,
    /// True if the gel has markers; `None` if unknown.
    pub markers: Option<bool>,
    /// Remark on the product behind the published numbers, such as its inference from a data sheet; `None` for no remark.
    pub identity: Option<String>,
    /// Limits of depth, force and radius; `None` if unknown.
    pub limits: Option<Limits>,
    /// Outer dimensions; `None` if unknown.
    pub size: Option<Size>,
    /// Prices with their dates.
    #[serde(default, rename = "price")]
    pub prices: Vec<Price>,
    /// Known sellers, or files for building the sensor.
    #[serde(default)]
    pub availability: Vec<Availability>,
    /// Sources of the numbers.
    #[serde(default, rename = "source")]
    pub sources: Vec<Source>,
    /// Published numbers.
    #[serde(default, rename = "result", alias = "published")]
    pub results: Vec<Published>,
    /// Values from bundles whose samples were recorded.
    #[serde(default)]
    pub measured: Vec<Measured>,
    /// Values from bundles whose samples have no stated origin.
    #[serde(default)]
    pub unknown: Vec<Measured>,
    /// Values from bundles whose samples are simulated or synthetic.
    #[serde(default)]
    pub simulated: Vec<Measured>,
    /// Digest of the samples behind `results`, if these come from a bundle or a result; `None` for published numbers.
    #[serde(skip)]
    pub samples: Option<String>,
    /// Prediction errors on pictures or signals with faults; `None` if no fault was tested.
    #[serde(skip)]
    pub faults: Option<FaultResult>,
    /// Metrics for which the sources state no number, each with the reason.
    #[serde(default)]
    pub missing: Vec<Missing>,
    /// Properties that the publication reports, each `yes`, `no` or `partial`. The key `source` has the id of the source.
    #[serde(default)]
    pub reported: BTreeMap<String, String>,
    /// Applications in the evaluation of the sensor, by theme, such as `force`.
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
    /// Published number of a metric and channel; `None` if the source states no number, or only an inexact number.
    pub fn result(&self, metric: &str, channel: &str) -> Option<&Published> {
        let exact = self.results.iter().filter(|result| result.bound.is_none());
        let mut named = exact.filter(|result| result.metric == metric);
        named.find(|result| result.channel == channel)
    }

    /// Frame rate in Hz; `None` if unknown.
    pub fn frame_rate_hz(&self) -> Option<f64> {
        Some(self.result("intrinsic", "frame_rate")?.value)
    }

    /// Number of known values among size, prices, limits and published results.
    pub fn known(&self) -> usize {
        let size = usize::from(self.size.is_some());
        let limits = if self.limits.is_some() { 3 } else { 0 };
        size + self.prices.len() + limits + self.results.len()
    }

    /// True if a seller of the sensor is known.
    pub fn is_sold(&self) -> bool {
        let mut ways = self.availability.iter();
        ways.any(|offer| offer.way == Way::Bought)
    }

    /// Lowest exact price of a ready sensor in `currency`; `None` if no price is known.
    pub fn price_in(&self, currency: &str) -> Option<&Price> {
        let ready = self.prices.iter().filter(|price| price.is_comparable());
        let ready = ready.filter(|price| price.currency == currency);
        ready.min_by(|left, right| left.amount.total_cmp(&right.amount))
    }

    /// Rows of bundles in the table of `origin`.
    pub fn rows(&self, origin: Origin) -> &[Measured] {
        match origin {
            Origin::Measured => &self.measured,
            Origin::Unknown => &self.unknown,
            Origin::Simulated => &self.simulated,
        }
    }

    /// Rows of bundles in all tables.
    pub fn all_rows(&self) -> impl Iterator<Item = &Measured> {
        Origin::ALL
            .into_iter()
            .flat_map(move |origin| self.rows(origin))
    }

    /// Source with the id `id`; `None` for an unknown id.
    pub fn source(&self, id: &str) -> Option<&Source> {
        self.sources.iter().find(|source| source.id == id)
    }

    /// Name of the sensor for files and links; see [`slug_of`](Sensor::slug_of).
    pub fn slug(&self) -> String {
        Sensor::slug_of(&self.name)
    }

    /// Name for files and links of a sensor called `name`. Converts ASCII letters to lower case, and replaces each character other than ASCII letters
    /// and digits by `-`.
    pub fn slug_of(name: &str) -> String {
        let letters = name.chars().map(|letter| {
            if letter.is_ascii_alphanumeric() {
                letter.to_ascii_lowercase()
            } else {
                '-'
            }
        });
        letters.collect()
    }
}
