//! Remarks on a verdict: ties, nearly constant light, and different label spreads.

use taceva_metrics::Standing;

use super::Answer;
use crate::light::Light;
use crate::results::Study;
use crate::spread;
use crate::tie::{Tie, tie};

/// Remarks on one score of all studies.
#[derive(Clone, Debug)]
pub(super) struct Remarks {
    pub(super) metric: String,
    pub(super) channel: String,
    /// Tie for the best value.
    pub(super) tie: Option<Tie>,
    /// Studies that are excluded from verdicts, with the reason.
    pub(super) barred: Vec<(usize, String)>,
    /// True if the models were trained at too few contact points for a verdict on sensors.
    pub(super) is_demonstration: bool,
    /// Remark if the label spreads of the studies that take part in verdicts differ; empty if they are similar.
    pub(super) spread: String,
}

impl Remarks {
    /// Creates remarks on the score of `answer`.
    pub(super) fn of(studies: &[Study], names: &[String], answer: &Answer) -> Remarks {
        let (metric, channel) = (answer.metric.as_str(), answer.channel.as_str());
        let scores = studies.iter().enumerate();
        let scores: Vec<_> = scores
            .filter_map(|(at, study)| Some((at, study.score(metric, channel)?)))
            .collect();
        let counting = scores
            .iter()
            .filter(|(_, score)| score.standing.takes_part() && score.value.number().is_some());
        let counting: Vec<usize> = counting.map(|(at, _)| *at).collect();
        let barred = scores.iter().filter_map(|(at, score)| {
            let mark = score
                .standing
                .phrase()
                .filter(|_| !score.standing.takes_part())?;
            let is_low = score.standing == Standing::LowStimulus;
            let words = Light::of(score).low_stimulus().filter(|_| is_low);
            let words = words.unwrap_or_else(|| mark.to_owned());
            let sample = studies[*at].dominant(score);
            let sample = sample.map_or_else(String::new, |sample| format!(" (its {sample})"));
            Some((*at, format!("{}: {words}{sample}", names.get(*at)?)))
        });
        Remarks {
            metric: metric.to_owned(),
            channel: channel.to_owned(),
            tie: tie(studies, names, metric, channel),
            barred: barred.collect(),
            is_demonstration: answer.is_demonstration,
            spread: spread::words(studies, names, &counting, metric, channel),
        }
    }
}
