//! The two tables to score: read, reduced to common channels, and paired row by row.

use std::collections::{BTreeMap, HashMap};
use std::num::NonZeroUsize;
use std::path::Path;
use taceva_core::shown;

use taceva_core::{Channel, Channels, Unit, counted};
use taceva_dataset::internal::each_part;
use taceva_dataset::{Digest, Place};
use taceva_import::CsvTable;

use super::fields::NOT_CHANNELS;
use super::row_key::{KEY_NAMES, KeyPair, RowKeys, in_words, key_of, nearly};
use super::table_parts::TableParts;
use super::{ScoreRequest, parquet_parts};
use crate::error::EvaluateError;
use crate::note::Note;
use crate::rows::DISTANCE;

/// Pairing of the rows of two tables.
#[derive(Debug)]
pub(super) enum Pairing {
    /// Rows with equal numbers are paired.
    ByOrder,
    /// For each row of the truth, the index of the paired row of the predictions.
    ByKey(Vec<usize>),
}

/// Reads the table at `path`, CSV or Parquet, on `jobs` threads. Also returns the digest of its content.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("study.csv");
/// std::fs::write(&path, "part,Fz\na,0.5\n")?;
/// let (table, _) = taceva_evaluate::read_table(&path, std::num::NonZeroUsize::MIN)?;
/// assert_eq!((table.rows(), table.cell(0, 1)), (1, "0.5"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`EvaluateError`] if the file is not a table, or cannot be read.
pub fn read_table(path: &Path, jobs: NonZeroUsize) -> Result<(CsvTable, Digest), EvaluateError> {
    if parquet_parts::is_parquet(path) {
        let parts = TableParts::scan(path)?;
        return Ok((parts.reader()?.whole(parts.rows())?, parts.digest()));
    }
    let table = CsvTable::read_with(path, jobs)?;
    let digest = table.digest();
    Ok((table, digest))
}

/// Reads both tables and their digests, in parallel if two threads are allowed.
///
/// Reading takes about equally long for both tables. One thread for each table is therefore more efficient than several threads within a table.
pub(super) fn read_both(request: &ScoreRequest) -> Result<[(CsvTable, Digest); 2], EvaluateError> {
    let share = NonZeroUsize::new(request.jobs.get() / 2).unwrap_or(NonZeroUsize::MIN);
    both_at_once(request, |path| read_table(path, share))
}

/// Reads both tables by `read`, in parallel if two threads are allowed.
pub(super) fn both_at_once<T: Send>(
    request: &ScoreRequest,
    read: impl Fn(&Path) -> Result<T, EvaluateError> + Sync,
) -> Result<[T; 2], EvaluateError> {
    let paths = [request.truth.as_path(), request.prediction.as_path()];
    if request.jobs == NonZeroUsize::MIN {
        let [truth, prediction] = paths;
        return Ok([read(truth)?, read(prediction)?]);
    }
    let mut both = each_part(paths.to_vec(), read).into_iter();
    let mut next = || both.next().expect("two tables");
    Ok([next()?, next()?])
}

/// Rejects the same file as both truth and prediction, because every error would be 0.
///
/// # Errors
/// [`EvaluateError::Request`] for the same file.
pub(super) fn check_distinct(request: &ScoreRequest) -> Result<(), EvaluateError> {
    let [truth, prediction] =
        [&request.truth, &request.prediction].map(|path| path.canonicalize().ok());
    if truth.is_none() || truth != prediction {
        return Ok(());
    }
    Err(EvaluateError::Request(format!(
        "{} and {} are the same file; name one table of truth and another of predictions",
        shown(&request.truth),
        shown(&request.prediction)
    )))
}

/// Rejects a table without rows.
///
/// # Errors
/// [`EvaluateError::Tables`] for a table without rows.
pub(super) fn check_rows(table: &CsvTable) -> Result<(), EvaluateError> {
    check_some(table.path(), table.rows() as u64)
}

/// Like [`check_rows`], for a table that is read in parts.
///
/// # Errors
/// [`EvaluateError::Tables`] for a table without rows.
pub(super) fn check_some(path: &Path, rows: u64) -> Result<(), EvaluateError> {
    match rows {
        0 => Err(EvaluateError::Tables {
            path: path.to_owned(),
            problem: "the table has no row below its header".to_owned(),
        }),
        _ => Ok(()),
    }
}

