//! Recorder that acknowledges each sample only when the sample is durable.

use std::collections::{BTreeMap, HashSet};
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use taceva_core::{
    Channels, Field, FieldSet, Frame, FrameInfo, PressOutcome, Sample, SampleSink, Signals,
    SinkError,
};
use taceva_files::parent_of;

use crate::digest::Digest;
use crate::error::DatasetError;
use crate::file::make_names_durable;
use crate::header::{RecordingFacts, ReducedFrames, ReferenceInfo, StreamFacts};
use crate::journal::{Journal, RecordKind};
use crate::later_facts::{self, LaterFacts};
use crate::layout;
use crate::pack::{PackEnd, PackWriter, cut_behind};
use crate::signals::{SignalsSpec, SignalsWriter};
use crate::table::{FrameEntry, Row, Table};

mod check;
mod close;
mod folder;
mod frames;
mod payload;
mod predictions;
mod press;
mod replay;
mod stream;

use folder::{empty_folder, unclosed_folder};
use payload::{WrittenFrame, WrittenSample, WrittenStart};
use predictions::PredictedTable;
use replay::ReplayError;
pub use stream::Streamed;

/// Facts and channels of a recording.
///
/// ```
/// use taceva_core::{Channel, Channels, Clock};
/// use taceva_dataset::{RecordingFacts, RecordingSpec, SensorFacts, Source};
///
/// let facts = RecordingFacts::new(Source::Recorded, Clock::Monotonic, SensorFacts::new("DIGIT"));
/// let spec = RecordingSpec::new(facts, Channels::new([Channel::PZ, Channel::FZ])?);
/// assert_eq!(spec.channels.len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RecordingSpec {
    /// Facts about the recording that are known before the first sample.
    pub facts: RecordingFacts,
    /// Channels of the labels of each sample.
    pub channels: Channels,
    /// Taxels of the sensor; `None` without taxels. With taxels, every sample must have signals.
    pub signals: Option<SignalsSpec>,
    /// Original form of frames that were reduced before recording; `None` for unreduced frames.
    pub reduced: Option<ReducedFrames>,
}

impl RecordingSpec {
    /// Recording without taxels, whose frames are not reduced.
    pub fn new(facts: RecordingFacts, channels: Channels) -> RecordingSpec {
        RecordingSpec {
            facts,
            channels,
            signals: None,
            reduced: None,
        }
    }

    /// The same recording for a sensor with taxels. Every sample must have signals.
    #[must_use]
    pub fn with_signals(self, signals: SignalsSpec) -> RecordingSpec {
        RecordingSpec {
            signals: Some(signals),
            ..self
        }
    }

    /// The same recording for frames that are reduced before they are recorded.
    #[must_use]
    pub fn with_reduced(self, reduced: ReducedFrames) -> RecordingSpec {
        RecordingSpec {
            reduced: Some(reduced),
            ..self
        }
    }
}

/// Writes samples as they arrive. An ended process or a power cut loses at most the unacknowledged sample.
///
/// ```
/// use taceva_core::{Channel, Channels, Clock, Readings, Sample};
/// use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
///
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("recording");
/// let sensor = SensorFacts::new("my gel").with_serial("7").with_opaque(true);
/// let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor);
/// let spec = RecordingSpec::new(facts, Channels::new([Channel::FZ])?);
/// let mut recorder = Recorder::create(&path, &spec)?;
/// recorder.append(&Sample::new("press 1").with_truth(Readings::from_values([0.5])))?;
/// recorder.close()?;
/// assert_eq!(Dataset::open(&path)?.table().truth(0).get(0), Some(0.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Recorder {
    path: PathBuf,
    _lock: File,
    journal: Journal,
    facts: RecordingFacts,
    table: Table,
    finished: HashSet<String>,
    presses: BTreeMap<String, PressOutcome>,
    stream: Option<StreamFacts>,
    predictions: Option<PredictedTable>,
    frame_info: Option<FrameInfo>,
    /// Original form of frames that were reduced before recording; `None` for unreduced frames.
    reduced: Option<ReducedFrames>,
    reference: Option<ReferenceInfo>,
    cut_bytes: u64,
    /// Pack for new frames; `None` before the first frame.
    pack: Option<PackWriter>,
    /// Position after the last frame that the journal names.
    pack_end: PackEnd,
    /// First frame of the pack, and its digest.
    first: Option<(Digest, Frame)>,
    /// Number of recorded frames without contact.
    references: usize,
    /// Signals file, which is rewritten from the journal when a recording is resumed; `None` without taxels.
    signals: Option<SignalsWriter>,
}

