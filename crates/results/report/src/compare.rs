//! Whether sensors or models differ: every pair, every score, with intervals and in words.

mod comparability;
mod estimate;
mod overview;
mod paired;
mod remarks;
mod render;
mod ties;

pub(crate) use overview::QUESTIONS;
pub use overview::{Decision, OVERVIEW_LINES, OVERVIEW_WIDTH};
pub use render::COMPARISON_SCHEMA;
pub use ties::ties;

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::Unit;
use taceva_metrics::{
    Better, ComparisonError, Difference, Question, Side, Sides, Standing, Verdict, by_intervals,
    decide,
};

use crate::names::listed;
use crate::results::Study;
use remarks::Remarks;
use taceva_results::Score;

/// What to compare, and how.
#[derive(Clone, Debug, Default)]
pub struct CompareRequest {
    /// The metrics that are compared; all that are one number and better on one side, if empty.
    pub metrics: Vec<String>,
    /// How far apart scores may be and still count as equal, by `mae` or `mae.Fz`; the longer name comes first.
    pub margins: BTreeMap<String, f64>,
    /// The seed of the random signs of the sign-flip test.
    pub seed: u64,
}

/// One answer for each pair of studies and each score that both have, metric by metric.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// The names of the studies, in their order.
    pub names: Vec<String>,
    /// Every pair of studies that have the same score.
    pub answers: Vec<Answer>,
    /// What a reader must know before comparing them.
    pub notes: Vec<String>,
    /// Remarks on the verdicts, by score.
    asides: Vec<Remarks>,
}

/// One score of two studies.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The metric.
    pub metric: String,
    /// The channel or plane.
    pub channel: String,
    /// Whether lower or higher scores are better.
    pub direction: Better,
    /// The variant of the metric that was compared; `None` where it is the value itself.
    pub decided_by: Option<String>,
    /// The unit of both scores.
    pub unit: Unit,
    /// Both scores, where they are numbers.
    pub scores: Sides<Option<f64>>,
    /// The positions of both studies.
    pub sides: Sides<usize>,
    /// What it says: decided by Holm's procedure among all pairs and channels of the metric.
    pub verdict: Verdict,
    /// The difference behind it, if there is one, with both p values and the interval of the same decision.
    pub difference: Option<Difference>,
    /// Why there is no answer.
    pub reason: Option<String>,
    /// Whether each score takes part in verdicts, and if not, why.
    pub standings: Sides<Standing>,
    /// Whether each score is of one training of a model that draws, so that another seed would move it.
    pub one_training: Sides<bool>,
}

impl Answer {
    /// What it says with the names of the studies in the place of A and B: `MagicTac better by …`.
    pub fn words(&self, names: &[String]) -> String {
        match &self.reason {
            Some(reason) => format!("no answer: {reason}"),
            None => {
                let words = self.verdict.words(Sides {
                    a: &names[self.sides.a],
                    b: &names[self.sides.b],
                });
                let unknown = self.unknown(names);
                let words = match unknown.is_empty() {
                    true => words,
                    false => format!("{words}; skill unknown of {}", unknown.join(" and ")),
                };
                let drawn = self.drawn(names);
                match drawn.is_empty() || self.better().is_none() {
                    true => words,
                    false => format!("{words}; one training of {}", drawn.join(" and ")),
                }
            }
        }
    }

    /// The studies for which the skill of the model is unknown.
    fn unknown<'n>(&self, names: &'n [String]) -> Vec<&'n str> {
        let sides = [
            (self.standings.a, self.sides.a),
            (self.standings.b, self.sides.b),
        ];
        let unknown = sides
            .into_iter()
            .filter(|(standing, _)| *standing == Standing::SkillUnknown);
        unknown.map(|(_, at)| names[at].as_str()).collect()
    }

    /// The studies of which one training of a model that draws was scored.
    fn drawn<'n>(&self, names: &'n [String]) -> Vec<&'n str> {
        let sides = [
            (self.one_training.a, self.sides.a),
            (self.one_training.b, self.sides.b),
        ];
        let drawn = sides.into_iter().filter(|(is_drawn, _)| *is_drawn);
        drawn.map(|(_, at)| names[at].as_str()).collect()
    }

    /// The position of the study that is shown to be better.
    pub fn better(&self) -> Option<usize> {
        match self.verdict.better()? {
            Side::A => Some(self.sides.a),
            Side::B => Some(self.sides.b),
        }
    }
}

