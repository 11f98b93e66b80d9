//! Final step of writing a dataset. Writes the table, and the header with the digests of table, frames and signals.

use std::collections::BTreeMap;
use std::path::Path;

use taceva_core::PressOutcome;

use crate::digest::Digest;
use crate::error::DatasetError;
use crate::file::write_durable;
use crate::header::{
    Extension, FramesInfo, Header, LeftOut, LivePredictions, Mapping, RecordingFacts, SourcesInfo,
    StreamFacts, TableInfo, ViewInfo, dataset_digest,
};
use crate::samples::to_parquet;
use crate::signals::SignalsInfo;
use crate::table::Table;
use crate::version::Version;
use taceva_files::seal::{Edit, Opened};

/// Header content besides the recording facts: origin of the rows, omissions and separate files.
#[derive(Debug, Default)]
#[doc(hidden)]
pub struct Beside {
    /// Number of presses by outcome.
    pub presses: BTreeMap<PressOutcome, u64>,
    /// Frames of each view, if samples have several pictures.
    pub views: Vec<ViewInfo>,
    /// Columns that no import map names.
    pub unmentioned_columns: Vec<String>,
    /// Mappings of all imports.
    pub mapping: Mapping,
    /// Data that the import left out.
    pub left_out: LeftOut,
    /// Warnings of the imports, or of the devices.
    pub warnings: Vec<String>,
    /// Frame losses of a stream; `None` for other recordings.
    pub stream: Option<StreamFacts>,
    /// Predictions of a model, whose file is already written; `None` without a model.
    pub predictions: Option<LivePredictions>,
    /// Signals, whose file is already written; `None` without signals.
    pub signals: Option<SignalsInfo>,
    /// List of imported source files, which is already written; `None` without imports.
    pub sources: Option<SourcesInfo>,
    /// States of the recording before each addition of rows.
    pub extended: Vec<Extension>,
    /// Header edits that were accepted before rows were added.
    pub history: Vec<Edit>,
}

/// Writes the table and the header to the given files. Syncs the content of the files, but not their names.
pub fn write_table_and_header(
    samples: &Path,
    header: &Path,
    facts: &RecordingFacts,
    table: &Table,
    frames: Option<FramesInfo>,
    beside: Beside,
) -> Result<Header, DatasetError> {
    let bytes = to_parquet(table).map_err(|problem| DatasetError::damaged(samples, problem))?;
    write_durable(samples, &bytes)?;
    let table_digest = table.digest();
    let digest = dataset_digest(
        table_digest,
        frames.as_ref(),
        &beside.views,
        beside.signals.as_ref(),
        &beside.extended,
    );
    let whole = table.with_tasks_digest(digest);
    let mut written = Header {
        format: match table.tasks().is_empty() {
            true => Version::CURRENT,
            false => Version::WITH_TASKS,
        },
        source: facts.source,
        clock: facts.clock,
        recorded_on: facts.recorded_on,
        recorded_until: facts.recorded_until,
        sensor: facts.sensor.clone(),
        footprint: facts.footprint,
        settings: facts.settings.clone(),
        traceability: facts.traceability.clone(),
        channels: table.channels().clone(),
        attributes: table.attribute_names().to_vec(),
        unmentioned_columns: beside.unmentioned_columns,
        columns: beside.mapping.columns,
        joins: beside.mapping.joins,
        pictures: beside.mapping.pictures,
        classes: beside.mapping.classes,
        rotations: beside.mapping.rotations,
        tasks: table.tasks().iter().map(|own| own.task().clone()).collect(),
        left_out: beside.left_out,
        warnings: beside.warnings,
        digest,
        digest_with_tasks: (!table.tasks().is_empty()).then_some(whole),
        frames,
        views: beside.views,
        presses: beside.presses,
        stream: beside.stream,
        predictions: beside.predictions,
        signals: beside.signals,
        extended: beside.extended,
        sources: beside.sources,
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
    written.seal =
        taceva_files::seal::toml_text::check(&text).map_err(|source| DatasetError::Seal {
            path: header.to_owned(),
            source,
        })?;
    write_durable(header, text.as_bytes())?;
    written.digest = whole;
    Ok(written)
}