impl Recorder {
    /// Begins a recording in a new folder at `path`.
    ///
    /// # Errors
    /// [`DatasetError::TargetExists`] if `path` already contains a recording; [`DatasetError::Busy`] if another process writes there; [`DatasetError::Io`].
    pub fn create(path: &Path, spec: &RecordingSpec) -> Result<Recorder, DatasetError> {
        let lock = empty_folder(path)?;
        // A deleted recording of this name may have left its later facts.
        LaterFacts::remove(path);
        let frames = path.join(layout::FRAMES);
        fs::create_dir_all(&frames).map_err(DatasetError::io("create", &frames))?;
        make_names_durable(parent_of(path))?;
        let start = WrittenStart::new(spec).to_toml();
        let journal = Journal::create(&path.join(layout::JOURNAL), start.as_bytes())?;
        Recorder::new(path, lock, journal, spec.clone())
    }

    /// Resumes a recording that was not closed. A torn last record is cut.
    ///
    /// # Errors
    /// [`DatasetError::NoDataset`] if `path` contains no recording; [`DatasetError::TargetExists`] if the recording was closed; [`DatasetError::Busy`] if
    /// another process writes there; [`DatasetError::Journal`] if the journal is damaged before its end; [`DatasetError::Damaged`] for a symbolic link in the
    /// recording; [`DatasetError::Io`].
    pub fn resume(path: &Path) -> Result<Recorder, DatasetError> {
        let journal_path = path.join(layout::JOURNAL);
        let lock = unclosed_folder(path)?;
        let nothing = || DatasetError::NoDataset {
            path: path.to_owned(),
            problem: "the folder has no recording to resume".to_owned(),
        };
        if !journal_path.exists() {
            return Err(nothing());
        }
        let (journal, recovered) = Journal::open(&journal_path)?;
        let mut records = recovered.records.into_iter().enumerate();
        let (_, start) = records.next().ok_or_else(nothing)?;
        let spec = WrittenStart::parse(&journal_path, &start.payload)?;
        let mut recorder = Recorder::new(path, lock, journal, spec)?;
        recorder.facts.recorded_until = LaterFacts::of(path).recorded_until;
        recorder.cut_bytes = recovered.cut_bytes;
        for (sequence, record) in records {
            recorder.replay(&record).map_err(|error| match error {
                ReplayError::Io(error) => error,
                ReplayError::Damaged(problem) => {
                    DatasetError::damaged(&journal_path, format!("record {sequence}: {problem}"))
                }
            })?;
        }
        cut_behind(path, recorder.pack_end)?;
        Ok(recorder)
    }

    /// Resumes the recording at `path`, or begins a new recording if there is none.
    ///
    /// # Errors
    /// Errors of [`create`](Recorder::create) and [`resume`](Recorder::resume); [`DatasetError::Request`] if the recording differs from `spec`.
    pub fn open(path: &Path, spec: &RecordingSpec) -> Result<Recorder, DatasetError> {
        if !path.exists() {
            return Recorder::create(path, spec);
        }
        let mut recorder = match Recorder::resume(path) {
            Err(DatasetError::NoDataset { .. }) => return Recorder::create(path, spec),
            resumed => resumed?,
        };
        let before = &recorder.facts;
        let taxels = recorder.signals.as_ref().map(SignalsWriter::spec);
        if let Some(problem) = before.other_setting(&spec.facts) {
            return Err(DatasetError::request(path, problem));
        }
        if *before != spec.facts.clone().resuming(before)
            || recorder.table.channels() != &spec.channels
            || taxels != spec.signals.as_ref()
            || recorder.reduced != spec.reduced
        {
            return Err(DatasetError::request(
                path,
                "the existing recording has another sensor, clock, set of channels or taxels, or reduction of frames",
            ));
        }
        match before.other_instrument(&spec.facts, path) {
            Some(problem) => Err(DatasetError::request(path, problem)),
            None => {
                let today = spec.facts.recorded_on;
                later_facts::resume_on(today, &mut recorder.facts, path)
                    .map_err(DatasetError::io("store the day of", path))?;
                Ok(recorder)
            }
        }
    }

    fn new(
        path: &Path,
        lock: File,
        journal: Journal,
        spec: RecordingSpec,
    ) -> Result<Recorder, DatasetError> {
        let signals = spec.signals.as_ref();
        let signals =
            signals.map(|signals| SignalsWriter::create(&partial(path, layout::SIGNALS), signals));
        Ok(Recorder {
            path: path.to_owned(),
            _lock: lock,
            journal,
            facts: spec.facts,
            table: Table::new(spec.channels, Vec::new()),
            finished: HashSet::new(),
            presses: BTreeMap::new(),
            stream: None,
            predictions: None,
            frame_info: None,
            reduced: spec.reduced,
            reference: None,
            cut_bytes: 0,
            pack: None,
            pack_end: PackEnd::default(),
            first: None,
            references: 0,
            signals: signals.transpose()?,
        })
    }

