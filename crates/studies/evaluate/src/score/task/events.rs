//! Events of a task.

use taceva_tasks::TaskScores;

use super::TaskTables;
use super::classes::ClassRow;
use crate::error::EvaluateError;

pub(super) fn debounce(_rows: &mut [ClassRow<'_>], _positive: u32, _negative: u32, _least: u32) {}

pub(super) fn add(
    _scores: &mut TaskScores,
    _tables: &TaskTables,
    _rows: &[ClassRow<'_>],
    _positive: Option<u32>,
) -> Result<(), EvaluateError> {
    Ok(())
}
