//! `taceva compare` of scores of tasks.

use taceva_core::shown;
use taceva_report::{OVERVIEW_WIDTH, TaskComparison, TaskResult};

use super::super::{Usage, results};
use crate::args::{Compare, Format};
use crate::{exit, output};

/// Compares the results if one of them has scores of tasks; `None` without scores of tasks.
pub(super) fn run(args: &Compare) -> anyhow::Result<Option<u8>> {
    let mut found: Vec<TaskResult> = Vec::new();
    let mut others = Vec::new();
    for path in &args.results {
        match results::tasks::read(path)? {
            Some(result) => found.push(result),
            None => others.push(path),
        }
    }
    if found.is_empty() {
        return Ok(None);
    }
    if let Some(other) = others.first() {
        return Err(Usage::error(format!(
            "{}: no scores of tasks, but the other results have such scores; compare results of tasks and of channels in two commands",
            shown(other)
        )));
    }
    check(args, &found)?;
    output::check_all_free(&args.output.path, args.output.force)?;
    results::check_distinct(&args.results)?;
    let comparison = TaskComparison::of(&found, &args.metrics, args.seed.value);
    match args.output.format {
        Format::Text | Format::Md => {
            let answers = |width: Option<usize>| match args.output.format {
                Format::Md => comparison.table().markdown(),
                _ => comparison.text(width.unwrap_or(OVERVIEW_WIDTH)),
            };
            results::write_values(&comparison.values(), answers, &args.output)?;
        }
        _ => results::write(&comparison.table(), &args.output, || comparison.json())?,
    }
    Ok(Some(exit::DONE))
}

/// Refuses a single result, and options that concern channels.
fn check(args: &Compare, found: &[TaskResult]) -> anyhow::Result<()> {
    let of_channels = [
        ("--catalogue", args.catalogue.is_some()),
        ("--channels", !args.channels.is_empty()),
        ("--margin", !args.margins.is_empty()),
        ("--table", args.table.scores.is_some()),
        ("--html", args.page.path.is_some()),
    ];
    if let Some((option, _)) = of_channels.iter().find(|(_, is_given)| *is_given) {
        return Err(Usage::error(format!(
            "{option} is for scores of channels: omit it for scores of tasks"
        )));
    }
    if let Some(unknown) = TaskComparison::unknown_metric(found, &args.metrics) {
        return Err(Usage::error(format!(
            "--metrics {}: no result has this score, expected a score such as f1 or class_accuracy",
            shown(unknown)
        )));
    }
    match found.len() {
        1 => Err(Usage::error(
            "one result: expected at least two results or states of tasks",
        )),
        _ => Ok(()),
    }
}
