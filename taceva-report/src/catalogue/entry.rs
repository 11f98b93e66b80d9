//! A sensor of the catalogue.

use std::collections::BTreeMap;
use taceva_core::shown;

use serde::Deserialize;
use taceva_core::Unit;
use taceva_metrics::Standing;

use super::definition;
use crate::results::{Interval, Made, Score, Study, Value, by_published_r2};

/// A sensor, or a study of sensors, as the catalogue knows it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sensor {
    /// 1.
    catalogue_version: u32,
    /// What it is called.
    pub name: String,
    /// `sensor`, or `study` of an evaluation of others.
    pub kind: Kind,
    /// IMM (intensity mapping), MDM (marker displacement), MFM (modality fusion).
    pub mechanism: Vec<String>,
    /// Its form.
    pub shape: Option<String>,
    /// Whether no light from outside reaches the camera.
    pub opaque: Option<bool>,
    /// Whether its gel carries markers.
    pub markers: Option<bool>,
    /// What it is built of.
    pub intrinsic: Option<Intrinsic>,
    /// What it stands.
    pub limits: Option<Limits>,
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

/// What an entry is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A sensor.
    Sensor,
    /// A study of sensors.
    Study,
}

/// What a sensor is built of.
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
    /// Pictures a second.
    #[serde(rename = "frame_rate_Hz")]
    pub frame_rate_hz: f64,
}

/// What a sensor stands.
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

/// Where numbers are from.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// By what it is named in the file.
    pub id: String,
    /// Who, what, where, when.
    pub text: String,
    /// Its address, if it has one.
    pub link: Option<String>,
}

/// A published number.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// The metric: `mae`.
    pub metric: String,
    /// The channel or plane.
    pub channel: String,
    /// The number, in `unit`.
    pub value: f64,
    /// The unit.
    pub unit: String,
    /// The id of the source.
    pub source: String,
    /// Where in the source: `table`, `figure`, `text`, or `derived` from its numbers.
    pub read_from: String,
    /// How it was measured.
    pub conditions: String,
    /// How it is defined.
    pub definition: String,
    /// How the number is to be read where it is no measured value: `about` it, `above` or `below` it.
    pub bound: Option<Roughly>,
    /// What a reader must know.
    pub note: Option<String>,
    /// Which part it takes in verdicts: by the published R² of its channel.
    #[serde(skip)]
    pub standing: Standing,
}

impl Published {
    /// The number as it was published, with `≈`, `>` or `<` where its authors said no more.
    pub fn shown(&self) -> String {
        let sign = self.bound.map_or("", Roughly::sign);
        format!("{sign}{}", self.value)
    }
}

/// What authors say of a number that they do not state exactly. It is shown, and takes part in no comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Roughly {
    /// About as much.
    About,
    /// More than that.
    Above,
    /// Less than that.
    Below,
}

impl Roughly {
    /// The sign before the number.
    pub const fn sign(self) -> &'static str {
        match self {
            Roughly::About => "≈ ",
            Roughly::Above => "> ",
            Roughly::Below => "< ",
        }
    }
}

/// A number that was not published.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Missing {
    /// The metric.
    pub metric: String,
    /// Why there is none.
    pub reason: String,
}

/// Why a file of the catalogue cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CatalogueError {
    /// It is no TOML, or has other keys than it may have.
    #[error("{file}: {source}")]
    Toml {
        /// The file.
        file: String,
        /// What is wrong, with its line.
        source: Box<toml::de::Error>,
    },
    /// A value is none of those that are accepted.
    #[error("{file}: {what} `{found}`: expected {expected}")]
    Value {
        /// The file.
        file: String,
        /// What the value is of.
        what: &'static str,
        /// What is there.
        found: String,
        /// What is accepted.
        expected: &'static str,
    },
}

impl Sensor {
    /// The sensor described by `text`, the content of `file`.
    ///
    /// # Errors
    /// [`CatalogueError`] with file and line.
    pub fn read(file: &str, text: &str) -> Result<Sensor, CatalogueError> {
        let mut sensor: Sensor = toml::from_str(text).map_err(|source| CatalogueError::Toml {
            file: file.to_owned(),
            source: Box::new(source),
        })?;
        let refuse = |what, found: &str, expected| CatalogueError::Value {
            file: file.to_owned(),
            what,
            found: shown(found).to_string(),
            expected,
        };
        if sensor.catalogue_version != 1 {
            let found = sensor.catalogue_version.to_string();
            return Err(refuse("catalogue_version", &found, "1"));
        }
        if let Some(word) = sensor
            .mechanism
            .iter()
            .find(|word| !["IMM", "MDM", "MFM"].contains(&word.as_str()))
        {
            return Err(refuse("mechanism", word, "IMM, MDM or MFM"));
        }
        for result in &sensor.results {
            let expected = definition::of(&result.metric, &result.channel);
            if let Some(expected) = expected
                && result.definition != expected
            {
                // One column, one definition.
                return Err(refuse("definition", &result.definition, expected));
            }
            if expected.is_none() && definition::is_ours(&result.metric) {
                return Err(refuse(
                    "metric",
                    &result.metric,
                    "a name that results of this program do not have, since no definition is known here",
                ));
            }
            if Unit::from_symbol(&result.unit).is_none() {
                return Err(refuse("unit", &result.unit, "mm, N, mm/N, N·mm or 1"));
            }
            if !result.value.is_finite() {
                return Err(refuse(
                    "value",
                    &result.value.to_string(),
                    "a finite number",
                ));
            }
        }
        let judged = sensor.as_study();
        for result in &mut sensor.results {
            let score = judged.score(&result.metric, &result.channel);
            result.standing = score.map_or(Standing::Counts, |score| score.standing);
        }
        Ok(sensor)
    }

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

