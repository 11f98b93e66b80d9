//! Numbers that others measured with this program, each with the digest of its bundle.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use taceva_core::Unit;
use taceva_results::full_name;
use toml::value::Datetime;

/// Depths of a verification, the shallowest first.
pub const DEPTHS: [&str; 6] = ["files", "form", "scores", "predictions", "model", "fit"];
/// List of [`DEPTHS`] for messages.
const DEPTH: &str = "files, form, scores, predictions, model or fit";
/// Format of digests, for messages.
const DIGEST: &str = "sha256: and 64 hexadecimal digits";
/// Addresses that [`is_address`] accepts, for messages.
pub const ADDRESS: &str = "an address that begins with https://, in ASCII, with %20 for a blank";
/// Beginning of a digest.
const PREFIX: &str = "sha256:";
/// Explanation of [`DEPTHS`] for readers.
pub(crate) const DEPTH_NOTE: &str = "The level states how deep a number was verified when it was added. `files` and `form` compare bytes and seals. `scores` \
                                     computes it again from sums, and `predictions` from tables of truth and prediction. `model` predicts again on the \
                                     recording, and `fit` fits the model again.";
/// Number of hexadecimal digits of a digest that names contain.
const SHORT: usize = 8;

/// Measured value from a bundle. The fields are the keys of a row in an entry. The struct gets no further field without a new version of the
/// entries.
///
/// ```
/// use taceva_report::catalogue::{Origin, Sensor};
/// let digest = format!("sha256:{}", "5".repeat(64));
/// let entry = format!(
///     "catalogue_version = 2\nname = \"X\"\nkind = \"sensor\"\nmechanism = []\n[[measured]]\nmetric = \"mae\"\nchannel = \"Fz\"\nvalue = 0.02\n\
///      unit = \"N\"\nn = 320\ndefinition = \"mae/1\"\nsamples = \"{digest}\"\nbundle = \"{digest}\"\nverified = \"predictions\"\n\
///      source = \"recorded\"\ndate = 2026-11-28\n"
/// );
/// let sensor = Sensor::read("x.toml", &entry)?;
/// assert_eq!(sensor.rows(Origin::Measured)[0].verified, "predictions");
/// assert!(Sensor::read("x.toml", &entry.replace("recorded", "simulated")).is_err());
/// # Ok::<(), taceva_report::catalogue::CatalogueError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// Index of the study in the results of the bundle, from 0.
    #[serde(default)]
    pub study: usize,
    /// Metric: `mae`.
    pub metric: String,
    /// Channel or plane: `Fz`, `Pxy`.
    pub channel: String,
    /// Variant of the metric: `slope`; `None` for the metric itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variant: Option<String>,
    /// Number in `unit`.
    pub value: f64,
    /// Both ends of the interval of 95 %, in `unit`; `None` without an interval.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ci95: Option<[f64; 2]>,
    /// Method of the interval: `jackknife by point_id, G=32`; `None` without an interval.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
    /// Unit of the number and of its interval.
    pub unit: String,
    /// Number of samples behind the number.
    pub n: u64,
    /// Number of clusters behind the interval; `None` if unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clusters: Option<u64>,
    /// Definition of the metric: `mae/1`.
    pub definition: String,
    /// Protocol of the presses: `scene sha256:…`; `None` without a scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub protocol: Option<String>,
    /// Digest of the samples.
    pub samples: String,
    /// Digest of the bundle's manifest.
    pub bundle: String,
    /// Address of the bundle; `None` if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub url: Option<String>,
    /// Depth to which the number was verified when it was added: one of [`DEPTHS`].
    pub verified: String,
    /// Origin of the samples: `recorded`, `unknown`, `simulated`, `synthetic`.
    pub source: String,
    /// Day on which the bundle was made.
    pub date: Datetime,
    /// Authors of the bundle.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub by: Vec<String>,
    /// Licence of the bundle, as an SPDX identifier; `None` if not stated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub licence: Option<String>,
    /// Calibration certificates behind the labels.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub traceability: Vec<String>,
}

/// Table of an entry for values from bundles. This type gets no further variant: samples are measured, not measured, or of unknown origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// `[[measured]]`: samples that a real sensor recorded.
    Measured,
    /// `[[unknown]]`: samples whose origin the bundle does not state.
    Unknown,
    /// `[[simulated]]`: simulated or synthetic samples.
    Simulated,
}

impl Origin {
    /// All tables.
    pub const ALL: [Origin; 3] = [Origin::Measured, Origin::Unknown, Origin::Simulated];

    /// Table for samples of the origin `source`; `None` if samples of one study have several origins.
    ///
    /// ```
    /// use taceva_report::catalogue::Origin;
    /// assert_eq!(Origin::of_source("synthetic"), Some(Origin::Simulated));
    /// assert_eq!(Origin::of_source("several"), None);
    /// ```
    pub fn of_source(source: &str) -> Option<Origin> {
        match source {
            "recorded" => Some(Origin::Measured),
            "unknown" => Some(Origin::Unknown),
            "simulated" | "synthetic" => Some(Origin::Simulated),
            _ => None,
        }
    }

    /// Name of the table in an entry.
    pub const fn table(self) -> &'static str {
        match self {
            Origin::Measured => "measured",
            Origin::Unknown => "unknown",
            Origin::Simulated => "simulated",
        }
    }

    /// Origins of samples that the table accepts, for messages.
    const fn expected(self) -> &'static str {
        match self {
            Origin::Measured => "recorded; other origins belong in [[simulated]] or [[unknown]]",
            Origin::Unknown => "unknown; other origins belong in [[measured]] or [[simulated]]",
            Origin::Simulated => {
                "simulated or synthetic; other origins belong in [[measured]] or [[unknown]]"
            }
        }
    }
}

