//! Agreement and tolerance intervals: values by hand and by cluster, and reasons for missing values.

use super::*;

/// Truths whose errors 1 to 5 and means 9.5, 11, 9.5, 12 and 10.5 give the slope 2/3.
const TRUTHS: [f64; 5] = [10.0, 12.0, 11.0, 14.0, 13.0];
const ERRORS: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 5.0];
/// The normal quantile of 97.5 %.
const Z: f64 = 1.959_963_984_540_054;

fn samples(point: impl Fn(usize) -> String) -> Vec<Sample> {
    let rows = TRUTHS.iter().zip(ERRORS).enumerate();
    rows.map(|(row, (truth, error))| at(&point(row), pair(&[*truth], &[truth - error])))
        .collect()
}

/// Three or four presses at each of eight places, in a different order at each step.
fn clusters() -> Vec<Sample> {
    let press = |step: u32| {
        (0..8_u32).filter_map(move |place| {
            let (shift, scatter) = (place * 5 % 8, (place * 3 + step * 7) % 11);
            let error = 0.02 * f64::from(shift) + 0.01 * f64::from(scatter);
            let truth = 1.0 + 0.1 * f64::from(place + 8 * step);
            let sample = at(&format!("place {place}"), pair(&[truth], &[truth - error]));
            (step < 3 || place % 2 == 0).then_some(sample)
        })
    };
    (0..4).flat_map(press).collect()
}

/// Value of `metric` or of its variant, and its interval.
fn number(evaluation: &Evaluation, metric: &str, variant: Option<&str>) -> (f64, Interval) {
    let score = score(evaluation, metric, "Fz");
    match variant {
        None => (scalar(evaluation, metric, "Fz"), score.interval),
        Some(name) => {
            let variant = score.variant(name).expect("a variant");
            let value = variant.value.scalar().expect("a number");
            (value, variant.interval.expect("an interval"))
        }
    }
}

fn ends(interval: Interval) -> [f64; 2] {
    interval.ends().unwrap_or_else(|| panic!("{interval:?}"))
}

#[test]
fn limits_of_independent_errors_are_those_of_a_calculation_by_hand() {
    // Mean 3, variance 2.5. Quantiles of 4 degrees of freedom by mpmath: Student 2.776, χ² 0.484 and 11.14, noncentral t at 1.96 √5.
    let evaluation = evaluate("agreement", &["Fz"], &samples(|row| row.to_string()));
    let sd = 2.5_f64.sqrt();
    let root = 5.0_f64.sqrt();
    let of_sd = [11.143_286_781_877_797, 0.484_418_557_087_930_3].map(|x: f64| (4.0 / x).sqrt());
    let [near, far] = [2.064_259_380_531_961, 13.360_328_393_642_498].map(|t| t / root * sd);
    let half = 2.776_445_105_197_794 * sd / root;
    for (variant, value, [low, high]) in [
        (None, Z * sd, of_sd.map(|end| end * Z * sd)),
        (Some("bias"), 3.0, [3.0 - half, 3.0 + half]),
        (Some("sd"), sd, of_sd.map(|end| end * sd)),
        (Some("lower"), 3.0 - Z * sd, [3.0 - far, 3.0 - near]),
        (Some("upper"), 3.0 + Z * sd, [3.0 + near, 3.0 + far]),
    ] {
        let (found, interval) = number(&evaluation, "agreement", variant);
        close(found, value);
        let found = ends(interval);
        close(found[0], low);
        close(found[1], high);
        assert_eq!(
            interval.method().as_deref(),
            Some("variance components by point_id, G=5"),
            "{variant:?}"
        );
    }
    let (slope, interval) = number(&evaluation, "agreement", Some("slope"));
    close(slope, 2.0 / 3.0);
    assert!(matches!(interval, Interval::Jackknife { .. }));
    let (p, interval) = number(&evaluation, "agreement", Some("slope_p"));
    close(p, 0.450_184_855_752_100_9);
    assert!(interval.ends().is_none());
}

#[test]
fn nearly_all_independent_errors_lie_within_an_exact_factor_of_their_deviation() {
    let evaluation = evaluate(
        "tolerance_interval",
        &["Fz"],
        &samples(|row| row.to_string()),
    );
    let half = 5.076_874_532_059_4 * 2.5_f64.sqrt();
    let (value, interval) = number(&evaluation, "tolerance_interval", None);
    close(value, 3.0 + half);
    close(
        number(&evaluation, "tolerance_interval", Some("lower")).0,
        3.0 - half,
    );
    close(
        number(&evaluation, "tolerance_interval", Some("upper")).0,
        3.0 + half,
    );
    let [low, high] = ends(interval);
    assert!(0.0 < low && low < value && value < high);
    assert_eq!(
        interval.method().as_deref(),
        Some("jackknife by point_id, G=5, logarithmic")
    );
}

