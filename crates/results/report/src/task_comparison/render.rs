//! Comparisons of tasks as tables, text and JSON.

use serde_json::{Value, json};
use taceva_metrics::{Difference, p_words};
use taceva_results::not_measured;

use super::{TaskAnswer, TaskComparison, tasks};
use crate::escape::terminal;
use crate::number::numeral;
use crate::table::{Cell, Column, Table};
use crate::task_result::ResultScore;
use crate::wrap::wrapped;

/// Schema of a comparison of tasks as JSON.
pub const TASK_COMPARISON_SCHEMA: &str = "taceva.task-comparison/1.0";

/// Method of the tests, for readers.
const METHOD: &str = "All scores and pairs of a task form one family. A difference is shown if p by Holm is at most 0.05; only then the interval excludes 0.";

/// One score of a task, of all results.
struct Line<'a> {
    task: &'a str,
    score: &'a ResultScore,
    /// The score of each result; `None` for a result without the score.
    cells: Vec<Option<&'a ResultScore>>,
}

impl TaskComparison {
    /// Name of the result at position `at`.
    fn name(&self, at: usize) -> &str {
        &self.results[at].name
    }

    /// Compared scores of all tasks, limited to the requested metrics, in the order of their first appearance.
    fn lines(&self) -> Vec<Line<'_>> {
        let mut lines: Vec<Line<'_>> = Vec::new();
        for task in tasks(&self.results) {
            let of_results = self.results.iter().filter_map(|result| result.task(task));
            for score in of_results.flat_map(|own| own.compared()) {
                let is_asked = self.metrics.is_empty() || self.metrics.contains(&score.metric);
                let mut known = lines.iter();
                let is_known =
                    known.any(|line| line.task == task && line.score.named() == score.named());
                if is_asked && !is_known {
                    let cells = self.results.iter();
                    let cells = cells.map(|result| result.task(task)?.find(score));
                    let cells = cells.collect();
                    lines.push(Line { task, score, cells });
                }
            }
        }
        lines
    }

    /// Values of all results side by side, with intervals, the best constant, and numbers of samples and clusters.
    pub fn values(&self) -> Table {
        let names = self.results.iter().map(|result| result.name.as_str());
        let columns = ["task", "score"].into_iter().chain(names);
        let columns = columns.chain(["best constant", "n in clusters"]);
        let mut table = Table::new(
            "Scores of tasks side by side, with 95 % intervals by cluster",
            columns.map(Column::new),
        );
        for line in self.lines() {
            let known = || line.cells.iter().flatten();
            let value = |score: &Option<&ResultScore>| match score {
                None => Cell::text("not scored"),
                Some(score) => match &score.estimate.undefined {
                    Some(reason) => Cell::text(format!("undefined: {reason}")),
                    None => Cell::estimate(score.estimate.value, score.estimate.ends()),
                },
            };
            let unit = line.score.unit.as_ref();
            let unit = unit.map_or_else(String::new, |unit| format!(" ({unit})"));
            let constants = known().map(|score| match score.estimate.of_constant {
                Some(constant) => numeral(constant),
                None => "–".to_owned(),
            });
            let counts =
                known().map(|score| format!("{} in {}", score.estimate.n, score.estimate.clusters));
            let first = [
                Cell::text(line.task),
                Cell::text(format!("{}{unit}", line.score.named())),
            ];
            let last = [
                Cell::text(distinct(constants)),
                Cell::text(distinct(counts)),
            ];
            table.push(
                first
                    .into_iter()
                    .chain(line.cells.iter().map(value))
                    .chain(last),
            );
        }
        table.note_all(self.remarks());
        table
    }

    /// Table with one row for each answer.
    pub fn table(&self) -> Table {
        let columns = [
            "task",
            "score",
            "A",
            "B",
            "A is",
            "B is",
            "A − B",
            "interval",
            "p",
            "p by Holm",
            "unit",
            "test",
            "answer",
        ];
        let mut table = Table::new("Comparison of scores of tasks", columns.map(Column::new));
        for answer in &self.answers {
            let number = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), numeral);
            let difference = answer.difference.as_ref().ok();
            let of = |words: &dyn Fn(&Difference) -> String| {
                difference.map_or_else(|| "–".to_owned(), words)
            };
            table.push([
                Cell::text(answer.task.as_str()),
                Cell::text(answer.score.as_str()),
                Cell::text(self.name(answer.sides.a)),
                Cell::text(self.name(answer.sides.b)),
                Cell::from(number(answer.values.a)),
                Cell::from(number(answer.values.b)),
                Cell::from(of(&|of| numeral(of.value))),
                Cell::text(of(&ends)),
                Cell::p_value(difference.map(|of| of.p)),
                Cell::p_value(difference.map(|of| of.adjusted_p)),
                Cell::text(answer.unit.as_str()),
                Cell::text(of(&|of| of.test.to_string())),
                Cell::text(self.words(answer)),
            ]);
        }
        table.note(METHOD);
        table.note_all(self.remarks());
        table
    }

    /// Answers for a terminal, one line for each, wrapped to `width` characters.
    pub fn text(&self, width: usize) -> String {
        let mut out = String::new();
        for answer in &self.answers {
            let line = format!("{} {}: {}", answer.task, answer.score, self.words(answer));
            out += &wrapped(&terminal(&line), width, 0);
        }
        if self.answers.is_empty() {
            out += "Nothing to compare: no two results share a score of a task\n";
        }
        out += &wrapped(METHOD, width, 0);
        out
    }

    /// The answer in words, with the names of both results.
    fn words(&self, answer: &TaskAnswer) -> String {
        let [a, b] = [answer.sides.a, answer.sides.b].map(|at| self.name(at));
        let difference = match &answer.difference {
            Ok(difference) => difference,
            Err(reason) => return format!("{a} and {b}: no answer: {reason}"),
        };
        let unit = match answer.unit.as_str() {
            "" => String::new(),
            unit => format!(" {unit}"),
        };
        let numbers = format!(
            "{}{unit}, {} by Holm, {}",
            ends(difference),
            p_words(difference.adjusted_p),
            difference.test
        );
        match (difference.is_shown, answer.winner) {
            (false, _) => format!("{a} and {b}: no difference shown (A − B {numbers})"),
            (true, None) => format!("{a} and {b} differ, and neither is better (A − B {numbers})"),
            (true, Some(winner)) => format!(
                "{} better than {} by {}{unit} (A − B {numbers})",
                self.name(winner),
                if winner == answer.sides.a { b } else { a },
                numeral(difference.value.abs())
            ),
        }
    }

    /// Notes for the reader.
    fn remarks(&self) -> Vec<String> {
        let notes = self.notes.iter().map(|note| format!("Note: {note}."));
        let sources = self.results.iter().flat_map(|result| &result.sources);
        let origins = not_measured(sources.map(String::as_str));
        notes.chain(origins).collect()
    }

    /// JSON of [`TASK_COMPARISON_SCHEMA`]; an infinite end of an interval is null.
    pub fn json(&self) -> String {
        let names: Vec<&str> = self.results.iter().map(|of| of.name.as_str()).collect();
        let value = |line: Line<'_>| {
            let of_result = |score: &Option<&ResultScore>| {
                score.map(|score| {
                    let of = &score.estimate;
                    json!({
                        "value": of.value,
                        "undefined": of.undefined,
                        "ci95": of.ends(),
                        "n": of.n,
                        "clusters": of.clusters,
                        "of_constant": of.of_constant,
                    })
                })
            };
            json!({
                "task": line.task,
                "metric": line.score.metric,
                "variant": line.score.variant,
                "unit": line.score.unit,
                "better": line.score.better().name(),
                "results": line.cells.iter().map(of_result).collect::<Vec<_>>(),
            })
        };
        let whole = json!({
            "schema": TASK_COMPARISON_SCHEMA,
            "of": names,
            "notes": self.notes,
            "values": self.lines().into_iter().map(value).collect::<Vec<_>>(),
            "answers": self.answers.iter().map(|answer| self.document(answer)).collect::<Vec<_>>(),
        });
        format!("{whole:#}\n")
    }

    fn document(&self, answer: &TaskAnswer) -> Value {
        let difference = answer.difference.as_ref().ok().map(|of| {
            json!({
                "value": of.value,
                "interval": of.interval.map(|end| end.is_finite().then_some(end)),
                "level": of.confidence,
                "p": of.p,
                "p_holm": of.adjusted_p,
                "shown": of.is_shown,
                "test": of.test.to_string(),
            })
        });
        json!({
            "task": answer.task,
            "score": answer.score,
            "unit": answer.unit,
            "a": self.name(answer.sides.a),
            "b": self.name(answer.sides.b),
            "values": [answer.values.a, answer.values.b],
            "paired": answer.is_paired(),
            "difference": difference,
            "winner": answer.winner.map(|at| self.name(at)),
            "answer": self.words(answer),
        })
    }
}

/// Interval of a difference: `0.01 … 0.05`.
fn ends(difference: &Difference) -> String {
    let [low, high] = difference.interval.map(|end| match end.is_finite() {
        true => numeral(end),
        false if end < 0.0 => "−∞".to_owned(),
        false => "∞".to_owned(),
    });
    format!("{low} … {high}")
}

/// Distinct texts in the given order, separated by semicolons.
fn distinct(texts: impl Iterator<Item = String>) -> String {
    taceva_core::distinct(texts).join("; ")
}
