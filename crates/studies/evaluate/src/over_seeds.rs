//! Scores of one model fitted with several seeds, and the variants that verdicts use.

use taceva_core::Field;
use taceva_metrics::{Evaluation, Repeats};
use taceva_results::{OverSeeds, SeedScore};

/// Scores of `evaluations`, one for each seed.
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

/// Range of a metric.
fn range(metric: &str, known: &[f64]) -> [f64; 2] {
    match metric {
        "r2" | "skill" => [f64::MIN, 1.0],
        "sr" | "tolerance" => [0.0, 1.0],
        // Metrics that are never negative, such as errors; a bias may be negative.
        _ if known.iter().all(|value| *value >= 0.0) => [0.0, f64::MAX],
        _ => [f64::MIN, f64::MAX],
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::{Channel, Channels, FieldSet, Readings, Sample, SampleSink};
    use taceva_metrics::{Evaluator, MetricPlan, catalogue};

    use super::*;

    /// Two repeats at each of six points: ±`scatter` mm at the first point and six times as much at the last.
    fn evaluation(scatter: f64) -> Evaluation {
        let channels = Channels::new([Channel::PZ]).expect("one channel");
        let wanted = catalogue::select(["repeatability"]).expect("a known name");
        let fields: FieldSet = Field::ALL.into_iter().collect();
        let mut evaluator = Evaluator::new(&MetricPlan::new(&wanted, channels, fields));
        for press in 0..12_u32 {
            let side = if press % 2 == 0 { scatter } else { -scatter };
            let predicted = 1.0 + side * f64::from(press / 2 + 1);
            let sample = Sample::default()
                .with_point_id(format!("p{}", press / 2))
                .with_depth_step(0)
                .with_repeat(press % 2)
                .with_truth(Readings::from_values([1.0]))
                .with_prediction(Readings::from_values([predicted]));
            evaluator.accept(&sample).expect("of the plan");
        }
        evaluator.finish().expect("scores")
    }

    #[test]
    fn the_variant_that_decides_verdicts_stands_beside_the_value() {
        let all = [0.01, 0.02].map(evaluation);
        let over = of(&[3, 4], &all.each_ref());
        let names: Vec<&str> = over.scores.iter().map(|of| of.metric.as_str()).collect();
        assert_eq!(names, ["repeatability", "repeatability.pooled"]);
        let pooled = |evaluation: &Evaluation| {
            let score = evaluation.score("repeatability", "Pz").expect("a score");
            score
                .variant("pooled")
                .and_then(|variant| variant.value.scalar())
        };
        assert_eq!(over.scores[1].values, all.each_ref().map(pooled));
        assert_ne!(over.scores[0].values, over.scores[1].values);
    }
}
