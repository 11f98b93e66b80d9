//! Tests for differences of every score between every pair of sensors or models.

mod comparability;
mod estimate;
mod notes;
mod overview;
mod pairs;
mod reach;
mod remarks;
mod render;
mod request;
mod splits;
mod ties;

pub(crate) use estimate::estimate as estimate_of;
pub(crate) use overview::QUESTIONS;
pub use overview::{Decision, OVERVIEW_LINES, OVERVIEW_WIDTH};
pub use render::COMPARISON_SCHEMA;
pub use request::RequestError;
pub(crate) use splits::barred as barred_by_split;
pub use ties::ties;

use std::collections::BTreeMap;

use taceva_core::Unit;
use taceva_metrics::{
    Better, ComparisonError, Difference, Estimate, Question, Side, Sides, Standing, Verdict,
    by_intervals, decide,
};

use crate::results::Study;
use crate::training::{NO_VERDICT, is_demonstration};
use remarks::Remarks;
use taceva_results::Score;

/// Options of a comparison.
#[derive(Clone, Debug, Default)]
pub struct CompareRequest {
    /// Metrics to compare. An empty list selects all metrics with a single number and a better direction.
    pub metrics: Vec<String>,
    /// Equivalence margins by name: `mae` for all channels, `mae.Fz` for one channel. The more specific name takes precedence.
    pub margins: BTreeMap<String, f64>,
    /// Seed of the random signs of the sign-flip test.
    pub seed: u64,
}

/// Tests of every common score between every pair of studies, ordered by metric.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Names of the compared studies, in the given order.
    pub names: Vec<String>,
    /// Answers for every pair of studies with a common score.
    pub answers: Vec<Answer>,
    /// Notes for the reader.
    pub notes: Vec<String>,
    /// Remarks on the verdicts, one entry for each score.
    asides: Vec<Remarks>,
    /// Metrics in the request; empty for all.
    asked: Vec<String>,
}

/// Comparison of one score between two studies.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Name of the metric.
    pub metric: String,
    /// Channel or plane of the score, such as `Fz` or `Fxy`.
    pub channel: String,
    /// Direction in which the score is better.
    pub direction: Better,
    /// Variant that was compared; `None` for the value itself.
    pub decided_by: Option<String>,
    /// Unit of both scores.
    pub unit: Unit,
    /// Both values; `None` for a value that is not a number.
    pub scores: Sides<Option<f64>>,
    /// Positions of both studies in the list of studies.
    pub sides: Sides<usize>,
    /// Verdict by Holm's procedure over all pairs and channels of the metric. If the models were trained at too few contact points, no side is
    /// better.
    pub verdict: Verdict,
    /// Difference and interval of the verdict, with the raw and the adjusted p value; `None` if there is no verdict.
    pub difference: Option<Difference>,
    /// Reason why there is no verdict; `None` if there is a verdict.
    pub reason: Option<String>,
    /// Reason why the number of groups is too small to show any difference; `None` if the number is large enough.
    pub out_of_reach: Option<String>,
    /// True if the models were trained at too few contact points for a verdict on sensors.
    pub is_demonstration: bool,
    /// Standing of each score in verdicts.
    pub standings: Sides<Standing>,
    /// True for a score from a single training of a model with a random seed.
    pub one_training: Sides<bool>,
}

impl Answer {
    /// Verdict as text with the names of the studies: `MagicTac better by …`.
    pub fn words(&self, names: &[String]) -> String {
        match &self.reason {
            Some(reason) => format!("no answer: {reason}"),
            None => {
                let words = self.verdict.words(Sides {
                    a: &names[self.sides.a],
                    b: &names[self.sides.b],
                });
                let words = match self.unreachable() {
                    Some(reason) => format!("{words}; {reason}"),
                    None => words,
                };
                let words = match self.is_demonstration && self.is_shown() {
                    true => format!("{words}; {NO_VERDICT}"),
                    false => words,
                };
                let unknown = self.unknown(names);
                let words = match unknown.is_empty() {
                    true => words,
                    false => format!(
                        "{words}; not tested against predicting the mean: {}",
                        unknown.join(" and ")
                    ),
                };
                let drawn = self.drawn(names);
                match drawn.is_empty() || self.better().is_none() {
                    true => words,
                    false => format!("{words}; only one training of {}", drawn.join(" and ")),
                }
            }
        }
    }

    /// Reason why the test cannot show any difference, such as too few groups; `None` for other verdicts.
    fn unreachable(&self) -> Option<&str> {
        let is_open = matches!(self.verdict, Verdict::NoDifferenceShown { .. });
        self.out_of_reach.as_deref().filter(|_| is_open)
    }

    /// Studies whose models have an unknown skill.
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

    /// Studies whose score depends on a single training of a model with a random seed.
    fn drawn<'n>(&self, names: &'n [String]) -> Vec<&'n str> {
        let sides = [
            (self.one_training.a, self.sides.a),
            (self.one_training.b, self.sides.b),
        ];
        let drawn = sides.into_iter().filter(|(is_drawn, _)| *is_drawn);
        drawn.map(|(_, at)| names[at].as_str()).collect()
    }

    /// Position of the significantly better study; `None` if no study is significantly better.
    pub fn better(&self) -> Option<usize> {
        match self.verdict.better()? {
            Side::A => Some(self.sides.a),
            Side::B => Some(self.sides.b),
        }
    }
}

