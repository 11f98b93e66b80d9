//! Output of the scores of tasks.

use std::path::Path;

use taceva_evaluate::TaskStates;
use taceva_report::{task_numbers, task_table};
use taceva_tasks::{PublicProgram, TaskReport};

use super::{Usage, results};
use crate::args::{Format, Output};
use crate::output;

/// Writes the scores of `states` to the path and in the format of `to`, and the states to `state_out`.
pub(super) fn write(
    states: &TaskStates,
    to: &Output,
    state_out: Option<&Path>,
) -> anyhow::Result<()> {
    write_report(&states.report(), states, to, state_out)
}

/// Same as [`write()`], with the numbers of the public program `program` beside the scores.
pub(super) fn write_as_published(
    program: PublicProgram,
    states: &TaskStates,
    to: &Output,
    state_out: Option<&Path>,
) -> anyhow::Result<()> {
    let mut report = states.report();
    for (scores, state) in report.tasks.iter_mut().zip(&states.tasks) {
        scores.as_published = state.as_published(program);
    }
    if report.tasks.iter().all(|task| task.as_published.is_empty()) {
        return Err(Usage::error(format!(
            "--as {program}: none of its numbers is of these tasks, expected a task of {}",
            program.of_tasks()
        )));
    }
    write_report(&report, states, to, state_out)
}

fn write_report(
    report: &TaskReport,
    states: &TaskStates,
    to: &Output,
    state_out: Option<&Path>,
) -> anyhow::Result<()> {
    let table = match to.format {
        Format::Csv => task_numbers(report),
        _ => task_table(report),
    };
    let json = serde_json::to_string_pretty(report)?;
    results::write(&table, to, || format!("{json}\n"))?;
    if let Some(path) = state_out {
        output::write(Some(path), |out| states.write(out))?;
    }
    Ok(())
}
