//! What scores by press, unit, time and level say of samples whose answer is known, and why some have none.

use taceva_core::{
    Channel, Channels, Field, FieldSet, Footprint, Phase, Readings, Sample, SampleSink, Stamp, Unit,
};
use taceva_metrics::{
    Evaluation, Evaluator, Flag, Interval, MetricPlan, Score, SensorFacts, Value, catalogue,
};

/// Evaluates samples whose readings are of `channels`.
fn evaluate(metric: &str, channels: &[&str], samples: &[Sample]) -> Evaluation {
    let channel = |name: &&str| {
        let unit = match name.as_bytes() {
            [b'F', ..] => Unit::Newton,
            [b'R', ..] => Unit::Degree,
            [b'L', ..] => Unit::Lux,
            _ => Unit::Millimetre,
        };
        Channel::named(name, unit).expect("a plain name")
    };
    let channels = Channels::new(channels.iter().map(channel)).expect("distinct channels");
    let wanted = catalogue::select([metric]).expect("a known name");
    let available: FieldSet = Field::ALL.into_iter().collect();
    let facts = SensorFacts {
        footprint: Some(Footprint::disc(10.0, None).expect("a length")),
        ..SensorFacts::default()
    };
    let plan = MetricPlan::new(&wanted, channels, available).with_facts(facts);
    assert_eq!(plan.skipped(), []);
    let mut evaluator = Evaluator::new(&plan);
    for sample in samples {
        evaluator.accept(sample).expect("the plan's channels");
    }
    evaluator.finish().expect("the plan's channels")
}

fn score<'a>(evaluation: &'a Evaluation, metric: &str, label: &str) -> &'a Score {
    evaluation.score(metric, label).expect("a score")
}

fn said(evaluation: &Evaluation, metric: &str, label: &str) -> String {
    match &score(evaluation, metric, label).value {
        Value::Undefined(reason) => reason.to_string(),
        Value::NotApplicable(reason) => reason.to_string(),
        value => panic!("{metric} of {label} is {value:?}"),
    }
}

fn scalar(evaluation: &Evaluation, metric: &str, label: &str) -> f64 {
    let score = score(evaluation, metric, label);
    score
        .value
        .scalar()
        .unwrap_or_else(|| panic!("{:?}", score.value))
}

fn close(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-12 * expected.abs().max(1.0),
        "{found}, not {expected}"
    );
}

fn pair(truth: &[f64], prediction: &[f64]) -> Sample {
    Sample {
        truth: Readings::from_values(truth.iter().copied()),
        prediction: Some(Readings::from_values(prediction.iter().copied())),
        ..Sample::default()
    }
}

fn at(point: &str, sample: Sample) -> Sample {
    Sample {
        point_id: Some(point.to_owned()),
        ..sample
    }
}

fn timed(valid_s: f64, sample: Sample) -> Sample {
    Sample {
        stamp: Some(Stamp {
            valid_s,
            received_s: None,
        }),
        ..sample
    }
}

fn repeat(point: &str, step: u32, prediction: f64) -> Sample {
    Sample {
        depth_step: Some(step),
        repeat: Some(0),
        ..at(point, pair(&[0.0], &[prediction]))
    }
}

#[test]
fn an_empty_stream_has_no_value_of_any_kind() {
    let channels = ["Px", "Py", "Pz", "Fx", "Fy", "Fz", "surface_z"];
    for metric in catalogue::ALL
        .iter()
        .skip(12)
        .filter(|metric| metric.id != "intrinsic")
    {
        let evaluation = evaluate(metric.id, &channels, &[]);
        assert!(evaluation.scores().count() > 0, "{}", metric.id);
        for (_, label, score) in evaluation.scores() {
            let expected = match metric.id {
                "minimum_detectable_force" => "no sample is without contact",
                _ => "empty",
            };
            let undefined = !matches!(score.value, Value::NotApplicable(_));
            assert!(undefined);
            assert_eq!(
                said(&evaluation, metric.id, label),
                expected,
                "{} {label}",
                metric.id
            );
        }
    }
}

