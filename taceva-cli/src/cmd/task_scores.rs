//! Output of the scores of tasks.

use std::io::Write as _;

use taceva_dataset::Dataset;
use taceva_report::{Picture, task_numbers, task_page, task_table};
use taceva_tasks::TaskReport;

use super::results;
use crate::args::{Format, Output, PageArgs};
use crate::output;
use crate::report::thumbnail::{MEDIA_TYPE, thumbnail};

/// Writes `report` to the path and in the format of `to`.
pub(super) fn write(report: &TaskReport, to: &Output) -> anyhow::Result<()> {
    let table = match to.format {
        Format::Csv => task_numbers(report),
        _ => task_table(report),
    };
    let json = serde_json::to_string_pretty(report)?;
    results::write(&table, to, || format!("{json}\n"))
}

/// Writes the page of `report`, if one is requested. The errors of the only task have the pictures of `dataset`.
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
