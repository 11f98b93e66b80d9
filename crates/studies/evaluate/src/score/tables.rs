//! The two tables of a score: read, brought to common channels, and paired row by row.

use std::collections::{BTreeMap, HashMap};
use std::num::NonZeroUsize;
use std::path::Path;
use taceva_core::shown;

use taceva_core::{Channel, Channels, Unit};
use taceva_dataset::Digest;
use taceva_import::CsvTable;

use super::fields::NOT_CHANNELS;
use super::table_parts::TableParts;
use super::{ScoreRequest, parquet_parts};
use crate::error::EvaluateError;

/// How rows find each other.
#[derive(Debug)]
pub(super) enum Pairing {
    /// The first with the first.
    ByOrder,
    /// For each row of the truth, its row of the prediction.
    ById(Vec<usize>),
}

/// Both tables with their digests, read at the same time where two threads are allowed.
///
/// The two take about as long as each other, so this shares work better than threads within each of them.
pub(super) fn read_both(request: &ScoreRequest) -> Result<[(CsvTable, Digest); 2], EvaluateError> {
    let share = NonZeroUsize::new(request.jobs.get() / 2).unwrap_or(NonZeroUsize::MIN);
    let read = |path: &Path| -> Result<(CsvTable, Digest), EvaluateError> {
        if parquet_parts::is_parquet(path) {
            let parts = TableParts::scan(path)?;
            return Ok((parts.reader()?.whole(parts.rows())?, parts.digest()));
        }
        let table = CsvTable::read_with(path, share)?;
        let digest = table.digest();
        Ok((table, digest))
    };
    if request.jobs == NonZeroUsize::MIN {
        return Ok([read(&request.truth)?, read(&request.prediction)?]);
    }
    std::thread::scope(|scope| {
        let truth = scope.spawn(|| read(&request.truth));
        let prediction = read(&request.prediction);
        let truth = truth
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        Ok([truth?, prediction?])
    })
}

/// Refuses one file as truth and as prediction: every error would be 0, and say nothing.
///
/// # Errors
/// [`EvaluateError::Request`].
pub(super) fn check_distinct(request: &ScoreRequest) -> Result<(), EvaluateError> {
    let [truth, prediction] =
        [&request.truth, &request.prediction].map(|path| path.canonicalize().ok());
    if truth.is_none() || truth != prediction {
        return Ok(());
    }
    Err(EvaluateError::Request(format!(
        "{} and {} are one file: nothing is predicted; name a table of what is true and another of what was predicted",
        shown(&request.truth),
        shown(&request.prediction)
    )))
}

/// Refuses a table without a row.
///
/// # Errors
/// [`EvaluateError::Tables`].
pub(super) fn check_rows(table: &CsvTable) -> Result<(), EvaluateError> {
    check_some(table.path(), table.rows() as u64)
}

/// The same of a table that is read in parts.
///
/// # Errors
/// [`EvaluateError::Tables`].
pub(super) fn check_some(path: &Path, rows: u64) -> Result<(), EvaluateError> {
    match rows {
        0 => Err(EvaluateError::Tables {
            path: path.to_owned(),
            problem: "no row below the header: there is nothing to score".to_owned(),
        }),
        _ => Ok(()),
    }
}

/// What both tables are known by together.
pub(super) fn input_of(digests: &BTreeMap<String, String>) -> String {
    let digests: Vec<&str> = digests.values().map(String::as_str).collect();
    digests.join(" ")
}

/// The channels of the prediction; the truth must have each, and no channel of the six that the prediction lacks.
pub(super) fn channels(
    truth: &CsvTable,
    prediction: &CsvTable,
    units: &[(String, Unit)],
) -> Result<Channels, EvaluateError> {
    let is_channel = |name: &&String| !NOT_CHANNELS.contains(&name.as_str());
    let six = |name: &str| {
        Channel::SIX
            .into_iter()
            .find(|channel| channel.name() == name)
    };
    let wrong = |table: &CsvTable, problem: String| EvaluateError::Tables {
        path: table.path().to_owned(),
        problem,
    };
    let mut found = Vec::new();
    for name in prediction.names().iter().filter(is_channel) {
        truth.position(name)?;
        let declared = units
            .iter()
            .find(|(known, _)| known == name)
            .map(|(_, unit)| *unit);
        let unit = declared
            .or_else(|| six(name).map(|channel| channel.unit()))
            .unwrap_or(Unit::One);
        found.push(
            Channel::named(name, unit).map_err(|error| wrong(prediction, error.to_string()))?,
        );
    }
    let absent = truth
        .names()
        .iter()
        .find(|name| six(name).is_some() && !prediction.has(name));
    if let Some(name) = absent {
        let problem = format!(
            "no column `{name}`, which {} has: both must have the same channels",
            shown(&truth.path())
        );
        return Err(wrong(prediction, problem));
    }
    if let Some((name, _)) = units.iter().find(|(name, _)| !prediction.has(name)) {
        return Err(EvaluateError::Request(format!(
            "a unit is given for `{name}`, which is no column of the predictions"
        )));
    }
    if found.is_empty() {
        let problem =
            "no column is a channel: expected Px, Py, Pz, Fx, Fy, Fz or named others".to_owned();
        return Err(wrong(prediction, problem));
    }
    Channels::new(found).map_err(|error| wrong(prediction, error.to_string()))
}

/// Pairs the rows by `id` where both tables have one, else by order.
pub(super) fn pair(truth: &CsvTable, prediction: &CsvTable) -> Result<Pairing, EvaluateError> {
    let wrong = |table: &CsvTable, problem: String| EvaluateError::Tables {
        path: table.path().to_owned(),
        problem,
    };
    if !truth.has("id") || !prediction.has("id") {
        if truth.rows() != prediction.rows() {
            let problem = format!(
                "{} rows, but {} has {}; without a column `id` in both, rows are matched by order",
                prediction.rows(),
                shown(&truth.path()),
                truth.rows()
            );
            return Err(wrong(prediction, problem));
        }
        return Ok(Pairing::ByOrder);
    }
    let ids = prediction.text("id")?;
    let mut rows: HashMap<&str, usize> = HashMap::with_capacity(ids.len());
    for (row, id) in ids.iter().enumerate() {
        if rows.insert(id, row).is_some() {
            return Err(wrong(
                prediction,
                format!("id `{}` comes twice", shown(*id)),
            ));
        }
    }
    let wanted = truth.text("id")?;
    let mut paired = Vec::with_capacity(wanted.len());
    for id in &wanted {
        // Taken out, so that an id of the truth that comes twice finds nothing the second time.
        match rows.remove(id) {
            Some(row) => paired.push(row),
            None if ids.contains(id) => {
                return Err(wrong(truth, format!("id `{}` comes twice", shown(*id))));
            }
            None => {
                let problem = format!(
                    "no row with id `{}`, which {} has",
                    shown(*id),
                    shown(&truth.path())
                );
                return Err(wrong(prediction, problem));
            }
        }
    }
    if let Some(id) = ids.iter().find(|id| rows.contains_key(**id)) {
        let problem = format!(
            "no row with id `{}`, which {} has",
            shown(*id),
            shown(&prediction.path())
        );
        return Err(wrong(truth, problem));
    }
    Ok(Pairing::ById(paired))
}