/// Invalid value of a row of an entry, with the key and the accepted values.
pub(super) struct RowFault {
    pub(super) what: &'static str,
    pub(super) found: String,
    pub(super) expected: &'static str,
}

impl Measured {
    /// Metric and variant: `hysteresis.ratio`.
    pub fn full_name(&self) -> String {
        full_name(&self.metric, self.variant.as_deref())
    }

    /// Metric, variant and channel in words: `hysteresis.ratio of Fz`.
    pub fn words(&self) -> String {
        format!("{} of {}", self.full_name(), self.channel)
    }

    /// Origin of the samples in a word for readers: `measured`, `origin unknown`, `simulated`.
    pub fn origin_word(&self) -> &str {
        match self.source.as_str() {
            "recorded" => "measured",
            "unknown" => "origin unknown",
            other => other,
        }
    }

    /// First digits of the bundle's digest.
    pub fn short_bundle(&self) -> String {
        short(&self.bundle)
    }

    /// Index of [`verified`](Measured::verified) in [`DEPTHS`], from 0.
    pub fn depth(&self) -> usize {
        let place = DEPTHS.iter().position(|word| *word == self.verified);
        place.unwrap_or_default()
    }

    /// First invalid value of a row in the table of `origin`; `None` if all values are valid.
    pub(super) fn fault(&self, origin: Origin) -> Option<RowFault> {
        let fault = |what, found: String, expected| {
            Some(RowFault {
                what,
                found,
                expected,
            })
        };
        if Origin::of_source(&self.source) != Some(origin) {
            return fault("source", self.source.clone(), origin.expected());
        }
        if !DEPTHS.contains(&self.verified.as_str()) {
            return fault("verified", self.verified.clone(), DEPTH);
        }
        if Unit::from_symbol(&self.unit).is_none() {
            return fault("unit", self.unit.clone(), "a unit such as mm, N or 1");
        }
        let ends = self.ci95.into_iter().flatten();
        if let Some(number) = ends.chain([self.value]).find(|number| !number.is_finite()) {
            return fault("value", number.to_string(), "a finite number");
        }
        if let Some([low, high]) = self.ci95
            && low > high
        {
            return fault("ci95", format!("{low}, {high}"), "the lower end first");
        }
        let digests = [("samples", &self.samples), ("bundle", &self.bundle)];
        if let Some((what, found)) = digests.into_iter().find(|(_, text)| !is_digest(text)) {
            return fault(what, found.clone(), DIGEST);
        }
        let date = &self.date;
        if date.date.is_none() || date.time.is_some() || date.offset.is_some() {
            return fault("date", date.to_string(), "a day such as 2026-11-28");
        }
        if let Some(url) = self.url.as_ref().filter(|url| !is_address(url)) {
            return fault("url", url.clone(), ADDRESS);
        }
        None
    }
}

/// True for a web address without characters that need escaping.
///
/// ```
/// use taceva_report::catalogue::is_address;
/// assert!(is_address("https://example.org/result.tar.gz"));
/// assert!(!is_address("https://example.org/my result") && !is_address("http://example.org"));
/// ```
pub fn is_address(text: &str) -> bool {
    let is_plain = |letter: char| letter.is_ascii_graphic() && !"\"<>\\^`{|}".contains(letter);
    let rest = text.strip_prefix("https://");
    rest.is_some_and(|rest| !rest.is_empty() && rest.chars().all(is_plain))
}

/// First digits of a digest.
pub(crate) fn short(digest: &str) -> String {
    let digits = digest.strip_prefix(PREFIX).unwrap_or(digest);
    digits.chars().take(SHORT).collect()
}

/// True for `sha256:` and 64 lower-case hexadecimal digits.
fn is_digest(text: &str) -> bool {
    let is_digit = |letter: u8| letter.is_ascii_digit() || (b'a'..=b'f').contains(&letter);
    text.strip_prefix(PREFIX)
        .is_some_and(|digits| digits.len() == 64 && digits.bytes().all(is_digit))
}

/// Rows as text of an entry, each in the table of its origin.
///
/// # Errors
/// [`toml::ser::Error`] for a count above 2⁶³.
pub fn rows_text(rows: &[Measured]) -> Result<String, toml::ser::Error> {
    let mut tables: BTreeMap<&str, Vec<&Measured>> = BTreeMap::new();
    for row in rows {
        if let Some(origin) = Origin::of_source(&row.source) {
            tables.entry(origin.table()).or_default().push(row);
        }
    }
    toml::to_string(&tables)
}

/// Line numbers at which the rows of the table `origin` begin in the text of an entry. Empty if the rows are not written as `[[table]]`.
///
/// ```
/// use taceva_report::catalogue::{Origin, row_lines};
/// let entry = "name = \"X\"\n[[measured]]\nn = 1\n[[measured]]\nn = 2\n";
/// assert_eq!(row_lines(entry, Origin::Measured), [2, 4]);
/// assert!(row_lines(entry, Origin::Simulated).is_empty());
/// ```
pub fn row_lines(text: &str, origin: Origin) -> Vec<usize> {
    let head = format!("[[{}]]", origin.table());
    let lines = text.lines().zip(1..);
    let heads = lines.filter(|(line, _)| line.trim().starts_with(&head));
    heads.map(|(_, number)| number).collect()
}
