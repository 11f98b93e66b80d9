//! Presses of a protocol. Each press is one record of the journal, so an interruption keeps either all of its samples or none.

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::{Frame, PressOutcome, Sample};

use super::payload::{WrittenPress, WrittenSample};
use super::{Recorder, ReplayError, signals_of};
use crate::error::DatasetError;
use crate::journal::RecordKind;
use crate::table::FrameEntry;

impl Recorder {
    /// True if a press called `press` is recorded.
    pub fn has_press(&self, press: &str) -> bool {
        self.presses.contains_key(press)
    }

    /// Number of presses by outcome.
    pub(super) fn press_counts(&self) -> BTreeMap<PressOutcome, u64> {
        let mut counts = BTreeMap::new();
        for outcome in self.presses.values() {
            *counts.entry(*outcome).or_default() += 1;
        }
        counts
    }

    /// Records a press, its outcome and all its samples, possibly none. Returns the number of the journal record once the record is durable.
    ///
    /// # Errors
    /// Errors of [`append`](Recorder::append), for the first rejected sample; [`DatasetError::Sample`] if the name of the press is empty or already
    /// used; [`DatasetError::Request`] for more samples than fit into one record, some thousands. Nothing is recorded after an error.
    pub fn append_press(
        &mut self,
        press: &str,
        outcome: PressOutcome,
        samples: &[Sample],
    ) -> Result<u64, DatasetError> {
        self.check_press(press, samples)?;
        let entries = self.write_frames(samples)?;
        let of_press = |samples| {
            let press = press.to_owned();
            let written = WrittenPress {
                press,
                outcome,
                samples,
            };
            written.to_toml()
        };
        let sequence = self.append_all(RecordKind::Press, samples, entries, of_press)?;
        self.presses.insert(press.to_owned(), outcome);
        Ok(sequence)
    }

    /// Appends one record with the text `payload`. `entries` are the locations of the written frames of `samples`.
    pub(super) fn append_all<'a>(
        &mut self,
        kind: RecordKind,
        samples: impl IntoIterator<Item = &'a Sample>,
        entries: Vec<Option<FrameEntry>>,
        payload: impl FnOnce(Vec<WrittenSample>) -> String,
    ) -> Result<u64, DatasetError> {
        let rows: Vec<_> = samples
            .into_iter()
            .zip(entries)
            .map(|(sample, entry)| {
                let info = sample.frame.as_ref().map(Frame::info);
                (self.row(sample, entry), info, signals_of(sample))
            })
            .collect();
        let channels = self.table.channels();
        let written = rows
            .iter()
            .map(|(row, info, signals)| WrittenSample::new(row, channels, *info, *signals));
        let payload = payload(written.collect());
        let sequence = self.journal.append(kind, payload.as_bytes())?;
        for (row, info, signals) in rows {
            self.take(row, info, signals)?;
        }
        Ok(sequence)
    }

    pub(super) fn replay_press(&mut self, written: WrittenPress) -> Result<(), ReplayError> {
        for sample in written.samples {
            self.replay_sample(sample)?;
        }
        self.presses.insert(written.press, written.outcome);
        Ok(())
    }

    fn check_press(&self, press: &str, samples: &[Sample]) -> Result<(), DatasetError> {
        let refused = |id: &str, problem: String| Err(DatasetError::sample(id, problem));
        if press.is_empty() || self.has_press(press) {
            return refused(press, "the name of the press is empty or taken".to_owned());
        }
        self.check_together(samples)
    }

    /// Checks that `samples` can be recorded in one record.
    pub(super) fn check_together<'a>(
        &self,
        samples: impl IntoIterator<Item = &'a Sample>,
    ) -> Result<(), DatasetError> {
        let refused = |id: &str, problem: String| Err(DatasetError::sample(id, problem));
        let mut names = BTreeSet::new();
        let mut expected = self.frame_info;
        for sample in samples {
            self.check(sample)?;
            if !names.insert(&sample.id) {
                return refused(&sample.id, "two samples have this name".to_owned());
            }
            let found = sample.frame.as_ref().map(Frame::info);
            match (expected, found) {
                (Some(expected), Some(found)) if expected != found => {
                    let problem = format!("a frame of {found}, expected {expected} like the first");
                    return refused(&sample.id, problem);
                }
                _ => expected = expected.or(found),
            }
        }
        Ok(())
    }
}
