//! Content that all forms of an export share.

use std::num::NonZeroUsize;

use taceva_core::{Instrument, Progress, Traceability};

use super::picture::Pictures;
use crate::error::ImportError;
use taceva_dataset::internal::{NamedColumn, staging::StagedFolder, write_durable};
use taceva_dataset::{Dataset, DatasetError};

/// Content of an export.
pub(super) struct Exported<'a> {
    pub(super) dataset: &'a Dataset,
    pub(super) columns: Vec<NamedColumn<'a>>,
    /// Pictures of each view.
    pub(super) pictures: Vec<Pictures<'a>>,
    pub(super) jobs: NonZeroUsize,
    pub(super) progress: &'a dyn Progress,
}

impl Exported<'_> {
    /// True if only some samples have a picture.
    pub(super) fn is_partly(&self) -> bool {
        let table = self.dataset.table();
        let pictures = table.frames().iter().flatten().count();
        pictures > 0 && pictures < table.rows()
    }

    /// Facts of the dataset that no map can state, in words.
    pub(super) fn left_out(&self) -> Vec<String> {
        let header = self.dataset.header();
        let table = self.dataset.table();
        let pictures = table.frames().iter().flatten().count();
        let parts = [
            (!header.settings.is_empty(), "the settings of the camera"),
            (header.recorded_on.is_some(), "the day of the recording"),
            (
                has_several(&header.traceability),
                "instruments with several certificates",
            ),
            (
                has_device_of_sensor(&header.traceability),
                "driver and serial number beside the certificate of the sensor",
            ),
            (!header.presses.is_empty(), "counts of presses by outcome"),
            (header.stream.is_some(), "losses of the stream"),
            (
                !header.extended.is_empty(),
                "which rows were added later: an import of this export divides its samples anew, so do not test a model of this dataset on that import",
            ),
            (
                !header.left_out.is_empty(),
                "omissions of the import of the dataset",
            ),
            (
                !header.unmentioned_columns.is_empty(),
                "the names of columns that the import of the dataset did not read",
            ),
            (
                header
                    .frames
                    .iter()
                    .chain(header.views.iter().map(|view| &view.frames))
                    .any(|frames| frames.codec.is_some()),
                "the coding of the clips",
            ),
            (
                pictures == 0 && header.views.is_empty() && header.frames.is_some(),
                "the picture without contact, since no sample has one",
            ),
            (
                self.has_blanks(),
                "blanks around texts, which an import strips",
            ),
            (
                self.is_partly(),
                "missing pictures of samples, which an import refuses",
            ),
        ];
        let left = parts.into_iter().filter(|(is_left, _)| *is_left);
        left.map(|(_, what)| what.to_owned()).collect()
    }

    /// True if a text of the dataset has surrounding blanks, or is present but empty.
    fn has_blanks(&self) -> bool {
        let rows = self.dataset.table().rows();
        let texts = self.columns.iter().filter(|column| column.cells.is_text());
        texts
            .flat_map(|column| (0..rows).filter_map(|row| column.cells.text(row)))
            .any(|text| text.is_empty() || text.trim() != text)
    }

    /// Taxel values of a row.
    pub(super) fn signals(&self, row: usize) -> Result<Vec<f32>, ImportError> {
        let signals = self.dataset.signals(row)?;
        Ok(signals.map_or_else(Vec::new, |signals| signals.values().to_vec()))
    }

    /// Writes the picture without contact beside the other pictures. Returns its file name; `None` if the dataset has no picture without contact.
    pub(super) fn write_reference(
        &self,
        staged: &StagedFolder,
        pictures: &Pictures<'_>,
    ) -> Result<Option<String>, ImportError> {
        let Some(picture) = pictures.reference()? else {
            return Ok(None);
        };
        let name = format!("{}.{}", pictures.named("reference"), picture.extension);
        write_durable(&staged.path().join(&name), &picture.bytes)?;
        Ok(Some(name))
    }

    /// Reports `rows` more exported rows as progress. Fails if the export is cancelled.
    pub(super) fn advance(&self, rows: usize) -> Result<(), ImportError> {
        self.progress.advance(rows as u64);
        match self.progress.is_cancelled() {
            true => Err(DatasetError::Cancelled.into()),
            false => Ok(()),
        }
    }
}

/// True if labels were measured with several certificates or devices of one kind of instrument.
fn has_several(of: &[Traceability]) -> bool {
    let is_several = |instrument: Instrument| {
        let of = of.iter().filter(|of| of.instrument == instrument);
        of.count() > 1
    };
    Instrument::ALL.into_iter().any(is_several)
}

/// True if the instrument of the sensor has a driver or a serial number, which `[sensor]` of a map cannot state.
fn has_device_of_sensor(of: &[Traceability]) -> bool {
    of.iter().any(|of| {
        let is_device = of.driver.is_some() || of.serial.is_some();
        of.instrument == Instrument::Sensor && is_device
    })
}
