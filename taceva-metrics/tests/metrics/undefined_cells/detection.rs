//! Detection limit of light presses: values computed by hand, and reasons for a missing limit.

use super::*;

/// A press with `truth` N at a place of its own, and the prediction `prediction`.
fn light(place: u32, truth: f64, prediction: f64) -> Sample {
    at(&format!("place {place}"), pair(&[truth], &[prediction]))
}

/// Presses of 2/64 N to 12/64 N at eleven places, with predictions alternately `error` too high and too low.
fn eleven_places(error: f64) -> Vec<Sample> {
    let press = |place: u32| {
        let truth = f64::from(place + 2) / 64.0;
        let sign = if place.is_multiple_of(2) { 1.0 } else { -1.0 };
        light(place, truth, truth + sign * error)
    };
    (0..11).map(press).collect()
}

fn limit(samples: &[Sample]) -> Evaluation {
    evaluate("detection_limit", &["Fz"], samples)
}

fn variant(evaluation: &Evaluation, name: &str) -> f64 {
    let score = score(evaluation, "detection_limit", "Fz");
    let variant = score.variant(name).expect("a variant");
    variant.value.scalar().expect("a number")
}

#[test]
fn the_limit_of_light_presses_is_that_of_a_calculation_by_hand() {
    // The slope is 1: Σ (x − x̄) e = 0. Six errors of 1/128 and five of −1/128 have s² = (11 − 1/11) / 9 / 128² = 120/99 / 128².
    // x̄ = 7/64 and v = 10/64²: x̄² / v = 4.9, so that √(1 + (1 + 4.9) / 11) = √(16.9 / 11).
    // t = 1.833112932656237 and δ = 3.575384834044819 for nine degrees of freedom, by mpmath.
    let evaluation = limit(&eleven_places(1.0 / 128.0));
    let deviation = (120.0_f64 / 99.0).sqrt() / 128.0 * (16.9_f64 / 11.0).sqrt();
    let value = scalar(&evaluation, "detection_limit", "Fz");
    close(value, 3.575_384_834_044_819 * deviation);
    close(value, 0.038_118_241_694_743_84);
    close(
        variant(&evaluation, "critical"),
        1.833_112_932_656_237 * deviation,
    );
    close(variant(&evaluation, "least_force"), 2.0 / 64.0);
    close(variant(&evaluation, "greatest_force"), 12.0 / 64.0);
    let score = score(&evaluation, "detection_limit", "Fz");
    assert_eq!((score.n, score.unit), (11, Unit::Newton));
    let counts = score.counts.iter();
    let counts: Vec<(&str, u64)> = counts.map(|count| (count.name, count.value)).collect();
    assert_eq!(counts, [("places", 11)]);
}

#[test]
fn the_interval_of_a_limit_is_that_of_limits_without_one_place_each() {
    let evaluation = limit(&eleven_places(2.0 / 128.0));
    let found = score(&evaluation, "detection_limit", "Fz");
    close(
        scalar(&evaluation, "detection_limit", "Fz"),
        0.076_236_483_389_487_69,
    );
    // By exact rational arithmetic: eleven logarithms with a standard error of 0.12933 and t = 2.22814 for ten degrees of freedom.
    let [low, high] = found.interval.ends().expect("eleven places");
    assert!((low - 0.057_149_235_4).abs() < 1e-8, "{low}");
    assert!((high - 0.101_698_672_9).abs() < 1e-8, "{high}");
    let critical = found.variant("critical").expect("a variant");
    let critical = critical.interval.and_then(|interval| interval.ends());
    assert!(
        critical.is_some_and(|[low, high]| low < high),
        "{critical:?}"
    );
    // Without the lightest place, the limit of smaller errors is below the lightest press.
    let evaluation = limit(&eleven_places(1.0 / 128.0));
    let why = taceva_metrics::UndefinedReason::AtLightestPress;
    let found = score(&evaluation, "detection_limit", "Fz");
    assert_eq!(found.interval, Interval::Undefined(why));
}