#[test]
fn the_deviation_of_clusters_is_the_sum_of_both_components_of_variance() {
    let samples = clusters();
    let mut places: Vec<Vec<f64>> = vec![Vec::new(); 8];
    for (row, sample) in samples.iter().enumerate() {
        // Three steps of eight places, then every second place.
        let place = if row < 24 { row % 8 } else { 2 * (row - 24) };
        let prediction = sample.prediction.as_ref().and_then(|of| of.get(0));
        let error = sample.truth.get(0).expect("a truth") - prediction.expect("a prediction");
        places[place].push(error);
    }
    let count = |of: usize| f64::from(u32::try_from(of).expect("few"));
    let (n, k) = (count(samples.len()), 8.0);
    let mean = places.iter().flatten().sum::<f64>() / n;
    let of = |place: &Vec<f64>| place.iter().sum::<f64>() / count(place.len());
    let between = places
        .iter()
        .map(|place| count(place.len()) * (of(place) - mean).powi(2));
    let between = between.sum::<f64>() / (k - 1.0);
    let within = places.iter().flat_map(|place| {
        let own = of(place);
        place.iter().map(move |error| (error - own).powi(2))
    });
    let within = within.sum::<f64>() / (n - k);
    let squares = places.iter().map(|place| count(place.len()).powi(2));
    let size = (n - squares.sum::<f64>() / n) / (k - 1.0);
    assert!(between > within);
    let sd = ((between - within) / size + within).sqrt();
    let evaluation = evaluate("agreement", &["Fz"], &samples);
    close(number(&evaluation, "agreement", Some("sd")).0, sd);
    close(number(&evaluation, "agreement", Some("bias")).0, mean);
    close(number(&evaluation, "agreement", None).0, Z * sd);
    close(
        number(&evaluation, "agreement", Some("upper")).0,
        mean + Z * sd,
    );
    // Clusters may differ in spread: no distribution of all errors is assumed.
    let method = number(&evaluation, "agreement", Some("upper")).1.method();
    let expected = "jackknife by point_id, G=8";
    assert_eq!(method.as_deref(), Some(expected));
    // The probability of the slope is that of its jackknife.
    let (slope, interval) = number(&evaluation, "agreement", Some("slope"));
    let Interval::Jackknife {
        standard_error,
        freedom,
        ..
    } = interval
    else {
        panic!("{interval:?}");
    };
    let t = slope.abs() / standard_error;
    let p = 2.0 * taceva_metrics::distributions::student_t::above(t, freedom);
    close(number(&evaluation, "agreement", Some("slope_p")).0, p);
}

#[test]
fn clusters_widen_what_is_known_of_their_errors() {
    let samples = clusters();
    let plans = [false, true].map(|are_independent| {
        let channels = Channels::new([Channel::FZ]).expect("one channel");
        let names = ["agreement", "tolerance_interval"];
        let plan = MetricPlan::new(
            &catalogue::select(names).expect("known names"),
            channels,
            FieldSet::PAIRS,
        );
        match are_independent {
            true => plan.independent_samples(),
            false => plan,
        }
    });
    let [clustered, independent] = plans.map(|plan| {
        let mut evaluator = Evaluator::new(&plan);
        for sample in &samples {
            evaluator.accept(sample).expect("the plan's channels");
        }
        evaluator.finish().expect("scores")
    });
    let width = |of: &Evaluation| {
        let [low, high] = ends(number(of, "agreement", Some("upper")).1);
        high - low
    };
    assert!(width(&clustered) > 1.2 * width(&independent));
    let value = |of: &Evaluation| number(of, "tolerance_interval", None).0;
    assert!(value(&clustered) > 1.1 * value(&independent));
    let method = number(&independent, "agreement", Some("upper")).1.method();
    let expected = "variance components, samples taken as independent, G=28";
    assert_eq!(method.as_deref(), Some(expected));
}

#[test]
fn errors_of_more_than_30_000_places_count_as_without_places_in_any_order() {
    let sample = |place: u32| {
        let error = 0.001 * f64::from(place % 7);
        at(&place.to_string(), pair(&[1.0], &[1.0 - error]))
    };
    let most: Vec<Sample> = (0..30_000).map(sample).collect();
    let more: Vec<Sample> = (0..30_001).rev().map(sample).collect();
    let of = |metric: &str, samples: &[Sample]| evaluate(metric, &["Fz"], samples);
    let name = "tolerance_interval";
    assert!(scalar(&of(name, &most), name, "Fz") > 0.0);
    let reason = said(&of(name, &more), name, "Fz");
    assert_eq!(reason, "samples without point_id");
    let sd = |samples: &[Sample]| scalar(&of("agreement", samples), "agreement", "Fz") / Z;
    assert!((sd(&more) - 0.002).abs() < 1e-5 && (sd(&most) - 0.002).abs() < 1e-5);
}

