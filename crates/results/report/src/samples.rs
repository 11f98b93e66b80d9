//! The samples behind scores: what was true, what was predicted, and what is known beside.

use std::collections::BTreeMap;
use taceva_core::shown;

use taceva_core::{Channel, Unit};

use crate::escape;

/// Columns of words.
const WORDS: [&str; 9] = [
    "id",
    "recording",
    "protocol",
    "part",
    "point_id",
    "unit_id",
    "scene",
    "phase",
    "kind",
];
/// Columns of numbers that are no channel.
const NUMBERS: [&str; 6] = [
    "depth_step",
    "repeat",
    "t_s",
    "spacing_mm",
    "spacing_predicted_mm",
    "intensity",
];
/// What the name of a column of predictions ends with.
const PREDICTED: &str = "_predicted";

/// Samples, column by column.
///
/// # Shapes
/// Every column has one value a sample; one that was not known is absent.
/// # Units
/// Channels in mm or N; `t_s` in s; spacings in mm; `intensity` in grey levels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    rows: usize,
    words: BTreeMap<String, Vec<String>>,
    numbers: BTreeMap<String, Vec<Option<f64>>>,
    channels: Vec<SampleChannel>,
}

/// A channel of samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SampleChannel {
    /// Its name.
    pub name: String,
    /// The readings of the reference instruments, in the unit of the channel; `None` where one is missing.
    pub truth: Vec<Option<f64>>,
    /// The predictions, in the unit of the channel; `None` for every sample where nothing was predicted.
    pub prediction: Vec<Option<f64>>,
}

/// Why a table of samples cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SamplesError {
    /// It is no CSV, or a row has another length than the head.
    #[error("samples: {0}")]
    Csv(#[from] csv::Error),
    /// A cell holds something else than a finite number.
    #[error("samples, line {line}, column `{column}`: expected a finite number, found `{found}`")]
    Cell {
        /// The line, counted from 1.
        line: u64,
        /// The name of the column.
        column: String,
        /// What is there.
        found: String,
    },
    /// There is no column `id`.
    #[error("samples: no column `id`")]
    NoId,
}

impl Samples {
    /// The samples in a table with a head: `id`, what is known beside (`protocol`, `part`, `point_id`, `unit_id`, `scene`, `depth_step`,
    /// `repeat`, `phase`, `t_s`, `kind`, `spacing_mm`, `spacing_predicted_mm`, `intensity`), and for each channel its truth under its
    /// name and its prediction under `<name>_predicted`.
    ///
    /// ```
    /// use taceva_report::Samples;
    /// let samples = Samples::read("id,point_id,Fz,Fz_predicted\na,p1,0.5,0.4\nb,p1,0.7,\n")?;
    /// let force = samples.channel("Fz").expect("there");
    /// assert_eq!((force.pair(0), force.pair(1)), (Some([0.5, 0.4]), None));
    /// # Ok::<(), taceva_report::SamplesError>(())
    /// ```
    ///
    /// # Errors
    /// [`SamplesError`] with the line and the column.
    pub fn read(table: &str) -> Result<Samples, SamplesError> {
        let mut reader = csv::Reader::from_reader(table.as_bytes());
        let head = reader.headers()?.iter().map(escape::from_csv);
        let head: Vec<String> = head.map(str::to_owned).collect();
        if !head.iter().any(|name| name == "id") {
            return Err(SamplesError::NoId);
        }
        let mut texts: Vec<Vec<String>> = vec![Vec::new(); head.len()];
        let mut numbers: Vec<Vec<Option<f64>>> = vec![Vec::new(); head.len()];
        let mut record = csv::StringRecord::new();
        let mut rows = 0;
        while reader.read_record(&mut record)? {
            rows += 1;
            for (position, (cell, name)) in record.iter().zip(&head).enumerate() {
                if WORDS.contains(&name.as_str()) {
                    texts[position].push(escape::from_csv(cell).to_owned());
                } else {
                    let line = record.position().map_or(0, csv::Position::line);
                    numbers[position].push(number(cell, name, line)?);
                }
            }
        }
        let mut samples = Samples {
            rows,
            ..Samples::default()
        };
        for (name, (texts, numbers)) in head.iter().zip(texts.into_iter().zip(numbers)) {
            samples.take_in(name, texts, numbers);
        }
        Ok(samples)
    }

