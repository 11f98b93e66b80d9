//! Scores that are independent of the number of repeats and of samples per place.

use taceva_core::random::SplitMix64;
use taceva_core::{Channel, Channels, Field, FieldSet, Footprint, Readings, Sample, SampleSink};
use taceva_metrics::{
    Estimate, Evaluation, Evaluator, MetricPlan, SensorFacts, Sides, Standing, StatedInterval,
    by_intervals, catalogue, decide,
};

fn gaussian(random: &mut SplitMix64) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

fn evaluate(metric: &str, channels: &[Channel], samples: &[Sample]) -> Evaluation {
    let channels = Channels::new(channels.iter().cloned()).expect("distinct");
    let fields: FieldSet = Field::ALL.into_iter().collect();
    let footprint = Footprint::disc(10.0, Some(2.0)).expect("lengths");
    let facts = SensorFacts::default().with_footprint(Some(footprint));
    let metrics = catalogue::select([metric]).expect("known");
    let plan = MetricPlan::new(&metrics, channels, fields).with_facts(facts);
    let mut evaluator = Evaluator::new(&plan);
    for sample in samples {
        evaluator.accept(sample).expect("the plan's channels");
    }
    evaluator.finish().expect("finished")
}

/// Thirty presses with `repeats` repeats each, whose predictions scatter by 0.1 N.
fn repeats(random: &mut SplitMix64, repeats: u32) -> Vec<Sample> {
    let mut samples = Vec::new();
    for point in 0..30 {
        for repeat in 0..repeats {
            let prediction = f64::from(point) * 0.1 + 0.1 * gaussian(random);
            samples.push(
                Sample::default()
                    .with_point_id(point.to_string())
                    .with_depth_step(0)
                    .with_repeat(repeat)
                    .with_truth(Readings::from_values([f64::from(point) * 0.1]))
                    .with_prediction(Readings::from_values([prediction])),
            );
        }
    }
    samples
}

/// Estimate from the variant that decides verdicts.
fn deciding(evaluation: &Evaluation, metric: &str, variant: Option<&str>) -> Estimate {
    let score = evaluation.score(metric, "Fz").expect("scored");
    let (value, interval) = match variant.and_then(|name| score.variant(name)) {
        Some(variant) => (&variant.value, variant.interval.expect("an interval")),
        None => (&score.value, score.interval),
    };
    let ends = interval.ends().expect("ends");
    let freedom = interval.freedom().expect("clusters");
    let stated = StatedInterval::new(ends, freedom, interval.clusters().expect("clusters"))
        .on(interval.scale().expect("a scale"))
        .with_standard_error(interval.standard_error());
    Estimate::try_from_interval(value.scalar().expect("a number"), stated).expect("an estimate")
}

#[test]
fn equal_sensors_with_two_and_ten_repeats_differ_in_at_most_5_percent_of_cases() {
    const CASES: u64 = 100;
    for metric in ["repeatability", "signal_to_repeatability"] {
        let decides = catalogue::find(metric).expect("known").decided_by;
        let mut differ = 0;
        for case in 0..CASES {
            let mut random = SplitMix64::new(case);
            let estimates = [2, 10].map(|count| {
                let samples = repeats(&mut random, count);
                deciding(&evaluate(metric, &[Channel::FZ], &samples), metric, decides)
            });
            let [a, b] = estimates;
            let mut family = vec![by_intervals(Sides { a, b }).expect("both have intervals")];
            decide(&mut family);
            differ += u32::from(family[0].is_shown);
        }
        // Three standard errors of 100 cases at 5 % are 6.5 %.
        assert!(differ <= 11, "{metric}: {differ} of {CASES}");
    }
}

