//! Log of the presses in a recording.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use taceva_core::{Frame, Nanometre, Sample, SinkError};
use taceva_dataset::{PressZero, Recorder, SessionTable, add_press_zero};
use taceva_models::FrameReduction;
use taceva_protocol::{
    ContentId, ForceZero, Plan, PlannedPress, PressLog, PressRecord, SessionRecord,
};

use super::reduction::reduced;
use super::session;

/// Log of the presses in a recording in progress.
pub(super) struct RecordedPresses {
    /// Path of the recording.
    path: PathBuf,
    recorder: Recorder,
    /// Recorded presses that will be repeated.
    relived: BTreeSet<ContentId>,
    /// Row number of each sample of the presses to repeat, by sample name.
    rows: BTreeMap<String, usize>,
    sessions: SessionTable,
    /// Reduction of frames before they are recorded; `None` to record full frames.
    reduction: Option<FrameReduction>,
}

impl RecordedPresses {
    /// Creates a log that continues `recorder` and `sessions` of the recording at `path`. `reduction` reduces frames; `None` records full frames.
    pub(super) fn new(
        path: &Path,
        recorder: Recorder,
        sessions: SessionTable,
        reduction: Option<FrameReduction>,
    ) -> RecordedPresses {
        RecordedPresses {
            path: path.to_owned(),
            recorder,
            sessions,
            relived: BTreeSet::new(),
            rows: BTreeMap::new(),
            reduction,
        }
    }

    /// Schedules recorded presses of `unit` for repetition and comparison. A press is repeated if another press at the same place is missing.
    pub(super) fn relive(&mut self, plan: &Plan, unit: &str) {
        let of_unit = || plan.presses.iter().filter(|press| press.press.unit == unit);
        let is_recorded = |press: &&PlannedPress| self.has(press.id);
        let missing: BTreeSet<[Nanometre; 2]> = of_unit()
            .filter(|press| !is_recorded(press))
            .map(|press| press.press.place)
            .collect();
        let relived: BTreeSet<ContentId> = of_unit()
            .filter(is_recorded)
            .filter(|press| missing.contains(&press.press.place))
            .map(|press| press.id)
            .collect();
        if !relived.is_empty() && self.rows.is_empty() {
            let names = self.recorder.table().samples().iter().cloned();
            self.rows = names.zip(0..).collect();
        }
        self.relived = relived;
    }

    pub(super) fn sessions(&self) -> &SessionTable {
        &self.sessions
    }

    pub(super) fn into_recorder(self) -> Recorder {
        self.recorder
    }

    fn has(&self, press: ContentId) -> bool {
        self.recorder.has_press(&press.to_string())
    }

    /// Adds the zero of the transducer in an attempt at `press` to the table next to the recording.
    fn keep_zero(
        &self,
        press: ContentId,
        zero: &ForceZero,
        is_kept: bool,
    ) -> Result<(), SinkError> {
        let [before_fx_n, before_fy_n, before_fz_n] = zero.before.map(|force| force.0);
        let [after_fx_n, after_fy_n, after_fz_n] = zero.after.map(|force| force.0);
        let row = PressZero {
            press: press.to_string(),
            is_kept,
            t_s: zero.at_s,
            before_fx_n,
            before_fy_n,
            before_fz_n,
            after_fx_n,
            after_fy_n,
            after_fz_n,
        };
        Ok(add_press_zero(&self.path, &row)?)
    }

    /// Rejects a repeated press that differs from its recording.
    fn check(&self, samples: &[Sample]) -> Result<(), SinkError> {
        let table = self.recorder.table();
        let bits = |value: Option<f64>| value.map(f64::to_bits);
        let is_as_recorded = |sample: &Sample| {
            let Some(&row) = self.rows.get(&sample.id) else {
                return false;
            };
            let stamp = sample.stamp.map(|stamp| stamp.valid_s);
            let mut channels = 0..table.channels().len();
            bits(stamp) == bits(table.t_s()[row])
                && channels.all(|at| bits(sample.truth.get(at)) == bits(table.truth(at).get(row)))
        };
        match samples.iter().find(|sample| !is_as_recorded(sample)) {
            None => Ok(()),
            Some(sample) => Err(format!(
                "sample {} differs from its recording when repeated: the recording was begun with another version of the bench",
                sample.id
            )
            .into()),
        }
    }
}

impl PressLog for RecordedPresses {
    fn is_finished(&self, press: ContentId) -> bool {
        self.has(press) && !self.relived.contains(&press)
    }

    fn append(&mut self, record: &PressRecord) -> Result<(), SinkError> {
        if self.relived.contains(&record.press) {
            return self.check(&record.samples);
        }
        if let Some(zero) = &record.force_zero {
            self.keep_zero(record.press, zero, true)?;
        }
        let name = record.press.to_string();
        let samples = match &self.reduction {
            Some(reduction) => Cow::Owned(reduced(&record.samples, reduction)?),
            None => Cow::Borrowed(&record.samples[..]),
        };
        self.recorder
            .append_press(&name, record.outcome, &samples)?;
        Ok(())
    }

    /// Stores the reference frame of the first unit. Later frames are ignored.
    fn untouched(&mut self, frame: &Frame) -> Result<(), SinkError> {
        if !self.recorder.has_reference() {
            match &self.reduction {
                Some(reduction) => self.recorder.append_reference(&reduction.reduce(frame)?)?,
                None => self.recorder.append_reference(frame)?,
            };
        }
        Ok(())
    }

    fn zero_step(&mut self, press: ContentId, zero: &ForceZero) -> Result<(), SinkError> {
        self.keep_zero(press, zero, false)
    }

    fn session(&mut self, record: &SessionRecord) -> Result<(), SinkError> {
        Ok(self.sessions.add(session::row(record))?)
    }
}
