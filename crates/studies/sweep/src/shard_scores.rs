//! Merges the scores of all shards of two tables. The merged scores equal the scores of a single run.

use std::fs;
use std::path::PathBuf;

use taceva_core::shown;
use taceva_dataset::Digest;
use taceva_evaluate::{EvaluateError, merge_task_states};

use crate::collected_counts::Collected;
use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::grid::{PlannedLabels, PlannedTables};
use crate::outcome::sealed;
use crate::task_list::TaskList;
use crate::times;

/// Name of the file of merged scores. The file has the bytes that `taceva score --format json` prints.
const RESULT: &str = "score.json";

/// Merges the shards in `folder` into the file of scores, and writes the run times. While a shard is missing, an earlier file of scores is removed
/// instead.
///
/// # Errors
/// [`SweepError`] if a state was edited or belongs to other tables, or if the folder cannot be written.
pub(crate) fn join(folder: &SweepFolder, list: &TaskList) -> Result<Collected, SweepError> {
    let counts = list.counts(folder)?;
    let mut collected = Collected {
        scored: counts.scored,
        failed: counts.failed,
        missing: counts.left,
        is_of_tables: true,
        ..Collected::default()
    };
    let path = folder.path().join(RESULT);
    folder.write(
        &folder.path().join("times.csv"),
        &times::csv(folder, &list.tasks)?,
    )?;
    if !collected.is_whole() {
        // Removes scores that were merged from other tasks.
        return match fs::remove_file(&path) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(SweepError::io("remove", &path)(error))
            }
            _ => Ok(collected),
        };
    }
    let states: Vec<PathBuf> = list
        .tasks
        .iter()
        .map(|task| folder.result(&task.key))
        .collect();
    let merged = match (&list.tables, &list.label_tables) {
        (Some(planned), _) => merged_scores(&states, planned)?,
        (None, Some(planned)) => merged_labels(&states, planned)?,
        (None, None) => None,
    };
    let text = merged.ok_or_else(|| SweepError::Kept {
        path: folder.path().join("results"),
        problem: format!(
            "its states are not all shards of {}; remove the folder to compute them again",
            shown(list.tasks.first().map_or("", |task| task.dataset.as_str()))
        ),
    })?;
    collected.digest = Digest::of(text.as_bytes()).to_string();
    folder.write(&path, text.as_bytes())?;
    Ok(collected)
}

/// Scores of channels from `states`; `None` unless they are all shards of the planned tables.
fn merged_scores(
    states: &[PathBuf],
    planned: &PlannedTables,
) -> Result<Option<String>, SweepError> {
    let (report, state) = taceva_evaluate::merge(states)?;
    let [truth, prediction] = planned.digests().map(|digest| digest.to_string());
    let tables = &report.provenance.tables;
    let is_same = |role: &str, digest: &String| tables.get(role) == Some(digest);
    match is_same("truth", &truth) && is_same("prediction", &prediction) && state.is_whole() {
        true => Ok(Some(sealed(&report)? + "\n")),
        false => Ok(None),
    }
}

/// Scores of tasks from `states`; `None` unless they are all shards of the planned tables.
fn merged_labels(
    states: &[PathBuf],
    planned: &PlannedLabels,
) -> Result<Option<String>, SweepError> {
    let merged = merge_task_states(states)?;
    if !planned.is_of(&merged) || !merged.is_whole() {
        return Ok(None);
    }
    let text = serde_json::to_string_pretty(&merged.report());
    let text = text.map_err(|error| EvaluateError::Request(error.to_string()))?;
    Ok(Some(text + "\n"))
}
