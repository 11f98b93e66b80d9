//! Reads catalogue files.

use taceva_core::{Unit, shown};
use taceva_metrics::Standing;

use super::bundle_row::{Origin, row_lines};
use super::definition;
use super::entry::Sensor;
use super::offer::{self, DAY};

/// Error while reading a catalogue file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CatalogueError {
    /// The file is not TOML, or has unknown keys.
    #[error("{file}:{line}: {}", shown(problem))]
    Toml {
        /// Name of the file.
        file: String,
        /// Line number of the error.
        line: usize,
        /// Message of the parser, with the expected value.
        problem: String,
    },
    /// A value is invalid.
    #[error("{file}: {what} `{found}`: expected {expected}")]
    Value {
        /// Name of the file.
        file: String,
        /// Key of the invalid value.
        what: &'static str,
        /// Value found.
        found: String,
        /// Accepted values.
        expected: &'static str,
    },
    /// Invalid value in a row of a bundle.
    #[error("{file}:{line}: {what} `{found}`: expected {expected}")]
    Row {
        /// Name of the file.
        file: String,
        /// Line at which the row begins.
        line: usize,
        /// Key of the value.
        what: &'static str,
        /// Value found.
        found: String,
        /// Accepted values.
        expected: &'static str,
    },
}

/// Sensing mechanisms: three of sensors with cameras, as in the TacEva study, and four of taxels.
const MECHANISMS: [&str; 7] = [
    "IMM",
    "MDM",
    "MFM",
    "magnetic",
    "capacitive",
    "resistive",
    "optical",
];

impl Sensor {
    /// Parses the sensor in `text`, the content of `file`.
    ///
    /// # Errors
    /// [`CatalogueError`] with file and line.
    pub fn read(file: &str, text: &str) -> Result<Sensor, CatalogueError> {
        let mut sensor: Sensor = toml::from_str(text).map_err(|error| {
            let start = error.span().map_or(0, |span| span.start);
            let before = text.get(..start).unwrap_or_default();
            CatalogueError::Toml {
                file: file.to_owned(),
                line: before.matches('\n').count() + 1,
                problem: error.message().to_owned(),
            }
        })?;
        let refuse = |what, found: &str, expected| CatalogueError::Value {
            file: file.to_owned(),
            what,
            found: shown(found).to_string(),
            expected,
        };
        let version = sensor.catalogue_version.to_string();
        match sensor.catalogue_version {
            1 if sensor.has_bundles() => {
                let expected = "2, which has [[measured]], [[unknown]] and [[simulated]]";
                return Err(refuse("catalogue_version", &version, expected));
            }
            1 | 2 => {}
            _ => return Err(refuse("catalogue_version", &version, "1 or 2")),
        }
        check_rows(&sensor, file, text)?;
        if let Some(word) = sensor
            .mechanism
            .iter()
            .find(|word| !MECHANISMS.contains(&word.as_str()))
        {
            return Err(refuse(
                "mechanism",
                word,
                "IMM, MDM, MFM, magnetic, capacitive, resistive or optical",
            ));
        }
        for result in &sensor.results {
            let expected = definition::of(&result.metric, &result.channel);
            let is_left_open = definition::may_be_unstated(&result.metric) && !result.is_defined();
            if let Some(expected) = expected
                && result.definition != expected
                && !is_left_open
            {
                // All numbers of a column have one definition.
                return Err(refuse("definition", &result.definition, expected));
            }
            if expected.is_none() && definition::is_ours(&result.metric) {
                return Err(refuse(
                    "metric",
                    &result.metric,
                    "a name that no metric of this program has, because the definition is unknown here",
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
        if let Some(size) = &sensor.size
            && !size.is_possible()
        {
            return Err(refuse(
                "size",
                &size.shown(),
                "one to three lengths above 0 mm",
            ));
        }
        if sensor.aliases.iter().any(|alias| alias.trim().is_empty()) {
            return Err(refuse("aliases", "", "names of one letter or more"));
        }
        for price in &sensor.prices {
            if !(price.amount.is_finite() && price.amount > 0.0) {
                let found = price.amount.to_string();
                return Err(refuse("amount", &found, "a finite number above 0"));
            }
            if !offer::is_currency(&price.currency) {
                let expected = "three capital letters such as USD";
                return Err(refuse("currency", &price.currency, expected));
            }
        }
        let prices = sensor.prices.iter().map(|price| &price.seen);
        let ways = sensor.availability.iter().map(|way| &way.seen);
        if let Some(seen) = prices.chain(ways).find(|seen| !offer::is_day(seen)) {
            return Err(refuse("seen", seen, DAY));
        }
        let judged = sensor.as_study();
        for result in &mut sensor.results {
            let score = judged.score(&result.metric, &result.channel);
            result.standing = score.map_or(Standing::Counts, |score| score.standing);
        }
        Ok(sensor)
    }
}

/// Rejects an invalid value in a row of a bundle. The error has the line of the row.
fn check_rows(sensor: &Sensor, file: &str, text: &str) -> Result<(), CatalogueError> {
    for origin in Origin::ALL {
        for (at, row) in sensor.rows(origin).iter().enumerate() {
            if let Some(fault) = row.fault(origin) {
                return Err(CatalogueError::Row {
                    file: file.to_owned(),
                    line: row_lines(text, origin).get(at).copied().unwrap_or(1),
                    what: fault.what,
                    found: shown(&fault.found).to_string(),
                    expected: fault.expected,
                });
            }
        }
    }
    Ok(())
}
