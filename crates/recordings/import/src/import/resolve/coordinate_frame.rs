//! Coordinate frames of wrenches and poses. Each column must have the same frame in all rows.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use taceva_core::Unit;

use super::Sources;
use super::cell::cell_of;
use super::columns::base_of;
use crate::csv_table::number;
use crate::error::{ImportError, Place, table_error};
use crate::foreign::ForeignTable;
use crate::import::map::{FrameNames, ImportMap};
use taceva_dataset::internal::shown;

/// Endings of columns that name a coordinate frame: `header.frame_id`, `/header/frame_id`, `wrench_reference_frame`.
const ENDINGS: [&str; 6] = [
    "frame_id",
    "child_frame",
    "coordinate_frame",
    "parent_frame",
    "reference_frame",
    "_frame",
];
/// Quantities whose frame column applies to columns with another prefix: `wrench_frame` beside `Fx`.
const QUANTITIES: [&str; 6] = ["force", "ft", "pose", "position", "torque", "wrench"];
/// Minimum number of rows of a column of picture names, whose texts all differ. A shorter column may name coordinate frames.
const NAMES_OF_PICTURES: usize = 8;
/// Maximum number of coordinate frames that a message lists.
const LISTED: usize = 8;

/// Coordinate frames of a main table and its joined tables.
#[derive(Default)]
pub(in crate::import) struct CoordinateFrames {
    stated: BTreeMap<FrameColumn, StatedFrame>,
    /// Rows of the main table that are left out because their coordinate frame differs from the map, each with the reason.
    pub(in crate::import) left_out: BTreeMap<usize, String>,
}

/// Coordinate frame, with the first row that has it.
struct StatedFrame {
    name: String,
    place: Place,
    /// Time of the row, s, if known.
    time_s: Option<f64>,
}

/// Column of the main or a joined table that names coordinate frames.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct FrameColumn {
    join: Option<String>,
    name: String,
}

impl CoordinateFrames {
    /// Adds the coordinate frames of a further main table. Rejects frames that differ from those of the previous tables.
    pub(in crate::import) fn add(&mut self, other: CoordinateFrames) -> Result<(), ImportError> {
        for (column, stated) in other.stated {
            let name = stated.name.clone();
            self.take(column, &name, || stated)?;
        }
        Ok(())
    }

    /// Records the coordinate frame `name` of a row. Rejects a frame that differs from the previous rows.
    fn take(
        &mut self,
        column: FrameColumn,
        name: &str,
        stated: impl FnOnce() -> StatedFrame,
    ) -> Result<(), ImportError> {
        match self.stated.get(&column) {
            Some(known) if known.name != name => Err(changed(&column, known, &stated())),
            Some(_) => Ok(()),
            None => {
                self.stated.insert(column, stated());
                Ok(())
            }
        }
    }
}

fn changed(column: &FrameColumn, known: &StatedFrame, found: &StatedFrame) -> ImportError {
    let at = found.time_s.map(|time_s| format!(", at {time_s} s"));
    let (first, second) = (shown(&known.name), shown(&found.name));
    let (name, whose) = match &column.join {
        Some(join) => {
            let join = shown(join);
            (
                format!("{join}.{}", column.name),
                format!("in the [[join]] `{join}`"),
            )
        }
        None => (column.name.clone(), "below `table` of the map".to_owned()),
    };
    table_error!(
        found.place.clone(),
        "`{}` has 2 frames: `{second}` here{}, `{first}` before ({}). A channel needs one frame: write `frame_id = {first:?}` {whose} \
             to read only the rows of that frame and count the others",
        shown(&name),
        at.unwrap_or_default(),
        known.place
    )
}

/// Names of the columns of `table` that may name coordinate frames.
pub(super) fn columns(table: &ForeignTable) -> Vec<String> {
    let mut names = table.columns();
    names.extend(table.names());
    names.retain(|name| without_ending(name).is_some());
    names.sort_unstable();
    names.dedup();
    names
}

/// Name of a column of coordinate frames without its ending; `None` for another column.
fn without_ending(column: &str) -> Option<&str> {
    let lower = column.to_ascii_lowercase();
    let ending = ENDINGS.into_iter().find(|ending| lower.ends_with(ending))?;
    Some(&column[..column.len() - ending.len()])
}

/// Beginning of the names of the columns whose frame `column` states: empty, or `wrench.`.
fn prefix(column: &str) -> &str {
    let mut prefix = without_ending(column).unwrap_or(column);
    for part in ["child_", "header.", "header/", "header_"] {
        let split = prefix.len().checked_sub(part.len());
        let split = split.filter(|split| prefix.is_char_boundary(*split));
        if let Some((before, found)) = split.map(|split| prefix.split_at(split))
            && found.eq_ignore_ascii_case(part)
        {
            prefix = before;
        }
    }
    prefix
}

