//! Repeated presses: cells without repeats, and predictors without a signal.

use super::*;

fn repeat(point: &str, step: u32, prediction: f64) -> Sample {
    at(point, pair(&[0.0], &[prediction]))
        .with_depth_step(step)
        .with_repeat(0)
}

#[test]
fn missing_repeats_leave_a_cell_out_and_none_leave_no_score() {
    let once = [
        repeat("a", 0, 1.0),
        repeat("a", 1, 2.0),
        repeat("b", 0, 3.0),
    ];
    let evaluation = evaluate("repeatability", &["Px"], &once);
    assert_eq!(
        said(&evaluation, "repeatability", "Px"),
        "no press was repeated"
    );
    let mut some = once.to_vec();
    some.push(repeat("b", 0, 5.0));
    let evaluation = evaluate("repeatability", &["Px"], &some);
    let score = score(&evaluation, "repeatability", "Px");
    assert_eq!(
        score.value.scalar().map(f64::to_bits),
        Some(2.0_f64.sqrt().to_bits())
    );
    assert_eq!(
        (score.count("cells_valid"), score.count("cells_total")),
        (Some(1), Some(3))
    );
}

#[test]
fn pooled_spread_and_limit_weigh_cells_by_their_freedom() {
    // Variances 2 (freedom 1) and 1 (freedom 2): pooled 4/3.
    let samples = [
        repeat("a", 0, 1.0),
        repeat("a", 0, 3.0),
        repeat("b", 0, 4.0),
        repeat("b", 0, 5.0),
        repeat("b", 0, 6.0),
    ];
    let evaluation = evaluate("repeatability", &["Px"], &samples);
    let score = score(&evaluation, "repeatability", "Px");
    let variant = |name| {
        score
            .variant(name)
            .and_then(|variant| variant.value.scalar())
    };
    assert_eq!(score.value, Value::Scalar((2.0_f64.sqrt() + 1.0) / 2.0));
    assert_eq!(variant("pooled"), Some((4.0_f64 / 3.0).sqrt()));
    assert_eq!(variant("limit"), Some(2.8 * (4.0_f64 / 3.0).sqrt()));
}

#[test]
fn a_press_without_a_location_leaves_repeats_unknown() {
    let mut samples = vec![repeat("a", 0, 1.0), repeat("a", 0, 2.0)];
    samples[1].point_id = None;
    let evaluation = evaluate("repeatability", &["Px"], &samples);
    assert_eq!(
        said(&evaluation, "repeatability", "Px"),
        "samples without point_id"
    );
}

#[test]
fn a_constant_predictor_has_no_signal_and_perfect_repeats_no_ratio() {
    let presses = |predict: fn(u32, u32) -> f64| {
        let presses = (0..8).flat_map(|point| (0..3).map(move |turn| (point, turn)));
        let samples =
            presses.map(|(point, turn)| repeat(&point.to_string(), 0, predict(point, turn)));
        evaluate(
            "signal_to_repeatability",
            &["Px"],
            &samples.collect::<Vec<_>>(),
        )
    };
    let constant = presses(|_, _| 0.7);
    assert_eq!(
        scalar(&constant, "signal_to_repeatability", "Px").to_bits(),
        0
    );
    let perfect = presses(|point, _| f64::from(point));
    assert_eq!(
        said(&perfect, "signal_to_repeatability", "Px"),
        "repeats do not differ"
    );
    // Means 1, 3, 5, …, 15 have the variance 24. The repeats 0, 1, 2 about them have the variance 1; a third of it is subtracted.
    let usual = presses(|point, turn| f64::from(2 * point + turn));
    close(
        scalar(&usual, "signal_to_repeatability", "Px"),
        (24.0_f64 - 1.0 / 3.0).sqrt(),
    );
    let one = evaluate(
        "signal_to_repeatability",
        &["Px"],
        &[repeat("a", 0, 1.0), repeat("a", 0, 2.0)],
    );
    assert_eq!(
        said(&one, "signal_to_repeatability", "Px"),
        "1 repeated press, 2 are needed"
    );
}