/// A pair before its p value is adjusted.
struct Pair<'a> {
    scores: Sides<&'a Score>,
    sides: Sides<usize>,
    difference: Result<Difference, String>,
    /// The reason why two predictions of one truth were not compared in pairs, in words.
    unpaired: Option<String>,
}

/// Compares every pair of `studies`.
///
/// The mean absolute error is compared sample by sample where both studies predict the same samples (the sign-flip test, by contact point);
/// everything else by the intervals of both, on their own scales. The pairs and channels of one metric are one family of Holm's
/// procedure: verdict, p value and interval of an answer come from that one decision.
///
/// Where a metric names a variant by which verdicts go (`excess` of `r_spatial`, `debiased` of `uniformity`, `pooled` of `repeatability`), that is
/// what is compared, and its values stand in the answers.
pub fn compare(studies: &[Study], request: &CompareRequest) -> Comparison {
    let names = crate::names::names(studies);
    let deciding: Vec<Study> = studies.iter().map(Study::deciding).collect();
    let studies = deciding.as_slice();
    let mut answers = Vec::new();
    let mut unpaired: Vec<String> = Vec::new();
    for metric in metrics(studies, request) {
        let mut pairs = pairs(studies, &names, &metric, request);
        decide_together(&mut pairs);
        for reason in pairs.iter_mut().filter_map(|pair| pair.unpaired.take()) {
            if !unpaired.contains(&reason) {
                unpaired.push(reason);
            }
        }
        answers.extend(pairs.into_iter().map(|pair| answer(pair, studies, request)));
    }
    Comparison {
        asides: asides(studies, &names, &answers),
        notes: comparability::notes(studies, &names)
            .into_iter()
            .chain(simulated(studies))
            .chain(trainings(&names, &answers))
            .chain(unpaired)
            .collect(),
        names,
        answers,
    }
}

/// That nothing, or not everything, was measured.
fn simulated(studies: &[Study]) -> Option<String> {
    let simulated = studies.iter().filter(|study| study.is_simulated()).count();
    match simulated {
        0 => None,
        _ if simulated == studies.len() => {
            Some("the samples are simulated: nothing here was measured".to_owned())
        }
        _ => Some("some of the samples are simulated and were not measured".to_owned()),
    }
}

/// Whose differences rest on one training of a model that draws, with the way to try others.
fn trainings(names: &[String], answers: &[Answer]) -> Option<String> {
    let shown = answers.iter().filter(|answer| answer.better().is_some());
    let drawn: BTreeSet<&str> = shown.flat_map(|answer| answer.drawn(names)).collect();
    let drawn: Vec<String> = drawn.into_iter().map(str::to_owned).collect();
    (!drawn.is_empty()).then(|| {
        format!(
            "differences rest on one training of {}: another seed moves them, which no interval contains; repeat with --seeds 3",
            listed(&drawn)
        )
    })
}

/// Remarks on the answers, by score.
fn asides(studies: &[Study], names: &[String], answers: &[Answer]) -> Vec<Remarks> {
    let mut asides: Vec<Remarks> = Vec::new();
    for Answer {
        metric, channel, ..
    } in answers
    {
        let is_known = |aside: &Remarks| aside.metric == *metric && aside.channel == *channel;
        if !asides.iter().any(is_known) {
            asides.push(Remarks::of(studies, names, metric, channel));
        }
    }
    asides
}

/// The metrics that are asked for and that some study has, in the order of the first.
fn metrics(studies: &[Study], request: &CompareRequest) -> Vec<String> {
    let mut metrics: Vec<String> = Vec::new();
    for score in studies.iter().flat_map(|study| &study.scores) {
        let is_wanted = if request.metrics.is_empty() {
            score.better() != Better::Described
        } else {
            request.metrics.contains(&score.metric)
        };
        if is_wanted && !metrics.contains(&score.metric) {
            metrics.push(score.metric.clone());
        }
    }
    metrics
}