/// True if the last word before `_frame` is a quantity with a coordinate frame.
fn is_quantity(prefix: &str) -> bool {
    let word = prefix.rsplit(['.', '/', '_']).next().unwrap_or(prefix);
    QUANTITIES
        .iter()
        .any(|known| word.eq_ignore_ascii_case(known))
}

/// Name of a coordinate frame without a leading slash: ROS 1 writes `/tool0` for `tool0`.
fn comparable(cell: &str) -> &str {
    let cell = cell.trim();
    cell.strip_prefix('/').unwrap_or(cell)
}

/// Names of the columns that contain labels in space: in the table of `join`, or in the main table if `join` is `None`.
fn labels<'m>(map: &'m ImportMap, main: &ForeignTable, join: Option<&str>) -> Vec<&'m str> {
    let in_space = [
        Unit::Newton,
        Unit::NewtonMillimetre,
        Unit::Millimetre,
        Unit::Degree,
    ];
    let columns = map.channels.iter().zip(&map.columns);
    let columns = columns.filter(|(channel, _)| in_space.contains(&channel.unit()));
    let columns = columns.map(|(_, column)| column.from.as_str());
    let given = |name: &&str| {
        let mut matrices = map.matrices.iter();
        !matrices.any(|matrix| (0..matrix.gives.len()).any(|at| matrix.column(at) == **name))
    };
    let of_matrices = map.matrices.iter().flat_map(|matrix| matrix.from.iter());
    let names = columns.filter(given).chain(of_matrices.map(String::as_str));
    let own = names.filter_map(|name| {
        let split = name.split_once('.').filter(|(prefix, _)| {
            let mut joins = map.joins.iter();
            !main.has(name) && joins.any(|known| known.name == *prefix)
        });
        match (join, split) {
            (None, None) if !name.starts_with("path.") => Some(name),
            (Some(join), Some((prefix, column))) if prefix == join => Some(column),
            _ => None,
        }
    });
    own.collect()
}

/// True if the map reads `column` as names of pictures or samples.
fn is_name(map: &ImportMap, column: &str) -> bool {
    let of_frames = map.frames.iter();
    let of_frames = of_frames.filter_map(|frame| match &frame.names {
        FrameNames::Column(name) => Some(name),
        FrameNames::Array(array) => Some(&array.index),
        FrameNames::Video(video) => Some(&video.index),
        _ => None,
    });
    let mut known = of_frames.chain(&map.ids.sample);
    known.any(|known| known == column)
}

/// Columns of `table` that name the coordinate frames of `labels`. Columns of numbers or picture names are excluded.
fn naming(table: &ForeignTable, labels: &[&str]) -> Result<Vec<String>, ImportError> {
    let mut found = Vec::new();
    if labels.is_empty() {
        return Ok(found);
    }
    for column in columns(table) {
        let prefix = prefix(&column);
        let is_beside = labels
            .iter()
            .any(|label| base_of(label).starts_with(prefix));
        if !is_beside && !is_quantity(prefix) {
            continue;
        }
        let mut names = BTreeSet::new();
        let mut rows = 0_usize;
        let mut has_number = false;
        for row in 0..table.rows() {
            let cell = cell_of(table, row, &column)?;
            if cell.trim().is_empty() {
                continue;
            }
            rows += 1;
            has_number |= matches!(number::number(&cell), Ok(Some(_)));
            names.insert(comparable(&cell).to_owned());
        }
        let is_frame = !has_number && (rows < NAMES_OF_PICTURES || names.len() < rows);
        if is_frame && !names.is_empty() {
            found.push(column);
        }
    }
    Ok(found)
}

/// Rows of `table` in the coordinate frame `frame`. Fails if no column names frames, or if no row has that frame.
pub(super) fn rows_in(
    table: &ForeignTable,
    labels: &[&str],
    frame: &str,
) -> Result<BTreeSet<usize>, ImportError> {
    let columns = naming(table, labels)?;
    let refuse = |problem: String| {
        Err(table_error!(
            table.path(),
            "`frame_id = {frame:?}`: {problem}"
        ))
    };
    if columns.is_empty() {
        return refuse(
            "no column holds names of coordinate frames, expected a column such as `frame_id` or `header.frame_id`; remove `frame_id` from the map if the table has one frame"
                .to_owned(),
        );
    }
    let mut rows = BTreeSet::new();
    let mut names = BTreeSet::new();
    for row in 0..table.rows() {
        for column in &columns {
            let cell = cell_of(table, row, column)?;
            if comparable(&cell) == comparable(frame) {
                rows.insert(row);
            } else if names.len() < LISTED {
                names.insert(format!("`{}`", shown(comparable(&cell))));
            }
        }
    }
    match rows.is_empty() {
        false => Ok(rows),
        true => {
            let names: Vec<String> = names.into_iter().collect();
            refuse(format!("its frames are {}", names.join(", ")))
        }
    }
}

