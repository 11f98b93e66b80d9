//! Remarks on a verdict: ties, light that hardly changed, and labels of different spread.

use crate::light::{Light, is_low};
use crate::results::Study;
use crate::spread;
use crate::tie::{Tie, tie};

/// What a reader must know of one score of all studies.
#[derive(Clone, Debug)]
pub(super) struct Remarks {
    pub(super) metric: String,
    pub(super) channel: String,
    /// Who is tied for the best.
    pub(super) tie: Option<Tie>,
    /// Those whose light hardly changed, so that no verdict is given of them, with the words for it.
    pub(super) low: Vec<(usize, String)>,
    /// How the labels of those that take part differ in spread; empty where they do not.
    pub(super) spread: String,
}

impl Remarks {
    pub(super) fn of(studies: &[Study], names: &[String], metric: &str, channel: &str) -> Remarks {
        let scores = studies.iter().enumerate();
        let scores: Vec<_> = scores
            .filter_map(|(at, study)| Some((at, study.score(metric, channel)?)))
            .collect();
        let counting = scores.iter().filter(|(_, score)| {
            score.standing.takes_part() && score.value.number().is_some() && !is_low(score)
        });
        let counting: Vec<usize> = counting.map(|(at, _)| *at).collect();
        let low = scores.iter().filter_map(|(at, score)| {
            let words = Light::of(score).low_stimulus()?;
            Some((*at, format!("{}: {words}", names.get(*at)?)))
        });
        Remarks {
            metric: metric.to_owned(),
            channel: channel.to_owned(),
            tie: tie(studies, names, metric, channel),
            low: low.collect(),
            spread: spread::words(studies, &counting, metric, channel),
        }
    }
}
