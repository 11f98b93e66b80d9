//! Detection of columns that are probably a row key under an unknown name. Such a column is an error and is never scored.

use std::collections::HashSet;

use taceva_core::{Channel, shown};

use super::row_key::{is_whole, key_of};
use super::whole_columns::WholeColumns;
use super::{ScorePlan, ScoreRequest, tables};
use crate::error::EvaluateError;

/// Minimum number of rows for which equal sets of distinct whole numbers are unlikely to be accidental.
const LEAST_ROWS: u64 = 5;

/// Channels without a declared unit, except the six standard channels.
pub(super) fn doubtful<'a>(
    request: &'a ScoreRequest,
    plan: &'a ScorePlan,
) -> impl Iterator<Item = &'a Channel> {
    plan.metrics.channels().iter().filter(|channel| {
        let is_six = Channel::SIX.iter().any(|six| six.name() == channel.name());
        !is_six && !tables::is_declared(request, channel.name())
    })
}

/// Rejects tables with a column that is probably a key and would be scored as a channel.
///
/// # Errors
/// [`EvaluateError::Tables`] with the name of the column.
pub(super) fn check(
    request: &ScoreRequest,
    plan: &ScorePlan,
    tables: [&dyn WholeColumns; 2],
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

/// First filled cell of the column `name`, if it is a text and not a number in both tables.
fn text_of_both(
    name: &str,
    tables: [&dyn WholeColumns; 2],
) -> Result<Option<String>, EvaluateError> {
    let mut found = None;
    for table in tables {
        let mut first = None;
        table.visit(name, &mut |cell| {
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

/// True if a column contains the same distinct whole numbers in both tables.
fn counts_rows_of_both(name: &str, tables: [&dyn WholeColumns; 2]) -> Result<bool, EvaluateError> {
    let mut sets = Vec::new();
    for table in tables {
        let mut numbers = HashSet::new();
        let mut are_distinct = true;
        table.visit(name, &mut |cell| {
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
