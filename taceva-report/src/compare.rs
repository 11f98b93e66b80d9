//! Whether sensors or models differ: every pair, every score, with intervals and in words.

mod estimate;
mod paired;
mod render;

pub use render::COMPARISON_SCHEMA;

use std::collections::BTreeMap;

use taceva_core::Unit;
use taceva_metrics::{
    Better, ComparisonError, Difference, Question, Side, Sides, Verdict, holm, welch,
};

use crate::results::{Score, Study};

/// What a comparison is asked.
#[derive(Clone, Debug, Default)]
pub struct CompareRequest {
    /// The metrics that are compared; all that are one number and better on one side, if empty.
    pub metrics: Vec<String>,
    /// How far apart scores may be and still count as equal, by `mae` or `mae.Fz`; the longer name comes first.
    pub margins: BTreeMap<String, f64>,
    /// The seed of what is drawn.
    pub seed: u64,
}

/// Answers, metric by metric.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// What the studies are called.
    pub names: Vec<String>,
    /// Every pair of studies that have the same score.
    pub answers: Vec<Answer>,
}

/// One score of two studies.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The metric.
    pub metric: String,
    /// The channel or plane.
    pub channel: String,
    /// The unit of both scores.
    pub unit: Unit,
    /// Both scores, where they are numbers.
    pub scores: Sides<Option<f64>>,
    /// The positions of both studies.
    pub sides: Sides<usize>,
    /// What it says, with p values adjusted over all pairs and channels of the metric.
    pub verdict: Verdict,
    /// The difference behind it, if there is one.
    pub difference: Option<Difference>,
    /// Why there is no answer.
    pub reason: Option<String>,
}

impl Answer {
    /// What it says with the names of the studies in the place of A and B: `MagicTac lower by …`.
    pub fn words(&self, names: &[String]) -> String {
        let text = match &self.reason {
            Some(reason) => format!("no answer: {reason}"),
            None => self.verdict.to_string(),
        };
        match text.strip_prefix("A ") {
            Some(rest) => format!("{} {rest}", names[self.sides.a]),
            None => text,
        }
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
}

/// Compares every pair of `studies`.
///
/// The mean absolute error is compared sample by sample where both studies predict the same samples (the sign-flip test, by contact point);
/// everything else by Welch's test on the standard errors behind the intervals. The p values of one metric, over all its pairs and channels,
/// are adjusted by Holm's method.
pub fn compare(studies: &[Study], request: &CompareRequest) -> Comparison {
    let mut answers = Vec::new();
    for metric in metrics(studies, request) {
        let mut pairs = pairs(studies, &metric, request);
        adjust(&mut pairs);
        answers.extend(pairs.into_iter().map(|pair| answer(pair, request)));
    }
    Comparison {
        names: crate::figures::names(studies),
        answers,
    }
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

fn pairs<'a>(studies: &'a [Study], metric: &str, request: &CompareRequest) -> Vec<Pair<'a>> {
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
                let difference = difference(scores, Sides { a: study, b: other }, request.seed);
                pairs.push(Pair {
                    scores,
                    sides: Sides { a, b },
                    difference,
                });
            }
        }
    }
    pairs
}

fn difference(
    scores: Sides<&Score>,
    studies: Sides<&Study>,
    seed: u64,
) -> Result<Difference, String> {
    let paired = match scores.a.metric.as_str() {
        "mae" => paired::difference(scores, studies, seed),
        _ => None,
    };
    if let Some(paired) = paired {
        return paired.map_err(|error| error.to_string());
    }
    let estimates = estimate::of_both(scores)?;
    welch(estimates).map_err(|error| error.to_string())
}

/// Holm's adjustment over those pairs that have a p value.
fn adjust(pairs: &mut [Pair<'_>]) {
    let tested = || {
        let differences = pairs
            .iter()
            .filter_map(|pair| pair.difference.as_ref().ok());
        differences.map(|difference| difference.p)
    };
    let p_values: Vec<f64> = tested().collect();
    let adjusted = holm(&p_values).expect("p values of tests lie between 0 and 1");
    let mut adjusted = adjusted.into_iter();
    for pair in pairs {
        if let Ok(difference) = &mut pair.difference {
            let p = adjusted.next().expect("one for each");
            *difference = difference.with_adjusted_p(p);
        }
    }
}

fn answer(pair: Pair<'_>, request: &CompareRequest) -> Answer {
    let Score {
        metric, channel, ..
    } = pair.scores.a;
    let margins = [format!("{metric}.{channel}"), metric.clone()];
    let margin = margins.iter().find_map(|name| request.margins.get(name));
    let question = Question {
        unit: pair.scores.a.unit,
        better: pair.scores.a.better(),
        margin: margin.copied(),
    };
    let (verdict, reason) = match &pair.difference {
        Ok(difference) => (Verdict::of(Ok(*difference), question), None),
        Err(reason) => (
            Verdict::Undefined(ComparisonError::NoSpread),
            Some(reason.clone()),
        ),
    };
    Answer {
        metric: metric.clone(),
        channel: channel.clone(),
        unit: question.unit,
        scores: Sides {
            a: pair.scores.a.value.number(),
            b: pair.scores.b.value.number(),
        },
        sides: pair.sides,
        verdict,
        difference: pair.difference.ok(),
        reason,
    }
}
