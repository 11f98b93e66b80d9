//! What a comparison decides, in so few lines that they are read.

use taceva_metrics::Better;

use super::{Answer, Comparison};
use crate::figures::listed;
use crate::html::QUESTIONS;
use crate::number::{numeral, significant, spaced};

/// Lines of the first screen.
pub const OVERVIEW_LINES: usize = 12;
/// Letters of a line.
pub(super) const WIDTH: usize = 100;

/// What is asked of one score, and how it is answered.
#[derive(Clone, Debug, PartialEq)]
pub struct Decision {
    /// What is asked: `Depth`; the metric and the channel where nobody gave the question a name.
    pub question: String,
    /// The metric.
    pub metric: String,
    /// The channel or plane.
    pub channel: String,
    /// Which values are good.
    pub better: Better,
    /// The position of the study that is shown to be better than every other one.
    pub winner: Option<usize>,
    /// Who has the best value, what it is, than whom it is shown to be better, and how sure that is.
    pub words: String,
}

impl Decision {
    /// `Depth (mae Pz ↓)`
    pub fn asked(&self) -> String {
        let of = self
            .better
            .beside(&format!("{} {}", self.metric, self.channel));
        if self.question.is_empty() {
            of
        } else {
            format!("{} ({of})", self.question)
        }
    }
}

impl Comparison {
    /// The questions that are asked first, each with its answer: those that have names, or else the first score of each metric. At most
    /// [`OVERVIEW_LINES`] less two.
    pub fn decisions(&self) -> Vec<Decision> {
        const MOST: usize = OVERVIEW_LINES - 2;
        let named = QUESTIONS.iter();
        let named =
            named.filter_map(|(metric, channel, name)| self.decision(name, metric, channel));
        let mut decisions: Vec<Decision> = named.take(MOST).collect();
        if decisions.is_empty() {
            let mut metrics: Vec<&str> = Vec::new();
            for answer in &self.answers {
                if !metrics.contains(&answer.metric.as_str()) && decisions.len() < MOST {
                    metrics.push(&answer.metric);
                    decisions.extend(self.decision("", &answer.metric, &answer.channel));
                }
            }
        }
        decisions
    }

    /// How many answers say what: one line.
    pub fn tally(&self) -> String {
        let all = self.answers.len();
        let shown = self
            .answers
            .iter()
            .filter(|answer| answer.is_shown())
            .count();
        let without = self
            .answers
            .iter()
            .filter(|answer| answer.difference.is_none());
        let without = without.count();
        let kept = all - shown - without;
        format!(
            "{all} pairs of scores: {shown} differ, {kept} are not shown to, {without} have no answer (5 %, by Holm over each metric)"
        )
    }

    /// The first screen: what decides, in at most [`OVERVIEW_LINES`] lines of 100 letters.
    pub fn overview(&self) -> String {
        let decisions = self.decisions();
        let notes = self.notes.iter();
        let notes: Vec<String> = notes
            .map(|note| cut(&crate::escape::terminal(&format!("mind: {note}"))))
            .take(1)
            .collect();
        let most = OVERVIEW_LINES - 2 - notes.len();
        let lines = decisions.iter().take(most).map(|decision| {
            let line = format!("{}: {}", decision.asked(), decision.words);
            cut(&crate::escape::terminal(&line))
        });
        let mut lines: Vec<String> = lines.collect();
        lines.insert(0, cut(&self.tally()));
        lines.extend(notes);
        lines.push("every pair, with both p values and its interval: --all".to_owned());
        lines.join("\n") + "\n"
    }

