//! Output of the scores of tasks.

use std::path::Path;

use taceva_dataset::Dataset;
use taceva_evaluate::TaskStates;
use taceva_report::{Picture, task_numbers, task_page, task_table};
use taceva_tasks::{PublicProgram, TaskReport};

use super::{Usage, results};
use crate::args::{Format, Output, PageArgs};
use crate::output;
use crate::report::thumbnail::{MEDIA_TYPE, thumbnail};

/// Writes the scores of `states` to the path and in the format of `to`, and the states to `state_out`. Returns the scores.
pub(super) fn write(
    states: &TaskStates,
    to: &Output,
    state_out: Option<&Path>,
) -> anyhow::Result<TaskReport> {
    write_report(states.report(), states, to, state_out)
}

/// Same as [`write()`], with the numbers of the public program `program` next to the scores.
pub(super) fn write_as_published(
    program: PublicProgram,
    states: &TaskStates,
    to: &Output,
    state_out: Option<&Path>,
) -> anyhow::Result<TaskReport> {
    let mut report = states.report();
    for (scores, state) in report.tasks.iter_mut().zip(&states.tasks) {
        scores.as_published = state.as_published(program);
    }
    if report.tasks.iter().all(|task| task.as_published.is_empty()) {
        return Err(Usage::error(format!(
            "--as {program}: this program scores none of these tasks, expected a task of {}",
            program.of_tasks()
        )));
    }
    write_report(report, states, to, state_out)
}

fn write_report(
    report: TaskReport,
    states: &TaskStates,
    to: &Output,
    state_out: Option<&Path>,
) -> anyhow::Result<TaskReport> {
    let table = match to.format {
        Format::Csv => task_numbers(&report),
        _ => task_table(&report),
    };
    let json = serde_json::to_string_pretty(&report)?;
    results::write(&table, to, || format!("{json}\n"))?;
    if let Some(path) = state_out {
        output::write(Some(path), |out| states.write(out))?;
    }
    Ok(report)
}

/// Writes the page of `report`, if it is requested. Errors are shown with pictures of `dataset`, if given.
pub(super) fn write_page(
    report: &TaskReport,
    page: &PageArgs,
    dataset: Option<&Dataset>,
) -> anyhow::Result<()> {
    let Some(path) = &page.path else {
        return Ok(());
    };
    let pictures = match dataset {
        Some(dataset) => pictures(report, dataset)?,
        None => Vec::new(),
    };
    let names: Vec<&str> = report.tasks.iter().map(|task| task.name.as_str()).collect();
    let text = task_page(&format!("Tasks: {}", names.join(", ")), report, &pictures);
    output::write(Some(path), |out| out.write_all(text.as_bytes()))
}

/// Pictures of the samples with the greatest errors.
fn pictures(report: &TaskReport, dataset: &Dataset) -> anyhow::Result<Vec<Picture>> {
    let mut pictures = Vec::new();
    for (study, task) in report.tasks.iter().enumerate() {
        for worst in &task.evidence.worst {
            if let Some(frame) = dataset.frame(worst.row)? {
                pictures.push(Picture {
                    study,
                    id: worst.sample.clone(),
                    media_type: MEDIA_TYPE,
                    bytes: thumbnail(&frame)?,
                });
            }
        }
    }
    Ok(pictures)
}
