//! Files of the successor of a dataset: files shared with the dataset, the signals of all rows, the table and the header.

use std::collections::BTreeSet;
use std::fs::{self, File};

use taceva_core::{Progress, Traceability};
use taceva_dataset::internal::{
    Beside, SignalsWriter, layout, staging::StagedFolder, write_table_and_header,
};
use taceva_dataset::{Dataset, DatasetError, Extension, Header, SignalsInfo, SourcesInfo, Table};

use super::Addition;
use crate::error::ImportError;
use crate::import::copy::CopiedFrames;
use crate::import::plan::ImportPlan;
use crate::import::signals::PlannedSignals;

/// Shares the frames of `before` with the staged folder under the same paths, by hard links, or by copies on file systems without them. Returns the
/// folders of the frames.
pub(super) fn share_files(
    before: &Dataset,
    staged: &StagedFolder,
) -> Result<BTreeSet<String>, ImportError> {
    let frames = before.table().frames().iter().flatten();
    let views = before.table().views().iter();
    let views = views.flat_map(|view| view.frames().iter().flatten());
    let frames = frames.chain(views);
    let mut files: BTreeSet<&str> = frames.map(|entry| entry.path.as_str()).collect();
    let views = before.header().views.iter().map(|view| &view.frames);
    let infos = before.header().frames.iter().chain(views);
    files.extend(infos.filter_map(|frames| Some(frames.reference.as_ref()?.path.as_str())));
    let mut folders = BTreeSet::new();
    for relative in files {
        for (at, _) in relative.match_indices('/') {
            if folders.insert(relative[..at].to_owned()) {
                staged.ensure_folder(&relative[..at])?;
            }
        }
        let (from, to) = (before.path().join(relative), staged.path().join(relative));
        if fs::hard_link(&from, &to).is_err() {
            // On file systems without hard links.
            fs::copy(&from, &to).map_err(ImportError::io("copy", &from))?;
            let copied = File::open(&to).and_then(|file| file.sync_all());
            copied.map_err(ImportError::io("write", &to))?;
        }
    }
    Ok(folders)
}

/// Writes the signals of all rows, beginning with the rows of `before`.
pub(super) fn write_signals(
    before: &Dataset,
    new: &PlannedSignals,
    staged: &StagedFolder,
    progress: &dyn Progress,
) -> Result<SignalsInfo, ImportError> {
    let rows = before.table().rows();
    let own = before.header().signals.iter();
    let own = own.flat_map(|signals| signals.spec.rest.iter().copied());
    let added = new.spec().rest.iter();
    let added = added.map(|run| run.map(|row| row + rows as u64));
    let spec = new.spec().clone().with_rest(own.chain(added));
    let mut writer = SignalsWriter::create(&staged.path().join(layout::SIGNALS), &spec)?;
    for row in 0..rows {
        if progress.is_cancelled() {
            return Err(DatasetError::Cancelled.into());
        }
        let signals = before.signals(row)?;
        let signals = signals.ok_or_else(|| {
            DatasetError::damaged(
                &before.path().join(layout::SIGNALS),
                format!("no signals of row {row}"),
            )
        })?;
        writer.push(signals.values())?;
    }
    new.write_to(&mut writer, progress)?;
    Ok(writer.finish()?)
}

/// Files of the successor that are written before its header.
pub(super) struct Written {
    pub(super) frames: CopiedFrames,
    pub(super) signals: Option<SignalsInfo>,
    pub(super) sources: SourcesInfo,
}

pub(super) fn write_header(
    staged: &StagedFolder,
    before: &Dataset,
    table: &Table,
    written: Written,
    plan: &ImportPlan,
    added: &Addition,
) -> Result<Header, ImportError> {
    let Written {
        frames,
        signals,
        sources,
    } = written;
    let header = before.header();
    let all = header.frames.clone().map(|mut all| {
        all.count += frames.frames.map_or(0, |new| new.count);
        all
    });
    let mut views = header.views.clone();
    for new in frames.views {
        let mut known = views.iter_mut();
        if let Some(known) = known.find(|known| known.name == new.name) {
            known.frames.count += new.frames.count;
        }
    }
    let mut unmentioned = header.unmentioned_columns.clone();
    for column in plan.summary.columns_left_behind() {
        if !unmentioned.contains(&column) {
            unmentioned.push(column);
        }
    }
    let mut warnings = header.warnings.clone();
    for warning in plan.summary.warnings_in_words() {
        if !warnings.contains(&warning) {
            warnings.push(warning);
        }
    }
    let mut extended = header.extended.clone();
    extended.push(Extension::new(
        header.table.rows,
        header.digest,
        added.date.clone(),
        added.from.clone(),
    ));
    let mut facts = header.recording_facts();
    facts.traceability = Traceability::joined(&header.traceability, &plan.facts.traceability);
    Ok(write_table_and_header(
        &staged.path().join(layout::SAMPLES),
        &staged.path().join(layout::HEADER),
        &facts,
        table,
        all,
        Beside {
            unmentioned_columns: unmentioned,
            views,
            signals,
            extended,
            mapping: header.mapping().and(&plan.mapping),
            left_out: header.left_out.clone().and(plan.summary.left_out()),
            warnings,
            sources: Some(sources),
            history: header.seal.history.clone(),
            ..Beside::default()
        },
    )?)
}
