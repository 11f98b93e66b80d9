//! Predictions beside a recording, separate from its labels.

use std::path::Path;

use super::{Recorder, partial};
use crate::digest::Digest;
use crate::error::DatasetError;
use crate::file::write_durable;
use crate::header::LivePredictions;
use crate::layout;

/// Table of predictions, with its facts for the header.
#[derive(Debug)]
pub(super) struct PredictedTable {
    text: Vec<u8>,
    pub(super) facts: LivePredictions,
}

impl Recorder {
    /// Stores the predictions `table` of the model called `by` until the recording is closed. `table` is CSV with one line per sample.
    ///
    /// Only the last table is kept. An interruption before the close loses the table, but not frames and labels. `taceva predict` can compute the predictions
    /// again.
    pub fn keep_predictions(&mut self, by: &str, model: Digest, table: Vec<u8>) {
        self.predictions = Some(PredictedTable {
            facts: LivePredictions::new(by, model, &table),
            text: table,
        });
    }
}

impl PredictedTable {
    /// Writes the table into a temporary file in `folder`.
    pub(super) fn write(&self, folder: &Path) -> Result<(), DatasetError> {
        write_durable(&partial(folder, layout::PREDICTIONS), &self.text)
    }
}
