//! Detection of columns that are probably a row key under an unknown name. Such a column is an error and is never scored.

use std::collections::HashSet;

use taceva_core::{Channel, shown};
use taceva_import::CsvTable;

use super::row_key::{is_whole, key_of};
use super::table_parts::Reader;
use super::{ScorePlan, ScoreRequest, tables};
use crate::error::EvaluateError;

/// Least number of rows for which equal sets of distinct whole numbers are unlikely to be chance.
const LEAST_ROWS: u64 = 5;

/// Passes the cells of a column to the visitor until the visitor returns `false`.
type Cells<'a> = dyn Fn(&str, &mut dyn FnMut(&str) -> bool) -> Result<(), EvaluateError> + 'a;

/// Channels other than the six without a declared unit.
pub(super) fn doubtful<'a>(
    request: &'a ScoreRequest,
    plan: &'a ScorePlan,
) -> impl Iterator<Item = &'a Channel> {
    plan.metrics.channels().iter().filter(|channel| {
        let is_six = Channel::SIX.iter().any(|six| six.name() == channel.name());
        !is_six && !tables::is_declared(request, channel.name())
    })
}

/// Rejects tables with a column that is probably a key and would be scored.
///
/// # Errors
/// [`EvaluateError::Tables`] with the column.
pub(super) fn check_tables(
    request: &ScoreRequest,
    plan: &ScorePlan,
    [truth, prediction]: [&CsvTable; 2],
) -> Result<(), EvaluateError> {
    let cells = |table: &CsvTable, name: &str, visit: &mut dyn FnMut(&str) -> bool| {
        let column = table.position(name)?;
        (0..table.rows()).all(|row| visit(table.cell(row, column)));
        Ok(())
    };
    check(
        request,
        plan,
        [&|name, visit| cells(truth, name, visit), &|name, visit| {
            cells(prediction, name, visit)
        }],
    )
}

/// As [`check_tables`], for tables that are read in parts.
///
/// # Errors
/// As [`check_tables`].
pub(super) fn check_parts(
    request: &ScoreRequest,
    plan: &ScorePlan,
    [truth, prediction]: [(&Reader<'_>, u64); 2],
) -> Result<(), EvaluateError> {
    let cells = |(reader, parts): (&Reader<'_>, u64),
                 name: &str,
                 visit: &mut dyn FnMut(&str) -> bool|
     -> Result<(), EvaluateError> {
        for part in 0..parts {
            let table = reader.read(part)?;
            let column = table.position(name)?;
            if !(0..table.rows()).all(|row| visit(table.cell(row, column))) {
                break;
            }
        }
        Ok(())
    };
    check(
        request,
        plan,
        [&|name, visit| cells(truth, name, visit), &|name, visit| {
            cells(prediction, name, visit)
        }],
    )
}

fn check(
    request: &ScoreRequest,
    plan: &ScorePlan,
    tables: [&Cells<'_>; 2],
) -> Result<(), EvaluateError> {
    for channel in doubtful(request, plan) {
        let name = channel.name();
        if let Some(first) = text_of_both(name, tables)? {
            return Err(refused(
                request,
                format!(
                    "column `{}` holds texts such as `{}`, which cannot be scored: if it identifies rows, pair them with --key {}, else \
                     remove it from the predictions",
                    shown(name),
                    shown(&first),
                    shown(name)
                ),
            ));
        }
        if counts_rows_of_both(name, tables)? {
            return Err(refused(
                request,
                format!(
                    "column `{}` holds the same unique whole numbers in both tables, so it probably identifies rows: pair them with --key \
                     {}, or score it as a channel with --units {}=1",
                    shown(name),
                    shown(name),
                    shown(name)
                ),
            ));
        }
    }
    Ok(())
}

fn refused(request: &ScoreRequest, problem: String) -> EvaluateError {
    EvaluateError::Tables {
        path: request.prediction.clone(),
        problem,
    }
}

/// First text of a column, if its first cells are not numbers in both tables.
fn text_of_both(name: &str, tables: [&Cells<'_>; 2]) -> Result<Option<String>, EvaluateError> {
    let mut found = None;
    for cells in tables {
        let mut first = None;
        cells(name, &mut |cell| {
            first = (!cell.is_empty()).then(|| cell.to_owned());
            first.is_none()
        })?;
        match first {
            // The number parser reports a decimal comma or a stray sign.
            Some(text) if text.contains(char::is_alphabetic) && text.parse::<f64>().is_err() => {
                found = Some(text);
            }
            _ => return Ok(None),
        }
    }
    Ok(found)
}

/// True if a column holds the same distinct whole numbers in both tables.
fn counts_rows_of_both(name: &str, tables: [&Cells<'_>; 2]) -> Result<bool, EvaluateError> {
    let mut sets = Vec::new();
    for cells in tables {
        let mut numbers = HashSet::new();
        let mut are_distinct = true;
        cells(name, &mut |cell| {
            let key = key_of(cell);
            let number = key.parse::<i64>().ok().filter(|_| is_whole(key));
            are_distinct = number.is_some_and(|number| numbers.insert(number));
            are_distinct
        })?;
        if !are_distinct || (numbers.len() as u64) < LEAST_ROWS {
            return Ok(false);
        }
        sets.push(numbers);
    }
    Ok(sets[0] == sets[1])
}