#[test]
fn values_that_are_no_numbers_are_counted_and_give_none() {
    let broken = |point: &str| Sample {
        depth_step: Some(0),
        repeat: Some(0),
        phase: Some(Phase::Load),
        ..timed(1.0, at(point, pair(&[f64::NAN; 6], &[f64::INFINITY; 6])))
    };
    let channels = ["Px", "Py", "Pz", "Fx", "Fy", "Fz"];
    for metric in [
        "repeatability",
        "hysteresis",
        "linearity",
        "crosstalk",
        "bias_level",
        "tolerance",
        "drift",
    ] {
        let evaluation = evaluate(metric, &channels, &[broken("a"), broken("b")]);
        for (_, label, score) in evaluation.scores() {
            assert!(
                matches!(score.value, Value::Undefined(_)),
                "{metric} {label}"
            );
            assert_eq!((score.n, score.n_invalid), (0, 2), "{metric} {label}");
        }
    }
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
    // Means 1, 3, 5, …, 15 with standard deviation √24; repeats 0, 1, 2 about them: 1.
    let usual = presses(|point, turn| f64::from(2 * point + turn));
    close(
        scalar(&usual, "signal_to_repeatability", "Px"),
        24.0_f64.sqrt(),
    );
    let one = evaluate(
        "signal_to_repeatability",
        &["Px"],
        &[repeat("a", 0, 1.0), repeat("a", 0, 2.0)],
    );
    assert_eq!(
        said(&one, "signal_to_repeatability", "Px"),
        "1 repeated presses, 2 are needed"
    );
}

fn loop_at(point: &str, corners: &[(Phase, f64, f64)]) -> Vec<Sample> {
    let sample = |&(phase, depth, force): &(Phase, f64, f64)| Sample {
        phase: Some(phase),
        ..at(point, pair(&[1.0, 2.0, depth, force], &[0.0; 4]))
    };
    corners.iter().map(sample).collect()
}

#[test]
fn unsorted_branches_are_compared_all_the_same_and_shown_where_they_lie() {
    use Phase::{Load, Unload};
    // A triangle between (0, 0), (0.5, 0.4), (1, 1) and (0.5, 0.2): area 0.1 of 0.45.
    let corners = [
        (Unload, 0.5, 0.2),
        (Load, 1.0, 1.0),
        (Load, 0.0, 0.0),
        (Unload, 1.0, 1.0),
        (Load, 0.5, 0.4),
        (Unload, 0.0, 0.0),
    ];
    let evaluation = evaluate(
        "hysteresis",
        &["Px", "Py", "Pz", "Fz"],
        &loop_at("a", &corners),
    );
    let score = score(&evaluation, "hysteresis", "Fz");
    close(scalar(&evaluation, "hysteresis", "Fz"), 0.1);
    let greatest = score
        .variant("greatest_difference")
        .and_then(|variant| variant.value.scalar());
    close(greatest.expect("a number"), 0.2);
    let Some(Value::Map(map)) = score.variant("map").map(|variant| &variant.value) else {
        panic!("there is a footprint");
    };
    let filled: Vec<(usize, usize)> = (0..20)
        .flat_map(|row| (0..20).map(move |column| (row, column)))
        .filter(|&(row, column)| map.values[row][column].is_some())
        .collect();
    // x = 1 mm and y = 2 mm in cells of 1 mm from −10 mm.
    assert_eq!(filled, [(12, 11)]);
}

#[test]
fn branches_without_overlap_or_depths_say_which_it_is() {
    use Phase::{Load, Unload};
    let said = |corners: &[(Phase, f64, f64)]| {
        let samples = loop_at("a", corners);
        said(
            &evaluate("hysteresis", &["Px", "Py", "Pz", "Fz"], &samples),
            "hysteresis",
            "Fz",
        )
    };
    let short = [(Load, 0.0, 0.0), (Load, 1.0, 1.0), (Unload, 0.5, 0.2)];
    assert_eq!(said(&short), "no point has two depths on both branches");
    let apart = [
        (Load, 0.0, 0.0),
        (Load, 0.2, 0.1),
        (Unload, 0.5, 0.2),
        (Unload, 1.0, 1.0),
    ];
    assert_eq!(said(&apart), "no common range");
    assert_eq!(
        said(&short[..1]),
        "no point has two depths on both branches"
    );
}