    /// How many numbers are known of it.
    pub fn known(&self) -> usize {
        let built = if self.intrinsic.is_some() { 4 } else { 0 };
        let limits = if self.limits.is_some() { 3 } else { 0 };
        built + limits + self.results.len()
    }

    /// The source called `id`.
    pub fn source(&self, id: &str) -> Option<&Source> {
        self.sources.iter().find(|source| source.id == id)
    }

    /// By which it is named in files and links: letters and digits of its name.
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

    /// Results as a sensor that can be chosen: its numbers, and whether light is kept out as far as the results say. What a sensor stands is no
    /// result; it is taken from the sensor of that name in the catalogue, if there is one.
    pub fn of_study(study: &Study) -> Sensor {
        let result = |score: &Score| {
            Some(Published {
                metric: score.metric.clone(),
                channel: score.channel.clone(),
                value: score.value.number()?,
                unit: score.unit.symbol().to_owned(),
                source: "result".to_owned(),
                read_from: study.source.clone(),
                conditions: "as its provenance says".to_owned(),
                definition: score.definition.clone(),
                bound: None,
                note: None,
                standing: score.standing,
            })
        };
        let is_opaque = |reason: &str| reason.contains("opaque");
        let skips = study.skipped.iter().any(|skip| is_opaque(&skip.reason));
        let has_light = study.of_metric("r_light").next().is_some();
        Sensor {
            catalogue_version: 1,
            name: study.sensor.clone(),
            kind: Kind::Sensor,
            mechanism: Vec::new(),
            shape: None,
            opaque: (skips || has_light).then_some(skips),
            markers: None,
            intrinsic: None,
            limits: super::find(&study.sensor).and_then(|known| known.limits),
            sources: Vec::new(),
            results: study.scores.iter().filter_map(result).collect(),
            missing: Vec::new(),
            reported: BTreeMap::new(),
            applications: BTreeMap::new(),
        }
    }

    /// Its published numbers as results that can be shown and compared beside others; their source is `published`, and none has an interval.
    pub fn as_study(&self) -> Study {
        let score = |metric: &str, channel: &str, value: f64, unit: Unit| Score {
            metric: metric.to_owned(),
            channel: channel.to_owned(),
            value: Value::Number(value),
            unit,
            n: 0,
            n_invalid: 0,
            interval: Some(Interval::Absent("published without one".to_owned())),
            definition: "published".to_owned(),
            parameters: Vec::new(),
            counts: Vec::new(),
            flags: Vec::new(),
            standing: Standing::Counts,
            bounded_share: None,
            of: Vec::new(),
            variants: Vec::new(),
        };
        let is_score =
            |result: &&Published| definition::is_ours(&result.metric) && result.bound.is_none();
        let published = self.results.iter().filter(is_score);
        let mut scores: Vec<Score> = published
            .map(|result| {
                let unit = Unit::from_symbol(&result.unit).unwrap_or(Unit::One);
                score(&result.metric, &result.channel, result.value, unit)
            })
            .collect();
        if let Some(intrinsic) = &self.intrinsic {
            let camera = [
                ("frame_rate", intrinsic.frame_rate_hz, Unit::Hertz),
                (
                    "field_of_view",
                    intrinsic.field_of_view_mm2,
                    Unit::SquareMillimetre,
                ),
                ("resolution", intrinsic.camera_mp * 1e6, Unit::Pixel),
            ];
            scores.extend(camera.map(|(name, value, unit)| score("intrinsic", name, value, unit)));
        }
        by_published_r2(&mut scores);
        let sources = self
            .sources
            .iter()
            .map(|source| ("source".to_owned(), source.text.clone()));
        Study {
            sensor: self.name.clone(),
            serial: "unknown".to_owned(),
            gel: "unknown".to_owned(),
            source: "published".to_owned(),
            scores,
            skipped: Vec::new(),
            provenance: sources.collect(),
            made: Made::default(),
            notes: vec![
                "published numbers; nothing here was measured with this program".to_owned(),
            ],
            over_seeds: None,
            samples: None,
        }
    }
}
