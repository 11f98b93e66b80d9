//! Matches rows of joined tables to rows of the main table.

mod candidates;
mod interpolation;
mod matches;
mod matching;
mod timing;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::Sources;
use super::cell::cell_of;
use super::classes::holds_integers;
use super::columns::{base_of, mentioned};
use super::coordinate_frame;
use super::unit_statement::{self, Reading};
use crate::csv_table::number;
use crate::error::{ImportError, table_error};
use crate::foreign::ForeignTable;
use crate::import::map::{JoinBy, JoinMap, Lag, TimeJoin, Unmatched};
use crate::import::warning::ImportWarning;
use crate::source_folder::SourceFolder;
use candidates::{Candidates, TakenRow};
use interpolation::{Gap, Interpolation};
use matches::TableUses;
use matching::{At, about, comparable, seconds};
use taceva_dataset::internal::shown;
use timing::{TimedRow, Timing};

pub(in crate::import) use matches::JoinMatches;

/// Table of a join, or several tables if the file name of the join depends on the path.
pub(super) struct Joined<'a> {
    map: &'a JoinMap,
    tables: Vec<Candidates>,
    /// One match per row of the main table.
    matches: Vec<Match>,
    /// Times of the rows in a join by time.
    timing: Timing,
    /// Interpolations of columns for which linear interpolation would be wrong.
    interpolations: Vec<Interpolation>,
}

/// Match of a row of the main table.
#[derive(Clone, Copy)]
struct Match {
    table: usize,
    at: At,
}

