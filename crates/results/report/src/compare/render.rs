//! Comparisons as table rows, text and JSON.

use serde_json::{Value, json};
use taceva_metrics::{Difference, DifferenceTest, p_words};

use super::overview::OVERVIEW_WIDTH;
use super::{Answer, Comparison, Decision};
use crate::escape::{markdown, terminal};
use crate::number::{fixed, numeral, significant, spaced};
use crate::table::{Cell, Column, Table};
use crate::wrap::wrapped;

/// Indent of answers below the name of the score, in characters.
const INDENT: usize = 2;

/// Schema of a comparison as JSON. Version 2.1 adds `values`, which lists the values side by side.
pub const COMPARISON_SCHEMA: &str = "taceva.comparison/2.1";

/// Heads of the columns of an answer, after the column of the metric.
const HEAD: [&str; 12] = [
    "channel",
    "A",
    "B",
    "A is",
    "B is",
    "A − B",
    "interval",
    "level",
    "p",
    "p by Holm",
    "unit",
    "answer",
];

/// Confidence level as a share, with enough digits to differ from 1: `0.9983`.
fn level(confidence: f64) -> String {
    let beside = significant(1.0 - confidence).len().saturating_sub(2).max(2);
    fixed(confidence, beside)
}

impl Comparison {
    /// Table with one row for each answer.
    pub fn table(&self) -> Table {
        let columns = [Column::of_metrics()].into_iter();
        let mut table = Table::new("Comparison", columns.chain(HEAD.map(Column::new)));
        for answer in &self.answers {
            table.push(self.row(answer));
        }
        table.note_all(self.rules());
        table
    }

    /// Notes on the statistical method.
    fn rules(&self) -> Vec<String> {
        let differences = self.answers.iter();
        let differences = differences.filter_map(|answer| answer.difference.as_ref());
        let tests: std::collections::BTreeSet<String> = differences
            .map(|difference| difference.test.to_string())
            .collect();
        let rule = "All pairs and channels of a metric form one family. p is for the pair alone. p by Holm is adjusted, so that a family contains a false difference in at most 5 % of cases. The interval has the level of the decision on its pair. \
                    A difference is shown if p by Holm is at most 0.05; only then the interval excludes 0.";
        let mut notes = vec![rule.to_owned()];
        notes.extend(self.notes.iter().map(|note| format!("Note: {note}.")));
        notes.extend(tests.into_iter().map(|test| format!("Test: {test}.")));
        notes
    }

