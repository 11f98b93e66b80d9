//! What scores become when the same model is fitted again with other seeds: how much they vary with the random numbers of a training.

use serde::Serialize;
use taceva_core::Field;
use taceva_metrics::{Evaluation, Repeats};

/// The scores of one model fitted with several seeds, on the same presses, divided alike.
///
/// This is another spread than that of intervals by contact point, which say how far a score would move with other presses and the same training.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OverSeeds {
    /// The seeds, in order; the scores of the report are those of the first.
    pub seeds: Vec<u64>,
    /// What a seed decides.
    pub decides: &'static str,
    /// The scores that are formed from predictions.
    pub scores: Vec<SeedScore>,
}

/// One score over the seeds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeedScore {
    /// The metric: `r2`.
    pub metric: &'static str,
    /// The channel or plane.
    pub channel: String,
    /// The unit of every number.
    pub unit: &'static str,
    /// The value with each seed; absent where there is none.
    pub values: Vec<Option<f64>>,
    /// The mean of them.
    pub mean: f64,
    /// Their standard deviation.
    pub standard_deviation: f64,
    /// The 95 % interval of the mean over all seeds.
    pub interval: [f64; 2],
}

impl OverSeeds {
    /// Of `evaluations`, one a seed.
    pub fn of(seeds: &[u64], evaluations: &[&Evaluation]) -> OverSeeds {
        let first = evaluations.first().into_iter();
        let scores = first.flat_map(|evaluation| evaluation.scores());
        let of_predictions =
            scores.filter(|(metric, ..)| metric.needs.fields.contains(Field::Prediction));
        let scores = of_predictions.filter_map(|(metric, channel, score)| {
            let of_seed = evaluations.iter().map(|evaluation| {
                let score = evaluation.score(metric.id, channel);
                score.and_then(|score| score.value.scalar())
            });
            let values: Vec<Option<f64>> = of_seed.collect();
            let known: Vec<f64> = values.iter().copied().flatten().collect();
            let repeats = Repeats::of(&known)?.within(range(metric.id, &known));
            Some(SeedScore {
                metric: metric.id,
                channel: channel.to_owned(),
                unit: score.unit.symbol(),
                values,
                mean: repeats.mean,
                standard_deviation: repeats.standard_deviation,
                interval: repeats.interval,
            })
        });
        OverSeeds {
            seeds: seeds.to_vec(),
            decides: "first weights, order and augmentation of the training; presses, division and scored samples are the same",
            scores: scores.collect(),
        }
    }
}

/// What a metric can be.
fn range(metric: &str, known: &[f64]) -> [f64; 2] {
    match metric {
        "r2" | "skill" => [f64::MIN, 1.0],
        "sr" | "tolerance" => [0.0, 1.0],
        // Of what is never below zero, as errors are; a bias is.
        _ if known.iter().all(|value| *value >= 0.0) => [0.0, f64::MAX],
        _ => [f64::MIN, f64::MAX],
    }
}