fn surface(unit: &str, named: bool, place: impl Fn(f64, f64) -> [f64; 3]) -> Vec<Sample> {
    let sample = |number: u32| {
        let (x, y) = (f64::from(number % 7) - 3.0, f64::from(number / 7) - 3.0);
        Sample {
            unit_id: Some(unit.to_owned()),
            point_id: named.then(|| number.to_string()),
            truth: Readings::from_values(place(x, y)),
            ..Sample::default()
        }
    };
    (0..49).map(sample).collect()
}

fn dome(x: f64, y: f64) -> [f64; 3] {
    [x, y, -0.1 * x * x - 0.05 * y * y + 0.02 * x * y]
}

#[test]
fn a_surface_that_was_only_moved_has_no_gap() {
    let (sine, cosine) = (0.6, 0.8);
    let moved = |x: f64, y: f64| {
        let [x, y, z] = dome(x, y);
        [cosine * x - sine * y + 0.5, sine * x + cosine * y, z - 1.0]
    };
    let samples = [surface("a", true, dome), surface("b", true, moved)].concat();
    let evaluation = evaluate("inter_sensor", &["Px", "Py", "surface_z"], &samples);
    assert!(scalar(&evaluation, "inter_sensor", "surface_z") < 1e-13);
    let score = score(&evaluation, "inter_sensor", "surface_z");
    assert_eq!(score.count("pairs_by_point_id"), Some(1));
    assert!(score.interval.ends().is_some());
}

#[test]
fn surfaces_without_shared_points_are_laid_onto_each_other_step_by_step() {
    let moved = |x: f64, y: f64| {
        let [x, y, z] = dome(x, y);
        [x + 0.1, y - 0.1, z + 0.5]
    };
    let samples = [surface("a", false, dome), surface("b", false, moved)].concat();
    let evaluation = evaluate("inter_sensor", &["Px", "Py", "surface_z"], &samples);
    assert!(scalar(&evaluation, "inter_sensor", "surface_z") < 1e-13);
    let score = score(&evaluation, "inter_sensor", "surface_z");
    assert_eq!(score.count("pairs_by_point_id"), Some(0));
    assert_eq!(score.count("pairs_unsettled"), Some(0));
}

#[test]
fn a_single_unit_or_a_line_of_points_has_no_gap_to_tell() {
    let channels = ["Px", "Py", "surface_z"];
    let one = evaluate("inter_sensor", &channels, &surface("a", true, dome));
    assert_eq!(
        said(&one, "inter_sensor", "surface_z"),
        "one unit, two are needed"
    );
    let line = |x: f64, _: f64| [x, 0.0, 0.0];
    let lines = [surface("a", false, line), surface("b", false, line)].concat();
    let lines = evaluate("inter_sensor", &channels, &lines);
    assert_eq!(
        said(&lines, "inter_sensor", "surface_z"),
        "points on one line leave a turn open"
    );
}

#[test]
fn a_recording_tells_its_frame_rate_and_its_field_of_view() {
    let corner = |x: f64, y: f64, force: f64| pair(&[x, y, force], &[0.0; 3]);
    let digest = |digest: &str, sample: Sample| Sample {
        frame_digest: Some(digest.to_owned()),
        ..sample
    };
    let samples = [
        digest("p", timed(10.0, corner(-2.0, -1.0, 0.5))),
        digest("p", timed(10.5, corner(2.0, -1.0, 0.5))),
        digest("q", timed(11.0, corner(2.0, 1.0, 0.02))),
        digest("r", timed(11.5, corner(-2.0, 1.0, 0.5))),
        digest("s", timed(12.5, corner(9.0, 9.0, 0.019))),
    ];
    let evaluation = evaluate("intrinsic", &["Px", "Py", "Fz"], &samples);
    let value = |label| scalar(&evaluation, "intrinsic", label);
    assert_eq!(value("frame_rate").to_bits(), 2.0_f64.to_bits());
    assert_eq!(value("jitter").to_bits(), 0.0_f64.to_bits());
    assert_eq!((value("dropped"), value("duplicated")), (0.25, 0.25));
    assert_eq!(value("field_of_view").to_bits(), 8.0_f64.to_bits());
    assert_eq!(
        said(&evaluation, "intrinsic", "resolution"),
        "the sensor's `frame_size` is not declared"
    );
    let interval = score(&evaluation, "intrinsic", "frame_rate").interval;
    assert!(
        matches!(interval, Interval::Undefined(reason) if reason.to_string() == "no interval is defined")
    );
}