    fn row(&self, answer: &Answer) -> Vec<Cell> {
        let number = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), numeral);
        let apart = answer.scores.a.zip(answer.scores.b).map(|(a, b)| a - b);
        let of_difference = |words: &dyn Fn(&Difference) -> String| {
            let difference = answer.difference.as_ref();
            difference.map_or_else(|| "–".to_owned(), words)
        };
        let of_pair = [
            answer.compared(),
            answer.channel.clone(),
            self.names[answer.sides.a].clone(),
            self.names[answer.sides.b].clone(),
            number(answer.scores.a),
            number(answer.scores.b),
            number(apart),
            of_difference(&|difference| {
                let [low, high] = difference.interval.map(end);
                format!("{low} … {high}")
            }),
            of_difference(&|difference| level(difference.confidence)),
        ];
        let difference = answer.difference.as_ref();
        let alone = difference.map(|difference| difference.p);
        let adjusted = difference.map(|difference| difference.adjusted_p);
        let answered = [answer.unit.to_string(), answer.words(&self.names)];
        let cells = of_pair.into_iter().map(Cell::from);
        let cells = cells.chain([alone, adjusted].map(Cell::p_value));
        cells.chain(answered.map(Cell::from)).collect()
    }

    /// All questions and answers for a terminal, score by score, in lines of at most 100 characters.
    pub fn text(&self) -> String {
        self.text_within(OVERVIEW_WIDTH)
    }

    /// All questions and answers for a terminal, score by score, in lines of at most `width` characters.
    pub fn text_within(&self, width: usize) -> String {
        let below = |text: &str| wrapped(&terminal(text), width, INDENT);
        let mut out = wrapped(&self.summary(), width, 0);
        for decision in self.decisions() {
            out += &below(&decision.line());
        }
        let mut last = String::new();
        for answer in &self.answers {
            let unit = match spaced(answer.unit).trim() {
                "" => String::new(),
                unit => format!(", in {unit}"),
            };
            let heading = format!("{}{unit}", answer.named());
            if heading != last {
                out += &format!("\n{}", wrapped(&terminal(&heading), width, 0));
                last = heading;
            }
            out += &below(&self.line(answer));
        }
        for note in self.rules() {
            out += &format!("\n{}", below(&note));
        }
        out
    }

    /// Summary, most important questions with answers, and all pairs, as Markdown.
    pub fn markdown(&self) -> String {
        let mut out = format!("{}.\n", markdown(&self.summary()));
        let decisions = self.decisions();
        let questions = decisions.iter();
        let questions: Vec<String> = questions
            .map(|decision| format!("- {}\n", markdown(&decision.line())))
            .collect();
        if !questions.is_empty() {
            out += &format!("\n{}", questions.concat());
        }
        match self.answers.is_empty() {
            true => {
                let notes = self.notes.iter();
                out.extend(notes.map(|note| format!("\nNote: {}.\n", markdown(note))));
            }
            false => out += &format!("\n{}", self.table().markdown()),
        }
        out
    }

    /// Values and verdict of a pair on one line: `GelSight 0.041, TacTip 0.053: GelSight better by 0.012 N (99 % 0.004…0.020, p = 0.004); p = 0.001 alone, p = 0.004 by Holm`.
    fn line(&self, answer: &Answer) -> String {
        let number = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), numeral);
        let [a, b] = [answer.sides.a, answer.sides.b].map(|at| self.names[at].as_str());
        let p = answer
            .difference
            .as_ref()
            .map_or_else(String::new, |difference| {
                let [alone, adjusted] = [difference.p, difference.adjusted_p].map(p_words);
                format!("; {alone} alone, {adjusted} by Holm")
            });
        format!(
            "{a} {}, {b} {}: {}{p}",
            number(answer.scores.a),
            number(answer.scores.b),
            answer.words(&self.names)
        )
    }

    /// JSON of [`COMPARISON_SCHEMA`]; an infinite end of an interval is null.
    pub fn json(&self) -> String {
        format!("{:#}\n", self.document())
    }

    /// Content of [`json`](Comparison::json).
    pub(crate) fn document(&self) -> Value {
        let answer = |answer: &Answer| {
            let difference = answer.difference.as_ref().map(|difference| {
                json!({
                    "value": difference.value,
                    "interval": difference.interval.map(|end| end.is_finite().then_some(end)),
                    "level": difference.confidence,
                    "p": difference.p,
                    "p_holm": difference.adjusted_p,
                    "shown": difference.is_shown,
                    "test": difference.test.to_string(),
                    "degrees_of_freedom": freedom(difference.test),
                })
            });
            json!({
                "metric": answer.metric,
                "decided_by": answer.decided_by,
                "better": answer.direction.name(),
                "channel": answer.channel,
                "scores": [answer.scores.a, answer.scores.b],
                "unit": answer.unit.symbol(),
                "a": self.names[answer.sides.a],
                "b": self.names[answer.sides.b],
                "difference": difference,
                "standings": [answer.standings.a.words(), answer.standings.b.words()],
                "winner": answer.better().map(|at| &self.names[at]),
                "answer": answer.words(&self.names),
            })
        };
        let decision = |decision: &Decision| {
            json!({
                "question": decision.question,
                "metric": decision.metric,
                "decided_by": decision.decided_by,
                "channel": decision.channel,
                "better": decision.better.name(),
                "winner": decision.winner.map(|at| &self.names[at]),
                "tied": decision.tied.iter().map(|at| &self.names[*at]).collect::<Vec<_>>(),
                "answer": decision.words,
            })
        };
        let answers: Vec<_> = self.answers.iter().map(answer).collect();
        let decisions: Vec<_> = self.decisions().iter().map(decision).collect();
        json!({
            "schema": COMPARISON_SCHEMA,
            "of": self.names,
            "notes": self.notes,
            "decisions": decisions,
            "answers": answers,
        })
    }
}

/// End of an interval as text. The end may be infinite.
fn end(end: f64) -> String {
    if end.is_finite() {
        numeral(end)
    } else if end < 0.0 {
        "−∞".to_owned()
    } else {
        "∞".to_owned()
    }
}

/// Degrees of freedom of both intervals; `None` for a test that does not use intervals.
fn freedom(test: DifferenceTest) -> Option<[f64; 2]> {
    match test {
        DifferenceTest::Intervals { freedom } => Some([freedom.a, freedom.b]),
        _ => None,
    }
}
