//! Comparisons as a page.

use super::{Answer, Comparison};
use crate::escape::html;
use crate::figures::{figures, listed};
use crate::html::{Document, counted, figure, fold, folded_glossary, lead, score_link};
use crate::number::{numeral, spaced};
use crate::results::Study;

impl Comparison {
    /// As a page: what is shown, every answer, and the sensors side by side.
    pub fn page(&self, studies: &[Study]) -> String {
        let mut document = Document::new("Comparison");
        document.lead(&lead(studies));
        let decisions = self.decisions();
        let lines: String = decisions
            .iter()
            .map(|decision| {
                let of = score_link(&decision.metric, &decision.channel);
                let asked = match decision.question.as_str() {
                    "" => format!("<strong>{of}</strong>"),
                    question => format!("<strong>{}</strong> ({of})", html(question)),
                };
                format!("<li>{asked}: {}</li>\n", html(&decision.words))
            })
            .collect();
        let counts = html(&self.summary());
        let summary = format!("<p>{counts}.</p>\n<ul class=\"verdicts\">\n{lines}</ul>\n");
        document.section("summary", "Decisions", &summary);
        document.section("answers", "Every pair", &self.pairs());
        let radars: String = figures(studies)
            .iter()
            .filter(|drawn| drawn.id.starts_with("radar"))
            .map(figure)
            .collect();
        if !radars.is_empty() {
            let radars = format!("<div class=\"radars\">\n{radars}</div>\n");
            document.section("figures", "Side by side", &radars);
        }
        let named = self.answers.iter().map(|answer| answer.metric.as_str());
        document.section("meanings", "What the metrics mean", &folded_glossary(named));
        document.finish()
    }
}

impl Comparison {
    /// What is shown, score by score, and every answer, both folded.
    fn pairs(&self) -> String {
        let lines: String = self.won().iter().map(|won| won.html(&self.names)).collect();
        let shown = if lines.is_empty() {
            format!(
                "<p>No difference is shown between {}.</p>\n",
                html(&listed(&self.names))
            )
        } else {
            let list = format!("<ul class=\"verdicts\">\n{lines}</ul>");
            let holds = counted(self.won().len(), "line");
            fold("shown-all", "All differences that are shown", &holds, &list)
        };
        let table = self.table().html_with_links();
        let holds = counted(self.answers.len(), "answer");
        format!(
            "{shown}{}",
            fold("answers-all", "Every answer", &holds, &table)
        )
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
            "<li>{}: <strong>{}</strong> is better than {}</li>\n",
            score_link(&of.metric, &of.channel),
            html(&names[self.winner]),
            html(&listed(&others))
        )
    }
}
