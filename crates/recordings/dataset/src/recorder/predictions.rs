//! Predictions beside a recording, never among its labels.

use std::path::Path;

use super::{Recorder, partial};
use crate::digest::Digest;
use crate::error::DatasetError;
use crate::file::write_durable;
use crate::header::LivePredictions;
use crate::layout;

/// A table of predictions, and what the header says of it.
#[derive(Debug)]
pub(super) struct PredictedTable {
    text: Vec<u8>,
    pub(super) facts: LivePredictions,
}

impl Recorder {
    /// Keeps `table`, CSV with a line a sample, as what the model called `by` predicted; it is written when the recording is closed.
    ///
    /// The last one counts. An interruption before that loses it; frames and labels are kept, and `taceva predict` makes it anew.
    pub fn keep_predictions(&mut self, by: &str, model: Digest, table: Vec<u8>) {
        self.predictions = Some(PredictedTable {
            facts: LivePredictions::new(by, model, &table),
            text: table,
        });
    }
}

impl PredictedTable {
    /// Writes the table into a file beside its place in `folder`.
    pub(super) fn write(&self, folder: &Path) -> Result<(), DatasetError> {
        write_durable(&partial(folder, layout::PREDICTIONS), &self.text)
    }
}