impl Sources<'_> {
    /// Names of the columns whose labels depend on a coordinate frame: in the table of `join`, or in the main table if `join` is `None`.
    pub(super) fn labels(&self, join: Option<&str>) -> Vec<&str> {
        labels(self.map, &self.main, join)
    }

    /// Coordinate frame of every label column. All rows in which the label is a number must have the same frame.
    pub(super) fn coordinate_frames(&self) -> Result<CoordinateFrames, ImportError> {
        let mut frames = CoordinateFrames::default();
        let labels = self.labels(None);
        if let Some(frame) = self.map.frame_id.as_deref() {
            let rows = rows_in(&self.main, &labels, frame)?;
            let others = (0..self.main.rows()).filter(|row| !rows.contains(row));
            let reason = format!("frame_id other than {}", shown(frame));
            frames.left_out = others.map(|row| (row, reason.clone())).collect();
        }
        let is_kept = |row: usize, frames: &CoordinateFrames| {
            let mut joined = self.joined.iter();
            joined.all(|joined| joined.is_matched(row)) && !frames.left_out.contains_key(&row)
        };
        for column in naming(&self.main, &labels)? {
            if is_name(self.map, &column) {
                continue;
            }
            for row in 0..self.main.rows() {
                if !is_kept(row, &frames) {
                    continue;
                }
                let given = Given {
                    table: &self.main,
                    join: None,
                    row,
                    column: &column,
                };
                given.take(&mut frames, &labels, || self.time_s(row))?;
            }
        }
        for joined in &self.joined {
            let labels = self.labels(Some(joined.name()));
            let mut columns: BTreeMap<usize, Vec<String>> = BTreeMap::new();
            for row in 0..self.main.rows() {
                if !is_kept(row, &frames) {
                    continue;
                }
                for taken in joined.rows_of(row) {
                    let columns = match columns.entry(taken.at) {
                        Entry::Occupied(known) => known.into_mut(),
                        Entry::Vacant(empty) => empty.insert(naming(taken.table(), &labels)?),
                    };
                    for column in columns.iter() {
                        let given = Given {
                            table: taken.table(),
                            join: Some(joined.name()),
                            row: taken.row,
                            column,
                        };
                        given.take(&mut frames, &labels, || taken.time_s())?;
                    }
                }
            }
        }
        Ok(frames)
    }

    /// Time of a row of the main table, s.
    fn time_s(&self, row: usize) -> Option<f64> {
        let time = self.map.time.as_ref()?;
        let cell = self.cell_in_seconds(row, &time.column).ok()?;
        match &self.times {
            Some(_) => cell.trim().parse().ok(),
            None => number::number_in_unit(&cell, &time.unit).ok()?,
        }
    }
}

/// Row and column of a table whose cell names the coordinate frame of labels.
struct Given<'a> {
    table: &'a ForeignTable,
    join: Option<&'a str>,
    row: usize,
    column: &'a str,
}

impl Given<'_> {
    /// Records the coordinate frame of the row, if a label in this frame has a value in the row.
    fn take(
        &self,
        frames: &mut CoordinateFrames,
        labels: &[&str],
        time_s: impl FnOnce() -> Option<f64>,
    ) -> Result<(), ImportError> {
        let prefix = prefix(self.column);
        let is_there = |label: &&&str| {
            let is_column = self.table.has(label) || self.table.has(base_of(label));
            is_column && (label.starts_with(prefix) || is_quantity(prefix))
        };
        let mut has_number = false;
        for label in labels.iter().filter(is_there) {
            has_number |= !cell_of(self.table, self.row, label)?.trim().is_empty();
        }
        if !has_number {
            return Ok(());
        }
        let cell = cell_of(self.table, self.row, self.column)?;
        let column = FrameColumn {
            join: self.join.map(str::to_owned),
            name: self.column.to_owned(),
        };
        let name = comparable(&cell);
        frames.take(column, name, || StatedFrame {
            name: name.to_owned(),
            place: self.table.place(self.row, self.column),
            time_s: time_s(),
        })
    }
}

#[cfg(test)]
mod tests;
