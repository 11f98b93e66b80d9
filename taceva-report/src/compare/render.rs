//! Comparisons as rows, as JSON and as a page.

use serde_json::json;

use super::{Answer, Comparison};
use crate::escape::html;
use crate::figures::{figures, listed};
use crate::html::{Document, figure, lead};
use crate::listing::Listing;
use crate::number::{numeral, significant, spaced};
use crate::results::Study;

/// Answers that a page shows at once.
const MANY: usize = 80;

/// The schema of a comparison as JSON.
pub const COMPARISON_SCHEMA: &str = "taceva.comparison/1";

impl Comparison {
    /// A row an answer.
    pub fn listing(&self) -> Listing {
        let head = [
            "metric", "channel", "A", "B", "A is", "B is", "A − B", "95 %", "p", "unit", "answer",
        ];
        let mut listing = Listing::new("Comparison", &head);
        listing.rows = self.answers.iter().map(|answer| self.row(answer)).collect();
        let tests: std::collections::BTreeSet<String> = self
            .answers
            .iter()
            .filter_map(|answer| {
                answer
                    .difference
                    .map(|difference| difference.test.to_string())
            })
            .collect();
        listing.notes = vec![
            "p values are adjusted by Holm's method over all pairs and channels of a metric; answers are given at a level of 5 %.".to_owned(),
        ];
        listing
            .notes
            .extend(tests.into_iter().map(|test| format!("Test: {test}.")));
        listing
    }

    fn row(&self, answer: &Answer) -> Vec<String> {
        let number = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), numeral);
        let apart = answer.scores.a.zip(answer.scores.b).map(|(a, b)| a - b);
        let interval = answer.difference.map_or_else(
            || "–".to_owned(),
            |difference| {
                let [low, high] = difference.interval.map(numeral);
                format!("{low} … {high}")
            },
        );
        vec![
            answer.metric.clone(),
            answer.channel.clone(),
            self.names[answer.sides.a].clone(),
            self.names[answer.sides.b].clone(),
            number(answer.scores.a),
            number(answer.scores.b),
            number(apart),
            interval,
            answer
                .difference
                .map_or_else(|| "–".to_owned(), |difference| significant(difference.p)),
            answer.unit.to_string(),
            answer.words(&self.names),
        ]
    }

    /// As JSON of [`COMPARISON_SCHEMA`].
    pub fn json(&self) -> String {
        let answer = |answer: &Answer| {
            let difference = answer.difference.map(|difference| {
                json!({
                    "value": difference.value,
                    "ci95": difference.interval,
                    "p": difference.p,
                    "test": difference.test.to_string(),
                })
            });
            json!({
                "metric": answer.metric,
                "channel": answer.channel,
                "scores": [answer.scores.a, answer.scores.b],
                "unit": answer.unit.symbol(),
                "a": self.names[answer.sides.a],
                "b": self.names[answer.sides.b],
                "difference": difference,
                "better": answer.better().map(|at| &self.names[at]),
                "answer": answer.words(&self.names),
            })
        };
        let answers: Vec<_> = self.answers.iter().map(answer).collect();
        let whole = json!({"schema": COMPARISON_SCHEMA, "of": self.names, "answers": answers});
        format!("{whole:#}\n")
    }

    /// As a page: what is shown, every answer, and the sensors side by side.
    pub fn page(&self, studies: &[Study]) -> String {
        let mut document = Document::new("Comparison");
        document.lead(&lead(studies));
        let lines: String = self.won().iter().map(|won| won.html(&self.names)).collect();
        let summary = match lines.is_empty() {
            true => format!(
                "<p>No difference is shown between {}.</p>",
                html(&listed(&self.names))
            ),
            false => format!("<ul class=\"verdicts\">{lines}</ul>"),
        };
        document.section("summary", "What is shown to differ", &summary);
        document.section("answers", "Every pair", &self.pairs());
        let radars: String = figures(studies)
            .iter()
            .filter(|drawn| drawn.id.starts_with("radar"))
            .map(figure)
            .collect();
        if !radars.is_empty() {
            document.section("figures", "Side by side", &radars);
        }
        document.finish()
    }
}

impl Comparison {
    /// Every answer; folded where they are more than a reader goes through.
    fn pairs(&self) -> String {
        let table = self.listing().html();
        match self.answers.len() {
            0..=MANY => table,
            count => {
                format!("<details><summary>All {count} answers</summary>\n{table}</details>\n")
            }
        }
    }

    /// What is shown, score by score: who is better, and than whom.
    fn won(&self) -> Vec<Won<'_>> {
        let mut all: Vec<Won<'_>> = Vec::new();
        for answer in &self.answers {
            let Some(winner) = answer.better() else {
                continue;
            };
            let is_same = |won: &&mut Won<'_>| {
                let of = won.answers[0];
                won.winner == winner && of.metric == answer.metric && of.channel == answer.channel
            };
            match all.iter_mut().find(is_same) {
                Some(won) => won.answers.push(answer),
                None => all.push(Won {
                    winner,
                    answers: vec![answer],
                }),
            }
        }
        all
    }
}

/// The answers by which one study is better than others, all of one metric and channel.
struct Won<'a> {
    winner: usize,
    /// At least one.
    answers: Vec<&'a Answer>,
}

impl Won<'_> {
    /// `mae Fz: MagicTac is better than ViTacTip (0.092 and 0.17 N) and GelSight (0.092 and 0.3 N)`.
    fn html(&self, names: &[String]) -> String {
        let of = self.answers[0];
        let than = |answer: &&Answer| {
            let (loser, [own, other]) = match answer.sides.a == self.winner {
                true => (answer.sides.b, [answer.scores.a, answer.scores.b]),
                false => (answer.sides.a, [answer.scores.b, answer.scores.a]),
            };
            let scores = own.zip(other).map_or_else(String::new, |(own, other)| {
                let unit = spaced(answer.unit);
                format!(" ({} and {}{unit})", numeral(own), numeral(other))
            });
            format!("{}{scores}", names[loser])
        };
        let others: Vec<String> = self.answers.iter().map(than).collect();
        format!(
            "<li><code>{}</code> {}: <strong>{}</strong> is better than {}</li>\n",
            html(&of.metric),
            html(&of.channel),
            html(&names[self.winner]),
            html(&listed(&others))
        )
    }
}
