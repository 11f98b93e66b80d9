//! Laws of scores by place, scene and grating, for any samples.

use crate::support::laws::{self, states};
use crate::support::press::{METRICS, evaluate, evaluator, plan, press as pressed};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use taceva_core::{GratingKind, Nanometre, Readings, Sample};
use taceva_metrics::{Evaluator, Value};

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(2028),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

fn seen<'a>(samples: impl IntoIterator<Item = &'a Sample>) -> Evaluator {
    evaluator(&plan(&METRICS), samples)
}

fn reading(low: f64, high: f64) -> impl Strategy<Value = Option<f64>> {
    prop_oneof![
        20 => (low..high).prop_map(Some),
        1 => any::<f64>().prop_map(Some),
        1 => Just(None),
    ]
}

fn length() -> impl Strategy<Value = Option<Nanometre>> {
    let level = (5_i64..36).prop_map(|level| Some(Nanometre(level * 50_000)));
    prop_oneof![4 => level, 1 => Just(None)]
}

/// Samples of all kinds, some with missing values, some with NaN.
fn samples() -> impl Strategy<Value = Vec<Sample>> {
    let place = [
        reading(-13.0, 13.0),
        reading(-13.0, 13.0),
        reading(-0.1, 1.1),
    ];
    let force = [
        reading(-0.05, 0.05),
        reading(-0.05, 0.05),
        reading(-0.1, 2.0),
    ];
    let errors = prop::collection::vec(reading(-0.3, 0.3), 6);
    let scene = prop_oneof![
        Just(None),
        Just(Some("normal")),
        Just(Some("S1")),
        Just(Some("S2"))
    ];
    let kind = prop_oneof![
        Just(None),
        Just(Some(GratingKind::Line)),
        Just(Some(GratingKind::Dot))
    ];
    let light = (scene, reading(0.0, 255.0));
    let grating = (kind, length(), length());
    let sample = ((place, force), errors, light, grating, 0..40_u32);
    let sample = sample.prop_map(|((place, force), errors, light, grating, point)| {
        let truth: Vec<Option<f64>> = place.into_iter().chain(force).collect();
        let predicted = truth.iter().zip(&errors);
        let predicted = predicted.map(|(truth, error)| Some((*truth)? + (*error)?));
        Sample::default()
            .with_point_id(format!("point {point}"))
            .with_scene_id(light.0.map(str::to_owned))
            .with_intensity(light.1)
            .with_kind(grating.0)
            .with_spacing(grating.1)
            .with_predicted_spacing(grating.2)
            .with_prediction(Readings::new(predicted.collect()))
            .with_truth(Readings::new(truth))
    });
    prop::collection::vec(sample, 0..60)
}

proptest! {
    #![proptest_config(config(60))]

    #[test]
    fn a_whole_equals_its_merged_parts_in_any_order(
        samples in samples(), cut in any::<prop::sample::Index>(),
    ) {
        laws::a_whole_equals_its_merged_parts(&samples, cut.index(samples.len() + 1), |samples| seen(samples));
        prop_assert_eq!(states(seen(samples.iter().rev())), states(seen(&samples)));
    }

    #[test]
    fn merging_is_associative_and_nothing_is_its_identity(
        a in samples(), b in samples(), c in samples(),
    ) {
        laws::merging_is_commutative_and_associative_and_nothing_is_its_identity([&a, &b, &c], |samples| seen(samples));
    }

    #[test]
    fn a_state_that_was_written_and_read_is_the_same(samples in samples()) {
        laws::a_state_that_was_written_and_read_is_the_same(&samples, |samples| seen(samples));
    }
}

proptest! {
    #![proptest_config(config(100))]

    #[test]
    fn more_tolerance_never_recognises_less(levels in prop::collection::vec((5_i64..36, 5_i64..36), 1..80)) {
        let samples: Vec<Sample> = levels
            .iter()
            .map(|&(truth, predicted)| Sample::default().with_kind(GratingKind::Dot).with_spacing(Nanometre(truth * 50_000)).with_predicted_spacing(Nanometre(predicted * 50_000)))
            .collect();
        let evaluation = evaluate(&["sr"], &samples);
        let score = evaluation.score("sr", "dot").expect("a score");
        let Some(Value::Curve(curve)) = score.variant("curve").map(|curve| &curve.value) else {
            panic!("a success rate has a curve");
        };
        prop_assert!(curve.counts.is_sorted());
        let exact = score.variant("exact").and_then(|exact| exact.value.scalar());
        prop_assert_eq!(exact, curve.values[0]);
        prop_assert_eq!(score.value.scalar(), curve.values[1]);
    }

    #[test]
    fn a_surface_that_yields_alike_everywhere_is_uniform(
        places in prop::collection::vec((-8.0..8.0, -8.0..8.0, 1_u32..64), 2..60),
    ) {
        // Powers of two keep depth over force exact.
        let samples: Vec<Sample> = places
            .iter()
            .enumerate()
            .map(|(point, &(x, y, eighths))| {
                let force_n = f64::from(eighths) / 8.0;
                pressed(point, [x, y, force_n / 4.0], force_n, 0.0)
            })
            .collect();
        let evaluation = evaluate(&["uniformity", "sensitivity"], &samples);
        let uniformity = evaluation.score("uniformity", "Fz").expect("a score");
        prop_assert_eq!(&uniformity.value, &Value::Scalar(1.0));
        let sensitivity = evaluation.score("sensitivity", "Fz").expect("a score");
        prop_assert_eq!(&sensitivity.value, &Value::Scalar(0.25));
        let slope = sensitivity.variant("slope").and_then(|slope| slope.value.scalar());
        prop_assert_eq!(slope, Some(0.25));
    }

    #[test]
    fn moving_truth_and_prediction_together_moves_no_error(
        errors in prop::collection::vec((-12_i32..12, -64_i32..64), 1..60), offset in -1024_i32..1024,
    ) {
        // Multiples of 1/64 up to 2^20 are exact, so the errors are equal.
        let score = |offset: i32| {
            let samples: Vec<Sample> = errors
                .iter()
                .enumerate()
                .map(|(point, &(x, error))| {
                    pressed(point, [f64::from(x), 0.0, 0.5], f64::from(offset), f64::from(error) / 64.0)
                })
                .collect();
            let evaluation = evaluate(&["r_spatial"], &samples);
            let score = evaluation.score("r_spatial", "Fz").expect("a score").clone();
            (score.value, score.interval, score.variants)
        };
        prop_assert_eq!(score(0), score(offset));
    }
}
