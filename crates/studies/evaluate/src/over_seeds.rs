//! Scores of one model fitted with several seeds, and the variants that decide verdicts.

use taceva_core::Field;
use taceva_metrics::{Evaluation, Repeats};
use taceva_results::{OverSeeds, SeedScore};

/// The scores of `evaluations`, one a seed.
pub fn of(seeds: &[u64], evaluations: &[&Evaluation]) -> OverSeeds {
    let first = evaluations.first().into_iter();
    let scores = first.flat_map(|evaluation| evaluation.scores());
    let of_predictions =
        scores.filter(|(metric, ..)| metric.needs.fields.contains(Field::Prediction));
    let with_deciding = of_predictions.flat_map(|(metric, channel, score)| {
        let deciding = metric.decided_by.into_iter().map(Some);
        let numbers = std::iter::once(None).chain(deciding);
        numbers.map(move |variant| (metric, channel, score, variant))
    });
    let scores = with_deciding.filter_map(|(metric, channel, score, variant)| {
        let of_seed = evaluations.iter().map(|evaluation| {
            let score = evaluation.score(metric.id, channel)?;
            match variant {
                Some(name) => score.variant(name)?.value.scalar(),
                None => score.value.scalar(),
            }
        });
        let values: Vec<Option<f64>> = of_seed.collect();
        let known: Vec<f64> = values.iter().copied().flatten().collect();
        let repeats = Repeats::of(&known)?.within(range(metric.id, &known));
        let variant = variant.and_then(|name| score.variant(name));
        Some(SeedScore {
            metric: match variant {
                Some(variant) => format!("{}.{}", metric.id, variant.name),
                None => metric.id.to_owned(),
            },
            channel: channel.to_owned(),
            unit: variant.map_or(score.unit, |variant| variant.unit),
            values,
            mean: repeats.mean,
            standard_deviation: repeats.standard_deviation,
            interval: repeats.interval,
        })
    });
    OverSeeds {
        seeds: seeds.to_vec(),
        decides: "initial weights, order and augmentation of the training; presses, division and scored samples are equal".to_owned(),
        scores: scores.collect(),
    }
}

/// The range of a metric.
fn range(metric: &str, known: &[f64]) -> [f64; 2] {
    match metric {
        "r2" | "skill" => [f64::MIN, 1.0],
        "sr" | "tolerance" => [0.0, 1.0],
        // Metrics that are never negative, such as errors; a bias may be.
        _ if known.iter().all(|value| *value >= 0.0) => [0.0, f64::MAX],
        _ => [f64::MIN, f64::MAX],
    }
}
