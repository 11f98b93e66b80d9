//! Scores of one model fitted with several seeds, and the variants that verdicts use.

use taceva_core::Field;
use taceva_metrics::{Evaluation, Repeats};
use taceva_results::{OverSeeds, SeedScore, full_name};

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
        let repeats = Repeats::of(&known)?.within(metric.range.ends());
        let variant = variant.and_then(|name| score.variant(name));
        Some(SeedScore {
            metric: full_name(metric.id, variant.map(|variant| &*variant.name)),
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

#[cfg(test)]
mod tests {
    use taceva_core::{Channel, Channels, FieldSet, Readings, Sample, SampleSink};
    use taceva_metrics::{Evaluator, MetricPlan, catalogue};

    use super::*;

    /// Test evaluation with two repeats at each of six points. Repeats differ by `scatter` mm to either side at the first point, and six times as much at the
    /// last. All values are too small by `bias` mm.
    fn evaluation(metric: &str, scatter: f64, bias: f64) -> Evaluation {
        let channels = Channels::new([Channel::PZ]).expect("one channel");
        let wanted = catalogue::select([metric]).expect("a known name");
        let fields: FieldSet = Field::ALL.into_iter().collect();
        let mut evaluator = Evaluator::new(&MetricPlan::new(&wanted, channels, fields));
        for press in 0..12_u32 {
            let side = if press % 2 == 0 { scatter } else { -scatter };
            let predicted = 1.0 - bias + side * f64::from(press / 2 + 1);
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
        let all = [0.01, 0.02].map(|scatter| evaluation("repeatability", scatter, 0.0));
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

    #[test]
    fn the_mean_bias_may_be_below_zero_and_the_mean_error_may_not() {
        let of_metric = |metric: &str| {
            let all = [0.01, 0.02].map(|bias| evaluation(metric, 0.0, bias));
            let over = of(&[3, 4], &all.each_ref());
            assert_eq!(over.scores.len(), 1, "{metric}");
            over.scores[0].interval[0]
        };
        assert!(of_metric("bias") < 0.0);
        assert_eq!(of_metric("mae").to_bits(), 0.0_f64.to_bits());
    }
}
