//! Confusion of classes: a matrix of few classes, or the most confused pairs of many.

use std::collections::BTreeMap;

use maud::{Markup, html};
use taceva_tasks::TaskScores;

use super::counts;
use crate::figure::{Anchor, Canvas, Figure, Ink, Label, diverging, short};
use crate::html::drawn;
use crate::markup::fold;
use crate::number::numeral;
use crate::table::{Cell, Column, Table};

/// Greatest number of classes of a drawn matrix.
const MOST_CLASSES: usize = 12;
/// Number of listed pairs if there are too many classes for a matrix.
const PAIRS: usize = 20;
/// Width for the names of the true classes, canvas units.
const LEFT: f64 = 150.0;
/// Space above the matrix, canvas units.
const TOP: f64 = 34.0;

/// Number of samples of a true class that are predicted as a class.
#[derive(Clone, Copy)]
struct Pair {
    count: u64,
    /// Number of samples of the true class.
    of_row: u64,
}

impl Pair {
    fn share(self) -> f64 {
        self.count as f64 / self.of_row as f64
    }

    /// Count and share as text: `12 of 15 (80 %)`.
    fn words(self) -> String {
        let share = numeral(self.share() * 100.0);
        format!("{} of {} ({share} %)", self.count, self.of_row)
    }
}

/// Pairs of a true and a predicted class that have samples, by both names.
fn pairs(task: &TaskScores) -> BTreeMap<[&str; 2], Pair> {
    let mut rows: BTreeMap<&str, u64> = BTreeMap::new();
    for cell in &task.confusion {
        *rows.entry(&cell.truth).or_default() += cell.count;
    }
    let cells = task.confusion.iter().map(|cell| {
        let pair = Pair {
            count: cell.count,
            of_row: rows[cell.truth.as_str()],
        };
        ([cell.truth.as_str(), cell.predicted.as_str()], pair)
    });
    cells.collect()
}

pub(super) fn part(task: &TaskScores, at: usize) -> Option<Markup> {
    if task.confusion.is_empty() {
        return None;
    }
    let pairs = pairs(task);
    if task.names.len() > MOST_CLASSES {
        return Some(most_confused(task, &pairs).html());
    }
    let matrix = matrix(task, &pairs);
    let title = format!("Numbers of the matrix of {}", task.name);
    let holds = counts(task);
    Some(html! {
        (drawn(&figure(task, &pairs, at)))
        (fold(&format!("matrix-{at}"), &title, &holds, &matrix.html()))
    })
}

/// Table with the true classes as rows and the predicted classes as columns.
fn matrix(task: &TaskScores, pairs: &BTreeMap<[&str; 2], Pair>) -> Table {
    let names = task.names.iter().map(String::as_str);
    let columns = ["true class"].into_iter().chain(names).map(Column::new);
    let mut table = Table::new(
        format!("{}: counts, and shares of the row", task.name),
        columns,
    );
    for truth in &task.names {
        let cells = task.names.iter().map(|predicted| {
            let pair = pairs.get(&[truth.as_str(), predicted.as_str()]);
            Cell::text(pair.map_or_else(|| "0".to_owned(), |pair| pair.words()))
        });
        let row: Vec<Cell> = std::iter::once(Cell::text(truth.as_str()))
            .chain(cells)
            .collect();
        table.push(row);
    }
    table
}

/// Table of the most frequent errors. Among equally frequent errors, the error of the smaller class comes first.
fn most_confused(task: &TaskScores, pairs: &BTreeMap<[&str; 2], Pair>) -> Table {
    let mut wrong: Vec<(&str, &str, Pair)> = pairs
        .iter()
        .filter(|([truth, predicted], _)| truth != predicted)
        .map(|([truth, predicted], pair)| (*truth, *predicted, *pair))
        .collect();
    wrong.sort_by_key(|(_, _, pair)| (std::cmp::Reverse(pair.count), pair.of_row));
    let columns = [
        "true class",
        "predicted class",
        "samples",
        "share of the true class (%)",
    ];
    let caption = match wrong.len() {
        0 => format!(
            "{}: confused pairs of {} classes",
            task.name,
            task.names.len()
        ),
        found => format!(
            "{}: the {} most confused of {found} pairs of {} classes",
            task.name,
            found.min(PAIRS),
            task.names.len()
        ),
    };
    let mut table = Table::new(caption, columns);
    for (truth, predicted, pair) in wrong.into_iter().take(PAIRS) {
        table.push([
            Cell::text(truth),
            Cell::text(predicted),
            Cell::Number(pair.count.to_string()),
            Cell::Number(numeral(pair.share() * 100.0)),
        ]);
    }
    table.note(format!("{}.", counts(task)));
    table
}

/// Matrix with one row for each true class. Right classes are blue, and errors orange.
fn figure(task: &TaskScores, pairs: &BTreeMap<[&str; 2], Pair>, at: usize) -> Figure {
    let count = task.names.len().max(1) as f64;
    let side = (480.0 / count).clamp(46.0, 96.0);
    let mut canvas = Canvas::new(LEFT + side * count + 16.0, TOP + side * count + 92.0);
    let mut y = TOP;
    for truth in &task.names {
        let name = Label::new(
            [LEFT - 8.0, y + side / 2.0 + 4.0],
            short(truth, 20),
            Anchor::End,
        );
        canvas.label(name);
        let mut x = LEFT;
        for predicted in &task.names {
            let pair = pairs.get(&[truth.as_str(), predicted.as_str()]);
            if let Some(pair) = pair {
                let sign = if truth == predicted { -0.5 } else { 0.5 };
                let place = [x + 1.0, y + 1.0, side - 2.0, side - 2.0];
                let words = format!("{truth} as {predicted}: {}", pair.words());
                canvas.fill(place, Ink::Rgb(diverging(sign * pair.share())), words);
                let middle = [x + side / 2.0, y + side / 2.0 - 2.0];
                canvas.cell_label(Label::new(middle, pair.count.to_string(), Anchor::Middle));
                let share = format!("{} %", numeral(pair.share() * 100.0));
                let below = [middle[0], middle[1] + 14.0];
                canvas.cell_label(Label::new(below, share, Anchor::Middle));
            }
            x += side;
        }
        y += side;
    }
    let mut x = LEFT;
    for predicted in &task.names {
        let mut name = Label::new(
            [x + side / 2.0 + 4.0, y + 6.0],
            short(predicted, 12),
            Anchor::End,
        );
        name.upwards = true;
        canvas.label(name);
        x += side;
    }
    let above = [LEFT + side * count / 2.0, TOP - 12.0];
    canvas.label(Label::new(
        above,
        "rows: true class, columns: predicted class",
        Anchor::Middle,
    ));
    let shown = pairs
        .iter()
        .map(|([truth, predicted], pair)| format!("{truth} as {predicted}: {}", pair.words()));
    let shown: Vec<String> = shown.collect();
    Figure {
        id: format!("confusion-{at}"),
        title: format!("Confusion of {}", task.name),
        caption: format!(
            "Counts, and shares of the samples of the true class. {}.",
            counts(task)
        ),
        description: format!("Confusion matrix of {}. {}.", task.name, shown.join("; ")),
        canvas,
    }
}