    /// True if a sample called `id` is recorded.
    pub fn has(&self, id: &str) -> bool {
        self.finished.contains(id)
    }

    /// Recorded samples, in order.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// Size of a torn last record that was cut on resuming, bytes.
    pub fn cut_bytes(&self) -> u64 {
        self.cut_bytes
    }

    /// Records a sample. Returns its number in the journal, from 1, once the sample is durable. Predictions are not recorded.
    ///
    /// # Errors
    /// [`DatasetError::Sample`] for an empty or used name, a number that is not finite, more values than channels, signals that do not match the
    /// taxels, or a frame that differs in size or format from the first. [`DatasetError::Io`], after which the recording must be resumed.
    pub fn append(&mut self, sample: &Sample) -> Result<u64, DatasetError> {
        self.check(sample)?;
        let entries = self.write_frames(std::slice::from_ref(sample))?;
        let of_sample = |written: Vec<WrittenSample>| {
            let texts = written.iter().map(WrittenSample::to_toml);
            texts.collect::<String>()
        };
        self.append_all(RecordKind::Sample, [sample], entries, of_sample)
    }

    /// True if a frame without contact was recorded.
    pub fn has_reference(&self) -> bool {
        self.reference.is_some()
    }

    /// Records a frame without contact. The last recorded frame without contact is used.
    ///
    /// # Errors
    /// [`DatasetError::Sample`] if the frame differs in size or format from the other frames; [`DatasetError::Io`].
    pub fn append_reference(&mut self, frame: &Frame) -> Result<u64, DatasetError> {
        self.check_frame("reference", frame)?;
        // The previous frame keeps its file, because the journal names it until the new frame is durable.
        let relative = layout::reference_path_anew(self.references, "png");
        let digest = self.write_image(&relative, frame)?;
        let written = WrittenFrame {
            path: relative,
            sha256: digest,
            info: frame.info(),
        };
        let sequence = self
            .journal
            .append(RecordKind::Reference, written.to_toml().as_bytes())?;
        self.take_reference(written);
        Ok(sequence)
    }

    /// Adds a durable sample to the table and to the signals file.
    fn take(
        &mut self,
        row: Row,
        info: Option<FrameInfo>,
        signals: Option<&[f32]>,
    ) -> Result<(), DatasetError> {
        if let Some(writer) = &mut self.signals {
            writer.push(signals.unwrap_or_default())?;
        }
        if let Some(frame) = &row.frame {
            self.pack_end = self.pack_end.behind(&frame.path, frame.span);
        }
        self.frame_info = self.frame_info.or(info);
        self.finished.insert(row.sample.clone());
        self.table.push(row);
        Ok(())
    }

    fn take_reference(&mut self, written: WrittenFrame) {
        self.frame_info = self.frame_info.or(Some(written.info));
        self.references += 1;
        self.reference = Some(ReferenceInfo {
            path: written.path,
            sha256: written.sha256,
        });
    }

    fn row(&self, sample: &Sample, frame: Option<FrameEntry>) -> Row {
        Row {
            sample: sample.id.clone(),
            point_id: sample.point_id.clone(),
            unit_id: sample.unit_id.clone(),
            scene: sample.scene_id.clone(),
            depth_step: sample.depth_step,
            repeat: sample.repeat,
            phase: sample.phase,
            limited_by: sample.limited_by,
            zero_u_mm: sample.zero_u_mm,
            source_table: None,
            source_row: None,
            source_frame: None,
            part: None,
            t_s: sample.stamp.map(|stamp| stamp.valid_s),
            kind: sample.kind,
            spacing: sample.spacing,
            // The value of the sample, or else of its picture.
            intensity: sample
                .intensity
                .or_else(|| sample.frame.as_ref().map(Frame::mean_luma)),
            truth: (0..self.table.channels().len())
                .map(|position| sample.truth.get(position))
                .collect(),
            attributes: Vec::new(),
            frame,
            views: Vec::new(),
            tasks: Vec::new(),
        }
    }
}

/// Path of the file `name` before the recording is closed.
fn partial(folder: &Path, name: &str) -> PathBuf {
    folder.join(format!("{name}.partial"))
}

/// Signal values of a sample, if any.
fn signals_of(sample: &Sample) -> Option<&[f32]> {
    sample.signals.as_ref().map(Signals::values)
}

impl SampleSink for Recorder {
    fn fields(&self) -> FieldSet {
        Field::ALL
            .into_iter()
            .filter(|field| *field != Field::Prediction)
            .collect()
    }

    fn accept(&mut self, sample: &Sample) -> Result<(), SinkError> {
        self.append(sample)?;
        Ok(())
    }
}