/// Name of the pair of tables: both digests, separated by a space.
pub(super) fn input_of(digests: &BTreeMap<String, String>) -> String {
    let digests: Vec<&str> = digests.values().map(String::as_str).collect();
    digests.join(" ")
}

/// Channels of the predictions. The truth must have each of them, and no standard channel that the predictions lack.
pub(super) fn channels(
    truth: &CsvTable,
    prediction: &CsvTable,
    request: &ScoreRequest,
    keys: &RowKeys,
) -> Result<Channels, EvaluateError> {
    let (units, periods) = (&request.units, &request.periods);
    let is_beside = |name: &str| {
        NOT_CHANNELS.contains(&name)
            || KEY_NAMES.contains(&name)
            || keys.names().any(|key| key == name)
    };
    // Distances that `predict` writes are not predictions, unless the truth has such a column.
    let is_distance = |name: &str| name == DISTANCE && !truth.has(name) && prediction.has("sample");
    let is_channel =
        |name: &&String| is_declared(request, name) || !(is_beside(name) || is_distance(name));
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
        let declared = declared.or_else(|| six(name).map(|channel| channel.unit()));
        let channel = match periods.iter().find(|(known, _)| known == name) {
            Some((_, period)) => {
                let unit = declared.or_else(|| period.stated_unit(name));
                let unit = unit.unwrap_or(Unit::Degree);
                let degrees = period.degrees(name, unit);
                let degrees = degrees.map_err(EvaluateError::Request)?;
                Channel::named(name, unit).and_then(|channel| channel.with_period(degrees))
            }
            None => Channel::named(name, declared.unwrap_or(Unit::One)),
        };
        found.push(channel.map_err(|error| wrong(prediction, error.to_string()))?);
    }
    let absent = truth
        .names()
        .iter()
        .find(|name| six(name).is_some() && !prediction.has(name));
    if let Some(name) = absent {
        let problem = format!(
            "no column `{name}`, although {} has it: both tables must have the same channels",
            shown(&truth.path())
        );
        return Err(wrong(prediction, problem));
    }
    let units = units.iter().map(|(name, _)| ("unit", name));
    let periods = periods.iter().map(|(name, _)| ("period", name));
    if let Some((what, name)) = units.chain(periods).find(|(_, name)| !prediction.has(name)) {
        return Err(EvaluateError::Request(format!(
            "a {what} is given for `{name}`, but the predictions have no such column"
        )));
    }
    if found.is_empty() {
        let problem =
            "no column is a channel: expected Px, Py, Pz, Fx, Fy, Fz or channels named by --units"
                .to_owned();
        return Err(wrong(prediction, problem));
    }
    Channels::new(found).map_err(|error| wrong(prediction, error.to_string()))
}

/// Note on the `channels` that have unit 1 because no unit is stated; `None` without such channels.
pub(super) fn unit_of_one(request: &ScoreRequest, channels: &Channels) -> Option<Note> {
    let is_six = |name: &str| Channel::SIX.iter().any(|channel| channel.name() == name);
    let names = channels.iter().map(Channel::name);
    let names = names.filter(|name| !is_six(name) && !is_declared(request, name));
    let names: Vec<String> = names.map(str::to_owned).collect();
    (!names.is_empty()).then_some(Note::UnitOfOne(names))
}

/// True if the unit of the column `name` is declared, which makes the column a channel.
pub(super) fn is_declared(request: &ScoreRequest, name: &str) -> bool {
    let units = request.units.iter().map(|(known, _)| known);
    let periods = request.periods.iter().map(|(known, _)| known);
    units.chain(periods).any(|known| known == name)
}

