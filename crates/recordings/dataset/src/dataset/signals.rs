//! Signals of a dataset. The first request opens and verifies their file.

use std::sync::{Arc, PoisonError};

use taceva_core::{Field, FieldSet, Signals, single};

use super::Dataset;
use crate::error::DatasetError;
use crate::layout;
use crate::signals::SignalsReader;

impl Dataset {
    /// Fields that at least one sample has: columns of the table and, from a separate file, signals.
    pub fn fields(&self) -> FieldSet {
        let fields = self.table.fields();
        match self.header.signals {
            Some(_) => fields.with(Field::Signals),
            None => fields,
        }
    }

    /// Signals of a row; `None` if the recording has no signals. The first request verifies the whole file.
    ///
    /// # Errors
    /// [`DatasetError::Digest`] if the file differs from the recorded digest; [`DatasetError::Damaged`] if the file contradicts its header;
    /// [`DatasetError::Request`] if the row does not exist; [`DatasetError::Io`].
    pub fn signals(&self, row: usize) -> Result<Option<Signals>, DatasetError> {
        self.check_row(row)?;
        if let Some((recording, row)) = self.recording_of(row) {
            return recording.signals(row);
        }
        match self.signals_reader()? {
            Some(reader) => reader.row(row).map(Some),
            None => Ok(None),
        }
    }

    /// Mean signals over the rows declared as without contact. `None` if no row is declared so, and for joined recordings, because each recording has a
    /// separate mean.
    ///
    /// # Errors
    /// Errors of [`signals`](Dataset::signals).
    pub fn rest(&self) -> Result<Option<Signals>, DatasetError> {
        if !self.joined.is_empty() {
            return Ok(None);
        }
        let (Some(info), Some(reader)) = (&self.header.signals, self.signals_reader()?) else {
            return Ok(None);
        };
        let mut sums = vec![0.0_f64; info.spec.info.len()];
        let mut count = 0.0;
        for row in self.rest_rows() {
            let signals = reader.row(row)?;
            let places = sums.iter_mut().zip(signals.values());
            places.for_each(|(sum, value)| *sum += f64::from(*value));
            count += 1.0;
        }
        if count < 1.0 {
            return Ok(None);
        }
        let means = sums.iter().map(|sum| single(sum / count)).collect();
        let rest = Signals::new(info.spec.info, means);
        rest.map(Some).map_err(|error| {
            DatasetError::damaged(
                &self.path().join(layout::SIGNALS),
                format!("the mean of its rows without contact: {error}"),
            )
        })
    }

    /// Indices of the rows whose signals are declared as measured without contact.
    pub fn rest_rows(&self) -> impl Iterator<Item = usize> + '_ {
        let info = self.header.signals.iter();
        let runs = info.flat_map(|info| &info.spec.rest);
        // The header is not compared with the file yet, so a run may reach beyond the rows.
        let rows = self.table.rows();
        runs.flat_map(move |[first, last]| {
            let bound = |row: u64| usize::try_from(row).unwrap_or(rows).min(rows);
            bound(*first)..bound(last.saturating_add(1))
        })
    }

    /// Reads all signals and checks their digest.
    pub(super) fn verify_signals(&self) -> Result<(), DatasetError> {
        match self.signals_reader()? {
            Some(reader) => reader.verify(),
            None => Ok(()),
        }
    }

    fn signals_reader(&self) -> Result<Option<Arc<SignalsReader>>, DatasetError> {
        let Some(info) = &self.header.signals else {
            return Ok(None);
        };
        let mut opened = self.signals.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(reader) = &*opened {
            return Ok(Some(Arc::clone(reader)));
        }
        let (file, _) = self.folder.file(layout::SIGNALS, u64::MAX)?;
        let path = self.path().join(layout::SIGNALS);
        let rows = self.table.rows() as u64;
        let reader = Arc::new(SignalsReader::open(&path, file, info, rows)?);
        *opened = Some(Arc::clone(&reader));
        Ok(Some(reader))
    }
}
