//! Candidate rows of a joined table, indexed by their join key.

use std::collections::HashMap;

use super::matching::{comparable, seconds};
use crate::csv_table::number;
use crate::error::{ImportError, table_error};
use crate::foreign::ForeignTable;
use crate::import::map::{JoinBy, JoinMap};
use crate::import::resolve::cell::cell_of;
use crate::import::resolve::coordinate_frame;
use crate::import::resolve::times::TextTimes;
use crate::import::resolve::unit_statement::{self, Of, Reading};
use taceva_dataset::internal::shown;

/// Minimum number of time steps from which a usual step is computed.
const LEAST_STEPS: usize = 10;

/// Joined table with its candidate rows.
pub(super) struct Candidates {
    pub(super) table: ForeignTable,
    pub(super) rows: Vec<usize>,
    /// Number of rows excluded because of another coordinate frame.
    pub(super) in_other_frames: usize,
    /// For a join by columns: rows by key.
    pub(super) by_key: HashMap<Vec<String>, Vec<usize>>,
    /// For a join by time: time, s, and row, in order of time.
    pub(super) by_time: Vec<(f64, usize)>,
    /// For a join by time: number of rows with a time. `by_time` contains only the first of several rows with equal times.
    pub(super) timed: usize,
    /// For a join by time: usual time step between rows, s, which is the third quartile of the steps.
    pub(super) usual_s: Option<f64>,
    /// For a join with `until`: number and row, in order of the number.
    pub(super) until: Vec<(u64, usize)>,
}

/// Row of a joined table that supplies cells of a main row.
pub(crate) struct TakenRow<'a> {
    pub(super) candidates: &'a Candidates,
    /// Index of the joined table among the tables of the join.
    pub(crate) at: usize,
    pub(crate) row: usize,
}

impl<'a> TakenRow<'a> {
    pub(crate) fn table(&self) -> &'a ForeignTable {
        &self.candidates.table
    }

    /// Time of the row, s; `None` unless the join is by time.
    pub(crate) fn time_s(&self) -> Option<f64> {
        let mut times = self.candidates.by_time.iter();
        let found = times.find(|(_, row)| *row == self.row);
        found.map(|(time_s, _)| *time_s)
    }
}

impl Candidates {
    pub(super) fn new(
        map: &JoinMap,
        table: ForeignTable,
        labels: &[&str],
    ) -> Result<Candidates, ImportError> {
        let frame = map.frame_id.as_deref();
        let in_frame = frame.map(|frame| coordinate_frame::rows_in(&table, labels, frame));
        let in_frame = in_frame.transpose()?;
        let mut in_other_frames = 0;
        let mut rows = Vec::new();
        for row in 0..table.rows() {
            if in_frame.as_ref().is_some_and(|rows| !rows.contains(&row)) {
                in_other_frames += 1;
                continue;
            }
            let mut is_skipped = false;
            for (column, number) in &map.skip {
                let cell = cell_of(&table, row, column)?;
                is_skipped |= number::number(&cell).ok().flatten() == Some(*number);
            }
            if !is_skipped {
                rows.push(row);
            }
        }
        let mut candidates = Candidates {
            table,
            rows,
            in_other_frames,
            by_key: HashMap::new(),
            by_time: Vec::new(),
            timed: 0,
            usual_s: None,
            until: Vec::new(),
        };
        let Candidates {
            table,
            rows,
            by_key,
            by_time,
            timed,
            usual_s,
            until,
            ..
        } = &mut candidates;
        match &map.by {
            JoinBy::Row | JoinBy::All => {}
            JoinBy::Until(column) => {
                for row in rows.iter() {
                    let cell = cell_of(table, *row, column)?;
                    let end = cell.trim().parse::<u64>();
                    let end = end
                        .ok()
                        .filter(|end| until.last().is_none_or(|(last, _)| last <= end));
                    let end = end.ok_or_else(|| {
                        table_error!(
                            table.place(*row, column),
                            "`{}`: expected a whole number, at least that of the row before, because join `{}` has `until`",
                            shown(&cell),
                            map.name
                        )
                    })?;
                    until.push((end, *row));
                }
            }
            JoinBy::Columns(columns) => {
                for row in rows.iter() {
                    let cells = columns.iter().map(|(_, other)| cell_of(table, *row, other));
                    let key: Result<Vec<String>, ImportError> =
                        cells.map(|cell| Ok(comparable(&cell?))).collect();
                    let key = key?;
                    if !key.iter().any(String::is_empty) {
                        by_key.entry(key).or_default().push(*row);
                    }
                }
            }
            JoinBy::Time(join) => {
                let reading = Reading {
                    unit: &join.time.unit,
                    is_moved: false,
                    of: Of::Others,
                };
                unit_statement::check(table, &join.time.column, reading)?;
                let cells: Result<Vec<String>, ImportError> = rows
                    .iter()
                    .map(|row| cell_of(table, *row, &join.time.column))
                    .collect();
                let cells = cells?;
                let texts = TextTimes::of(&cells, &join.time);
                let texts = texts.map_err(|(at, problem)| {
                    ImportError::table(
                        table.place(rows.get(at).copied().unwrap_or_default(), &join.time.column),
                        problem,
                    )
                })?;
                let cells = texts.map_or(cells, |texts| texts.seconds);
                for (row, cell) in rows.iter().zip(&cells) {
                    let place = || table.place(*row, &join.time.column);
                    by_time.extend(seconds(cell, &join.time, place)?.map(|time| (time, *row)));
                }
                let back = by_time.windows(2).find(|pair| pair[1].0 < pair[0].0);
                let back = back.map(<[_]>::to_vec);
                *timed = by_time.len();
                // The first of several rows at one time is kept.
                by_time.dedup_by(|later, first| later.0.total_cmp(&first.0).is_eq());
                let steps = by_time.windows(2).map(|pair| pair[1].0 - pair[0].0);
                *usual_s = usual_step_s(steps.collect());
                if let Some([_, (_, row)]) = back.as_deref() {
                    return Err(table_error!(
                        table.place(*row, &join.time.column),
                        "the time of join `{}` decreases here, so rows cannot be matched by time: split the table where its clock was set",
                        map.name
                    ));
                }
            }
        }
        Ok(candidates)
    }
}

/// Usual step, s: the third quartile of `steps_s`; `None` for fewer than 10 steps.
fn usual_step_s(mut steps_s: Vec<f64>) -> Option<f64> {
    steps_s.sort_by(f64::total_cmp);
    let usual_s = steps_s.get(steps_s.len() * 3 / 4).copied();
    usual_s.filter(|_| steps_s.len() >= LEAST_STEPS)
}
