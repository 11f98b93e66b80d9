//! Table of the samples behind the scores.

mod dominant_sample;

pub use dominant_sample::DominantSample;

use std::io::{self, Write};
use std::path::PathBuf;

use taceva_core::{Channel, Column, Unit, shown};

use crate::formula::{escape_csv, unescape_csv};

/// Names of the text columns in a table of samples.
const WORDS: [&str; 12] = [
    Samples::KEY,
    "recording",
    "protocol",
    "part",
    "point_id",
    "unit_id",
    "scene",
    "phase",
    "kind",
    "frame_sha256",
    Samples::GROUP,
    Samples::FOLD,
];
/// Names of the numeric columns in a table of samples that are not channels.
const NUMBERS: [&str; 7] = [
    "depth_step",
    "repeat",
    "t_s",
    "spacing_mm",
    "spacing_predicted_mm",
    Samples::ZERO_U,
    "intensity",
];
/// Suffix of columns with unclipped predictions, which may exceed the bounds of the model.
const UNBOUNDED: &str = "_predicted_unbounded";

/// Table of samples with the columns `sample` (name), covariates, and the truth and prediction of each channel.
///
/// # Shapes
/// Each column has one optional value per sample.
/// # Units
/// Channels in their own units; `t_s` in s; spacings and `zero_u_mm` in mm; `intensity` in grey levels, 0 to 255.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    rows: usize,
    columns: Vec<(String, SampleColumn)>,
    recordings: Vec<PathBuf>,
}

#[derive(Clone, Debug, PartialEq)]
enum SampleColumn {
    Words(Vec<Option<String>>),
    Numbers(Column),
}

/// Truth and prediction of one channel, each with one optional value per sample.
#[derive(Clone, Copy, Debug)]
pub struct SampleChannel<'a> {
    /// Name of the channel.
    pub name: &'a str,
    rows: usize,
    truth: Option<&'a Column>,
    prediction: Option<&'a Column>,
}

/// Reason why a table of samples is rejected.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SamplesError {
    /// Invalid CSV, or a row whose length differs from the header.
    #[error("samples: {0}")]
    Csv(#[from] csv::Error),
    /// A cell of a numeric column is neither empty nor a finite number.
    #[error("samples, line {line}, column `{column}`: expected a finite number, found `{found}`")]
    Cell {
        /// Line of the cell in the file, from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// Content of the cell.
        found: String,
    },
    /// The column `sample` is missing.
    #[error("samples: no column `sample`, expected one with the names of the rows")]
    NoKey,
}

impl Samples {
    /// Name of the column with sample names, in all tables that this program writes.
    pub const KEY: &'static str = "sample";
    /// Name of the column with the group of each sample, which a split keeps in one part.
    pub const GROUP: &'static str = "group";
    /// Name of the column with fold numbers, from 1. Each fold is predicted by a model that was fitted without this fold.
    pub const FOLD: &'static str = "fold";
    /// Name of the column with the standard uncertainty of the zero height, in mm. The depth of a sample is measured from this height.
    pub const ZERO_U: &'static str = "zero_u_mm";
    /// Suffix of the columns with predictions.
    pub const PREDICTED: &'static str = "_predicted";

    /// Creates a table with the names `ids` of samples, from recordings in the folders `recordings`.
    pub fn new(ids: Vec<Option<String>>, recordings: Vec<PathBuf>) -> Samples {
        Samples {
            rows: ids.len(),
            columns: vec![(Samples::KEY.to_owned(), SampleColumn::Words(ids))],
            recordings,
        }
    }

    /// Keeps only the truths and predictions of the channels called `names`.
    pub(crate) fn of_channels(mut self, names: &[&str]) -> Samples {
        self.columns.retain(|(column, values)| {
            let channel = column.strip_suffix(UNBOUNDED).unwrap_or(column);
            let channel = channel.strip_suffix(Samples::PREDICTED).unwrap_or(channel);
            let is_channel =
                matches!(values, SampleColumn::Numbers(_)) && !NUMBERS.contains(&column.as_str());
            !is_channel || names.contains(&channel)
        });
        self
    }

    /// Replaces the folders of the recordings with `recordings`.
    #[must_use]
    pub fn with_recordings(self, recordings: Vec<PathBuf>) -> Samples {
        Samples { recordings, ..self }
    }

    /// Adds a text column called `name`, with one text per sample.
    pub fn push_words(&mut self, name: &str, words: Vec<Option<String>>) {
        self.columns
            .push((name.to_owned(), SampleColumn::Words(words)));
    }