impl<'a> Joined<'a> {
    /// Matches every row of the main table.
    pub(super) fn new(
        sources: &Sources<'_>,
        folder: &SourceFolder,
        map: &'a JoinMap,
    ) -> Result<Joined<'a>, ImportError> {
        let mut joined = Joined {
            map,
            tables: Vec::new(),
            matches: Vec::new(),
            timing: Timing::default(),
            interpolations: Interpolation::of_join(sources.map, &map.name),
        };
        let mut known: BTreeMap<String, usize> = BTreeMap::new();
        for row in 0..sources.main.rows() {
            let file = sources.filled(row, &map.file)?;
            let table = match known.get(&file) {
                Some(table) => *table,
                None => {
                    let path = folder.file(folder.path(), &file)?;
                    let table = ForeignTable::read_by(&path, &map.form, sources.decoders)?;
                    let labels = sources.labels(Some(&map.name));
                    let of_frames = match labels.is_empty() {
                        true => Vec::new(),
                        false => coordinate_frame::columns(&table),
                    };
                    let names = mentioned(sources.map, &sources.main);
                    let mut ahead = own_columns(&names, &map.name);
                    ahead.extend(of_frames.iter().map(String::as_str));
                    table.read_ahead(&ahead)?;
                    joined.tables.push(Candidates::new(map, table, &labels)?);
                    known.insert(file, joined.tables.len() - 1);
                    joined.tables.len() - 1
                }
            };
            let at = joined.find(sources, table, row)?;
            if at == At::Nowhere && map.unmatched == Unmatched::Refuse {
                let spans = joined.timing.spans(&map.name);
                let spans = spans.map_or_else(String::new, |spans| format!("; {spans}"));
                return Err(table_error!(
                    sources.main.place(row, ""),
                    "no row of {} matches it (join `{}`){spans}; write `unmatched = \"drop\"` to leave out and count such rows",
                    shown(&joined.tables[table].table.path().to_string_lossy()),
                    map.name
                ));
            }
            joined.matches.push(Match { table, at });
        }
        Ok(joined)
    }

    pub(super) fn name(&self) -> &str {
        &self.map.name
    }

    /// Tables that the join reads.
    pub(super) fn tables(&self) -> impl Iterator<Item = &ForeignTable> {
        self.tables.iter().map(|candidates| &candidates.table)
    }

    /// Warning for a join by time in which most rows share their time with another row.
    pub(super) fn repeated_stamps(&self) -> Option<ImportWarning> {
        /// Minimum number of rows for a warning. A few equal times do not indicate a clock with whole seconds.
        const LEAST: usize = 10;
        let rows: usize = self.tables.iter().map(|of| of.timed).sum();
        let times: usize = self.tables.iter().map(|of| of.by_time.len()).sum();
        (rows >= LEAST && 2 * times <= rows).then(|| ImportWarning::RepeatedStamps {
            join: self.map.name.clone(),
            rows: rows as u64,
            times: times as u64,
        })
    }

    pub(super) fn is_matched(&self, row: usize) -> bool {
        self.matches[row].at != At::Nowhere
    }

    /// Folder of the joined table that is matched with `row` of the main table.
    pub(super) fn folder(&self, row: usize) -> &Path {
        taceva_files::parent_of(self.tables[self.matches[row].table].table.path())
    }

    /// True if every joined table states that `column` contains integers.
    pub(super) fn holds_integers(&self, column: &str) -> bool {
        let mut tables = self.tables.iter();
        !self.tables.is_empty() && tables.all(|joined| holds_integers(&joined.table, column))
    }

    /// Columns of the main table that the join reads: its keys, or the column of its lag.
    pub(super) fn own_columns(&self) -> impl Iterator<Item = &str> {
        let columns = match &self.map.by {
            JoinBy::Columns(columns) => columns.as_slice(),
            JoinBy::Row | JoinBy::All | JoinBy::Time(_) | JoinBy::Until(_) => &[],
        };
        let lag = match &self.map.by {
            JoinBy::Time(TimeJoin {
                lag: Lag::Column(column),
                ..
            }) => Some(column.as_str()),
            _ => None,
        };
        columns.iter().map(|(own, _)| own.as_str()).chain(lag)
    }

    /// Cell in `column` of the joined row that is matched with `row` of the main table; empty without a match.
    pub(super) fn cell(&self, row: usize, column: &str) -> Result<String, ImportError> {
        let Match { table, at } = self.matches[row];
        let table = &self.tables[table].table;
        match at {
            At::Nowhere => {
                // A missing column is still an error.
                match (table.has(column), super::columns::indexed(column)) {
                    (false, None) => Err(table.no_column(column)),
                    _ => Ok(String::new()),
                }
            }
            At::Row(row) if column == "row" && !table.has(column) => Ok(row.to_string()),
            At::Row(row) => cell_of(table, row, column),
            At::Between(rows, share) => {
                Gap { table, rows, share }.cell(column, &self.interpolations)
            }
        }
    }

    /// Rows of joined tables that supply the cells of `row` of the main table.
    pub(super) fn rows_of(&self, row: usize) -> impl Iterator<Item = TakenRow<'_>> {
        let Match { table: at, at: of } = self.matches[row];
        let candidates = &self.tables[at];
        let (first, second) = match of {
            At::Nowhere => (None, None),
            At::Row(row) => (Some(row), None),
            At::Between([before, after], _) => (Some(before), Some(after)),
        };
        let rows = first.into_iter().chain(second);
        rows.map(move |row| TakenRow {
            candidates,
            at,
            row,
        })
    }

    /// Example of a cell of a joined table whose decimal point may be a digit separator, and the number of such cells.
    pub(super) fn grouped_digits(&self, column: &str) -> Option<(String, u64)> {
        let mut tables = self.tables.iter();
        tables.find_map(|candidates| candidates.table.grouped_digits(column))
    }

    /// Checks that `reading`, the interpretation by the map, agrees with the statements of the files about `column`.
    pub(super) fn check(&self, column: &str, reading: Reading<'_>) -> Result<(), ImportError> {
        let mut tables = self.tables.iter();
        tables.try_for_each(|candidates| unit_statement::check(&candidates.table, column, reading))
    }

    /// Adds the numbers of unwritten chunks of the arrays that the join reads to `into`.
    pub(super) fn count_absent_chunks(
        &self,
        folder: &SourceFolder,
        names: &[String],
        into: &mut BTreeMap<String, u64>,
    ) -> Result<(), ImportError> {
        let own = own_columns(names, &self.map.name);
        let mut tables = self.tables.iter();
        tables.try_for_each(|candidates| candidates.table.count_absent_chunks(folder, &own, into))
    }

    /// Warning for rows of the main table whose times are out of order.
    pub(super) fn wrong_order(&self, sources: &Sources<'_>) -> Option<ImportWarning> {
        let (first, rows) = self.timing.swapped()?;
        let mut place = sources.main.place(first, "");
        place.path = PathBuf::from(&sources.relative);
        Some(ImportWarning::TimeOrder {
            at: place.to_string(),
            rows,
        })
    }

    /// Summary of the matches with `main`.
    pub(super) fn matched(&self, main: &ForeignTable) -> JoinMatches {
        let mut used: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); self.tables.len()];
        for Match { table, at } in &self.matches {
            match at {
                At::Nowhere => {}
                At::Row(row) => drop(used[*table].insert(*row)),
                At::Between(rows, _) => used[*table].extend(rows),
            }
        }
        let matched = self.matches.iter();
        let matched = matched.filter(|found| found.at != At::Nowhere).count();
        let tables = self.tables.iter().zip(used).map(|(candidates, used)| {
            let table = &candidates.table;
            let uses = TableUses {
                candidates: candidates.rows.len(),
                skipped: table.rows() - candidates.rows.len() - candidates.in_other_frames,
                in_other_frames: candidates.in_other_frames,
                used,
            };
            (table.path().to_owned(), uses)
        });
        JoinMatches {
            name: self.map.name.clone(),
            frame_id: self.map.frame_id.clone(),
            counted_by: match &self.map.by {
                JoinBy::Row => Some("`on = \"row\"`"),
                JoinBy::Until(_) => Some("`until`"),
                JoinBy::Columns(columns) => {
                    let mut own = columns.iter();
                    own.all(|(own, _)| own == "row" && !main.has(own))
                        .then_some("`on = { row = … }`")
                }
                JoinBy::All | JoinBy::Time(_) => None,
            },
            matched: matched as u64,
            unmatched: (self.matches.len() - matched) as u64,
            timing: self.timing.clone(),
            tables: tables.collect(),
        }
    }

    /// Offset of the clock of the joined table at `row` of the main table, ms; positive if the joined clock shows a later time.
    fn lag_ms(&self, sources: &Sources<'_>, row: usize, lag: &Lag) -> Result<f64, ImportError> {
        match lag {
            Lag::Fixed(lag) => Ok(*lag),
            Lag::Files(lags) => {
                let joined = sources.filled(row, &self.map.file)?;
                let found = lags.get(&sources.relative).or_else(|| lags.get(&joined));
                found.copied().ok_or_else(|| {
                    table_error!(
                        sources.main.path(),
                        "`lag_ms` of join `{0}` names neither this table nor the joined one: add `\"{1}\" = …` or `\"{2}\" = …`, in ms",
                        self.map.name,
                        shown(&sources.relative),
                        shown(&joined)
                    )
                })
            }
            Lag::Column(column) => {
                let cell = sources.cell(row, column)?;
                let place = || sources.main.place(row, column);
                let number = number::number(&cell)
                    .map_err(|problem| table_error!(place(), "`{}`: {problem}", shown(&cell)))?;
                number.ok_or_else(|| {
                    table_error!(
                        place(),
                        "empty, expected the lag of join `{}` in ms: `lag_ms` names this column",
                        self.map.name
                    )
                })
            }
        }
    }

    fn find(&mut self, sources: &Sources<'_>, table: usize, row: usize) -> Result<At, ImportError> {
        let candidates = &self.tables[table];
        match &self.map.by {
            JoinBy::Row => Ok(match candidates.rows.binary_search(&row) {
                Ok(_) => At::Row(row),
                Err(_) => At::Nowhere,
            }),
            JoinBy::All => match candidates.rows[..] {
                [only] => Ok(At::Row(only)),
                _ => Err(table_error!(
                    candidates.table.path(),
                    "{} rows, where `on = \"all\"` of join `{}` expects one",
                    candidates.rows.len(),
                    self.map.name
                )),
            },
            JoinBy::Columns(columns) => {
                let key: Result<Vec<String>, ImportError> = columns
                    .iter()
                    .map(|(own, _)| Ok(comparable(&sources.cell(row, own)?)))
                    .collect();
                match candidates.by_key.get(&key?).map(Vec::as_slice) {
                    None => Ok(At::Nowhere),
                    Some([only]) => Ok(At::Row(*only)),
                    Some([first, second, ..]) => Err(table_error!(
                        sources.main.place(row, &columns[0].0),
                        "two rows of join `{}` match it: {} and {}",
                        self.map.name,
                        candidates.table.place(*first, ""),
                        candidates.table.place(*second, "")
                    )),
                    Some([]) => Ok(At::Nowhere),
                }
            }
            JoinBy::Until(_) => {
                let behind = candidates
                    .until
                    .partition_point(|(end, _)| *end <= row as u64);
                let found = candidates.until.get(behind);
                Ok(found.map_or(At::Nowhere, |(_, row)| At::Row(*row)))
            }
            JoinBy::Time(join) => {
                let Some(time) = &sources.map.time else {
                    return Err(table_error!(
                        sources.main.path(),
                        "join `{}` is by time, and [time] names no column of the main table",
                        self.map.name
                    ));
                };
                let cell = sources.cell_in_seconds(row, &time.column)?;
                let place = || sources.main.place(row, &time.column);
                let Some(instant) = seconds(&cell, time, place)? else {
                    return Ok(At::Nowhere);
                };
                let lag_s = self.lag_ms(sources, row, &join.lag)? / 1e3;
                let found = about(&candidates.by_time, instant + lag_s, join);
                let timed = TimedRow {
                    row,
                    time_s: instant,
                    lag_s,
                    pick: join.pick,
                    gap_s: found.map(|(_, gap_s)| gap_s),
                };
                self.timing.add(timed, candidates);
                Ok(found.map_or(At::Nowhere, |(at, _)| at))
            }
        }
    }
}

/// Columns of the join `join` among `names`, which are column names in a map.
fn own_columns<'n>(names: &'n [String], join: &str) -> Vec<&'n str> {
    let own = names.iter().filter_map(|name| {
        let (prefix, column) = name.split_once('.')?;
        (prefix == join).then(|| base_of(column))
    });
    own.collect()
}
