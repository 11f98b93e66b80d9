//! Finds scores of tasks that `score --task`, `evaluate --task` and `merge` wrote.

use std::fs;
use std::path::Path;

use anyhow::Context as _;
use taceva_core::shown;
use taceva_evaluate::TaskStates;
use taceva_report::TaskResult;

/// Extension of the states next to a result, in place of `json`.
const STATE: &str = "state";

/// Scores of tasks in the file at `path`: a result, with the states next to it, or states; `None` for another file.
pub(in crate::cmd) fn read(path: &Path) -> anyhow::Result<Option<TaskResult>> {
    if !path.is_file() {
        return Ok(None);
    }
    let name = path.with_extension("");
    let name = name.to_string_lossy();
    if TaskStates::is_at(path) {
        return of_states(path, &name).map(Some);
    }
    let Ok(text) = fs::read_to_string(path) else {
        return Ok(None);
    };
    if !TaskResult::is_in(&text) {
        return Ok(None);
    }
    let result = TaskResult::read(name.clone(), &text).with_context(|| shown(&path).to_string())?;
    let beside = path.with_extension(STATE);
    Ok(Some(match TaskStates::is_at(&beside) {
        true => result.with_clusters_of(of_states(&beside, &name)?),
        false => result,
    }))
}

/// Scores of the states at `path`.
fn of_states(path: &Path, name: &str) -> anyhow::Result<TaskResult> {
    let report = TaskStates::read(path)?.report();
    TaskResult::of(name, &report).with_context(|| shown(&path).to_string())
}
