//! Output of the scores of tasks.

use taceva_report::{task_numbers, task_table};
use taceva_tasks::TaskReport;

use super::results;
use crate::args::{Format, Output};

/// Writes `report` to the path and in the format of `to`.
pub(super) fn write(report: &TaskReport, to: &Output) -> anyhow::Result<()> {
    let table = match to.format {
        Format::Csv => task_numbers(report),
        _ => task_table(report),
    };
    let json = serde_json::to_string_pretty(report)?;
    results::write(&table, to, || format!("{json}\n"))
}
