//! Output of the scores of tasks.

use std::path::Path;

use taceva_evaluate::TaskStates;
use taceva_report::{task_numbers, task_table};

use super::results;
use crate::args::{Format, Output};
use crate::output;

/// Writes the scores of `states` to the path and in the format of `to`, and the states to `state_out`.
pub(super) fn write(
    states: &TaskStates,
    to: &Output,
    state_out: Option<&Path>,
) -> anyhow::Result<()> {
    let report = states.report();
    let table = match to.format {
        Format::Csv => task_numbers(&report),
        _ => task_table(&report),
    };
    let json = serde_json::to_string_pretty(&report)?;
    results::write(&table, to, || format!("{json}\n"))?;
    if let Some(path) = state_out {
        output::write(Some(path), |out| states.write(out))?;
    }
    Ok(())
}