fn pairs<'a>(
    studies: &'a [Study],
    names: &[String],
    metric: &str,
    request: &CompareRequest,
) -> Vec<Pair<'a>> {
    let mut pairs = Vec::new();
    for (a, study) in studies.iter().enumerate() {
        for score in study.scores.iter().filter(|score| score.metric == metric) {
            for (b, other) in studies.iter().enumerate().skip(a + 1) {
                let Some(of_other) = other.score(metric, &score.channel) else {
                    continue;
                };
                let scores = Sides {
                    a: score,
                    b: of_other,
                };
                let of_both = Sides {
                    a: names[a].as_str(),
                    b: &names[b],
                };
                let of_studies = Sides { a: study, b: other };
                let (difference, unpaired) = match comparability::barred(scores, of_both) {
                    Some(reason) => (Err(reason), None),
                    None => difference(scores, of_studies, of_both, request.seed),
                };
                pairs.push(Pair {
                    scores,
                    sides: Sides { a, b },
                    difference,
                    unpaired,
                });
            }
        }
    }
    pairs
}

/// The difference of two scores, with the reason why two predictions of one truth were not compared in pairs.
fn difference(
    scores: Sides<&Score>,
    studies: Sides<&Study>,
    names: Sides<&str>,
    seed: u64,
) -> (Result<Difference, String>, Option<String>) {
    let paired = match scores.a.metric.as_str() {
        "mae" => paired::difference(scores, studies, names, seed),
        _ => Err(None),
    };
    let unpaired = match paired {
        Ok(paired) => return (paired.map_err(|error| error.to_string()), None),
        Err(reason) => reason.map(|reason| {
            format!(
                "{} and {} are not compared in pairs, though both are of one truth: {reason}",
                names.a, names.b
            )
        }),
    };
    let difference = estimate::of_both(scores)
        .and_then(|both| by_intervals(both).map_err(|error| error.to_string()));
    (difference, unpaired)
}

/// Decides about those pairs that were tested.
fn decide_together(pairs: &mut [Pair<'_>]) {
    let tested = pairs.iter();
    let tested = tested.filter_map(|pair| pair.difference.as_ref().ok().cloned());
    let mut family: Vec<Difference> = tested.collect();
    decide(&mut family);
    let mut family = family.into_iter();
    for difference in pairs
        .iter_mut()
        .filter_map(|pair| pair.difference.as_mut().ok())
    {
        if let Some(decided) = family.next() {
            *difference = decided;
        }
    }
}

fn answer(pair: Pair<'_>, studies: &[Study], request: &CompareRequest) -> Answer {
    let Score {
        metric, channel, ..
    } = pair.scores.a;
    let margins = [format!("{metric}.{channel}"), metric.clone()];
    let margin = margins.iter().find_map(|name| request.margins.get(name));
    let question = Question::new(pair.scores.a.unit, pair.scores.a.better());
    let question = question.with_margin(margin.copied());
    let (verdict, reason) = match &pair.difference {
        Ok(difference) => (Verdict::of(Ok(difference.clone()), question), None),
        Err(reason) => (
            Verdict::Undefined(ComparisonError::NoSpread),
            Some(reason.clone()),
        ),
    };
    Answer {
        metric: metric.clone(),
        channel: channel.clone(),
        direction: question.better,
        decided_by: pair
            .scores
            .a
            .decided_by()
            .map(|variant| variant.name.clone()),
        unit: question.unit,
        scores: Sides {
            a: pair.scores.a.value.number(),
            b: pair.scores.b.value.number(),
        },
        sides: pair.sides,
        verdict,
        difference: pair.difference.ok(),
        reason,
        standings: Sides {
            a: pair.scores.a.standing,
            b: pair.scores.b.standing,
        },
        one_training: Sides {
            a: studies[pair.sides.a].is_one_training(metric),
            b: studies[pair.sides.b].is_one_training(metric),
        },
    }
}