#[test]
fn a_press_that_is_made_again_at_its_place_is_no_evidence_and_heavy_or_idle_ones_do_not_enter() {
    let once = eleven_places(1.0 / 128.0);
    let value = scalar(&limit(&once), "detection_limit", "Fz");
    let twice: Vec<Sample> = once.iter().chain(&once).cloned().collect();
    let evaluation = limit(&twice);
    let again = scalar(&evaluation, "detection_limit", "Fz");
    assert_eq!(again.to_bits(), value.to_bits());
    assert_eq!(score(&evaluation, "detection_limit", "Fz").n, 22);
    let others = [(0.0, 0.5), (0.0199, 0.3), (0.201, 0.9), (-0.1, 0.4)];
    let others = others.into_iter().zip(100..);
    let others = others.map(|((truth, prediction), place)| light(place, truth, prediction));
    let more: Vec<Sample> = once.into_iter().chain(others).collect();
    let same = scalar(&limit(&more), "detection_limit", "Fz");
    assert_eq!(same.to_bits(), value.to_bits());
}

#[test]
fn a_limit_is_never_below_the_lightest_press() {
    for error in [0.0, 1.0 / 1024.0] {
        let evaluation = limit(&eleven_places(error));
        let value = scalar(&evaluation, "detection_limit", "Fz");
        assert_eq!(value.to_bits(), (2.0_f64 / 64.0).to_bits(), "{error}");
    }
    let exact = variant(&limit(&eleven_places(0.0)), "critical");
    assert_eq!(exact.to_bits(), 0.0_f64.to_bits());
}

#[test]
fn without_light_presses_at_enough_places_there_is_no_limit_and_the_reason_says_so() {
    let none = [light(0, 0.5, 0.5), light(1, 0.0, 0.001)];
    let said = |samples: &[Sample]| said(&limit(samples), "detection_limit", "Fz");
    assert_eq!(
        said(&none),
        "no light press: press ten places or more with 0.02 N to 0.2 N"
    );
    let mut few = eleven_places(1.0 / 128.0);
    few.truncate(9);
    assert_eq!(said(&few), "light presses count as 9 places, 10 are needed");
    // Ten places once and one of them ten times more: 20² / (9 × 1 + 11²) = 400 / 130.
    let mut uneven = eleven_places(1.0 / 128.0);
    uneven.truncate(10);
    let repeated: Vec<Sample> = std::iter::repeat_n(uneven[0].clone(), 10).collect();
    uneven.extend(repeated);
    assert_eq!(
        said(&uneven),
        "light presses count as 3 places, 10 are needed"
    );
    let mut unnamed = eleven_places(1.0 / 128.0);
    unnamed.push(pair(&[0.1], &[0.1]));
    assert_eq!(said(&unnamed), "samples without point_id");
    let equal: Vec<Sample> = (0..12).map(|place| light(place, 0.1, 0.1)).collect();
    assert_eq!(said(&equal), "constant truth");
}

#[test]
fn predictions_that_do_not_rise_or_scatter_beyond_the_presses_have_no_limit() {
    let said = |samples: &[Sample]| said(&limit(samples), "detection_limit", "Fz");
    let flat: Vec<Sample> = (0..12)
        .map(|place| light(place, f64::from(place + 3) / 100.0, 0.1))
        .collect();
    let falling: Vec<Sample> = (0..12)
        .map(|place| light(place, f64::from(place + 3) / 100.0, -f64::from(place)))
        .collect();
    // t of the slope is 19.05 for errors of 1/128: 1.19 for those of 1/8, and 1.83 is needed.
    let lost = eleven_places(1.0 / 8.0);
    for samples in [flat, falling, lost] {
        assert_eq!(
            said(&samples),
            "predictions do not rise with the force of light presses"
        );
    }
    // Six times the errors of 1/128 give six times the limit: 0.229 N, above 12/64 N.
    assert_eq!(
        said(&eleven_places(6.0 / 128.0)),
        "the limit exceeds the force of every light press"
    );
}
