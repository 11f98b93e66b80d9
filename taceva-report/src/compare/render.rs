//! Comparisons as rows, as JSON and as a page.

use serde_json::json;

use super::{Answer, Comparison};
use crate::escape::html;
use crate::figures::{figures, listed};
use crate::html::{Document, figure, lead};
use crate::listing::Listing;
use crate::number::{numeral, significant};
use crate::results::Study;

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
        let mut lines = String::new();
        for answer in &self.answers {
            let (Some(better), [a, b]) = (answer.better(), [answer.sides.a, answer.sides.b]) else {
                continue;
            };
            let words = answer.verdict.to_string();
            let words = words.strip_prefix("A ").unwrap_or(&words);
            let [a, b, better] = [a, b, better].map(|at| html(&self.names[at]));
            lines += &format!(
                "<li><code>{}</code> {}: <strong>{better}</strong> is better; {a} is {} than {b}</li>\n",
                html(&answer.metric),
                html(&answer.channel),
                html(words)
            );
        }
        let summary = match lines.is_empty() {
            true => format!(
                "<p>No difference is shown between {}.</p>",
                html(&listed(&self.names))
            ),
            false => format!("<ul class=\"verdicts\">{lines}</ul>"),
        };
        document.section("summary", "What is shown to differ", &summary);
        document.section("answers", "Every pair", &self.listing().html());
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
