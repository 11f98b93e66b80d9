//! Resolves the columns that a map names into one table. Sources are the main table, parts of its cells, file paths and joined tables.

mod cell;
mod classes;
mod columns;
mod coordinate_frame;
mod join;
mod matrix;
mod naming_folder;
mod positions;
mod rotation;
mod signals;
mod table;
mod times;
mod unit_statement;

use std::collections::BTreeMap;
use std::path::Path;

use taceva_core::Clock;

use super::map::{FrameNames, ImportMap, OWN_ROW};
use super::pattern_column::PatternColumn;
use super::warning::ImportWarning;
use crate::error::{ImportError, Place, table_error};
use crate::foreign::{BeforeCut, ForeignTable, TableForm};
use crate::source_folder::SourceFolder;
use cell::cell_of;
use columns::{base_of, mentioned};
use join::Joined;
use taceva_video::Decoders;
use times::TextTimes;

pub(super) use classes::ClassCells;
pub(super) use coordinate_frame::CoordinateFrames;
pub(super) use join::JoinMatches;
pub(super) use matrix::matrix_rows;
pub(super) use naming_folder::NamedBy;
pub(super) use signals::{ColumnSignals, place_first};
pub(super) use table::ResolvedTable;
pub(super) use unit_statement::{problem_of_names, problem_of_signals};

/// Table whose columns have the names that the map uses.
pub(super) struct Resolved {
    pub(super) table: ResolvedTable,
    /// Columns of the main table that the map does not mention.
    pub(super) unmentioned: Vec<String>,
    pub(super) joins: Vec<JoinMatches>,
    /// Number of unwritten chunks of the arrays read, by file and array.
    pub(super) absent_chunks: BTreeMap<String, u64>,
    /// Main table, as read from its file.
    pub(super) main: ForeignTable,
    /// Taxel values of every row, if they are in columns.
    pub(super) signals: Option<ColumnSignals>,
    /// Interpretation of the cells of each column of classes.
    pub(super) class_cells: Vec<ClassCells>,
    pub(super) warnings: Vec<ImportWarning>,
    /// Unread topics of the recording, each with the reason.
    pub(super) unread_topics: Vec<String>,
    /// Coordinate frames of the labels.
    pub(super) coordinate_frames: CoordinateFrames,
    /// Folders of the joined tables that name pictures.
    pub(super) named_by: NamedBy,
}

/// Sources of cells: the main table, the parts of its path, and the joined tables.
struct Sources<'a> {
    map: &'a ImportMap,
    main: ForeignTable,
    /// Path of the main table relative to the source folder, with `/`.
    relative: String,
    /// Captured parts of the path of each row; a single entry if all rows have the same path.
    captures: Vec<Vec<String>>,
    joined: Vec<Joined<'a>>,
    /// Time column in seconds; `None` if the table contains times as numbers.
    times: Option<Vec<String>>,
    warnings: Vec<ImportWarning>,
    /// Programs that read the times of clips.
    decoders: &'a Decoders,
}