/// Pairs the rows by the first of `keys` that pairs all rows, or by order if there are no keys. Also returns this key.
///
/// # Errors
/// [`EvaluateError::Tables`] if no key pairs all rows, because a value of the first key is empty, repeats, or is in only one table. Without keys, if
/// the numbers of rows differ.
pub(super) fn pair<'a>(
    truth: &CsvTable,
    prediction: &CsvTable,
    keys: &'a RowKeys,
) -> Result<(Pairing, Option<&'a KeyPair>), EvaluateError> {
    let mut first_error = None;
    for key in &keys.pairs {
        match pair_by(truth, prediction, key) {
            Ok(pairing) => return Ok((pairing, Some(key))),
            Err(error) => {
                first_error.get_or_insert(error);
            }
        }
    }
    if let Some(error) = first_error {
        return Err(error);
    }
    if truth.rows() != prediction.rows() {
        return Err(EvaluateError::Tables {
            path: prediction.path().to_owned(),
            problem: format!(
                "{}, but {} has {}; rows are matched by order, because no column `sample` or `id` is in both tables",
                counted(prediction.rows(), "row"),
                shown(&truth.path()),
                truth.rows()
            ),
        });
    }
    Ok((Pairing::ByOrder, None))
}

/// Row number of each key. Rejects keys that are empty or repeat.
fn rows_by_key<'a>(
    table: &'a CsvTable,
    name: &str,
) -> Result<HashMap<&'a str, usize>, EvaluateError> {
    let column = table.position(name)?;
    let mut rows: HashMap<&str, usize> = HashMap::with_capacity(table.rows());
    for row in 0..table.rows() {
        let key = key_of(table.cell(row, column));
        if key.is_empty() {
            return Err(without_key(table, row, name)?);
        }
        if let Some(first) = rows.insert(key, row) {
            return Err(EvaluateError::Tables {
                path: table.path().to_owned(),
                problem: comes_twice(
                    name,
                    key,
                    Some([table.place(first, column), table.place(row, column)]),
                ),
            });
        }
    }
    Ok(rows)
}

/// Error for a row with an empty key.
///
/// # Errors
/// [`EvaluateError::Table`] if the table has no column called `name`.
pub(super) fn without_key(
    table: &CsvTable,
    row: usize,
    name: &str,
) -> Result<EvaluateError, EvaluateError> {
    let expected = "expected the key of the row: fill it in, or choose another key with --key NAME";
    Ok(table.refuse(row, table.position(name)?, expected).into())
}

/// Message for a repeated key, with the lines of both rows if known.
pub(super) fn comes_twice(name: &str, key: &str, places: Option<[Place; 2]>) -> String {
    let lines = places.and_then(|[first, second]| Some([first.line?, second.line?]));
    let lines = lines.map_or_else(String::new, |[first, second]| {
        format!(", in lines {first} and {second}")
    });
    format!(
        "{} `{}` occurs twice{lines}: rows are paired by this key, which must be unique; name another column with --key NAME, or use --key order",
        in_words(name),
        shown(key)
    )
}

/// Message for a key that only one table has.
pub(super) fn is_lacking<'a>(
    name: &str,
    key: &str,
    has: &Path,
    others: impl IntoIterator<Item = &'a str>,
) -> String {
    let nearly = nearly(key, others).map_or_else(String::new, |other| {
        format!(
            "; `{}` differs only in blanks or case: write both alike",
            shown(other)
        )
    });
    format!(
        "no row with {} `{}`, although {} has such a row{nearly}",
        in_words(name),
        shown(key),
        shown(has)
    )
}

fn pair_by(
    truth: &CsvTable,
    prediction: &CsvTable,
    key: &KeyPair,
) -> Result<Pairing, EvaluateError> {
    let predicted = rows_by_key(prediction, &key.prediction)?;
    let wanted = rows_by_key(truth, &key.truth)?;
    let lacking =
        |table: &CsvTable, name: &str, key: &str, has: &CsvTable, others: &HashMap<&str, usize>| {
            EvaluateError::Tables {
                path: table.path().to_owned(),
                problem: is_lacking(name, key, has.path(), others.keys().copied()),
            }
        };
    let column = truth.position(&key.truth)?;
    let mut paired = Vec::with_capacity(truth.rows());
    for row in 0..truth.rows() {
        let own = key_of(truth.cell(row, column));
        match predicted.get(own) {
            Some(row) => paired.push(*row),
            None => return Err(lacking(prediction, &key.prediction, own, truth, &predicted)),
        }
    }
    let column = prediction.position(&key.prediction)?;
    for row in 0..prediction.rows() {
        let own = key_of(prediction.cell(row, column));
        if !wanted.contains_key(own) {
            return Err(lacking(truth, &key.truth, own, prediction, &wanted));
        }
    }
    Ok(Pairing::ByKey(paired))
}
