//! Overview of the decisions of a comparison.

use std::collections::BTreeMap;

use taceva_core::{by_count, counted};
use taceva_metrics::{Better, Standing, Verdict, p_words};
use taceva_results::full_name;

use super::{Answer, Comparison, Remarks};
use crate::names::listed;
use crate::number::{numeral, spaced};
use crate::tie::best;
use crate::training::NO_VERDICT;
use crate::wrap::wrapped;

/// Greatest number of lines in [`Comparison::overview`] before wrapping.
pub const OVERVIEW_LINES: usize = 12;
/// Greatest number of characters in a terminal line.
pub const OVERVIEW_WIDTH: usize = 100;

/// Most important questions about sensors: metric, channel, and words of the question.
pub(crate) const QUESTIONS: [(&str, &str, &str); 10] = [
    ("mae", "Pz", "Depth"),
    ("mae", "Pxy", "Position in the plane"),
    ("mae", "Fz", "Normal force"),
    ("mae", "Fxy", "Shear force"),
    ("sr", "line", "Fine lines"),
    ("sr", "dot", "Fine dots"),
    ("uniformity", "Fz", "Uniformity of the surface"),
    ("r_light", "Fz", "Force in changing light"),
    ("repeatability", "Pz", "Repeated depth"),
    ("hysteresis", "Fz", "Hysteresis"),
];

/// Question about one score, with the answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Decision {
    /// Words of the question: `Depth`; empty for scores without words.
    pub question: String,
    /// Name of the metric.
    pub metric: String,
    /// Channel or plane of the score, such as `Fz` or `Fxy`.
    pub channel: String,
    /// Deciding variant of the metric; `None` for the value itself.
    pub decided_by: Option<String>,
    /// Better direction of the values.
    pub better: Better,
    /// Position of the study that is significantly better than all other studies; `None` if there is no such study.
    pub winner: Option<usize>,
    /// Positions of the studies with exactly equal best values; empty without a tie.
    pub tied: Vec<usize>,
    /// Answer as text: best study with its value, significantly worse studies, and p value.
    pub words: String,
}

impl Decision {
    /// Question with its score: `Depth (mae Pz ↓)`.
    pub fn asked(&self) -> String {
        let metric = full_name(&self.metric, self.decided_by.as_deref());
        let of = self.better.beside(&format!("{metric} {}", self.channel));
        if self.question.is_empty() {
            of
        } else {
            format!("{} ({of})", self.question)
        }
    }

    /// Question and answer on one line: `Depth (mae Pz ↓): GelSight, 0.056 mm, better than all 3 others (p < 0.001)`.
    pub(super) fn line(&self) -> String {
        format!("{}: {}", self.asked(), self.words)
    }
}

impl Comparison {
    /// Most important questions with answers: each question with words, and the first score of each other requested metric. Without such questions, the first
    /// score of each metric.
    pub fn decisions(&self) -> Vec<Decision> {
        let named = QUESTIONS.iter();
        let named =
            named.filter_map(|(metric, channel, name)| self.decision(name, metric, channel));
        let mut decisions: Vec<Decision> = named.collect();
        let is_unnamed = decisions.is_empty();
        for answer in &self.answers {
            let metric = &answer.metric;
            let is_known = decisions.iter().any(|decision| decision.metric == *metric);
            if !is_known && (is_unnamed || self.asked.contains(metric)) {
                decisions.extend(self.decision("", metric, &answer.channel));
            }
        }
        decisions
    }

    /// Numbers of pairs by verdict, on one line.
    pub fn summary(&self) -> String {
        let all = self.answers.len();
        if all == 0 {
            return match self.asked.is_empty() {
                true => "No test is possible: no two of these results share a score with a better direction",
                false => "Nothing to compare: no two results share a requested score with a better direction",
            }
            .to_owned();
        }
        let shown = self
            .answers
            .iter()
            .filter(|answer| answer.is_shown())
            .count();
        let equivalent = self.answers.iter().filter(|answer| answer.is_equivalent());
        let equivalent = equivalent.count();
        let mut causes: BTreeMap<&str, usize> = BTreeMap::new();
        for answer in &self.answers {
            if answer.difference.is_none() {
                *causes.entry(answer.cause()).or_default() += 1;
            }
        }
        let without: usize = causes.values().sum();
        let causes = causes
            .iter()
            .map(|(cause, count)| format!("{} ({count})", crate::escape::terminal(cause)));
        let causes: Vec<String> = causes.collect();
        let why = match causes.is_empty() {
            true => String::new(),
            false => format!(": {}", causes.join(", ")),
        };
        let kept = all - shown - without - equivalent;
        let number =
            |count: usize, one: &str, more: &str| format!("{count} {}", by_count(count, one, more));
        let pairs = counted(all, "pair");
        let shown = number(shown, "differs", "differ");
        let others = [
            (
                equivalent,
                "is equivalent within the margin",
                "are equivalent within the margin",
            ),
            (kept, "is not shown to differ", "are not shown to differ"),
            (without, "cannot be tested", "cannot be tested"),
        ];
        let others = others.iter().filter(|(count, ..)| *count > 0);
        let others = others.map(|(count, one, more)| format!(", {}", number(*count, one, more)));
        let others: String = others.collect();
        format!("{pairs} of scores: {shown}{others}{why} (5 %, Holm-corrected per metric)")
    }