#[test]
fn the_state_of_60_000_places_is_the_same_in_one_part_and_in_three() {
    let wanted = catalogue::select(["agreement"]).expect("a known name");
    let channels = Channels::new([Channel::FZ]).expect("one channel");
    let plan = MetricPlan::new(&wanted, channels, Field::ALL.into_iter().collect());
    let of = |places: &mut dyn Iterator<Item = u32>| {
        let mut evaluator = Evaluator::new(&plan);
        for place in places {
            let error = 0.001 * f64::from(place % 7);
            let sample = at(&place.to_string(), pair(&[1.0], &[1.0 - error]));
            evaluator.accept(&sample).expect("the plan's channel");
        }
        evaluator
    };
    let mut whole = of(&mut (0..60_000));
    let mut parts = of(&mut (40_000..60_000));
    for mut places in [0..20_000, 20_000..40_000] {
        parts.merge(of(&mut places)).expect("one plan");
    }
    let states = whole.states().expect("states");
    assert_eq!(states, parts.states().expect("states"));
    // Names of 60,000 places would take megabytes.
    let length: usize = states.iter().map(|state| format!("{state:?}").len()).sum();
    assert!(length < 200_000, "{length}");
}

#[test]
fn limits_of_errors_say_why_there_are_none() {
    let both = ["agreement", "tolerance_interval"];
    for metric in both {
        let said = |samples: &[Sample]| said(&evaluate(metric, &["Fz"], samples), metric, "Fz");
        let all = samples(|row| row.to_string());
        assert_eq!(said(&all[..1]), "fewer than 2 samples");
        let one = samples(|_| "a".to_owned());
        assert_eq!(
            said(&one),
            "several samples of one cluster, two clusters are needed"
        );
        let equal = (0..6_u32).map(|row| {
            let truth = f64::from(row);
            at(&row.to_string(), pair(&[truth], &[truth - 0.5]))
        });
        let equal: Vec<Sample> = equal.collect();
        assert_eq!(said(&equal), "errors do not differ");
    }
    let unnamed: Vec<Sample> = TRUTHS
        .iter()
        .zip(ERRORS)
        .map(|(truth, error)| pair(&[*truth], &[truth - error]))
        .collect();
    let evaluation = evaluate("tolerance_interval", &["Fz"], &unnamed);
    assert_eq!(
        said(&evaluation, "tolerance_interval", "Fz"),
        "samples without point_id"
    );
    let evaluation = evaluate("agreement", &["Fz"], &unnamed);
    close(scalar(&evaluation, "agreement", "Fz"), Z * 2.5_f64.sqrt());
    let found = score(&evaluation, "agreement", "Fz");
    assert!(found.interval.ends().is_none());
    let variant = |name: &str| found.variant(name).map(|variant| variant.value.clone());
    assert_eq!(
        variant("slope_p").map(|value| value.to_string()).as_deref(),
        Some("undefined: samples without point_id")
    );
    let opposite: Vec<Sample> = [1.0, 2.0, 3.0]
        .map(|truth| at(&truth.to_string(), pair(&[truth], &[-truth])))
        .into();
    let evaluation = evaluate("agreement", &["Fz"], &opposite);
    let slope = score(&evaluation, "agreement", "Fz").variant("slope");
    assert_eq!(
        slope.map(|slope| slope.value.to_string()).as_deref(),
        Some("undefined: means of truth and prediction do not differ")
    );
}

#[test]
fn a_bootstrap_of_other_scores_leaves_the_intervals_of_limits_as_they_are() {
    let methods = [
        taceva_metrics::IntervalMethod::Jackknife,
        taceva_metrics::IntervalMethod::PoissonBootstrap(Default::default()),
    ];
    let [one, other] = methods.map(|method| {
        let channels = Channels::new([Channel::FZ]).expect("one channel");
        let wanted = catalogue::select(["agreement", "tolerance_interval"]).expect("known names");
        let plan = MetricPlan::new(&wanted, channels, FieldSet::PAIRS).with_interval_method(method);
        let mut evaluator = Evaluator::new(&plan);
        for sample in clusters() {
            evaluator.accept(&sample).expect("the plan's channels");
        }
        format!("{:?}", evaluator.finish().expect("scores"))
    });
    assert!(one.contains("Jackknife") && !one.contains("Components"));
    assert_eq!(one, other);
}

#[test]
fn limits_of_a_plane_are_the_means_of_both_axes() {
    let samples: Vec<Sample> = (0..12_u32)
        .map(|row| {
            let error = [0.01 * f64::from(row * 5 % 7), 0.03 * f64::from(row * 3 % 5)];
            at(
                &format!("{}", row / 2),
                pair(&[1.0, 2.0], &[1.0 - error[0], 2.0 - error[1]]),
            )
        })
        .collect();
    for metric in ["agreement", "tolerance_interval"] {
        let evaluation = evaluate(metric, &["Fx", "Fy"], &samples);
        let of = |label: &str| scalar(&evaluation, metric, label);
        close(of("Fxy"), f64::midpoint(of("Fx"), of("Fy")));
        let interval = score(&evaluation, metric, "Fxy").interval;
        assert!(matches!(interval, Interval::Jackknife { clusters: 6, .. }));
    }
}