    fn take_in(&mut self, name: &str, texts: Vec<String>, numbers: Vec<Option<f64>>) {
        if WORDS.contains(&name) {
            self.words.insert(name.to_owned(), texts);
            return;
        }
        if NUMBERS.contains(&name) {
            self.numbers.insert(name.to_owned(), numbers);
            return;
        }
        let (channel, is_prediction) = match name.strip_suffix(PREDICTED) {
            Some(channel) => (channel, true),
            None => (name, false),
        };
        let known = self.channels.iter().position(|known| known.name == channel);
        let position = known.unwrap_or_else(|| {
            self.channels.push(SampleChannel {
                name: channel.to_owned(),
                truth: vec![None; self.rows],
                prediction: vec![None; self.rows],
            });
            self.channels.len() - 1
        });
        let of = &mut self.channels[position];
        if is_prediction {
            of.prediction = numbers;
        } else {
            of.truth = numbers;
        }
    }

    /// The number of samples.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The channels, in the order of the table.
    pub fn channels(&self) -> &[SampleChannel] {
        &self.channels
    }

    /// The channel called `name`.
    pub fn channel(&self, name: &str) -> Option<&SampleChannel> {
        self.channels.iter().find(|channel| channel.name == name)
    }

    /// The word of a sample in a column; absent where it is empty or there is no such column.
    pub fn word(&self, column: &str, row: usize) -> Option<&str> {
        let word = self.words.get(column)?.get(row)?;
        (!word.is_empty()).then_some(word.as_str())
    }

    /// The number of a sample in a column that is no channel.
    pub fn number(&self, column: &str, row: usize) -> Option<f64> {
        *self.numbers.get(column)?.get(row)?
    }

    /// The samples of a part of the protocol; all of them where the table names no parts.
    pub fn of_protocol(&self, part: &str) -> Vec<usize> {
        let is_of = |row: &usize| match self.words.get("protocol") {
            Some(words) => words[*row].split(' ').any(|word| word == part),
            None => true,
        };
        (0..self.rows).filter(is_of).collect()
    }

    /// Whether the table names the part of the protocol of each sample.
    pub fn has_protocol(&self) -> bool {
        self.words.contains_key("protocol")
    }
}

impl SampleChannel {
    /// Truth and prediction of a sample, where there are both.
    pub fn pair(&self, row: usize) -> Option<[f64; 2]> {
        Some([
            self.truth.get(row).copied().flatten()?,
            self.prediction.get(row).copied().flatten()?,
        ])
    }

    /// The unit of a channel by its name; 1 of one that is not among the six and no height.
    pub fn unit(&self) -> Unit {
        let six = [
            Channel::PX,
            Channel::PY,
            Channel::PZ,
            Channel::FX,
            Channel::FY,
            Channel::FZ,
        ];
        let known = six.iter().find(|channel| channel.name() == self.name);
        match known {
            Some(channel) => channel.unit(),
            None if self.name == "surface_z" => Unit::Millimetre,
            None => Unit::One,
        }
    }
}

fn number(cell: &str, column: &str, line: u64) -> Result<Option<f64>, SamplesError> {
    if cell.is_empty() {
        return Ok(None);
    }
    match cell.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(Some(number)),
        _ => Err(SamplesError::Cell {
            line,
            column: column.to_owned(),
            found: shown(cell).to_string(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_found_by_the_part_of_the_protocol() {
        let table = "id,protocol,scene\n1,calibration light-sweep,\n2,idle,S1\n";
        let samples = Samples::read(table).expect("samples");
        assert_eq!(samples.of_protocol("light-sweep"), [0]);
        assert_eq!(samples.word("scene", 0), None);
        assert_eq!(samples.word("scene", 1), Some("S1"));
    }

    #[test]
    fn names_that_begin_like_a_formula_are_read_as_they_were() {
        let samples = Samples::read("id,point_id\n'=1+1,'=p\n'a,b\n").expect("samples");
        let words = |row: usize| (samples.word("id", row), samples.word("point_id", row));
        assert_eq!(words(0), (Some("=1+1"), Some("=p")));
        assert_eq!(words(1), (Some("'a"), Some("b")));
    }

    #[test]
    fn what_is_no_number_is_refused_by_its_place() {
        let error = Samples::read("id,Fz\na,1\nb,nan\n").expect_err("no number");
        assert_eq!(
            error.to_string(),
            "samples, line 3, column `Fz`: expected a finite number, found `nan`"
        );
        assert!(matches!(Samples::read("Fz\n1\n"), Err(SamplesError::NoId)));
    }
}
