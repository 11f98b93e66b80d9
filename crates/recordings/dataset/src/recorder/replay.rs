//! Restores the state of a recording from its journal, record by record.

use super::Recorder;
use super::payload::{WrittenFrame, WrittenPress, WrittenSample, WrittenStream};
use crate::error::DatasetError;
use crate::journal::{JournalRecord, RecordKind};

/// Error while a record of a journal is restored.
pub(super) enum ReplayError {
    /// Damaged record, with a description of the damage.
    Damaged(String),
    /// Error of the operating system.
    Io(DatasetError),
}

impl From<String> for ReplayError {
    fn from(problem: String) -> ReplayError {
        ReplayError::Damaged(problem)
    }
}

impl From<DatasetError> for ReplayError {
    fn from(error: DatasetError) -> ReplayError {
        ReplayError::Io(error)
    }
}

impl Recorder {
    pub(super) fn replay(&mut self, record: &JournalRecord) -> Result<(), ReplayError> {
        match record.kind {
            RecordKind::Start => Err("a second start record".to_owned().into()),
            RecordKind::Sample => self.replay_sample(WrittenSample::parse(&record.payload)?),
            RecordKind::Reference => {
                self.take_reference(WrittenFrame::parse(&record.payload)?);
                Ok(())
            }
            RecordKind::Press => self.replay_press(WrittenPress::parse(&record.payload)?),
            RecordKind::Stream => self.replay_stream(WrittenStream::parse(&record.payload)?),
        }
    }

    pub(super) fn replay_sample(&mut self, written: WrittenSample) -> Result<(), ReplayError> {
        let (row, info, signals) = written.into_row(self.table.channels())?;
        Ok(self.take(row, info, signals.as_deref())?)
    }
}
