//! Rows of one table, read by a map.

mod labels;
mod point;
mod rotation_matrix;
mod tasks;
mod views;
mod zero;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::map::{DroppedRow, ImportMap};
use super::resolve::{
    ClassCells, ColumnSignals, CoordinateFrames, JoinMatches, NamedBy, ResolvedTable, resolve,
};
use super::warning::ImportWarning;
use crate::error::{ImportError, table_error};
use crate::source_folder::SourceFolder;
use taceva_dataset::internal::shown;
use taceva_dataset::{Place, Row};
use taceva_video::Decoders;
use views::MappedView;
use zero::Zeros;

/// Name of the rule that leaves out rows with a number that means "not measured" among the taxels.
pub(super) const SIGNAL_PLACEHOLDERS: &str = "placeholders of [signals]";

/// Table whose columns the map has resolved.
pub(super) struct MappedTable<'a> {
    map: &'a ImportMap,
    table: ResolvedTable,
    /// Columns that the map does not mention.
    unmentioned: Vec<String>,
    pub(super) joins: Vec<JoinMatches>,
    pub(super) warnings: Vec<ImportWarning>,
    /// Unread topics of the recording, each with the reason.
    pub(super) unread_topics: Vec<String>,
    /// Coordinate frames of the labels.
    pub(super) coordinate_frames: CoordinateFrames,
    /// Number of unwritten chunks of the arrays read, by file and array.
    pub(super) absent_chunks: BTreeMap<String, u64>,
    truth: Vec<usize>,
    sample: Option<usize>,
    point_id: Vec<usize>,
    unit_id: Option<usize>,
    scene: Option<usize>,
    depth_step: Option<usize>,
    repeat: Option<usize>,
    phase: Option<usize>,
    limited_by: Option<usize>,
    zero_u_mm: Option<usize>,
    part: Option<usize>,
    kind: Option<usize>,
    spacing: Option<usize>,
    attributes: Vec<usize>,
    classes: Vec<usize>,
    /// Interpretation of the cells of each column of classes.
    class_cells: Vec<ClassCells>,
    /// Columns of each task.
    tasks: Vec<Vec<usize>>,
    time: Option<usize>,
    /// Columns with the path of the original table, the row number, and the path of the picture; `None` if the map does not name them.
    origin: [Option<usize>; 3],
    flags: Option<usize>,
    /// Pictures of the rows, for each view.
    pub(super) views: Vec<MappedView>,
    /// Taxel values of every row; `None` unless they are in columns of the table.
    signals: Option<ColumnSignals>,
    /// Folders of the joined tables that name pictures.
    pub(super) named_by: NamedBy,
    /// True if the table has a column called `row`, which replaces the row number.
    pub(super) has_row_column: bool,
    /// Zeros of forces, if the map sets any.
    pub(super) zeros: Option<Zeros>,
}

