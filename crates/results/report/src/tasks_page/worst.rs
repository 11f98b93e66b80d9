//! Samples with the greatest errors: a table, and their pictures.

use maud::{Markup, html};
use taceva_tasks::{TaskReport, TaskScores, WorstSample};

use crate::figure::{middle_cut, short};
use crate::html::{Picture, picture_address};
use crate::number::numeral;
use crate::table::{Cell, Table};

/// Table of the samples with the greatest errors of a task; `None` without such samples.
pub(super) fn table(task: &TaskScores, _at: usize) -> Option<Markup> {
    let worst = &task.evidence.worst;
    if worst.is_empty() {
        return None;
    }
    let caption = format!("{}: samples with the greatest errors", task.name);
    let mut table = Table::new(caption, ["sample", "cluster", "error", "unit", "labels"]);
    for sample in worst {
        table.push([
            Cell::text(sample.sample.as_str()),
            Cell::text(sample.cluster.as_str()),
            Cell::Number(numeral(sample.error)),
            Cell::text(sample.unit),
            Cell::text(sample.words.as_str()),
        ]);
    }
    Some(table.html())
}

/// Cards with the pictures of the samples with the greatest errors, the greatest first; `None` without pictures.
pub(super) fn cards(report: &TaskReport, pictures: &[Picture]) -> Option<Markup> {
    let tasks = report.tasks.iter().enumerate();
    let cards: Vec<Markup> = tasks
        .flat_map(|(at, task)| {
            let worst = task.evidence.worst.iter();
            worst.filter_map(move |sample| card(task, at, sample, pictures))
        })
        .collect();
    let body = html! {
        p.note { "The samples of the table of greatest errors that have a picture, the greatest error first." } "\n"
        ul.cards { @for card in &cards { (card) } }
    };
    (!cards.is_empty()).then_some(body)
}

fn card(
    task: &TaskScores,
    at: usize,
    sample: &WorstSample,
    pictures: &[Picture],
) -> Option<Markup> {
    let mut pictures = pictures.iter();
    let picture = pictures.find(|own| own.study == at && own.id == sample.sample)?;
    Some(html! {
        li.card {
            h3 { (short(&task.name, 30)) @if !sample.words.is_empty() { ": " (sample.words) } }
            p.error { (numeral(sample.error)) " " (sample.unit) }
            p { "sample " (middle_cut(&sample.sample, 14)) ", " (task.cluster) " " (middle_cut(&sample.cluster, 14)) }
            img alt={ "picture of sample " (middle_cut(&sample.sample, 40)) } src=(picture_address(picture.media_type, &picture.bytes));
        } "\n"
    })
}
