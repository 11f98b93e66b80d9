//! The samples behind a result as a table: what was true, what was predicted, and what is known beside.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::PathBuf;

use taceva_core::{Channel, Column, Field};
use taceva_dataset::Dataset;

use crate::error::EvaluateError;
use crate::predict::{Predicted, truth};
use crate::recordings;
use crate::rows::BESIDE_CHANNELS;

/// The samples of a recording, column by column.
///
/// # Shapes
/// Every column has one value a sample; what is not known is absent.
#[derive(Clone, Debug, Default)]
pub struct Samples {
    rows: usize,
    columns: Vec<(String, SampleColumn)>,
    recordings: Vec<PathBuf>,
}

#[derive(Clone, Debug)]
enum SampleColumn {
    Words(Vec<Option<String>>),
    Numbers(Column),
}

impl Samples {
    /// The samples of `rows` of `dataset`, in their order, without predictions.
    pub fn of(dataset: &Dataset, rows: &[usize]) -> Result<Samples, EvaluateError> {
        let table = dataset.table();
        let words = |texts: &[Option<String>]| rows.iter().map(|&row| texts[row].clone()).collect();
        let ids = rows
            .iter()
            .map(|&row| Some(table.samples()[row].clone()))
            .collect();
        let mut samples = Samples {
            rows: rows.len(),
            columns: vec![("id".to_owned(), SampleColumn::Words(ids))],
            recordings: recordings::paths(dataset),
        };
        if let Some(names) = recordings::names(dataset, rows) {
            let names = names.into_iter().map(Some);
            samples.push("recording", SampleColumn::Words(names.collect()));
        }
        for field in BESIDE_CHANNELS {
            if let Some(texts) = table.as_text(field.name()) {
                samples.push(field.name(), SampleColumn::Words(words(&texts)));
            }
        }
        for channel in table.channels().iter() {
            let column = truth(dataset, channel, rows)?;
            samples.push(channel.name(), SampleColumn::Numbers(column));
        }
        Ok(samples)
    }

    /// With the parts of the protocol that each sample was pressed for: `calibration light-sweep`.
    pub fn with_protocol(
        mut self,
        rows: &[usize],
        parts: &BTreeMap<&'static str, Vec<usize>>,
    ) -> Samples {
        let words = rows.iter().map(|row| {
            let of_row = parts
                .iter()
                .filter(|(_, rows)| rows.binary_search(row).is_ok());
            Some(of_row.map(|(part, _)| *part).collect::<Vec<_>>().join(" "))
        });
        let column = SampleColumn::Words(words.collect());
        self.columns.insert(1, ("protocol".to_owned(), column));
        self
    }

    /// With what was predicted of `of_rows`, which are some of `rows`.
    pub fn with_predictions(
        mut self,
        rows: &[usize],
        (predicted, of_rows): (&Predicted, &[usize]),
    ) -> Samples {
        let at: Vec<Option<usize>> = rows
            .iter()
            .map(|row| of_rows.binary_search(row).ok())
            .collect();
        for (channel, prediction) in predicted.channels().iter().zip(predicted.prediction()) {
            let mut column = Column::default();
            at.iter()
                .for_each(|at| column.push(at.and_then(|at| prediction.get(at))));
            self.push_prediction(channel, column);
        }
        self
    }

    /// Samples called `ids` from two columns a channel, truth and prediction.
    pub fn of_pairs(
        ids: Vec<Option<String>>,
        points: Option<Vec<Option<String>>>,
        channels: Vec<(Channel, Column, Column)>,
    ) -> Samples {
        let mut samples = Samples {
            rows: ids.len(),
            columns: vec![("id".to_owned(), SampleColumn::Words(ids))],
            recordings: Vec::new(),
        };
        if let Some(points) = points {
            samples.push(Field::Point.name(), SampleColumn::Words(points));
        }
        for (channel, truth, prediction) in channels {
            samples.push(channel.name(), SampleColumn::Numbers(truth));
            samples.push_prediction(&channel, prediction);
        }
        samples
    }

    fn push(&mut self, name: &str, column: SampleColumn) {
        self.columns.push((name.to_owned(), column));
    }

    fn push_prediction(&mut self, channel: &Channel, column: Column) {
        let name = format!("{}_predicted", channel.name());
        self.columns.push((name, SampleColumn::Numbers(column)));
    }

    /// The recordings that they are of, in the order in which they were joined; none of two tables.
    pub fn recordings(&self) -> &[PathBuf] {
        &self.recordings
    }

    /// How many there are.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Writes them as CSV: `id`, what is known beside, and for each channel its truth under its name and its prediction under
    /// `<name>_predicted`. Numbers are in shortest round-trip form, names and words as `word` writes them: a table for people escapes what
    /// a spreadsheet would take for a formula.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut dyn Write, word: impl Fn(&str) -> String) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(self.columns.iter().map(|(name, _)| word(name)))?;
        for row in 0..self.rows {
            for (_, column) in &self.columns {
                match column {
                    SampleColumn::Words(words) => {
                        writer
                            .write_field(words[row].as_deref().map_or_else(String::new, &word))?;
                    }
                    SampleColumn::Numbers(numbers) => {
                        let number = numbers.get(row);
                        let text = number.map_or_else(String::new, |number| format!("{number:?}"));
                        writer.write_field(text)?;
                    }
                }
            }
            writer.write_record(None::<&[u8]>)?;
        }
        writer.flush()
    }
}