    /// Adds the column `protocol` after `sample`. Each cell names the protocol parts of a sample, separated by spaces.
    pub fn insert_protocol(&mut self, parts: Vec<Option<String>>) {
        let column = ("protocol".to_owned(), SampleColumn::Words(parts));
        self.columns.insert(1.min(self.columns.len()), column);
    }

    /// Adds a numeric column called `name`: the truth of a channel, or a covariate.
    pub fn push_numbers(&mut self, name: &str, numbers: Column) {
        self.columns
            .push((name.to_owned(), SampleColumn::Numbers(numbers)));
    }

    /// Adds the predictions of `channel`.
    pub fn push_prediction(&mut self, channel: &Channel, numbers: Column) {
        self.push_numbers(
            &format!("{}{}", channel.name(), Samples::PREDICTED),
            numbers,
        );
    }

    /// Adds the unclipped predictions of `channel`. Without this column, no prediction counts as clipped.
    pub fn push_unbounded(&mut self, channel: &Channel, numbers: Column) {
        self.push_numbers(&format!("{}{UNBOUNDED}", channel.name()), numbers);
    }

    /// Reads a CSV table with a header. The columns are `sample` (or `id`), covariates, and for each channel `<name>` (truth) and `<name>_predicted`.
    ///
    /// ```
    /// use taceva_results::Samples;
    /// let samples = Samples::read("sample,point_id,Fz,Fz_predicted\na,p1,0.5,0.4\nb,p1,0.7,\n")?;
    /// let force = samples.channel("Fz").expect("there");
    /// assert_eq!((force.pair(0), force.pair(1)), (Some([0.5, 0.4]), None));
    /// # Ok::<(), taceva_results::SamplesError>(())
    /// ```
    ///
    /// # Errors
    /// [`SamplesError`] with the line and the column.
    pub fn read(table: &str) -> Result<Samples, SamplesError> {
        let mut reader = csv::Reader::from_reader(table.as_bytes());
        let names: Vec<&str> = reader.headers()?.iter().map(unescape_csv).collect();
        let has_key = names.contains(&Samples::KEY);
        // Name of the column in other programs, and in old versions of this one.
        let names = names.into_iter().map(|name| match name {
            "id" if !has_key => Samples::KEY,
            name => name,
        });
        let column = |name: &str| match WORDS.contains(&name) {
            true => SampleColumn::Words(Vec::new()),
            false => SampleColumn::Numbers(Column::default()),
        };
        let mut samples = Samples {
            columns: names.map(|name| (name.to_owned(), column(name))).collect(),
            ..Samples::default()
        };
        if !samples.columns.iter().any(|(name, _)| name == Samples::KEY) {
            return Err(SamplesError::NoKey);
        }
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record)? {
            samples.rows += 1;
            let line = record.position().map_or(0, csv::Position::line);
            for ((name, column), cell) in samples.columns.iter_mut().zip(&record) {
                match column {
                    SampleColumn::Words(words) => {
                        let word = unescape_csv(cell);
                        words.push((!word.is_empty()).then(|| word.to_owned()));
                    }
                    SampleColumn::Numbers(numbers) => numbers.push(number(cell, name, line)?),
                }
            }
        }
        Ok(samples)
    }

    /// Writes a CSV table that [`Samples::read`] reads. Each number has the fewest digits from which it is read back exactly.
    ///
    /// # Errors
    /// I/O errors of `out`.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(self.columns.iter().map(|(name, _)| escape_csv(name)))?;
        for row in 0..self.rows {
            for (_, column) in &self.columns {
                let cell = match column {
                    SampleColumn::Words(words) => words[row].as_deref().map(escape_csv),
                    SampleColumn::Numbers(numbers) => {
                        numbers.get(row).map(|number| format!("{number:?}"))
                    }
                };
                writer.write_field(cell.unwrap_or_default())?;
            }
            writer.write_record(None::<&[u8]>)?;
        }
        writer.flush()
    }

    /// Folders of the recordings, in the order in which the recordings were joined; empty for a table without recordings.
    pub fn recordings(&self) -> &[PathBuf] {
        &self.recordings
    }

    /// Number of samples.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Channels in the order of their columns.
    pub fn channels(&self) -> Vec<SampleChannel<'_>> {
        let mut names: Vec<&str> = Vec::new();
        for (name, column) in &self.columns {
            if name.ends_with(UNBOUNDED) {
                continue;
            }
            let name = name.strip_suffix(Samples::PREDICTED).unwrap_or(name);
            let is_channel = matches!(column, SampleColumn::Numbers(_)) && !NUMBERS.contains(&name);
            if is_channel && !names.contains(&name) {
                names.push(name);
            }
        }
        let channels = names.into_iter();
        channels.filter_map(|name| self.channel(name)).collect()
    }

    /// Channel called `name`; `None` for an unknown name.
    pub fn channel(&self, name: &str) -> Option<SampleChannel<'_>> {
        let truth = self.numbers(name);
        let prediction = self.numbers(&format!("{name}{}", Samples::PREDICTED));
        let named = truth.or(prediction).filter(|_| !NUMBERS.contains(&name))?;
        Some(SampleChannel {
            name: named.0.strip_suffix(Samples::PREDICTED).unwrap_or(named.0),
            rows: self.rows,
            truth: truth.map(|(_, column)| column),
            prediction: prediction.map(|(_, column)| column),
        })
    }

    /// Unclipped prediction of `channel` for the sample at index `row`; the prediction itself if the table has no column of unclipped predictions.
    pub fn unbounded(&self, channel: &str, row: usize) -> Option<f64> {
        match self.numbers(&format!("{channel}{UNBOUNDED}")) {
            Some((_, numbers)) => numbers.get(row),
            None => self.channel(channel)?.prediction(row),
        }
    }

    fn column(&self, name: &str) -> Option<&(String, SampleColumn)> {
        self.columns.iter().find(|(own, _)| own == name)
    }

    fn numbers(&self, name: &str) -> Option<(&str, &Column)> {
        match self.column(name)? {
            (name, SampleColumn::Numbers(numbers)) => Some((name, numbers)),
            _ => None,
        }
    }

    /// Text in `column` for the sample at index `row`; `None` for an empty cell, a numeric column or a missing column.
    pub fn word(&self, column: &str, row: usize) -> Option<&str> {
        match &self.column(column)?.1 {
            SampleColumn::Words(words) => {
                words.get(row)?.as_deref().filter(|word| !word.is_empty())
            }
            SampleColumn::Numbers(_) => None,
        }
    }

    /// Number in `column` for the sample at index `row`; `None` for an empty cell, a text that is not a number, or a missing column.
    pub fn number(&self, column: &str, row: usize) -> Option<f64> {
        match &self.column(column)?.1 {
            SampleColumn::Numbers(numbers) => numbers.get(row),
            SampleColumn::Words(words) => words.get(row)?.as_deref()?.parse().ok(),
        }
    }

    /// Indices of the rows that belong to the protocol part `part`; all rows if the table has no column `protocol`.
    pub fn of_protocol(&self, part: &str) -> Vec<usize> {
        let is_of = |row: &usize| {
            let parts = self.word("protocol", *row);
            parts.is_some_and(|parts| parts.split(' ').any(|own| own == part))
        };
        let rows = 0..self.rows;
        match self.has("protocol") {
            true => rows.filter(is_of).collect(),
            false => rows.collect(),
        }
    }

    /// True if there is a column called `name`.
    pub fn has(&self, name: &str) -> bool {
        self.column(name).is_some()
    }
}

impl<'a> SampleChannel<'a> {
    /// Number of samples.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Reading of the reference instrument for the sample at index `row`, in the unit of the channel; `None` if missing.
    pub fn truth(&self, row: usize) -> Option<f64> {
        self.truth?.get(row)
    }

    /// Prediction for the sample at index `row`, in the unit of the channel; `None` if missing.
    pub fn prediction(&self, row: usize) -> Option<f64> {
        self.prediction?.get(row)
    }

    /// Truth and prediction of the sample at index `row`, in the unit of the channel; `None` if either is missing.
    pub fn pair(&self, row: usize) -> Option<[f64; 2]> {
        Some([self.truth(row)?, self.prediction(row)?])
    }

    /// True values in the order of samples, without missing values.
    pub fn truths(self) -> impl Iterator<Item = f64> + 'a {
        (0..self.rows).filter_map(move |row| self.truth(row))
    }

    /// True if any sample has a prediction.
    pub fn is_predicted(&self) -> bool {
        (0..self.rows).any(|row| self.prediction(row).is_some())
    }

    /// Unit of the channel, from its name; [`Unit::One`] for an unknown name.
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
mod tests;