/// Presses at `points` places of a disc, at four depths each. The mean magnitude of errors increases by `trend` towards the rim.
fn places(random: &mut SplitMix64, points: u32, trend: f64) -> Vec<Sample> {
    let mut samples = Vec::new();
    for point in 0..points {
        let (turn, radius) = (6.3 * random.unit(), 9.9 * random.unit().sqrt());
        let own = 0.7 + 0.6 * random.unit();
        for step in 0..4 {
            let size = 0.1 * own * (1.0 + trend * radius / 10.0);
            let place = [radius * turn.cos(), radius * turn.sin()];
            let truth = [place[0], place[1], 0.3 + 0.4 * f64::from(step), 1.0];
            let mut prediction = truth;
            prediction[3] += size * gaussian(random);
            samples.push(
                Sample::default()
                    .with_point_id(point.to_string())
                    .with_truth(Readings::from_values(truth))
                    .with_prediction(Readings::from_values(prediction)),
            );
        }
    }
    samples
}

#[test]
fn errors_that_are_equal_everywhere_are_called_uneven_in_at_most_5_percent_of_repeats() {
    const REPEATS: u64 = 60;
    let channels = [Channel::PX, Channel::PY, Channel::PZ, Channel::FZ];
    for points in [30, 120] {
        let mut uneven = 0;
        for repeat in 0..REPEATS {
            let mut random = SplitMix64::new(repeat);
            let samples = places(&mut random, points, 0.0);
            let evaluation = evaluate("r_spatial", &channels, &samples);
            let score = evaluation.score("r_spatial", "Fz").expect("scored");
            let excess = score.variant("excess").expect("a variant");
            let ends = excess.interval.and_then(|interval| interval.ends());
            let [low, high] = ends.expect("an interval");
            let value = excess.value.scalar().expect("a number");
            assert!(low <= value && value <= high, "{low} {value} {high}");
            uneven += u32::from(low > 0.0);
            let counts = score.standing != Standing::NotAboveNoiseFloor;
            assert_eq!(counts, low > 0.0);
        }
        // Three standard errors of 60 repeats at 5 % are 8.4 %.
        assert!(uneven <= 8, "{points} points: {uneven} of {REPEATS}");
    }
}

#[test]
fn errors_that_grow_ninefold_to_the_rim_are_called_uneven() {
    let channels = [Channel::PX, Channel::PY, Channel::PZ, Channel::FZ];
    let uneven = (0..8).filter(|repeat| {
        let mut random = SplitMix64::new(*repeat);
        let samples = places(&mut random, 400, 8.0);
        let evaluation = evaluate("r_spatial", &channels, &samples);
        let score = evaluation.score("r_spatial", "Fz").expect("scored");
        score.standing != Standing::NotAboveNoiseFloor
    });
    let uneven = uneven.count();
    assert!(uneven >= 6, "{uneven} of 8");
}

#[test]
fn a_surface_that_yields_alike_everywhere_is_called_uneven_in_at_most_5_percent_of_repeats() {
    const REPEATS: u64 = 60;
    let channels = [Channel::PX, Channel::PY, Channel::PZ, Channel::FZ];
    let mut uneven = 0;
    for repeat in 0..REPEATS {
        let mut random = SplitMix64::new(repeat);
        let mut samples = Vec::new();
        for point in 0..60 {
            let place = [14.0 * random.unit() - 7.0, 14.0 * random.unit() - 7.0];
            for _ in 0..4 {
                let force = 0.5 + random.unit();
                let depth = force * (0.4 + 0.05 * gaussian(&mut random));
                let truth = [place[0], place[1], depth, force];
                samples.push(
                    Sample::default()
                        .with_point_id(point.to_string())
                        .with_truth(Readings::from_values(truth)),
                );
            }
        }
        let evaluation = evaluate("uniformity", &channels, &samples);
        let score = evaluation.score("uniformity", "Fz").expect("scored");
        uneven += u32::from(score.standing != Standing::NotAboveNoiseFloor);
    }
    assert!(uneven <= 8, "{uneven} of {REPEATS}");
}
