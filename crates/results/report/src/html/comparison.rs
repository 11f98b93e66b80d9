//! Comparison as an HTML page.

use maud::{Markup, html};
use taceva_core::{counted, distinct};

use super::{Document, drawn, lead, radars};
use crate::compare::{Answer, Comparison};
use crate::figure::Figure;
use crate::figures::{figures, intervals};
use crate::markup::{fold, folded_glossary, score_link};
use crate::names::listed;
use crate::number::{numeral, spaced};
use crate::results::Study;

impl Comparison {
    /// Figures of `studies`: first the values of each metric of the most important questions, with intervals.
    pub fn figures(&self, studies: &[Study]) -> Vec<Figure> {
        let mut all = self.of_values(studies);
        all.extend(figures(studies));
        all
    }

    /// Figures of the values with intervals, one for each metric of the most important questions.
    fn of_values(&self, studies: &[Study]) -> Vec<Figure> {
        let decisions = self.decisions().into_iter();
        let metrics = distinct(decisions.map(|decision| decision.metric)).into_iter();
        metrics
            .filter_map(|metric| intervals(studies, &metric))
            .collect()
    }

    /// HTML page with decisions, all answers, values with intervals, and radars.
    pub fn page(&self, studies: &[Study]) -> String {
        let mut document = Document::new("Comparison", lead(studies));
        document.section("summary", "Decisions", self.decided());
        document.section("answers", "Every pair", self.pairs());
        let of_values = self.of_values(studies);
        if !of_values.is_empty() {
            let figures = html! { @for figure in &of_values { (drawn(figure)) } };
            document.section("values", "Values with intervals", figures);
        }
        if let Some(radars) = radars(&figures(studies)) {
            document.section("figures", "Side by side", radars);
        }
        let named = self.answers.iter().map(|answer| answer.metric.as_str());
        document.section("meanings", "What the metrics mean", folded_glossary(named));
        document.finish()
    }

    /// Most important questions with answers, as HTML.
    fn decided(&self) -> Markup {
        html! {
            p { (self.summary()) "." } "\n"
            ul.verdicts {
                @for decision in self.decisions() {
                    @let of = score_link(&decision.metric, &decision.channel);
                    li {
                        @if decision.question.is_empty() { strong { (of) } } @else { strong { (decision.question) } " (" (of) ")" }
                        @if let Some(variant) = &decision.decided_by { ", decided by " code { (decision.metric) "." (variant) } }
                        ": " (decision.words)
                    } "\n"
                }
            } "\n"
        }
    }

    /// Folded lists of significant differences by score, and of all answers.
    fn pairs(&self) -> Markup {
        let (won, table) = (self.won(), self.table().html_with_links());
        let shown = html! { ul.verdicts { @for won in &won { (won.html(&self.names)) } } };
        html! {
            @if won.is_empty() && self.answers.iter().any(Answer::is_shown) {
                p { "None of " (listed(&self.names)) " is called better; each answer says why." } "\n"
            } @else if won.is_empty() {
                p { "No difference is shown between " (listed(&self.names)) "." } "\n"
            } @else {
                (fold("shown-all", "All differences that are shown", &counted(won.len(), "line"), &shown))
            }
            (fold("answers-all", "Every answer", &counted(self.answers.len(), "answer"), &table))
        }
    }

    /// Significant differences by score, each with the better study and the worse studies.
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

/// Answers about one score in which the same study is better.
struct Won<'a> {
    winner: usize,
    /// Answers about the score; at least one answer.
    answers: Vec<&'a Answer>,
}

impl Won<'_> {
    /// Line of a list: `mae Fz: MagicTac is better than ViTacTip (0.092 and 0.17 N) and GelSight (0.092 and 0.3 N)`.
    fn html(&self, names: &[String]) -> Markup {
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
        html! {
            li { (score_link(&of.metric, &of.channel)) ": " strong { (names[self.winner]) } " is better than " (listed(&others)) } "\n"
        }
    }
}
