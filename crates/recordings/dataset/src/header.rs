//! `dataset.toml`: facts about the recording as a whole.

mod class_mapping;
mod column_mapping;
mod content_digest;
mod extension;
mod footprint;
mod join_mapping;
mod leds;
mod live_predictions;
mod map_conflict;
mod mapping;
mod omissions;
mod picture_mapping;
mod recording_facts;
mod reduction;
mod sections;
mod sources;
mod stream;
#[cfg(test)]
mod tests;
mod view;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde::{Deserialize, Serialize};
use taceva_core::{Channel, ChannelError, Channels, Clock, Date, PressOutcome, Traceability, Unit};

use crate::digest::Digest;
use crate::error::DatasetError;
use crate::folder_handle::HeldFolder;
use crate::layout;
use crate::limits;
use crate::signals::{SignalsInfo, WrittenSignals};
use crate::task::{self, Task};
use crate::toml_file::{parse_toml, toml_error, utf8};
use crate::version::Version;
use taceva_files::seal::{Edit, Opened, toml_text};

pub use class_mapping::MappedClass;
pub use column_mapping::MappedColumn;
pub(crate) use content_digest::dataset_digest;
pub use extension::Extension;
pub use footprint::{Footprint, Shape};
pub use join_mapping::MappedJoin;
pub use leds::{Leds, PictureSide};
pub use live_predictions::LivePredictions;
pub use map_conflict::Misread;
pub use mapping::Mapping;
pub use omissions::LeftOut;
pub use omissions::add as add_left_out;
pub use picture_mapping::MappedPictures;
pub use recording_facts::RecordingFacts;
pub use reduction::ReducedFrames;
pub use sections::{FrameCodec, FramesInfo, Known, ReferenceInfo, SensorFacts, Source, TableInfo};
pub use sources::SourcesInfo;
pub use stream::StreamFacts;
pub use view::ViewInfo;

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct ChannelInfo {
    name: String,
    unit: Unit,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    period: Option<u16>,
}

impl ChannelInfo {
    fn of(channel: &Channel) -> ChannelInfo {
        ChannelInfo {
            name: channel.name().to_owned(),
            unit: channel.unit(),
            period: channel.period(),
        }
    }

    fn channel(&self) -> Result<Channel, ChannelError> {
        let channel = Channel::named(&self.name, self.unit)?;
        match self.period {
            Some(period) => channel.with_period(period),
            None => Ok(channel),
        }
    }
}