    /// Most important questions with answers, in at most [`OVERVIEW_LINES`] lines before wrapping. Wraps lines between words to `width` characters, if given.
    /// Counts the omitted questions.
    pub fn overview(&self, width: Option<usize>) -> String {
        let line = |words: &str| {
            let words = crate::escape::terminal(words);
            match width {
                Some(width) => wrapped(&words, width, 0),
                None => format!("{words}\n"),
            }
        };
        let notes = self.notes.iter().take(2);
        let notes: Vec<String> = notes.map(|note| line(&format!("note: {note}"))).collect();
        let room = OVERVIEW_LINES - 2 - notes.len();
        let decisions = self.decisions();
        let more = match decisions.len().saturating_sub(room) {
            0 => String::new(),
            more => format!("{}, and ", counted(more, "more question")),
        };
        let mut lines = vec![line(&self.summary())];
        lines.extend(decisions.iter().take(room).map(|of| line(&of.line())));
        lines.extend(notes);
        if !self.answers.is_empty() {
            let every = "every pair, with both p values and its interval: --all";
            lines.push(line(&format!("{more}{every}")));
        }
        lines.concat()
    }

    fn decision(&self, question: &str, metric: &str, channel: &str) -> Option<Decision> {
        let is_of_it = |answer: &&Answer| answer.metric == metric && answer.channel == channel;
        let answers: Vec<&Answer> = self.answers.iter().filter(is_of_it).collect();
        let better = answers.first()?.direction;
        let decided_by = answers.first()?.decided_by.clone();
        let unit = spaced(answers.first()?.unit);
        let is_of_score = |aside: &&Remarks| aside.metric == metric && aside.channel == channel;
        let aside = self.asides.iter().find(is_of_score)?;
        let is_barred = |at: usize| aside.barred.iter().any(|(barred, _)| *barred == at);
        let answers = answers.into_iter();
        let answers: Vec<&Answer> = answers
            .filter(|answer| !is_barred(answer.sides.a) && !is_barred(answer.sides.b))
            .collect();
        let valued = values(&answers, |_| true);
        let tested = values(&answers, |answer| answer.difference.is_some());
        let (winner, words) = match (best(tested, better), &aside.tie) {
            // Studies tied for the best value are not winners, even if they beat others.
            (_, Some(tie)) => {
                let others = valued.iter().map(|(at, _)| *at);
                let unbeaten = tie.unbeaten(&answers, others, &self.names);
                (None, format!("{}{unbeaten}", tie.words))
            }
            (None, None) if answers.is_empty() => (None, "no verdict".to_owned()),
            (None, None) => (None, untested(metric, &answers, &valued, &self.names)),
            (Some((at, value)), None) if aside.is_demonstration => (
                None,
                format!(
                    "{} has the best value, but {NO_VERDICT}, with {}{unit}",
                    self.names[at],
                    numeral(value)
                ),
            ),
            (Some((at, value)), None) => {
                let lost = |answer: &&&Answer| answer.better() == Some(at);
                let won: Vec<&Answer> = answers.iter().filter(lost).copied().collect();
                let other = |answer: &Answer| match answer.sides.a == at {
                    true => answer.sides.b,
                    false => answer.sides.a,
                };
                let losers: Vec<usize> = won.iter().map(|answer| other(answer)).collect();
                let equals = answers.iter().filter(|answer| answer.is_equivalent());
                let equals = equals.filter(|answer| [answer.sides.a, answer.sides.b].contains(&at));
                let equals: Vec<&Answer> = equals.copied().collect();
                let equal: Vec<usize> = equals.iter().map(|answer| other(answer)).collect();
                let open = valued.iter().filter(|(rival, _)| {
                    *rival != at && !losers.contains(rival) && !equal.contains(rival)
                });
                let open: Vec<String> = open.map(|(rival, _)| self.names[*rival].clone()).collect();
                let start = format!("{}, {}{unit}", self.names[at], numeral(value));
                let p = largest_p(&won);
                let alike = self.equivalent(&equals, &equal);
                match (losers.len(), open.len()) {
                    // A row has one decision, so an equivalence is not reported as undecided too.
                    (0, 0) if !equal.is_empty() => (
                        None,
                        format!("no winner; the best value, {start}, is {alike}"),
                    ),
                    (0, _) if !equal.is_empty() => (
                        None,
                        format!(
                            "no winner; the best value, {start}, is {alike}, undecided against {}",
                            listed(&open)
                        ),
                    ),
                    (count, _) if !equal.is_empty() => {
                        let open = match open.as_slice() {
                            [] => String::new(),
                            open => format!(", undecided against {}", listed(open)),
                        };
                        let words = format!(
                            "{start}, better than {count} of {} others ({p}), {alike}{open}",
                            valued.len().saturating_sub(1)
                        );
                        (None, words)
                    }
                    (0, _) => (
                        None,
                        format!("no winner; the best value, {start}, is not shown to be better"),
                    ),
                    (1, 0) => (
                        Some(at),
                        format!("{start}, better than {} ({p})", self.names[losers[0]]),
                    ),
                    (count, 0) => (
                        Some(at),
                        format!("{start}, better than all {count} others ({p})"),
                    ),
                    (count, _) => (
                        None,
                        format!(
                            "{start}, better than {count} of {} others ({p}), undecided against {}",
                            count + open.len(),
                            listed(&open)
                        ),
                    ),
                }
            }
        };
        let barred = aside.barred.iter().map(|(_, words)| format!("; {words}"));
        let reach = answers.iter().find_map(|answer| answer.unreachable());
        let reach = reach.map_or_else(String::new, |reason| format!("; {reason}"));
        let barred: String = barred.collect();
        let words = format!("{words}{reach}{}{barred}", aside.spread);
        let tied = aside.tie.as_ref().map(|tie| tie.who.clone());
        Some(Decision {
            tied: tied.unwrap_or_default(),
            question: question.to_owned(),
            metric: metric.to_owned(),
            channel: channel.to_owned(),
            decided_by,
            better,
            winner,
            words,
        })
    }
}

