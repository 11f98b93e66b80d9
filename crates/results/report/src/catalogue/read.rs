//! Reads catalogue files.

use taceva_core::{Unit, shown};
use taceva_metrics::Standing;

use super::definition;
use super::entry::Sensor;

/// Error while reading a catalogue file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CatalogueError {
    /// The file is no TOML, or has unknown keys.
    #[error("{file}: {source}")]
    Toml {
        /// Name of the file.
        file: String,
        /// TOML error with its line.
        source: Box<toml::de::Error>,
    },
    /// A value is not accepted.
    #[error("{file}: {what} `{found}`: expected {expected}")]
    Value {
        /// Name of the file.
        file: String,
        /// Name of the value.
        what: &'static str,
        /// Value found.
        found: String,
        /// Accepted values.
        expected: &'static str,
    },
}

/// Sensing mechanisms: by camera, in the words of the TacEva study, or by taxels.
const MECHANISMS: [&str; 5] = ["IMM", "MDM", "MFM", "magnetic", "capacitive"];

impl Sensor {
    /// Parses the sensor in `text`, the content of `file`.
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
            .find(|word| !MECHANISMS.contains(&word.as_str()))
        {
            return Err(refuse(
                "mechanism",
                word,
                "IMM, MDM, MFM, magnetic or capacitive",
            ));
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
}