#[test]
fn without_times_or_with_equal_ones_there_is_no_rate() {
    let sample = || pair(&[0.0, 0.0, 0.0], &[0.0; 3]);
    let said = |samples: &[Sample], label| {
        said(
            &evaluate("intrinsic", &["Px", "Py", "Fz"], samples),
            "intrinsic",
            label,
        )
    };
    assert_eq!(said(&[sample(), sample()], "frame_rate"), "no time stamps");
    assert_eq!(
        said(&[timed(1.0, sample())], "frame_rate"),
        "fewer than 2 samples"
    );
    let equal = [timed(1.0, sample()), timed(1.0, sample())];
    assert_eq!(said(&equal, "frame_rate"), "equal time stamps");
    assert_eq!(
        said(&equal, "duplicated"),
        "no successive digests of frames"
    );
    assert_eq!(
        said(&equal, "field_of_view"),
        "no sample in contact says where"
    );
}

#[test]
fn the_least_force_told_from_none_comes_from_samples_without_contact() {
    // Ten predictions of ±0.01 N: variance 10⁻⁴ × 10 / 9.
    let idle = |count: u32| {
        let samples =
            (0..count).map(|row| pair(&[0.019], &[if row % 2 == 0 { 0.01 } else { -0.01 }]));
        let touched = pair(&[0.02], &[5.0]);
        samples.chain([touched]).collect::<Vec<_>>()
    };
    let evaluation = evaluate("minimum_detectable_force", &["Fz"], &idle(10));
    close(
        scalar(&evaluation, "minimum_detectable_force", "Fz"),
        3.29 * (1e-3_f64 / 9.0).sqrt(),
    );
    let few = evaluate("minimum_detectable_force", &["Fz"], &idle(9));
    assert_eq!(
        said(&few, "minimum_detectable_force", "Fz"),
        "fewer than 10 samples"
    );
}

#[test]
fn a_gain_and_an_offset_are_no_error_of_linearity() {
    let samples: Vec<Sample> = (0..40)
        .map(|row| {
            at(
                &row.to_string(),
                pair(&[f64::from(row)], &[0.5 + 0.75 * f64::from(row)]),
            )
        })
        .collect();
    let evaluation = evaluate("linearity", &["Fz"], &samples);
    assert_eq!(
        scalar(&evaluation, "linearity", "Fz").to_bits(),
        0.0_f64.to_bits()
    );
    let constant: Vec<Sample> = (0..5).map(|row| pair(&[1.0], &[f64::from(row)])).collect();
    let constant = evaluate("linearity", &["Fz"], &constant);
    assert_eq!(said(&constant, "linearity", "Fz"), "constant truth");
}

#[test]
fn a_force_that_leaks_into_another_is_told_by_name() {
    let sample = |row: u32| {
        let (x, z) = (f64::from(row % 5), f64::from(row / 5));
        at(&row.to_string(), pair(&[x, z], &[x + 0.1 * z, z]))
    };
    let samples: Vec<Sample> = (0..25).map(sample).collect();
    let evaluation = evaluate("crosstalk", &["Fx", "Fz"], &samples);
    close(scalar(&evaluation, "crosstalk", "all"), 0.1);
    let matrix = score(&evaluation, "crosstalk", "all")
        .variant("matrix")
        .expect("a matrix");
    let Value::Matrix(matrix) = &matrix.value else {
        panic!("{:?}", matrix.value);
    };
    assert_eq!(matrix.columns, ["Fx", "Fz"]);
    close(matrix.values[0][1].expect("a share"), 0.1);
    let alike: Vec<Sample> = (0..9)
        .map(|row| pair(&[f64::from(row); 2], &[f64::from(row); 2]))
        .collect();
    let alike = evaluate("crosstalk", &["Fx", "Fz"], &alike);
    assert_eq!(
        score(&alike, "crosstalk", "all").flags,
        [Flag::CollinearTruths]
    );
    let one = evaluate("crosstalk", &["Fz"], &samples_of_one());
    assert_eq!(
        said(&one, "crosstalk", "all"),
        "one channel, two are needed"
    );
}