impl Comparison {
    /// Clause on equivalent studies: `equivalent to GelSight and TacTip within 0.05 N`.
    fn equivalent(&self, answers: &[&Answer], who: &[usize]) -> String {
        let names: Vec<String> = who.iter().map(|at| self.names[*at].clone()).collect();
        let margin = answers.iter().find_map(|answer| match &answer.verdict {
            Verdict::Equivalent { margin, unit, .. } => Some(format!("{margin}{}", spaced(*unit))),
            _ => None,
        });
        format!(
            "equivalent to {} within {}",
            listed(&names),
            margin.unwrap_or_default()
        )
    }
}

impl Answer {
    /// True if the verdict is equivalence within the margin.
    fn is_equivalent(&self) -> bool {
        matches!(self.verdict, Verdict::Equivalent { .. })
    }

    /// Short reason why the pair was not tested: `not better than predicting the mean`.
    fn cause(&self) -> &str {
        let sides = [self.standings.a, self.standings.b];
        let barred = sides.into_iter().find(|standing| !standing.takes_part());
        let words = barred.and_then(Standing::phrase);
        let words = words.or(self.reason.as_deref()).unwrap_or("no value");
        words.split([':', '(']).next().unwrap_or(words).trim_end()
    }

    /// Score with its direction: `mae Pz ↓`, or `repeatability.pooled Pz ↓` for a compared variant.
    pub(super) fn named(&self) -> String {
        let metric = self.compared();
        self.direction.beside(&format!("{metric} {}", self.channel))
    }

    /// Metric, with the variant if compared: `mae`, or `repeatability.pooled`.
    pub(super) fn compared(&self) -> String {
        full_name(&self.metric, self.decided_by.as_deref())
    }

    /// True for a significant difference beyond the margin.
    pub(crate) fn is_shown(&self) -> bool {
        matches!(self.verdict, Verdict::Differs { .. })
    }
}

/// Studies of the selected answers, each once, with their values.
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

/// Reason why there is no decision.
fn untested(
    metric: &str,
    answers: &[&Answer],
    valued: &[(usize, f64)],
    names: &[String],
) -> String {
    let reason = answers.iter().find_map(|answer| answer.reason.as_deref());
    match valued {
        [] => format!("no answer: {}", reason.unwrap_or("no value")),
        [(at, _)] => format!("only {} has a value", names[*at]),
        _ => {
            let undirected = match Better::of(metric) {
                Some(_) => "the score is neither good nor bad by itself",
                None => "this version of TacEva does not know which values are better",
            };
            let reason = reason.unwrap_or(undirected);
            format!("no winner: {reason}")
        }
    }
}

/// Largest p value of the significant differences `won`, as text: `p = 0.012`, or `largest p = 0.012` for several differences.
fn largest_p(won: &[&Answer]) -> String {
    let p_values = won.iter().filter_map(|answer| answer.difference.as_ref());
    let largest = p_values.fold(0.0_f64, |p, difference| p.max(difference.adjusted_p));
    let words = p_words(largest);
    match won.len() > 1 && words.contains('=') {
        true => format!("largest {words}"),
        false => words,
    }
}
