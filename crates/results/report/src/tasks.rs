//! Scores of tasks, for readers and programs.

use taceva_core::{counted, distinct};
use taceva_metrics::Interval;
use taceva_results::not_measured;
use taceva_tasks::{Estimate, PublicNumber, TaskReport, TaskScore, TaskScores};

use crate::number::numeral;
use crate::table::{Cell, Column, Table};

/// Greatest number of classes whose confusion is listed below the scores.
const MOST_CLASSES: usize = 12;

/// Table of the scores of tasks for readers. Scores of single classes are only in [`task_numbers`].
///
/// ```
/// use taceva_report::task_table;
/// use taceva_tasks::{Classes, TaskReport, TaskScores};
/// let mut grasp = Classes::new(["lost", "held"], Some("held"))?;
/// grasp.push("cup", "held", "lost")?;
/// let mut report = TaskReport::new("0.2.0", "by `sample`");
/// report.tasks.push(TaskScores::new("grasp", "outcome", "object").of_classes(&grasp));
/// assert!(task_table(&report).text().contains("held: 1 as lost"));
/// # Ok::<(), taceva_tasks::TaskError>(())
/// ```
pub fn task_table(report: &TaskReport) -> Table {
    let columns = [
        Column::new("task"),
        Column::new("score"),
        Column::new("value"),
        Column::new("best constant"),
        Column::new("n"),
        Column::new("clusters"),
    ];
    let mut table = Table::new("Scores of tasks, with 95 % intervals by cluster", columns);
    for task in &report.tasks {
        let of_task = task.scores.iter().filter(|score| !is_of_class(score));
        for score in of_task {
            table.push(row(task, score));
        }
    }
    for task in &report.tasks {
        for words in remarks(task) {
            table.note(format!("{}: {words}.", task.name));
        }
    }
    table.note(format!("Rows are paired {}.", report.paired));
    table.note_all(not_measured(report.sources.iter().map(String::as_str)));
    table
}

/// Table for programs: one row for each score and variant, in shortest round-trip form.
pub fn task_numbers(report: &TaskReport) -> Table {
    let columns = [
        "task",
        "kind",
        "metric",
        "variant",
        "value",
        "unit",
        "ci95_low",
        "ci95_high",
        "of_constant",
        "n",
        "clusters",
        "cluster",
        "definition",
        "remark",
        "source",
    ];
    let mut table = Table::new("Scores of tasks", columns);
    let source = report.sources.join(" ");
    for task in &report.tasks {
        for score in &task.scores {
            let estimate = &score.estimate;
            let ends = estimate.interval.ends();
            table.push([
                Cell::text(task.name.as_str()),
                Cell::text(task.kind.as_str()),
                Cell::text(score.metric),
                Cell::text(score.variant.clone().unwrap_or_default()),
                Cell::exact(estimate.value.ok()),
                Cell::text(score.unit.unwrap_or_default()),
                Cell::exact(ends.map(|[low, _]| low)),
                Cell::exact(ends.map(|[_, high]| high)),
                Cell::exact(estimate.of_constant),
                Cell::Number(estimate.n.to_string()),
                Cell::Number(estimate.clusters.to_string()),
                Cell::text(task.cluster.as_str()),
                Cell::text(score.definition.as_str()),
                Cell::text(remark(score).unwrap_or_default()),
                Cell::text(source.as_str()),
            ]);
        }
    }
    table
}

fn is_of_class(score: &TaskScore) -> bool {
    let variant = score.variant.as_deref();
    variant.is_some_and(|variant| variant.starts_with("class "))
}

fn row(task: &TaskScores, score: &TaskScore) -> [Cell; 6] {
    let estimate = &score.estimate;
    let name = match &score.variant {
        Some(variant) => format!("{} {variant}", score.metric),
        None => score.metric.to_owned(),
    };
    let unit = score
        .unit
        .map_or_else(String::new, |unit| format!(" ({unit})"));
    let value = match estimate.value {
        Ok(value) => Cell::estimate(Some(value), estimate.interval.ends()),
        Err(reason) => Cell::text(format!("undefined: {reason}")),
    };
    [
        Cell::text(task.name.as_str()),
        Cell::text(format!("{name}{unit}")),
        value,
        Cell::estimate(estimate.of_constant, None),
        Cell::Number(estimate.n.to_string()),
        Cell::Number(estimate.clusters.to_string()),
    ]
}

/// Reason for a missing value or interval, and the properties of the samples that limit the score.
fn remark(score: &TaskScore) -> Option<String> {
    let estimate = &score.estimate;
    let reason = match (estimate.value, &estimate.interval) {
        (Err(reason), _) => Some(reason.to_string()),
        (Ok(_), Interval::Undefined(reason)) => Some(format!("no interval: {reason}")),
        _ => None,
    };
    let flags = score.flags.iter().map(|flag| flag.words().to_owned());
    let all: Vec<String> = reason.into_iter().chain(flags).collect();
    (!all.is_empty()).then(|| all.join("; "))
}

/// Sentences below the scores of a task, without full stops.
fn remarks(task: &TaskScores) -> Vec<String> {
    let mut remarks = task.notes.clone();
    if let Some(Estimate {
        interval, clusters, ..
    }) = task.scores.first().map(|score| &score.estimate)
    {
        let by = format!(
            "{} of the column `{}`",
            counted(*clusters, "cluster"),
            task.cluster
        );
        let mut all = task.scores.iter().map(|score| &score.estimate.interval);
        let has_some = all.any(|interval| interval.ends().is_some());
        remarks.push(match interval {
            Interval::Undefined(reason) if !has_some => format!("no interval by {by}: {reason}"),
            _ => format!("intervals by {by}"),
        });
    }
    let flags = task.scores.iter().flat_map(|score| &score.flags);
    let flags = distinct(flags.map(|flag| flag.words()));
    remarks.extend(flags.into_iter().map(str::to_owned));
    if task.names.len() <= MOST_CLASSES {
        remarks.extend(confusion(task));
    }
    remarks.extend(task.as_published.iter().map(as_published));
    remarks
}

/// Number as computed by a public program, with the correct number.
fn as_published(number: &PublicNumber) -> String {
    let unit = (number.unit).map_or_else(String::new, |unit| format!(" {unit}"));
    let right = match number.right {
        Some(right) => format!("the right number is {}{unit}", numeral(right)),
        None => "the right number needs other columns".to_owned(),
    };
    format!(
        "{} as {} computes it is {}{unit}, and {right}: {}",
        number.number,
        number.program,
        numeral(number.value),
        number.difference
    )
}

/// One sentence for each true class: `held: 1 as lost, 4 as held`.
fn confusion(task: &TaskScores) -> Vec<String> {
    let of_class = |name: &String| {
        let cells = task.confusion.iter().filter(|cell| cell.truth == *name);
        let counts: Vec<String> = cells
            .map(|cell| format!("{} as {}", cell.count, cell.predicted))
            .collect();
        (!counts.is_empty()).then(|| format!("{name}: {}", counts.join(", ")))
    };
    task.names.iter().filter_map(of_class).collect()
}
