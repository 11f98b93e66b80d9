//! Closing of a recording, which turns it into a dataset.

use std::fs::{self, File};
use std::path::Path;

use super::folder::remove_journal;
use super::{Recorder, partial};
use crate::error::DatasetError;
use crate::file::make_names_durable;
use crate::header::Header;
use crate::later_facts::LaterFacts;
use crate::layout;
use crate::samples::from_parquet;
use crate::signals::{SignalsInfo, SignalsReader, SignalsWriter};
use crate::store::{Beside, write_table_and_header};

impl Recorder {
    /// Closes the recording and turns it into a dataset. The journal is kept until the header is written, so that an interrupted close can be resumed.
    ///
    /// # Errors
    /// [`DatasetError::Damaged`] if the written files cannot be read back; [`DatasetError::Io`].
    pub fn close(mut self) -> Result<Header, DatasetError> {
        let signals = self.signals.take().map(SignalsWriter::finish).transpose()?;
        let predictions = self.predictions.take();
        if let Some(table) = &predictions {
            table.write(&self.path)?;
        }
        let later = LaterFacts::of(&self.path);
        self.facts.settings.extend(later.measured);
        let name = |name: &str| partial(&self.path, name);
        let (samples, header_path) = (name(layout::SAMPLES), name(layout::HEADER));
        let header = write_table_and_header(
            &samples,
            &header_path,
            &self.facts,
            &self.table,
            self.frames_info(),
            Beside {
                presses: self.press_counts(),
                stream: self.stream,
                predictions: predictions.map(|table| table.facts),
                signals,
                warnings: later.warnings,
                ..Beside::default()
            },
        )?;
        self.verify(&samples, &header)?;
        if let Some(info) = &header.signals {
            self.verify_signals(&name(layout::SIGNALS), info)?;
            self.put_in_place(&name(layout::SIGNALS), layout::SIGNALS)?;
        }
        if header.predictions.is_some() {
            self.put_in_place(&name(layout::PREDICTIONS), layout::PREDICTIONS)?;
        }
        self.put_in_place(&samples, layout::SAMPLES)?;
        self.put_in_place(&header_path, layout::HEADER)?;
        remove_journal(&self.path)?;
        LaterFacts::remove(&self.path);
        Ok(header)
    }

    fn verify(&self, samples: &Path, header: &Header) -> Result<(), DatasetError> {
        let damaged = |problem: String| DatasetError::damaged(samples, problem);
        let file = File::open(samples).map_err(DatasetError::io("open", samples))?;
        let read = from_parquet(file, &header.channels, &header.attributes, &[], &[]);
        let read = read.map_err(damaged)?;
        if read != self.table {
            return Err(damaged(
                "the file reads back differently from what was written: check the disk".to_owned(),
            ));
        }
        Ok(())
    }

    fn verify_signals(&self, path: &Path, info: &SignalsInfo) -> Result<(), DatasetError> {
        let file = File::open(path).map_err(DatasetError::io("open", path))?;
        let rows = self.table.rows() as u64;
        SignalsReader::open(path, file, info, rows)?.verify()
    }

    fn put_in_place(&self, from: &Path, name: &str) -> Result<(), DatasetError> {
        let to = self.path.join(name);
        fs::rename(from, &to).map_err(DatasetError::io("rename into place", &to))?;
        make_names_durable(&self.path)
    }
}