/// Reads the table at `path` and the joined tables, and resolves the columns that `map` names.
pub(super) fn resolve(
    map: &ImportMap,
    folder: &SourceFolder,
    path: &Path,
    decoders: &Decoders,
) -> Result<Resolved, ImportError> {
    let main = ForeignTable::read_by(path, &map.form, decoders)?;
    let with_names = positions::with_names(map, &main)?;
    let map = with_names.as_ref().unwrap_or(map);
    let inside = path.strip_prefix(folder.path()).unwrap_or(path);
    let mut sources = Sources {
        map,
        main,
        // A table that is the folder itself keeps the name in its map.
        relative: match inside.as_os_str().is_empty() {
            true => ".".to_owned(),
            false => inside.to_string_lossy().replace('\\', "/"),
        },
        captures: Vec::new(),
        joined: Vec::new(),
        times: None,
        warnings: Vec::new(),
        decoders,
    };
    let names = mentioned(map, &sources.main);
    let of_signals = map.signals.iter().flat_map(|signals| signals.columns());
    let bases = names.iter().chain(of_signals).map(|name| base_of(name));
    let mut bases: Vec<&str> = bases.collect();
    let of_frames = match sources.labels(None).is_empty() {
        true => Vec::new(),
        false => coordinate_frame::columns(&sources.main),
    };
    bases.extend(of_frames.iter().map(String::as_str));
    sources.main.read_ahead(&bases)?;
    sources.capture()?;
    sources.read_times()?;
    // Joins must be known, and their times are compared later.
    sources.check_units()?;
    for join in &map.joins {
        let joined = Joined::new(&sources, folder, join)?;
        let wrong_order = joined.wrong_order(&sources);
        sources.warnings.extend(wrong_order);
        sources.joined.push(joined);
    }
    sources.check_units()?;
    // The time column may be in a joined table.
    sources.read_times()?;
    sources.warn_of_grouped_digits();
    sources.warn_of_cuts(folder);
    sources.warn_of_codes();
    let repeated = sources.joined.iter().filter_map(Joined::repeated_stamps);
    let repeated: Vec<ImportWarning> = repeated.collect();
    sources.warnings.extend(repeated);
    let coordinate_frames = sources.coordinate_frames()?;
    let class_cells = classes::of(&sources)?;
    let rows = sources.main.rows();
    let mut cells = Vec::with_capacity(names.len());
    for name in &names {
        let column: Result<Vec<String>, ImportError> = (0..rows)
            .map(|row| sources.cell_in_seconds(row, name))
            .collect();
        cells.push(column?);
    }
    let mut absent_chunks = BTreeMap::new();
    sources
        .main
        .count_absent_chunks(folder, &bases, &mut absent_chunks)?;
    for joined in &sources.joined {
        joined.count_absent_chunks(folder, &names, &mut absent_chunks)?;
    }
    let mut table = ResolvedTable::new(&sources, names, cells);
    for rotation in &map.rotations {
        rotation::apply(rotation, &mut table)?;
    }
    for map in &map.matrices {
        matrix::apply(map, folder, &mut table)?;
    }
    let in_columns = map
        .signals
        .as_ref()
        .filter(|signals| !signals.columns().is_empty());
    let signals = in_columns.map(|map| signals::numbers(&sources, map));
    Ok(Resolved {
        signals: signals.transpose()?,
        class_cells,
        coordinate_frames,
        unread_topics: match map.form {
            TableForm::Messages { .. } => sources.main.unread(),
            _ => Vec::new(),
        },
        absent_chunks,
        unmentioned: sources.unmentioned(&table),
        joins: sources
            .joined
            .iter()
            .map(|joined| joined.matched(&sources.main))
            .collect(),
        named_by: NamedBy::of(&sources),
        warnings: std::mem::take(&mut sources.warnings),
        main: sources.main,
        table,
    })
}

