//! Detects rows that the dataset already has.

use std::collections::{BTreeMap, HashMap};
use std::fs::File;
use std::path::Path;

use taceva_dataset::internal::{PartsDigest, SignalsReader, layout, shown};
use taceva_dataset::{Dataset, Digest, FrameEntry, SignalsInfo, Table, ViewFrames};

use crate::error::ImportError;

/// Minimum number of different pictures that duplicate rows share with the dataset. No camera takes the same picture twice by chance.
const SAME_PICTURES: usize = 3;

/// Rejects new rows of `table` that duplicate rows of `before`: the same sample name, or equal labels, time, frame and signals.
///
/// Rows without frame, signals and time are rejected only if the dataset already has every new row. Single rows may have equal labels by chance.
pub(super) fn refuse_twice(
    before: &Dataset,
    table: &Table,
    signals: Option<&SignalsInfo>,
    folder: &Path,
) -> Result<(), ImportError> {
    let refused = |problem: String| ImportError::request(before.path(), problem);
    let old = before.table().rows();
    let known = table.samples()[..old].iter().enumerate();
    let known: HashMap<&str, usize> = known.map(|(row, name)| (name.as_str(), row)).collect();
    for (row, name) in table.samples().iter().enumerate().skip(old) {
        if let Some(own) = known.get(name.as_str()) {
            return Err(refused(format!(
                "sample `{}`, {}, is already row {own} of the dataset; leave out rows that were added before, and give other rows new \
                 names (`[ids] sample`)",
                shown(name),
                origin(table, row, old)
            )));
        }
    }
    let reader = signals.map(|info| open(folder, info, table.rows()));
    let reader = reader.transpose()?;
    let labels = table.row_digests();
    let content = |row: usize| -> Result<Digest, ImportError> {
        let mut digest = PartsDigest::default();
        digest.fixed(labels[row].as_bytes());
        if let Some(reader) = &reader {
            for value in reader.row(row)?.values() {
                digest.fixed(&value.to_le_bytes());
            }
        }
        Ok(digest.finish())
    };
    let mut own = BTreeMap::new();
    for row in 0..old {
        own.entry(content(row)?).or_insert(row);
    }
    let mut twice: Vec<(usize, usize)> = Vec::new();
    for row in old..table.rows() {
        if let Some(before) = own.get(&content(row)?) {
            twice.push((row, *before));
        }
    }
    let is_sure = |(row, _): &(usize, usize)| {
        let mut views = table.views().iter();
        let has_frame =
            table.frames()[*row].is_some() || views.any(|view| view.frames()[*row].is_some());
        reader.is_some() || has_frame || table.t_s()[*row].is_some()
    };
    let is_all = twice.len() == table.rows() - old;
    let first = match is_all {
        true => twice.first(),
        false => twice.iter().find(|pair| is_sure(pair)),
    };
    match first {
        None => {
            let views = table.views().iter().map(ViewFrames::frames);
            let mut all = [table.frames()].into_iter().chain(views);
            all.try_for_each(|frames| refuse_same_pictures(table, frames, old, refused))
        }
        Some((row, before)) => Err(refused(format!(
            "{} repeats row {before} of the dataset, sample `{}`. {} of {} rows are already in it, and no row is added twice: leave out rows that were added before",
            origin(table, *row, old),
            shown(&table.samples()[*before]),
            twice.len(),
            table.rows() - old
        ))),
    }
}

/// Rejects new rows with pictures that the dataset has under other labels or times, as in a second import of the same recording.
fn refuse_same_pictures(
    table: &Table,
    frames: &[Option<FrameEntry>],
    old: usize,
    refused: impl Fn(String) -> ImportError,
) -> Result<(), ImportError> {
    let frames = || frames.iter().enumerate();
    let known = frames().take(old);
    let known: HashMap<Digest, usize> = known
        .filter_map(|(row, frame)| Some((frame.as_ref()?.digest, row)))
        .collect();
    let mut again: BTreeMap<Digest, (usize, usize)> = BTreeMap::new();
    for (row, frame) in frames().skip(old) {
        if let Some(frame) = frame
            && let Some(before) = known.get(&frame.digest)
        {
            again.entry(frame.digest).or_insert((row, *before));
        }
    }
    let Some((row, before)) = again.values().min() else {
        return Ok(());
    };
    if again.len() < SAME_PICTURES {
        return Ok(());
    }
    Err(refused(format!(
        "{} has the picture of row {before} of the dataset, sample `{}`, with other labels or another time. {} different pictures are already in the dataset, and no recording is added twice",
        origin(table, *row, old),
        shown(&table.samples()[*before]),
        again.len()
    )))
}

/// Names a new row in a message: by the row and table of its origin, otherwise by its number among the new rows.
fn origin(table: &Table, row: usize, old: usize) -> String {
    match (&table.source_table()[row], table.source_row()[row]) {
        (Some(source), Some(number)) => format!("row {number} of {}", shown(source)),
        _ => format!("new row {}", row - old),
    }
}

fn open(folder: &Path, info: &SignalsInfo, rows: usize) -> Result<SignalsReader, ImportError> {
    let path = folder.join(layout::SIGNALS);
    let file = File::open(&path).map_err(ImportError::io("open", &path))?;
    Ok(SignalsReader::open(&path, file, info, rows as u64)?)
}
