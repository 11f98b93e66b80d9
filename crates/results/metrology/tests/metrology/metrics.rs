//! Scores of agreement and of tolerance intervals equal the results of the public functions, bit for bit.

use taceva_core::{Channel, Channels, FieldSet};
use taceva_metrics::{Evaluation, Evaluator, MetricPlan, Rows, catalogue};
use taceva_metrology::agreement::{Agreement, Pair};
use taceva_metrology::tolerance::ToleranceInterval;

/// Truth and prediction of `presses` presses, which cycle through nine places.
fn presses(presses: u32) -> Vec<(u32, Pair)> {
    let press = |row: u32| {
        let (place, step) = (row % 9, row / 9);
        let truth = 0.3 * f64::from(step) + 0.1 * f64::from(place);
        let error = 0.017 * f64::from(place * 4 % 9) - 0.009 * f64::from(row * 7 % 13);
        (place, Pair::new(truth, truth - error))
    };
    (0..presses).map(press).collect()
}

/// Scores of `presses`, merged from evaluators of `at_once` presses each.
fn evaluated(presses: &[(u32, Pair)], at_once: usize) -> Evaluation {
    let channels = Channels::new([Channel::FZ]).expect("one channel");
    let wanted = catalogue::select(["agreement", "tolerance_interval"]).expect("known names");
    let plan = MetricPlan::new(&wanted, channels, FieldSet::PAIRS);
    let mut whole = Evaluator::new(&plan);
    for part in presses.chunks(at_once) {
        let column = |value: fn(&Pair) -> f64| part.iter().map(move |(_, pair)| value(pair));
        let truths: Vec<f64> = column(|pair| pair.one).collect();
        let predictions: Vec<f64> = column(|pair| pair.other).collect();
        let points = part.iter().map(|(place, _)| place.to_string());
        let rows = Rows::new().pairs(Channel::FZ, &truths, &predictions);
        let mut evaluator = Evaluator::new(&plan);
        let rows = rows.points(points);
        evaluator.update_rows(rows).expect("the plan's channels");
        whole.merge(evaluator).expect("one plan");
    }
    whole.finish().expect("scores")
}

/// Bit pattern of a variant's value, such as `lower` of `agreement`.
fn variant(evaluation: &Evaluation, metric: &str, name: &str) -> u64 {
    let score = evaluation.score(metric, "Fz").expect("a score");
    let variant = score.variant(name).expect("a variant");
    variant.value.scalar().expect("a number").to_bits()
}

/// Bit patterns of both interval ends of the variant `name` of `agreement`.
fn interval(evaluation: &Evaluation, name: &str) -> [u64; 2] {
    let score = evaluation.score("agreement", "Fz").expect("a score");
    let interval = score.variant(name).and_then(|variant| variant.interval);
    let ends = interval.and_then(|interval| interval.ends());
    ends.expect("an interval").map(f64::to_bits)
}

fn same(evaluation: &Evaluation, agreement: &Agreement, tolerance: &ToleranceInterval) {
    for (name, expected) in [
        ("bias", agreement.bias),
        ("sd", agreement.sd),
        ("lower", agreement.limits[0]),
        ("upper", agreement.limits[1]),
    ] {
        assert_eq!(
            variant(evaluation, "agreement", name),
            expected.to_bits(),
            "{name}"
        );
    }
    for (name, expected) in [("lower", tolerance.low), ("upper", tolerance.high)] {
        let found = variant(evaluation, "tolerance_interval", name);
        assert_eq!(found, expected.to_bits(), "{name}");
    }
    let score = evaluation
        .score("tolerance_interval", "Fz")
        .expect("a score");
    let farther = tolerance.low.abs().max(tolerance.high.abs());
    let value = score.value.scalar().expect("a number");
    assert_eq!(value.to_bits(), farther.to_bits());
}

#[test]
fn metrics_of_clusters_have_the_bits_of_slices_of_clusters() {
    let presses = presses(31);
    let clusters = (0..9_u32).map(|place| {
        let own = presses.iter().filter(|(of, _)| *of == place);
        own.map(|(_, pair)| *pair).collect::<Vec<Pair>>()
    });
    let clusters: Vec<Vec<Pair>> = clusters.collect();
    let agreement = Agreement::of_clusters(clusters.iter().map(Vec::as_slice));
    let error = |pair: &Pair| pair.one - pair.other;
    let errors = clusters.iter().map(|of| of.iter().map(error).collect());
    let errors: Vec<Vec<f64>> = errors.collect();
    let errors = errors.iter().map(Vec::as_slice);
    let tolerance = ToleranceInterval::of_clusters(errors, 0.95, 0.95);
    let (agreement, tolerance) = (agreement.expect("places"), tolerance.expect("places"));
    for at_once in [31, 7, 1] {
        same(&evaluated(&presses, at_once), &agreement, &tolerance);
    }
}

#[test]
fn metrics_of_places_pressed_once_have_the_bits_of_one_slice() {
    let presses = presses(9);
    let pairs: Vec<Pair> = presses.iter().map(|(_, pair)| *pair).collect();
    let errors: Vec<f64> = pairs.iter().map(|pair| pair.one - pair.other).collect();
    let agreement = Agreement::of(&pairs).expect("nine pairs");
    let tolerance = ToleranceInterval::of(&errors, 0.95, 0.95).expect("nine errors");
    let evaluation = evaluated(&presses, 4);
    same(&evaluation, &agreement, &tolerance);
    for (name, expected) in [
        ("bias", agreement.bias_ci95),
        ("lower", agreement.lower_ci95),
        ("upper", agreement.upper_ci95),
    ] {
        let found = interval(&evaluation, name);
        assert_eq!(found, expected.map(f64::to_bits), "{name}");
    }
    let slope = agreement.proportional.expect("a slope");
    for (name, expected) in [("slope", slope.slope), ("slope_p", slope.p)] {
        assert_eq!(
            variant(&evaluation, "agreement", name),
            expected.to_bits(),
            "{name}"
        );
    }
}