fn samples_of_one() -> Vec<Sample> {
    (0..5).map(|row| pair(&[f64::from(row)], &[0.0])).collect()
}

#[test]
fn errors_that_cancel_over_the_range_show_at_their_levels() {
    let samples: Vec<Sample> = (0..20)
        .map(|row| {
            let (truth, error) = if row % 2 == 0 {
                (0.05, 0.25)
            } else {
                (-0.05, -0.25)
            };
            pair(&[truth], &[truth - error])
        })
        .collect();
    let evaluation = evaluate("bias_level", &["Fz"], &samples);
    close(scalar(&evaluation, "bias_level", "Fz"), 0.25);
    let curve = score(&evaluation, "bias_level", "Fz")
        .variant("curve")
        .expect("a curve");
    let Value::Curve(curve) = &curve.value else {
        panic!("{:?}", curve.value);
    };
    assert_eq!(
        (&curve.x[..], &curve.counts[..]),
        (&[-0.05, 0.05][..], &[10, 10][..])
    );
    let few = evaluate("bias_level", &["Fz"], &samples[..4]);
    assert_eq!(said(&few, "bias_level", "Fz"), "no bin has 5 samples");
    let light = evaluate("bias_level", &["Light"], &samples);
    assert_eq!(
        said(&light, "bias_level", "Light"),
        "no step is defined for lx"
    );
}

#[test]
fn an_error_as_large_as_the_tolerance_is_within_it() {
    // In binary64 0.40 − 0.35 is above 0.05.
    let samples = [
        pair(&[0.40], &[0.35]),
        pair(&[0.40], &[0.349]),
        pair(&[-1.0], &[3.0]),
    ];
    let evaluation = evaluate("tolerance", &["Pz"], &samples);
    assert_eq!(
        scalar(&evaluation, "tolerance", "Pz").to_bits(),
        (1.0_f64 / 3.0).to_bits()
    );
    let curve = score(&evaluation, "tolerance", "Pz")
        .variant("curve")
        .expect("a curve");
    let Value::Curve(curve) = &curve.value else {
        panic!("{:?}", curve.value);
    };
    let shares: Vec<f64> = curve.values.iter().flatten().copied().collect();
    assert_eq!(curve.x, [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0]);
    assert!(shares.windows(2).all(|pair| pair[0] <= pair[1]));
}

#[test]
fn an_error_that_grows_by_a_newton_an_hour_drifts_by_that() {
    let start = 1.7e9;
    let sample = |row: u32| {
        let hours = f64::from(row) * 0.25;
        at(
            &row.to_string(),
            timed(start + 3600.0 * hours, pair(&[hours], &[0.0])),
        )
    };
    let samples: Vec<Sample> = (0..12).map(sample).collect();
    let evaluation = evaluate("drift", &["Fz"], &samples);
    let score = score(&evaluation, "drift", "Fz");
    assert_eq!(
        (score.value.scalar(), score.unit),
        (Some(1.0), Unit::NewtonPerHour)
    );
    assert!(score.interval.ends().is_some());
    let equal = [
        timed(1.0, pair(&[1.0], &[0.0])),
        timed(1.0, pair(&[2.0], &[0.0])),
    ];
    assert_eq!(
        said(&evaluate("drift", &["Fz"], &equal), "drift", "Fz"),
        "equal time stamps"
    );
    assert_eq!(
        said(&evaluate("drift", &["Fz"], &equal[..1]), "drift", "Fz"),
        "fewer than 2 samples"
    );
}