/// Content of `dataset.toml`.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample};
/// # use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("recording");
/// # let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("my gel"));
/// # let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, Channels::new([Channel::FZ])?))?;
/// # let info = FrameInfo { width: 2, height: 1, format: PixelFormat::Gray8 };
/// # for number in 0..2_u8 {
/// #     let sample = Sample::new(number.to_string()).with_truth(Readings::from_values([0.5]));
/// #     recorder.append(&sample.with_frame(Frame::new(info, vec![number, 90])?))?;
/// # }
/// let header = recorder.close()?;
/// assert_eq!((header.sensor.model.as_str(), header.table.rows), ("my gel", 2));
/// assert!(header.seal.digest.starts_with("sha256:"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Header {
    /// Version of the folder format.
    pub format: Version,
    /// Origin of the samples: measured, simulated or synthetic.
    pub source: Source,
    /// Clock that stamped the samples. Defines the origin of `t_s`.
    pub clock: Clock,
    /// UTC day on which the recording began; `None` if nothing was measured, or for an import.
    pub recorded_on: Option<Date>,
    /// UTC day of the last session, if different from `recorded_on`. For joined recordings, the last day of all recordings; `recorded_on` is then the first.
    pub recorded_until: Option<Date>,
    /// Facts about the sensor.
    pub sensor: SensorFacts,
    /// Sensing area, if known.
    pub footprint: Option<Footprint>,
    /// Settings read back from camera, transducer (`force_…`) and robot (`robot_…`), by name, such as `15.7` for `exposure_ms`; empty if unknown.
    pub settings: BTreeMap<String, String>,
    /// Instruments that measured the labels, with their certificates; empty if none is stated.
    pub traceability: Vec<Traceability>,
    /// Channels measured besides the frames, with their units.
    pub channels: Channels,
    /// Names of the text columns kept for splits.
    pub attributes: Vec<String>,
    /// Columns of the imported table that the import map does not name; empty for a recording.
    pub unmentioned_columns: Vec<String>,
    /// Source column of each label, from all imports; empty for a recording.
    pub columns: Vec<MappedColumn>,
    /// Joined tables, from all imports; empty for a recording.
    pub joins: Vec<MappedJoin>,
    /// Source of the pictures and conversion to pixels, from all imports; empty for a recording.
    pub pictures: Vec<MappedPictures>,
    /// Closed lists of classes, from all imports; empty for a recording.
    pub classes: Vec<MappedClass>,
    /// Definitions of the tasks, sorted by name; empty without tasks.
    pub tasks: Vec<Task>,
    /// Channels that together form one rotation: a rotation vector x, y, z or a quaternion x, y, z, w.
    pub rotations: Vec<Vec<String>>,
    /// Data that the import left out; empty for a recording.
    pub left_out: LeftOut,
    /// Warnings of all imports, or of the devices that made a recording.
    pub warnings: Vec<String>,
    /// Properties shared by all frames; `None` without frames.
    pub frames: Option<FramesInfo>,
    /// Frames of each view, if samples have several pictures. `frames` then describes the selected views.
    pub views: Vec<ViewInfo>,
    /// Number of presses by outcome, including presses without a sample; empty without a protocol.
    pub presses: BTreeMap<PressOutcome, u64>,
    /// Frame losses of a recorded stream; `None` for other recordings.
    pub stream: Option<StreamFacts>,
    /// Predictions that a model made during the recording, which are not labels; `None` without predictions.
    pub predictions: Option<LivePredictions>,
    /// Properties of the taxels, and the digests of their file; `None` without taxels.
    pub signals: Option<SignalsInfo>,
    /// States of the recording before each addition of rows, oldest first; empty if no rows were added.
    pub extended: Vec<Extension>,
    /// List of imported source files; `None` for a recording.
    pub sources: Option<SourcesInfo>,
    /// Number of rows and digests of `samples.parquet`.
    pub table: TableInfo,
    /// Digest of the table, frames, signals and tasks of the dataset. The key `digest` of the file is the digest without tasks.
    pub digest: Digest,
    /// Digest with tasks as the file states it; `None` without tasks.
    pub(crate) digest_with_tasks: Option<Digest>,
    /// State of the seal, with the accepted edits of the header.
    pub seal: Opened,
}

/// Header in the key order of TOML: plain keys before tables.
#[derive(Serialize, Deserialize)]
struct Written {
    format: Version,
    source: Source,
    clock: Clock,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    recorded_on: Option<Date>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    recorded_until: Option<Date>,
    attributes: Vec<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    unmentioned_columns: Vec<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    rotations: Vec<Vec<String>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<String>,
    digest: Digest,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    digest_with_tasks: Option<Digest>,
    sensor: SensorFacts,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    footprint: Option<Footprint>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    settings: BTreeMap<String, String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    frames: Option<FramesInfo>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    presses: BTreeMap<PressOutcome, u64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    stream: Option<StreamFacts>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    predictions: Option<LivePredictions>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    signals: Option<WrittenSignals>,
    #[serde(default, skip_serializing_if = "LeftOut::is_empty")]
    left_out: LeftOut,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    sources: Option<SourcesInfo>,
    table: TableInfo,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    extended: Vec<Extension>,
    channels: Vec<ChannelInfo>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    views: Vec<ViewInfo>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    columns: Vec<MappedColumn>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    joins: Vec<MappedJoin>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pictures: Vec<MappedPictures>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    classes: Vec<MappedClass>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    traceability: Vec<Traceability>,
    #[serde(
        default,
        deserialize_with = "task::known",
        skip_serializing_if = "BTreeMap::is_empty"
    )]
    task: BTreeMap<String, Task>,
    /// Edits accepted before rows were added; parsed with the seal.
    #[serde(default, skip_deserializing, skip_serializing_if = "Vec::is_empty")]
    history: Vec<Edit>,
}

impl Header {
    /// Header of the dataset in `folder`.
    pub(crate) fn read(folder: &HeldFolder) -> Result<Header, DatasetError> {
        let bytes = folder.read(layout::HEADER, limits::TOML_BYTES)?;
        Header::parse(&folder.path().join(layout::HEADER), bytes)
    }