    fn decision(&self, question: &str, metric: &str, channel: &str) -> Option<Decision> {
        let is_of_it = |answer: &&Answer| answer.metric == metric && answer.channel == channel;
        let answers: Vec<&Answer> = self.answers.iter().filter(is_of_it).collect();
        let better = answers.first()?.direction;
        let valued = values(&answers, |_| true);
        let tested = values(&answers, |answer| answer.difference.is_some());
        let unit = spaced(answers.first()?.unit);
        let (winner, words) = match best(&tested, better) {
            None => (None, untested(&answers, &valued, &self.names)),
            Some((at, value)) => {
                let lost = |answer: &&&Answer| answer.better() == Some(at);
                let won: Vec<&Answer> = answers.iter().filter(lost).copied().collect();
                let other = |answer: &Answer| match answer.sides.a == at {
                    true => answer.sides.b,
                    false => answer.sides.a,
                };
                let losers: Vec<usize> = won.iter().map(|answer| other(answer)).collect();
                let open = valued
                    .iter()
                    .filter(|(rival, _)| *rival != at && !losers.contains(rival));
                let open: Vec<String> = open.map(|(rival, _)| self.names[*rival].clone()).collect();
                let p_values = won.iter().filter_map(|answer| answer.difference.as_ref());
                let p = p_values.fold(0.0_f64, |p, difference| p.max(difference.adjusted_p));
                let start = format!("{}, {}{unit}", self.names[at], numeral(value));
                let p = p_words(p);
                let tie = self
                    .ties
                    .iter()
                    .find(|(of, _)| metric == "sr" && of == channel);
                // Of those that are tied for the best none is shown to be better, whomever else they beat.
                match (losers.len(), open.len(), tie) {
                    (_, _, Some((_, words))) => (None, words.clone()),
                    (0, _, None) => (
                        None,
                        format!("no winner; the best value, {start}, is not shown to be better"),
                    ),
                    (1, 0, None) => (
                        Some(at),
                        format!("{start}, better than {} ({p})", self.names[losers[0]]),
                    ),
                    (count, 0, None) => (
                        Some(at),
                        format!("{start}, better than all {count} others ({p})"),
                    ),
                    (count, _, None) => (
                        None,
                        format!(
                            "{start}, better than {count} of {} others ({p}), not than {}",
                            count + open.len(),
                            listed(&open)
                        ),
                    ),
                }
            }
        };
        Some(Decision {
            question: question.to_owned(),
            metric: metric.to_owned(),
            channel: channel.to_owned(),
            better,
            winner,
            words,
        })
    }
}

impl Answer {
    /// `mae Pz ↓`
    pub(super) fn named(&self) -> String {
        self.direction
            .beside(&format!("{} {}", self.metric, self.channel))
    }

    /// Whether a difference is shown.
    pub(super) fn is_shown(&self) -> bool {
        self.difference
            .as_ref()
            .is_some_and(|difference| difference.is_shown)
    }
}

/// The studies of those answers that are wanted, each once, with their values.
fn values(answers: &[&Answer], is_wanted: impl Fn(&Answer) -> bool) -> Vec<(usize, f64)> {
    let mut values: Vec<(usize, f64)> = Vec::new();
    for answer in answers.iter().filter(|answer| is_wanted(answer)) {
        let sides = [
            (answer.sides.a, answer.scores.a),
            (answer.sides.b, answer.scores.b),
        ];
        for (at, value) in sides {
            let Some(value) = value else { continue };
            if !values.iter().any(|(known, _)| *known == at) {
                values.push((at, value));
            }
        }
    }
    values
}

/// The best of some values; none where values only describe.
fn best(values: &[(usize, f64)], better: Better) -> Option<(usize, f64)> {
    let is_better = |new: f64, old: f64| match better {
        Better::Lower => new < old,
        Better::Higher => new > old,
        Better::NearZero => new.abs() < old.abs(),
        _ => false,
    };
    if better == Better::Described {
        return None;
    }
    let values = values.iter().copied();
    values.reduce(|best, next| {
        if is_better(next.1, best.1) {
            next
        } else {
            best
        }
    })
}

/// Why nothing is decided.
fn untested(answers: &[&Answer], valued: &[(usize, f64)], names: &[String]) -> String {
    let reason = answers.iter().find_map(|answer| answer.reason.as_deref());
    let reason = reason.unwrap_or("no value");
    match valued {
        [] => format!("no answer: {reason}"),
        [(at, _)] => format!("{} alone has a value", names[*at]),
        _ => format!("no winner: {reason}"),
    }
}

/// The largest p value of those that are shown.
fn p_words(p: f64) -> String {
    if p < 0.001 {
        "p < 0.001".to_owned()
    } else {
        format!("p ≤ {}", significant(p))
    }
}

/// A line of at most [`WIDTH`] letters; what is left out is marked.
fn cut(line: &str) -> String {
    if line.chars().count() <= WIDTH {
        return line.to_owned();
    }
    let start: String = line.chars().take(WIDTH - 1).collect();
    format!("{}…", start.trim_end())
}
