//! Builds the rows of the table, cell by cell.

use std::collections::BTreeSet;

use taceva_tables::Cell;

use taceva_results::{Interval, Score};

use crate::task::Task;

fn text(text: &str) -> Cell {
    match text {
        "" => Cell::Null,
        text => Cell::Text(text.to_owned()),
    }
}

pub(super) fn head(task: &Task, settings: &BTreeSet<&str>, of_result: [&str; 3]) -> Vec<Cell> {
    let mut cells = vec![
        text(task.key.as_str()),
        text(&task.dataset),
        text(&task.digest),
    ];
    cells.extend(of_result.map(text));
    cells.push(text(&task.model));
    cells.extend(settings.iter().map(|name| {
        task.settings
            .get(*name)
            .map_or(Cell::Null, |value| text(value))
    }));
    cells.push(text(task.split.as_deref().unwrap_or_default()));
    cells.push(Cell::Integer(i128::from(task.seed)));
    cells.extend(task.labels.as_deref().map(text));
    cells
}

pub(super) fn without_scores(mut cells: Vec<Cell>, status: &str, reason: &str) -> Vec<Cell> {
    cells.push(text(status));
    cells.extend(std::iter::repeat_n(Cell::Null, 10));
    cells.push(text(reason));
    cells
}

pub(super) fn scored(
    mut cells: Vec<Cell>,
    task: &Task,
    part: &str,
    score: &Score,
    by: &str,
) -> Vec<Cell> {
    let number = |value: Option<f64>| value.map_or(Cell::Null, Cell::Number);
    cells.extend(
        [
            "scored",
            part,
            &score.metric,
            &score.channel,
            score.unit.symbol(),
            task.better(score).name(),
        ]
        .map(text),
    );
    cells.push(number(score.value.number()));
    let ends = score.interval.as_ref().and_then(Interval::ends);
    cells.push(number(ends.map(|[low, _]| low)));
    cells.push(number(ends.map(|[_, high]| high)));
    cells.push(match score.n {
        0 => Cell::Null,
        n => Cell::Integer(i128::from(n)),
    });
    cells.push(text(by));
    cells.push(text(&score.value.reason().unwrap_or_default()));
    cells
}