    /// Parses the header from `bytes`, the content of the file at `path`.
    fn parse(path: &Path, bytes: Vec<u8>) -> Result<Header, DatasetError> {
        #[derive(Deserialize)]
        struct OnlyFormat {
            format: Version,
        }

        let text = utf8(path, bytes)?;
        let OnlyFormat { format } = parse_toml(path, &text)?;
        if !format.is_readable() {
            return Err(DatasetError::Version {
                path: path.to_owned(),
                found: format,
            });
        }
        // Text that is not TOML is rejected with its line.
        parse_toml::<toml::Table>(path, &text)?;
        let checked = toml_text::check(&text);
        let seal = checked.map_err(|source| DatasetError::Seal {
            path: path.to_owned(),
            source,
        })?;
        let written: Written = parse_toml(path, &text)?;
        let channels = written
            .channels
            .iter()
            .map(ChannelInfo::channel)
            .collect::<Result<Vec<_>, _>>()
            .and_then(Channels::new)
            .map_err(|error| toml_error(path, None, &error.to_string()))?;
        let signals = written.signals.map(SignalsInfo::try_from).transpose();
        let signals = signals.map_err(|problem| toml_error(path, None, &problem))?;
        let mut names = BTreeSet::new();
        let twice = written.views.iter();
        if let Some(view) = { twice }.find(|view| !names.insert(view.name.as_str())) {
            let problem = format!("two views are called `{}`", view.name);
            return Err(toml_error(path, None, &problem));
        }
        Ok(Header {
            format,
            source: written.source,
            clock: written.clock,
            recorded_on: written.recorded_on,
            recorded_until: written.recorded_until,
            sensor: written.sensor,
            footprint: written.footprint,
            settings: written.settings,
            traceability: written.traceability,
            channels,
            attributes: written.attributes,
            unmentioned_columns: written.unmentioned_columns,
            columns: written.columns,
            joins: written.joins,
            pictures: written.pictures,
            classes: written.classes,
            tasks: written.task.into_values().collect(),
            rotations: written.rotations,
            left_out: written.left_out,
            warnings: written.warnings,
            frames: written.frames,
            views: written.views,
            presses: written.presses,
            stream: written.stream,
            predictions: written.predictions,
            sources: written.sources,
            table: written.table,
            digest: written.digest,
            digest_with_tasks: written.digest_with_tasks,
            extended: written.extended,
            signals,
            seal,
        })
    }

    /// Facts known before the first sample.
    pub fn recording_facts(&self) -> RecordingFacts {
        RecordingFacts {
            source: self.source,
            clock: self.clock,
            recorded_on: self.recorded_on,
            recorded_until: self.recorded_until,
            sensor: self.sensor.clone(),
            footprint: self.footprint,
            settings: self.settings.clone(),
            traceability: self.traceability.clone(),
        }
    }

    /// Mappings of all imports.
    pub fn mapping(&self) -> Mapping {
        Mapping {
            columns: self.columns.clone(),
            joins: self.joins.clone(),
            pictures: self.pictures.clone(),
            classes: self.classes.clone(),
            rotations: self.rotations.clone(),
        }
    }

    /// Text of the header with its seal.
    pub(crate) fn to_toml(&self) -> String {
        toml_text::seal(&self.body()).expect("the body of a header is TOML")
    }

    /// Text of the header without its seal.
    fn body(&self) -> String {
        let tasks = self.tasks.iter();
        let tasks = tasks.map(|task| (task.name.clone(), task.clone()));
        let written = Written {
            format: self.format,
            source: self.source,
            clock: self.clock,
            recorded_on: self.recorded_on,
            recorded_until: self.recorded_until,
            attributes: self.attributes.clone(),
            unmentioned_columns: self.unmentioned_columns.clone(),
            rotations: self.rotations.clone(),
            warnings: self.warnings.clone(),
            digest: self.digest,
            digest_with_tasks: self.digest_with_tasks,
            sensor: self.sensor.clone(),
            footprint: self.footprint,
            settings: self.settings.clone(),
            frames: self.frames.clone(),
            views: self.views.clone(),
            presses: self.presses.clone(),
            stream: self.stream,
            predictions: self.predictions.clone(),
            signals: self.signals.as_ref().map(WrittenSignals::from),
            left_out: self.left_out.clone(),
            sources: self.sources,
            table: self.table,
            extended: self.extended.clone(),
            channels: self.channels.iter().map(ChannelInfo::of).collect(),
            columns: self.columns.clone(),
            joins: self.joins.clone(),
            pictures: self.pictures.clone(),
            classes: self.classes.clone(),
            traceability: self.traceability.clone(),
            task: tasks.collect(),
            history: self.seal.history.clone(),
        };
        toml::to_string(&written).expect("text, numbers and tables of them can be written as TOML")
    }
}
