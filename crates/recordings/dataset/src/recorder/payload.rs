//! Payloads of the journal, in TOML, so that people can read a damaged recording.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};
use taceva_core::{
    Channel, Channels, Clock, Date, FrameInfo, GratingKind, Limit, Nanometre, Phase, PressOutcome,
    Traceability, Unit,
};

use super::RecordingSpec;
use crate::digest::Digest;
use crate::error::DatasetError;
use crate::file::check_relative;
use crate::header::RecordingFacts;
use crate::header::{Footprint, ReducedFrames, SensorFacts, Source, StreamFacts};
use crate::signals::WrittenSignals;
use crate::table::{FrameEntry, Row};
use crate::toml_file::{parse_toml, toml_error};

/// Facts and channels of a recording, as written in the first journal record.
#[derive(Serialize, Deserialize)]
pub(super) struct WrittenStart {
    source: Source,
    clock: Clock,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    recorded_on: Option<Date>,
    sensor: SensorFacts,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    footprint: Option<Footprint>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    settings: BTreeMap<String, String>,
    channels: BTreeMap<String, Unit>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    signals: Option<WrittenSignals>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    reduced: Option<ReducedFrames>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    traceability: Vec<Traceability>,
}

impl WrittenStart {
    pub(super) fn new(spec: &RecordingSpec) -> WrittenStart {
        WrittenStart {
            source: spec.facts.source,
            clock: spec.facts.clock,
            recorded_on: spec.facts.recorded_on,
            sensor: spec.facts.sensor.clone(),
            footprint: spec.facts.footprint,
            settings: spec.facts.settings.clone(),
            channels: spec
                .channels
                .iter()
                .map(|channel| (channel.name().to_owned(), channel.unit()))
                .collect(),
            signals: spec.signals.as_ref().map(WrittenSignals::of),
            reduced: spec.reduced.clone(),
            traceability: spec.facts.traceability.clone(),
        }
    }

    pub(super) fn to_toml(&self) -> String {
        to_toml(self)
    }

    pub(super) fn parse(path: &Path, payload: &[u8]) -> Result<RecordingSpec, DatasetError> {
        let wrong = |problem: &str| toml_error(path, None, problem);
        let text = std::str::from_utf8(payload).map_err(|_| wrong("not UTF-8"))?;
        let written: WrittenStart = parse_toml(path, text)?;
        let channels = written
            .channels
            .iter()
            .map(|(name, unit)| Channel::named(name, *unit))
            .collect::<Result<Vec<_>, _>>()
            .and_then(Channels::new)
            .map_err(|error| wrong(&error.to_string()))?;
        let signals = written.signals.as_ref().map(WrittenSignals::spec);
        Ok(RecordingSpec {
            signals: signals.transpose().map_err(|problem| wrong(&problem))?,
            facts: RecordingFacts {
                source: written.source,
                clock: written.clock,
                recorded_on: written.recorded_on,
                recorded_until: None,
                sensor: written.sensor,
                footprint: written.footprint,
                settings: written.settings,
                traceability: written.traceability,
            },
            channels,
            reduced: written.reduced,
        })
    }
}

/// Sample read from a journal: row, frame format, and taxel values.
type Taken = (Row, Option<FrameInfo>, Option<Vec<f32>>);

/// Sample as written in the journal, without missing values.
#[derive(Serialize, Deserialize)]
pub(super) struct WrittenSample {
    sample: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    point_id: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unit_id: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    scene: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    depth_step: Option<u32>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    repeat: Option<u32>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    phase: Option<Phase>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    limited_by: Option<Limit>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    zero_u_mm: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    t_s: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    kind: Option<GratingKind>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    spacing_nm: Option<i64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    intensity: Option<f64>,
    /// Signals in double precision, whose text parses back to the same single-precision numbers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    signals: Option<Vec<f64>>,
    truth: BTreeMap<String, f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    frame: Option<WrittenFrame>,
}

/// Press with all its samples, as written in the journal.
#[derive(Serialize, Deserialize)]
pub(super) struct WrittenPress {
    pub(super) press: String,
    /// Outcome of the press; omitted for a complete press.
    #[serde(default = "complete", skip_serializing_if = "is_complete")]
    pub(super) outcome: PressOutcome,
    pub(super) samples: Vec<WrittenSample>,
}

impl WrittenPress {
    pub(super) fn to_toml(&self) -> String {
        to_toml(self)
    }

    pub(super) fn parse(payload: &[u8]) -> Result<WrittenPress, String> {
        from_toml(payload)
    }
}

/// Frames of a stream as written in the journal, and the losses of the stream until then.
#[derive(Serialize, Deserialize)]
pub(super) struct WrittenStream {
    pub(super) stream: StreamFacts,
    #[serde(default)]
    pub(super) samples: Vec<WrittenSample>,
}

impl WrittenStream {
    pub(super) fn new(stream: StreamFacts, samples: Vec<WrittenSample>) -> WrittenStream {
        WrittenStream { stream, samples }
    }

