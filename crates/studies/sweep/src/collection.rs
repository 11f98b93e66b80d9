//! Writes the output of a sweep from all results: the table, its digest, and the pages.

use std::fs;

use taceva_dataset::Digest;

use crate::analysis::{self, Found, Loaded};
use crate::collected_counts::Collected;
use crate::error::SweepError;
use crate::failure::Failure;
use crate::folder::SweepFolder;
use crate::page;
use crate::result::TaskResult;
use crate::shard_scores;
use crate::table::TidyTable;
use crate::task_list::TaskList;
use crate::times;
use crate::units;

/// Writes the table and the pages of all results in `folder`. If `anew` is false, existing output of the same results is kept.
///
/// # Errors
/// [`SweepError`] for a result that was edited or has another version, and if the folder cannot be written.
pub fn collect(folder: &SweepFolder, list: &TaskList, anew: bool) -> Result<Collected, SweepError> {
    if list.is_of_tables() {
        return shard_scores::join(folder, list);
    }
    let made_of = made_of(folder, list)?;
    if !anew && let Some(before) = Collected::read(folder, &made_of)? {
        return Ok(before);
    }
    let loaded = analysis::load(folder, list)?;
    for result in loaded.iter().filter_map(Loaded::result) {
        check_evaluation(folder, result)?;
    }
    let csv = TidyTable::of(&loaded).csv();
    let mut collected = Collected {
        digest: Digest::of(&csv).to_string(),
        made_of,
        units: units::units(folder, list, &loaded)?,
        ..Collected::default()
    };
    for one in &loaded {
        match one.found {
            Found::Result(_) => collected.scored += 1,
            Found::Failed(_) => collected.failed += 1,
            Found::Missing => collected.missing += 1,
        }
    }
    write_all(folder, list, &loaded, &collected, &csv)?;
    Ok(collected)
}

/// Rejects an evaluation file that does not match `result`. A missing file is accepted, because the table does not need it.
fn check_evaluation(folder: &SweepFolder, result: &TaskResult) -> Result<(), SweepError> {
    match folder.evaluation(&result.key).exists() {
        true => result.read_evaluation(folder).map(drop),
        false => Ok(()),
    }
}

fn write_all(
    folder: &SweepFolder,
    list: &TaskList,
    loaded: &[Loaded<'_>],
    collected: &Collected,
    csv: &[u8],
) -> Result<(), SweepError> {
    let at = |name: &str| folder.path().join(name);
    folder.write(&at("table.csv"), csv)?;
    let parquet = at("table.parquet");
    let table = TidyTable::of(loaded);
    taceva_files::replace(&parquet, |staged| {
        table.write_parquet(staged).map_err(std::io::Error::other)
    })
    .map_err(SweepError::io("write", &parquet))?;
    folder.write(&at("times.csv"), &times::csv(folder, &list.tasks)?)?;
    folder.write(
        &at("page.html"),
        page::results(list, loaded, collected).as_bytes(),
    )?;
    folder.write(
        &at("times.html"),
        page::times(folder, list, loaded).as_bytes(),
    )?;
    if !collected.units.is_empty() {
        let table = units::table(&collected.units);
        folder.write(&at("units.csv"), table.csv().as_bytes())?;
    }
    // Written last, so that it describes existing files.
    collected.write(folder)
}

/// Digest of the list of tasks, the limits, and the state of each task: result, reason for failure, or neither.
fn made_of(folder: &SweepFolder, list: &TaskList) -> Result<String, SweepError> {
    let (results, failures) = (folder.results()?, folder.failures()?);
    let mut text = serde_json::to_string(list).unwrap_or_default();
    if let Some(limits) = &list.limits {
        text.push_str(&fs::read_to_string(limits).map_err(SweepError::io("read", limits))?);
    }
    for task in &list.tasks {
        let key = task.key.as_str();
        match (results.contains(key), failures.contains(key)) {
            (true, _) => text.push('s'),
            (false, true) => {
                let failure = Failure::read(folder, &task.key)?;
                text.push_str(&failure.map_or_else(String::new, |failure| failure.reason));
                text.push('f');
            }
            (false, false) => text.push('m'),
        }
    }
    Ok(Digest::of(text.as_bytes()).to_string())
}
