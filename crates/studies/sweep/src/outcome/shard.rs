//! Scores one shard of the tables of truth and prediction. The result is a state, which is merged with the states of other shards.

use taceva_evaluate::{EvaluateError, Shard, Work};

use super::Common;
use crate::error::SweepError;
use crate::grid::PlannedTables;
use crate::task::{SHARD, Task};

/// Scores the shard of `task` and writes its state.
///
/// # Errors
/// [`SweepError`] if the shard fails. Nothing is written in this case.
pub(super) fn carry_out(
    task: &Task,
    planned: &PlannedTables,
    common: Common<'_>,
    work: Work<'_>,
) -> Result<(), SweepError> {
    let named = task.settings.get(SHARD).map_or("", String::as_str);
    let shard: Shard = named
        .parse()
        .map_err(|error| EvaluateError::Request(format!("{error}")))?;
    let tables = planned.again()?;
    let request = planned.request(
        &common.list.metrics,
        common.list.sensor.as_deref(),
        work.jobs,
    );
    let scored = tables.score(&request, shard, work.progress)?;
    let path = common.folder.result(&task.key);
    let mut bytes = Vec::new();
    let written = scored.state.write(&mut bytes);
    written.map_err(SweepError::io("write", &path))?;
    common.folder.write(&path, &bytes)
}