    pub(super) fn to_toml(&self) -> String {
        to_toml(self)
    }

    pub(super) fn parse(payload: &[u8]) -> Result<WrittenStream, String> {
        from_toml(payload)
    }
}

/// Location, digest and format of a frame, as written in the journal.
#[derive(Serialize, Deserialize)]
pub(super) struct WrittenFrame {
    pub(super) path: String,
    pub(super) sha256: Digest,
    #[serde(flatten)]
    pub(super) info: FrameInfo,
}

impl WrittenFrame {
    pub(super) fn to_toml(&self) -> String {
        to_toml(self)
    }

    pub(super) fn parse(payload: &[u8]) -> Result<WrittenFrame, String> {
        let written: WrittenFrame = from_toml(payload)?;
        check_relative(&written.path)?;
        Ok(written)
    }
}

impl WrittenSample {
    /// Written form of a row, with its frame format and taxel values if any.
    pub(super) fn new(
        row: &Row,
        channels: &Channels,
        info: Option<FrameInfo>,
        signals: Option<&[f32]>,
    ) -> WrittenSample {
        let truth = channels.iter().zip(&row.truth);
        WrittenSample {
            sample: row.sample.clone(),
            point_id: row.point_id.clone(),
            unit_id: row.unit_id.clone(),
            scene: row.scene.clone(),
            depth_step: row.depth_step,
            repeat: row.repeat,
            phase: row.phase,
            limited_by: row.limited_by,
            zero_u_mm: row.zero_u_mm,
            t_s: row.t_s,
            kind: row.kind,
            spacing_nm: row.spacing.map(|spacing| spacing.0),
            intensity: row.intensity,
            signals: signals.map(|values| values.iter().copied().map(f64::from).collect()),
            truth: truth
                .filter_map(|(channel, value)| Some((channel.name().to_owned(), (*value)?)))
                .collect(),
            frame: row
                .frame
                .as_ref()
                .zip(info)
                .map(|(entry, info)| WrittenFrame {
                    path: entry.place().into_owned(),
                    sha256: entry.digest,
                    info,
                }),
        }
    }

    pub(super) fn to_toml(&self) -> String {
        to_toml(self)
    }

    pub(super) fn parse(payload: &[u8]) -> Result<WrittenSample, String> {
        from_toml(payload)
    }

    /// Converts to the row, the frame format and the taxel values. The caller checks the number of values against the taxels of the recording.
    pub(super) fn into_row(self, channels: &Channels) -> Result<Taken, String> {
        let stranger = self
            .truth
            .keys()
            .find(|name| channels.position(name).is_none());
        if let Some(name) = stranger {
            return Err(format!(
                "`{name}` is not a channel of this recording: correct the name"
            ));
        }
        if self
            .truth
            .values()
            .chain(&self.t_s)
            .chain(&self.intensity)
            .chain(&self.zero_u_mm)
            .any(|number| !taceva_core::is_scorable(*number))
        {
            return Err("a number is infinite, NaN or too large to be scored".to_owned());
        }
        if let Some(frame) = &self.frame {
            check_relative(&frame.path)?;
        }
        let info = self.frame.as_ref().map(|frame| frame.info);
        let row = Row {
            sample: self.sample,
            point_id: self.point_id,
            unit_id: self.unit_id,
            scene: self.scene,
            depth_step: self.depth_step,
            repeat: self.repeat,
            phase: self.phase,
            limited_by: self.limited_by,
            zero_u_mm: self.zero_u_mm,
            source_table: None,
            source_row: None,
            source_frame: None,
            part: None,
            t_s: self.t_s,
            kind: self.kind,
            spacing: self.spacing_nm.map(Nanometre),
            intensity: self.intensity,
            truth: channels
                .iter()
                .map(|channel| self.truth.get(channel.name()).copied())
                .collect(),
            attributes: Vec::new(),
            frame: self
                .frame
                .map(|frame| FrameEntry::at(frame.path, frame.sha256)),
            views: Vec::new(),
            tasks: Vec::new(),
        };
        #[expect(
            clippy::cast_possible_truncation,
            reason = "numbers of single precision, written in double"
        )]
        let single = |values: Vec<f64>| values.into_iter().map(|value| value as f32).collect();
        Ok((row, info, self.signals.map(single)))
    }
}

fn complete() -> PressOutcome {
    PressOutcome::Complete
}

fn is_complete(outcome: &PressOutcome) -> bool {
    *outcome == PressOutcome::Complete
}

fn to_toml(value: &impl Serialize) -> String {
    toml::to_string(value).expect("text, numbers and tables of them can be written as TOML")
}

fn from_toml<T: for<'de> Deserialize<'de>>(payload: &[u8]) -> Result<T, String> {
    let text = std::str::from_utf8(payload).map_err(|_| "not UTF-8".to_owned())?;
    toml::from_str(text).map_err(|error| error.message().to_owned())
}