impl<'a> MappedTable<'a> {
    pub(super) fn open(
        map: &'a ImportMap,
        folder: &SourceFolder,
        path: &Path,
        decoders: &Decoders,
    ) -> Result<MappedTable<'a>, ImportError> {
        let found = resolve(map, folder, path, decoders)?;
        let has_row_column = found.main.has("row");
        let table = found.table;
        let views = map.frames.iter();
        let views = views.map(|frame| MappedView::find(map, frame, &found.main, &table, path));
        let find = |name: &String| table.position(name);
        let find_optional = |name: &Option<String>| name.as_ref().map(find).transpose();
        let ids = &map.ids;
        let has_flags = !map.drop.quality_flags.is_empty();
        let mut mapped = MappedTable {
            map,
            zeros: None,
            truth: map
                .columns
                .iter()
                .map(|column| find(&column.from))
                .collect::<Result<_, _>>()?,
            sample: find_optional(&ids.sample)?,
            point_id: ids.point_id.iter().map(find).collect::<Result<_, _>>()?,
            unit_id: find_optional(&ids.unit_id)?,
            scene: find_optional(&ids.scene)?,
            depth_step: find_optional(&ids.depth_step)?,
            repeat: find_optional(&ids.repeat)?,
            phase: find_optional(&ids.phase)?,
            limited_by: find_optional(&ids.limited_by)?,
            zero_u_mm: find_optional(&ids.zero_u_mm)?,
            part: find_optional(&ids.part)?,
            kind: find_optional(&ids.kind)?,
            spacing: find_optional(&ids.spacing_mm)?,
            attributes: map
                .attributes
                .values()
                .map(find)
                .collect::<Result<_, _>>()?,
            classes: map
                .classes
                .values()
                .map(|class| find(&class.from))
                .collect::<Result<_, _>>()?,
            tasks: map
                .tasks
                .iter()
                .map(|own| {
                    let columns = own.task.from.iter().map(find);
                    columns.collect::<Result<Vec<usize>, ImportError>>()
                })
                .collect::<Result<_, _>>()?,
            time: map
                .time
                .as_ref()
                .map(|time| find(&time.column))
                .transpose()?,
            origin: match &map.origin {
                Some(origin) => [
                    find_optional(&origin.table)?,
                    find_optional(&origin.row)?,
                    find_optional(&origin.frame)?,
                ],
                None => [None; 3],
            },
            flags: has_flags.then(|| find(&map.drop.flag_column)).transpose()?,
            views: views.collect::<Result<_, _>>()?,
            signals: found.signals,
            unmentioned: found.unmentioned,
            joins: found.joins,
            warnings: found.warnings,
            coordinate_frames: found.coordinate_frames,
            unread_topics: found.unread_topics,
            absent_chunks: found.absent_chunks,
            class_cells: found.class_cells,
            named_by: found.named_by,
            has_row_column,
            table,
        };
        if let Some(zero) = &map.zero {
            mapped.find_zeros(zero)?;
        }
        Ok(mapped)
    }

    /// Columns of the table that the map does not mention.
    pub(super) fn unmentioned(&self) -> Vec<String> {
        self.unmentioned.clone()
    }

    /// Taxel values of a row, NaN for missing values. `None` unless they are in columns of the table.
    pub(super) fn signals(&self, row: usize) -> Option<&[f32]> {
        let length = self.map.signals.as_ref()?.spec.info.len();
        let first = row.checked_mul(length)?;
        self.signals
            .as_ref()?
            .numbers
            .get(first..first.checked_add(length)?)
    }

    /// Place of a row, for messages.
    pub(super) fn place(&self, row: usize) -> Place {
        self.table.place(row, usize::MAX)
    }

    pub(super) fn rows(&self) -> usize {
        self.table.rows()
    }

    /// Path of the table relative to the lab's folder.
    pub(super) fn source(&self) -> &str {
        self.table.source()
    }

    /// Folder of the table.
    pub(super) fn folder(&self) -> PathBuf {
        taceva_files::parent_of(self.table.path()).to_owned()
    }

    /// Reasons to leave the row out: a join without a match, another coordinate frame, or rules of `[drop]`.
    pub(super) fn drop_reasons(&self, row: usize) -> Vec<String> {
        if let Some(join) = self.table.unmatched(row) {
            return vec![join.to_owned()];
        }
        if let Some(reason) = self.coordinate_frames.left_out.get(&row) {
            return vec![reason.clone()];
        }
        let rules = &self.map.drop;
        let cell = self.flags.map_or("", |column| self.table.cell(row, column));
        let mut reasons: Vec<String> = rules
            .quality_flags
            .iter()
            .filter(|flag| {
                cell.split([';', ' ', '\t'])
                    .any(|found| found == flag.as_str())
            })
            .cloned()
            .collect();
        reasons.extend(self.names_left_out(row));
        reasons.extend(self.names_within_left_out(row));
        let by_number = rules.rows.iter();
        let by_number = by_number.filter(|dropped| dropped.is_at(row, self.table.source()));
        reasons.extend(by_number.map(DroppedRow::rule));
        let is_placeholder = |rule: &super::map::Placeholder| {
            let position = self.map.channels.position(&rule.channel);
            let number = position.map(|position| self.table.number(row, self.truth[position]));
            matches!(number, Some(Ok(Some(number))) if number.partial_cmp(&rule.number).is_some_and(std::cmp::Ordering::is_eq))
        };
        if !rules.placeholders.is_empty() && rules.placeholders.iter().all(is_placeholder) {
            reasons.push("placeholders".to_owned());
        }
        let signals = self.signals.as_ref();
        if signals.is_some_and(|signals| signals.are_placeholders.get(row) == Some(&true)) {
            reasons.push(SIGNAL_PLACEHOLDERS.to_owned());
        }
        reasons
    }

    /// Labels of a row. `number` is the index of the row over all tables.
    pub(super) fn row(&self, row: usize, number: u64) -> Result<Row, ImportError> {
        let text = |column: Option<usize>| {
            column
                .map(|column| self.table.cell(row, column))
                .filter(|cell| !cell.is_empty())
                .map(str::to_owned)
        };
        let sample = match self.sample {
            None => number.to_string(),
            Some(column) => text(Some(column))
                .ok_or_else(|| self.wrong(row, column, "empty, expected the name of the sample"))?,
        };
        let [table, of_table, frame] = self.origin;
        let (source_table, source_row) = match &self.map.origin {
            Some(_) => (text(table), self.count(row, of_table)?),
            None => (
                Some(self.table.source().to_owned()),
                u32::try_from(row).ok(),
            ),
        };
        let mut read = Row::new(sample);
        read.point_id = self.point_id(row);
        read.unit_id = text(self.unit_id);
        read.scene = text(self.scene);
        read.depth_step = self.count(row, self.depth_step)?;
        read.repeat = self.count(row, self.repeat)?;
        read.phase = self.phase(row)?;
        read.limited_by = self.limited_by(row)?;
        read.zero_u_mm = self.zero_u_mm(row)?;
        read.source_table = source_table;
        read.source_row = source_row;
        read.source_frame = text(frame);
        read.part = text(self.part);
        read.t_s = self.time(row)?;
        read.kind = self.kind(row)?;
        read.spacing = self.spacing(row)?;
        read.truth = self.truth(row)?;
        read.attributes = self.texts(row)?;
        read.tasks = self.labels_of_tasks(row, &read)?;
        Ok(read)
    }

    /// Error for a sample name that another row also has.
    pub(super) fn duplicate(&self, row: usize, name: &str) -> ImportError {
        let column = self.sample.unwrap_or(usize::MAX);
        table_error!(
            self.table.place(row, column),
            "`{}` is the name of an earlier row",
            shown(name)
        )
    }

    /// Count in a cell; also accepts `3.0`, as spreadsheets write it.
    fn count(&self, row: usize, column: Option<usize>) -> Result<Option<u32>, ImportError> {
        let Some(column) = column else {
            return Ok(None);
        };
        let cell = self.table.cell(row, column);
        if cell.is_empty() {
            return Ok(None);
        }
        let digits = cell.strip_suffix(".0").unwrap_or(cell);
        digits
            .parse()
            .map(Some)
            .map_err(|_| self.wrong(row, column, "expected a whole number from 0"))
    }

    fn wrong(&self, row: usize, column: usize, expected: &str) -> ImportError {
        let cell = self.table.cell(row, column);
        ImportError::table(
            self.table.place(row, column),
            if cell.is_empty() {
                expected.to_owned()
            } else {
                format!("`{}`: {expected}", shown(cell))
            },
        )
    }
}