/// Pair of scores with its raw p value.
struct Pair<'a> {
    scores: Sides<&'a Score>,
    sides: Sides<usize>,
    difference: Result<Difference, String>,
    /// Reason why predictions of the same truth were not compared in pairs.
    unpaired: Option<String>,
    /// Reason why the number of groups is too small to show any difference; `None` if the number is large enough.
    out_of_reach: Option<String>,
}

/// Compares every pair of `studies`.
///
/// The mean absolute error is compared sample by sample if both studies predict the same samples (sign-flip test, by contact point). Other scores are compared
/// by their intervals, on the scale of each score. The pairs and channels of one metric form one family of Holm's procedure, which gives the verdict, p value
/// and interval of an answer.
///
/// If a model was trained several times, the variance of the score between trainings is added to the variance between clusters. Predictions of the
/// same samples are then compared by Student's t, because a sign-flip test does not include the variance between trainings.
///
/// If verdicts on a metric use a variant, such as `excess` of `r_spatial`, the answers contain that variant.
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
        let is_demonstration = is_demonstration(studies, &metric);
        let of_pair = |pair| answer(pair, studies, request, is_demonstration);
        answers.extend(pairs.into_iter().map(of_pair));
    }
    Comparison {
        asides: asides(studies, &names, &answers),
        notes: notes::notes(studies, &names, &answers, unpaired, request),
        names,
        answers,
        asked: request.metrics.clone(),
    }
}

/// Remarks on the answers, by score.
fn asides(studies: &[Study], names: &[String], answers: &[Answer]) -> Vec<Remarks> {
    let mut asides: Vec<Remarks> = Vec::new();
    for answer in answers {
        let is_known =
            |aside: &Remarks| aside.metric == answer.metric && aside.channel == answer.channel;
        if !asides.iter().any(is_known) {
            asides.push(Remarks::of(studies, names, answer));
        }
    }
    asides
}

/// Requested metrics that a study has, in order of their first appearance.
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
                let barred = comparability::of_other_samples(scores, of_studies)
                    .or_else(|| comparability::barred(scores, of_both))
                    .or_else(|| splits::barred(metric, of_studies, of_both));
                let (difference, unpaired) = match barred {
                    Some(reason) => (Err(reason), None),
                    None => difference(scores, of_studies, of_both, request.seed),
                };
                pairs.push(Pair {
                    scores,
                    sides: Sides { a, b },
                    difference,
                    unpaired,
                    out_of_reach: None,
                });
            }
        }
    }
    pairs
}

/// Difference of two scores, with the reason why predictions of the same truth were not compared in pairs.
fn difference(
    scores: Sides<&Score>,
    studies: Sides<&Study>,
    names: Sides<&str>,
    seed: u64,
) -> (Result<Difference, String>, Option<String>) {
    let paired = match scores.a.metric.as_str() {
        "mae" => pairs::difference(scores, studies, names, seed),
        _ => Err(None),
    };
    let unpaired = match paired {
        Ok(paired) => return (paired.map_err(|error| error.to_string()), None),
        Err(reason) => reason.map(|reason| {
            format!(
                "{} and {} predict the same truth but are not compared sample by sample: {reason}",
                names.a, names.b
            )
        }),
    };
    let difference = estimate::of_both(scores).and_then(|both| {
        let over_trainings =
            |estimate: Estimate, study: &Study, score: &Score| match study.trainings(score) {
                Some(spread) => estimate.over_trainings(spread),
                None => estimate,
            };
        let both = Sides {
            a: over_trainings(both.a, studies.a, scores.a),
            b: over_trainings(both.b, studies.b, scores.b),
        };
        by_intervals(both).map_err(|error| error.to_string())
    });
    (difference, unpaired)
}

/// Applies Holm's procedure to the tested pairs, and sets their adjusted p values and verdicts.
fn decide_together(pairs: &mut [Pair<'_>]) {
    let tested = pairs.iter();
    let tested = tested.filter_map(|pair| pair.difference.as_ref().ok().cloned());
    let mut family: Vec<Difference> = tested.collect();
    decide(&mut family);
    let mut family = reach::out_of_reach(&family).into_iter().zip(family);
    for pair in pairs.iter_mut().filter(|pair| pair.difference.is_ok()) {
        if let Some((out_of_reach, decided)) = family.next() {
            pair.difference = Ok(decided);
            pair.out_of_reach = out_of_reach;
        }
    }
}

fn answer(
    pair: Pair<'_>,
    studies: &[Study],
    request: &CompareRequest,
    is_demonstration: bool,
) -> Answer {
    let Score {
        metric, channel, ..
    } = pair.scores.a;
    let margins = [format!("{metric}.{channel}"), metric.clone()];
    let margin = margins.iter().find_map(|name| request.margins.get(name));
    let question = Question::new(pair.scores.a.unit, pair.scores.a.better());
    let question = question.with_margin(margin.copied());
    let (mut verdict, reason) = match &pair.difference {
        Ok(difference) => (Verdict::of(Ok(difference.clone()), question), None),
        Err(reason) => (
            Verdict::Undefined(ComparisonError::NoSpread),
            Some(reason.clone()),
        ),
    };
    if let Verdict::Differs { better, .. } = &mut verdict
        && is_demonstration
    {
        *better = None;
    }
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
        out_of_reach: pair.out_of_reach,
        is_demonstration,
        standings: Sides {
            a: pair.scores.a.standing,
            b: pair.scores.b.standing,
        },
        one_training: Sides {
            a: studies[pair.sides.a].is_one_training(pair.scores.a),
            b: studies[pair.sides.b].is_one_training(pair.scores.b),
        },
    }
}
