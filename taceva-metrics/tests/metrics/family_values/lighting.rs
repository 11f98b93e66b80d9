//! Robustness to external light.

use super::*;

fn close(found: f64, expected: f64) {
    // Half of the last printed decimal of the quantile.
    assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
}

#[test]
fn scenes_without_a_reference_or_without_another_have_no_robustness() {
    let reference = [lit(0, "normal", 100.0, 0.1)];
    assert_eq!(
        score_said(&evaluate(&["r_light"], &reference), "r_light", "Fz"),
        "only the reference scene"
    );
    let other = [lit(0, "S1", 100.0, 0.1)];
    assert_eq!(
        score_said(&evaluate(&["r_light"], &other), "r_light", "Fz"),
        "no sample of the reference scene"
    );
    let same = [lit(0, "normal", 100.0, 0.5), lit(0, "S1", 100.0, 0.5)];
    assert_eq!(
        score_said(&evaluate(&["r_light"], &same), "r_light", "Fz"),
        "light and error did not change"
    );
}

#[test]
fn robustness_to_lighting_by_hand() {
    // Errors 1…5 and 10…2 over five places: means 3 and 6. Light 100 → 300: a = 2, b = 1, R = 2/3, slope 2 × 2 / 9. Without the place of
    // error e the ratio of both means moves by (e − 3) / 6: variance (4/9)² × 4/5 × 10/36, standard error (4/9) × √2 / 3; t(4) = 2.776445105.
    let samples: Vec<Sample> = (1_u32..=5)
        .flat_map(|place| {
            let point = place as usize;
            let error = f64::from(place);
            [
                lit(point, "normal", 100.0, error),
                lit(point, "S1", 300.0, 12.0 - 2.0 * error),
            ]
        })
        .collect();
    let evaluation = evaluate(&["r_light"], &samples);
    let score = evaluation.score("r_light", "Fz").expect("a score");
    assert_eq!(score.value, Value::Scalar(2.0 / 3.0));
    assert_eq!(
        score.interval.method().as_deref(),
        Some("delta method by point_id, G=5, logit")
    );
    let [low, high] = score.interval.ends().expect("five places are enough");
    // The odds of 2/3 are 2; R (1 − R) = 2/9.
    let standard_error = 4.0 / 9.0 * 2.0_f64.sqrt() / 3.0;
    let factor = (2.776_445_105_f64 * standard_error / (2.0 / 9.0)).exp();
    close(low, 2.0 / (2.0 + factor));
    close(high, 2.0 * factor / (1.0 + 2.0 * factor));
    // Every error grew, so that `plus` is the same quantity.
    for name in ["scene:S1", "plus"] {
        let variant = score.variant(name).expect("a variant");
        assert_eq!(
            (&variant.value, variant.interval),
            (&score.value, Some(score.interval)),
            "{name}"
        );
    }
    assert_eq!(
        (
            score.count("scenes"),
            score.count("scenes_defined"),
            score.flags.len()
        ),
        (Some(1), Some(1), 0)
    );
    let plane = evaluation
        .score("r_light", "Fxy")
        .expect("a score of the plane");
    assert_eq!(plane.value, score.value);
    let of_mean_error = plane.variant("of_mean_error").expect("a variant");
    assert_eq!(of_mean_error.value, score.value);
}

#[test]
fn places_that_err_alike_under_both_lights_make_the_interval_narrow() {
    let width = |bright: [f64; 5]| {
        let samples: Vec<Sample> = (0_usize..5)
            .flat_map(|point| {
                let error = [1.0, 2.0, 3.0, 4.0, 5.0][point];
                [
                    lit(point, "normal", 100.0, error),
                    lit(point, "S1", 300.0, bright[point]),
                ]
            })
            .collect();
        let evaluation = evaluate(&["r_light"], &samples);
        let score = evaluation.score("r_light", "Fz").expect("a score");
        let [low, high] = score.interval.ends().expect("five places are enough");
        high - low
    };
    let alike = width([2.1, 3.9, 6.0, 8.2, 9.8]);
    let opposed = width([9.8, 8.2, 6.0, 3.9, 2.1]);
    assert!(10.0 * alike < opposed, "{alike} {opposed}");
}

#[test]
fn a_scene_of_four_places_has_no_interval_whatever_the_places_of_the_others() {
    for few in ["normal", "S1"] {
        let samples: Vec<Sample> = (0_usize..20)
            .flat_map(|point| {
                let error = [1.0, 2.0, 3.0, 4.0, 5.0][point % 5];
                let scenes = [("normal", 100.0, error), ("S1", 300.0, 2.1 * error)];
                let seen = scenes
                    .into_iter()
                    .filter(move |(scene, ..)| *scene != few || point < 4);
                seen.map(move |(scene, light, error)| lit(point, scene, light, error))
            })
            .collect();
        let evaluation = evaluate(&["r_light"], &samples);
        let score = evaluation.score("r_light", "Fz").expect("a score");
        assert_eq!(
            score.interval,
            Interval::Undefined(UndefinedReason::TooFewClusters { have: 4 }),
            "{few}"
        );
    }
}

#[test]
fn little_light_and_smaller_errors_are_flagged() {
    let samples = [lit(0, "normal", 100.0, 0.5), lit(0, "S1", 102.0, 0.25)];
    let evaluation = evaluate(&["r_light"], &samples);
    let score = evaluation.score("r_light", "Fz").expect("a score");
    assert_eq!(score.flags, [Flag::LowStimulus, Flag::ImprovedError]);
    // The light of a plane equals that of its axes.
    let plane = evaluation.score("r_light", "Fxy").expect("a plane");
    assert_eq!(plane.flags, score.flags);
    assert_eq!(
        score.variant("plus").map(|plus| &plus.value),
        Some(&Value::Scalar(1.0))
    );
}