impl Sources<'_> {
    /// Reads the time column if its cells are texts. Numbers are read row by row.
    fn read_times(&mut self) -> Result<(), ImportError> {
        let Some(time) = &self.map.time else {
            return Ok(());
        };
        let is_joined = time.column.split_once('.').is_some_and(|(join, _)| {
            let mut joins = self.map.joins.iter();
            joins.any(|known| known.name == join) && !self.main.has(&time.column)
        });
        if self.times.is_some() || (is_joined && self.joined.len() < self.map.joins.len()) {
            return Ok(());
        }
        let cells: Result<Vec<String>, ImportError> = (0..self.main.rows())
            .map(|row| self.cell(row, &time.column))
            .collect();
        let read = TextTimes::of(&cells?, time).map_err(|(row, problem)| {
            ImportError::table(self.main.place(row, &time.column), problem)
        })?;
        if let Some(read) = read {
            let is_unix = self.map.facts.clock == Clock::Unix;
            self.warnings.extend(read.warnings(&time.column, is_unix));
            self.times = Some(read.seconds);
        }
        Ok(())
    }

    /// Warns of label columns whose decimal points may be digit separators.
    fn warn_of_grouped_digits(&mut self) {
        for column in &self.map.columns {
            let base = base_of(&column.from);
            let found = match self.joined_column(base) {
                None => self.main.grouped_digits(base),
                Some((joined, column)) => joined.grouped_digits(column),
            };
            if let Some((example, cells)) = found {
                self.warnings.push(ImportWarning::GroupedDigits {
                    column: column.from.clone(),
                    example,
                    cells,
                });
            }
        }
    }

    /// Warns of truncated recordings of which only the complete messages are read.
    fn warn_of_cuts(&mut self, folder: &SourceFolder) {
        let joined = self.joined.iter().flat_map(Joined::tables);
        for table in std::iter::once(&self.main).chain(joined) {
            if let ForeignTable::Columns(columns) = table
                && let Some(BeforeCut { messages, end }) = columns.before_cut()
            {
                let file = folder.inside(table.path(), "");
                let warning = ImportWarning::CutRecording {
                    file,
                    messages,
                    end,
                };
                self.warnings.push(warning);
            }
        }
    }

    /// Cell of the column `name`; converted to seconds if the column is the time and contains texts.
    fn cell_in_seconds(&self, row: usize, name: &str) -> Result<String, ImportError> {
        let is_time = self
            .map
            .time
            .as_ref()
            .is_some_and(|time| time.column == name);
        match &self.times {
            Some(times) if is_time => Ok(times[row].clone()),
            _ => self.cell(row, name),
        }
    }

    /// Extracts the parts that the pattern of `[path]` captures, from the path of the table or of each row.
    fn capture(&mut self) -> Result<(), ImportError> {
        let Some(pattern) = &self.map.path else {
            return Ok(());
        };
        let captured = |path: &str, place: Place| {
            let found = pattern.captures(path);
            let owned = |found: Vec<&str>| found.into_iter().map(str::to_owned).collect();
            found.map(owned).ok_or_else(|| {
                table_error!(
                    place,
                    "`{}` does not follow the pattern of [path]",
                    taceva_dataset::internal::shown(path)
                )
            })
        };
        self.captures = match &pattern.of {
            None => vec![captured(&self.relative, Place::file(self.main.path()))?],
            Some(column) => {
                let rows = 0..self.main.rows();
                // A row without a path has empty parts; [drop] may leave it out.
                let nothing = vec![String::new(); pattern.names().count()];
                let captures: Result<Vec<Vec<String>>, ImportError> = rows
                    .map(|row| match self.cell(row, column)? {
                        path if path.is_empty() => Ok(nothing.clone()),
                        path => captured(&path, self.main.place(row, column)),
                    })
                    .collect();
                captures?
            }
        };
        Ok(())
    }

    /// Cell of a row in the column that the map calls `name`.
    fn cell(&self, row: usize, name: &str) -> Result<String, ImportError> {
        if let Some(part) = name.strip_prefix("path.") {
            return self.part(row, part);
        }
        if let Some((joined, column)) = self.joined_column(name) {
            return joined.cell(row, column);
        }
        match name {
            // Takes precedence over a column called `row`.
            OWN_ROW => return Ok(row.to_string()),
            _ if self.main.has(name) => {}
            "row" => return Ok(row.to_string()),
            "file" => return Ok(self.relative.clone()),
            "key" => return Ok(self.main.key(row).unwrap_or_default().to_owned()),
            _ => {}
        }
        cell_of(&self.main, row, name)
    }

    /// Join and column that `name` refers to; `None` if the main table has a column of that name.
    fn joined_column<'n>(&self, name: &'n str) -> Option<(&Joined<'_>, &'n str)> {
        let (join, column) = name.split_once('.')?;
        let joined = self.joined.iter().find(|joined| joined.name() == join)?;
        (!self.main.has(name)).then_some((joined, column))
    }

    /// Captured part called `part` of the path of a row.
    fn part(&self, row: usize, part: &str) -> Result<String, ImportError> {
        let names = self.map.path.iter().flat_map(|pattern| pattern.names());
        let names: Vec<&str> = names.collect();
        let captures = self.captures.get(row).or(self.captures.first());
        let position = names.iter().position(|name| *name == part);
        match position.zip(captures) {
            Some((position, captures)) => Ok(captures[position].clone()),
            None => Err(table_error!(
                self.main.path(),
                "`path.{part}`: the pattern of [path] names {}",
                match names.is_empty() {
                    true => "nothing, because the map has no [path]".to_owned(),
                    false => names.join(", "),
                }
            )),
        }
    }

    /// Replaces `{path.PART}` and `{path.PART:05}` in `text` by the captured parts of the path of a row.
    fn filled(&self, row: usize, text: &str) -> Result<String, ImportError> {
        let mut filled = String::new();
        let mut rest = text;
        while let Some(start) = rest.find("{path.") {
            let Some((column, after)) = rest[start + 1..].split_once('}') else {
                break;
            };
            let column = PatternColumn::parse(column, |_| false);
            let part = column.name.strip_prefix("path.").unwrap_or(column.name);
            filled += &rest[..start];
            filled += &column.form.write(&self.part(row, part)?);
            rest = after;
        }
        Ok(filled + rest)
    }

    /// Columns of the main table that neither the map nor a join names.
    fn unmentioned(&self, table: &table::ResolvedTable) -> Vec<String> {
        let keys = self.joined.iter().flat_map(Joined::own_columns);
        let of_path = self.map.path.iter().filter_map(|path| path.of.as_deref());
        let named: Vec<&str> = table.names().iter().map(String::as_str).collect();
        let signals = self
            .map
            .signals
            .iter()
            .flat_map(|signals| signals.columns());
        let signals = signals.map(String::as_str);
        let of_frame = self.map.frames.iter();
        let of_frame = of_frame.filter_map(|frame| match &frame.names {
            FrameNames::Bytes(column) => Some(column.as_str()),
            FrameNames::Array(array) if array.file.is_none() => array.path.as_deref(),
            _ => None,
        });
        // Arrays are listed without the leading slash.
        let of_frame = of_frame.map(|name| name.trim_start_matches('/'));
        let named = named.into_iter().chain(keys).chain(of_path).chain(signals);
        let named = named.chain(of_frame);
        let named: Vec<&str> = named.collect();
        let is_named = |name: &String| {
            named
                .iter()
                .any(|known| known == name || base_of(known) == name)
        };
        let mut names = self.main.names();
        names.retain(|name| !is_named(name));
        names
    }
}
