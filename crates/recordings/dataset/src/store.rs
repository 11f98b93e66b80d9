//! The last step of every dataset: its table is written, and its header with the digests that table, frames and signals must have.

use std::collections::BTreeMap;
use std::path::Path;

use taceva_core::{Clock, PressOutcome};

use crate::digest::{Digest, PartsDigest};
use crate::error::DatasetError;
use crate::file::write_durable;
use crate::header::{
    Extension, Footprint, FramesInfo, Header, LeftOut, Mapping, SensorFacts, Source, StreamFacts,
    TableInfo,
};
use crate::samples::to_parquet;
use crate::signals::SignalsInfo;
use crate::table::Table;
use crate::version::Version;
use taceva_files::seal::{Edit, Opened};

/// What is known about a recording before its first sample.
///
/// ```
/// use taceva_core::Clock;
/// use taceva_dataset::{Footprint, RecordingFacts, SensorFacts, Source};
///
/// let facts = RecordingFacts::new(Source::Recorded, Clock::Monotonic, SensorFacts::new("DIGIT"))
///     .with_footprint(Footprint::rectangle(8.0, 10.0));
/// assert!(facts.footprint.is_some());
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RecordingFacts {
    /// Whether the samples are measured, simulated or made up.
    pub source: Source,
    /// The clock that stamps the samples: what `t_s` counts from.
    pub clock: Clock,
    /// Model, serial number and gel of the sensor.
    pub sensor: SensorFacts,
    /// Where the sensor senses, if it is known.
    pub footprint: Option<Footprint>,
    /// The settings of the camera that were set and read back, by name: `exposure_ms` is `15.7`; empty where nobody knows.
    pub settings: BTreeMap<String, String>,
}

impl RecordingFacts {
    /// Facts without a footprint.
    pub fn new(source: Source, clock: Clock, sensor: SensorFacts) -> RecordingFacts {
        RecordingFacts {
            source,
            clock,
            sensor,
            footprint: None,
            settings: BTreeMap::new(),
        }
    }

    /// The same with the settings of the camera that were set and read back.
    #[must_use]
    pub fn with_settings(self, settings: BTreeMap<String, String>) -> RecordingFacts {
        RecordingFacts { settings, ..self }
    }

    /// The same with the part of the gel that the sensor senses with.
    #[must_use]
    pub fn with_footprint(self, footprint: Footprint) -> RecordingFacts {
        RecordingFacts {
            footprint: Some(footprint),
            ..self
        }
    }
}

/// What a header says besides, of how the recording was made.
#[derive(Debug, Default)]
pub(crate) struct Beside {
    /// How many presses ended in which way.
    pub(crate) presses: BTreeMap<PressOutcome, u64>,
    /// Columns that no key of an import names.
    pub(crate) unmentioned_columns: Vec<String>,
    /// How each map read what it read.
    pub(crate) mapping: Mapping,
    /// What an import left out.
    pub(crate) left_out: LeftOut,
    /// What was lost of a stream.
    pub(crate) stream: Option<StreamFacts>,
    /// The file of signals, which is written already.
    pub(crate) signals: Option<SignalsInfo>,
    /// What the recording was before rows were added to it.
    pub(crate) extended: Vec<Extension>,
    /// Edits of its header that were accepted before that.
    pub(crate) history: Vec<Edit>,
}

/// Writes the table and the header to the given files, durable but for their names.
pub(crate) fn write_table_and_header(
    samples: &Path,
    header: &Path,
    facts: &RecordingFacts,
    (table, frames): (&Table, Option<FramesInfo>),
    beside: Beside,
) -> Result<Header, DatasetError> {
    let bytes = to_parquet(table).map_err(|problem| DatasetError::Damaged {
        path: samples.to_owned(),
        problem,
    })?;
    write_durable(samples, &bytes)?;
    let table_digest = table.digest();
    let has_more_codecs = frames
        .as_ref()
        .is_some_and(|frames| !frames.other_codecs.is_empty());
    let is_reduced = frames
        .as_ref()
        .is_some_and(|frames| frames.reduced.is_some());
    let mut written = Header {
        format: match table.source_row().iter().any(Option::is_some) {
            _ if is_reduced => Version::CURRENT,
            _ if !beside.mapping.is_empty() => Version::WITHOUT_REDUCTION,
            _ if !beside.extended.is_empty() => Version::WITHOUT_COLUMNS,
            _ if !beside.left_out.is_empty() || has_more_codecs => Version::WITHOUT_COLUMNS,
            _ if beside.signals.is_some() => Version::NEVER_EXTENDED,
            true => Version::WITHOUT_SIGNALS,
            false if facts.settings.is_empty() && beside.stream.is_none() => {
                Version::WITHOUT_SETTINGS
            }
            false => Version::WITHOUT_ORIGIN,
        },
        source: facts.source,
        clock: facts.clock,
        sensor: facts.sensor.clone(),
        footprint: facts.footprint,
        settings: facts.settings.clone(),
        channels: table.channels().clone(),
        attributes: table.attribute_names().to_vec(),
        unmentioned_columns: beside.unmentioned_columns,
        columns: beside.mapping.columns,
        joins: beside.mapping.joins,
        pictures: beside.mapping.pictures,
        classes: beside.mapping.classes,
        left_out: beside.left_out,
        digest: digest_with(
            dataset_digest(table_digest, frames.as_ref()),
            beside.signals.as_ref(),
            &beside.extended,
        ),
        frames,
        presses: beside.presses,
        stream: beside.stream,
        signals: beside.signals,
        extended: beside.extended,
        table: TableInfo {
            rows: table.rows() as u64,
            digest: table_digest,
            sha256: Digest::of(&bytes),
        },
        seal: Opened {
            history: beside.history,
            ..Opened::default()
        },
    };
    let text = written.to_toml();
    written.seal = taceva_files::seal::toml_text::check(&text, taceva_files::seal::Version::Sealed)
        .map_err(|source| DatasetError::Seal {
            path: header.to_owned(),
            source,
        })?;
    write_durable(header, text.as_bytes())?;
    Ok(written)
}

/// The digest of a dataset: of its table, which holds the digest of each frame in order, and of what else decides what a
/// frame looks like when decoded.
pub(crate) fn dataset_digest(table: Digest, frames: Option<&FramesInfo>) -> Digest {
    let mut digest = PartsDigest::default();
    digest.part(b"taceva.dataset/1");
    digest.fixed(table.as_bytes());
    if let Some(frames) = frames {
        digest.part(frames.channel_order.name().as_bytes());
        if let Some(reference) = &frames.reference {
            digest.fixed(reference.sha256.as_bytes());
        }
    }
    digest.finish()
}

/// The digest of a dataset with its signals, where it has any, and with what it was before rows were added, which decides its parts; `others` is
/// the digest without them, which its header states.
pub(crate) fn digest_with(
    others: Digest,
    signals: Option<&SignalsInfo>,
    extended: &[Extension],
) -> Digest {
    let with_signals = match signals {
        None => others,
        Some(signals) => {
            let mut digest = PartsDigest::default();
            digest.part(b"taceva.dataset/1 with signals");
            digest.fixed(others.as_bytes());
            digest.fixed(signals.digest.as_bytes());
            digest.finish()
        }
    };
    if extended.is_empty() {
        return with_signals;
    }
    let mut digest = PartsDigest::default();
    digest.part(b"taceva.dataset/1 extended");
    digest.fixed(with_signals.as_bytes());
    for before in extended {
        digest.part(&before.rows.to_le_bytes());
        digest.fixed(before.digest.as_bytes());
    }
    digest.finish()
}
