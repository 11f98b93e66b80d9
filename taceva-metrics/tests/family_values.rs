//! Scores by place, scene and grating: values by hand, reasons where there is none, and states that are refused.

#[path = "support/press.rs"]
mod press;

use press::{METRICS, evaluate, evaluator, facts, plan, press as pressed};
use serde_json::json;
use taceva_core::{
    Batch, Channel, Channels, Column, Field, FieldSet, Footprint, GratingKind, Labels, Nanometre,
    Readings, Sample,
};
use taceva_metrics::{
    Evaluation, Evaluator, Flag, Interval, MetricPlan, SensorFacts, Settings, State, Value,
    catalogue,
};

fn said(value: &Value) -> String {
    match value {
        Value::Undefined(reason) => reason.to_string(),
        Value::NotApplicable(reason) => reason.to_string(),
        value => panic!("{value:?}"),
    }
}

fn score_said(evaluation: &Evaluation, metric: &str, label: &str) -> String {
    said(&evaluation.score(metric, label).expect("a score").value)
}

fn variant_said(evaluation: &Evaluation, metric: &str, label: &str, name: &str) -> String {
    let score = evaluation.score(metric, label).expect("a score");
    said(&score.variant(name).expect("a variant").value)
}

fn lit(point: usize, scene: &str, intensity: f64, error: f64) -> Sample {
    Sample {
        scene_id: Some(scene.to_owned()),
        intensity: Some(intensity),
        ..pressed(point, [0.0, 0.0, 0.5], 1.0, error)
    }
}

fn close(found: f64, expected: f64) {
    // Half of the last printed decimal of the quantile.
    assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
}

#[test]
fn nothing_has_no_value_and_says_so() {
    let evaluation = evaluate(&METRICS, &[]);
    let labels: Vec<&str> = evaluation.scores().map(|(_, label, _)| label).collect();
    assert_eq!(labels[..4], ["line", "dot", "Fz", "Fz"]);
    for (metric, label, score) in evaluation.scores() {
        assert_eq!(
            (said(&score.value), score.n),
            ("empty".to_owned(), 0),
            "{} {label}",
            metric.id
        );
    }
}

#[test]
fn one_press_has_a_sensitivity_and_one_bin_and_no_interval() {
    let evaluation = evaluate(&METRICS, &[pressed(0, [1.0, 1.0, 0.5], 2.0, 0.25)]);
    let sensitivity = evaluation.score("sensitivity", "Fz").expect("a score");
    assert_eq!(sensitivity.value, Value::Scalar(0.25));
    let Interval::Undefined(reason) = sensitivity.interval else {
        panic!("one cluster is not enough");
    };
    assert_eq!(reason.to_string(), "1 clusters, 5 are needed");
    let uniformity = evaluation.score("uniformity", "Fz").expect("a score");
    assert_eq!(
        (&uniformity.value, &uniformity.flags[..]),
        (&Value::Scalar(1.0), &[Flag::OneBin][..])
    );
    assert_eq!(
        variant_said(&evaluation, "uniformity", "Fz", "debiased"),
        "no bin has two samples"
    );
    assert_eq!(
        variant_said(&evaluation, "uniformity", "Fz", "n_min_5"),
        "no bin has 5 samples"
    );
    assert_eq!(
        evaluation.score("r_spatial", "Fz").expect("a score").value,
        Value::Scalar(0.0)
    );
    assert_eq!(
        variant_said(&evaluation, "r_spatial", "Fz", "excess"),
        "no bin has two samples"
    );
}

#[test]
fn what_is_no_number_is_counted_everywhere() {
    let samples: Vec<Sample> = (0..6)
        .map(|point| lit(point, "normal", 100.0, f64::NAN))
        .collect();
    let evaluation = evaluate(&["r_spatial", "r_light"], &samples);
    for metric in ["r_spatial", "r_light"] {
        let score = evaluation.score(metric, "Fz").expect("a score");
        assert_eq!((score.n, score.n_invalid), (0, 6), "{metric}");
        assert_eq!(said(&score.value), "empty");
    }
    let presses: Vec<Sample> = (0..6)
        .map(|point| pressed(point, [0.0, 0.0, f64::NAN], 1.0, 0.0))
        .collect();
    let evaluation = evaluate(&["sensitivity"], &presses);
    let score = evaluation.score("sensitivity", "Fz").expect("a score");
    assert_eq!((score.n, score.n_invalid), (0, 6));
    let dark = evaluate(&["r_light"], &[lit(0, "normal", -1.0, 0.1)]);
    assert_eq!(dark.score("r_light", "Fz").expect("a score").n_invalid, 1);
}

#[test]
fn presses_below_the_gate_or_off_the_surface_are_counted_apart() {
    let samples = [
        pressed(0, [0.0, 0.0, 0.1], 0.019, 0.0),
        pressed(1, [0.0, 0.0, -0.1], 1.0, 0.0),
        pressed(2, [12.0, 12.0, 0.1], 1.0, 0.0),
    ];
    let all = evaluate(&["sensitivity", "uniformity"], &samples);
    let score = all.score("sensitivity", "Fz").expect("a score");
    assert_eq!(
        (score.n, score.count("gated"), score.count("outside")),
        (1, Some(2), Some(1))
    );
    assert_eq!(
        score_said(&all, "uniformity", "Fz"),
        "no sample on the footprint"
    );
    let gated = evaluate(&["sensitivity", "uniformity"], &samples[..2]);
    assert_eq!(
        score_said(&gated, "sensitivity", "Fz"),
        "no truth reaches the gate"
    );
    let deep = evaluate(&["r_spatial"], &[pressed(0, [0.0, 0.0, 1.5], 1.0, 0.1)]);
    assert_eq!(
        score_said(&deep, "r_spatial", "Fz"),
        "no sample on the footprint"
    );
    assert_eq!(
        deep.score("r_spatial", "Fz")
            .and_then(|score| score.count("outside")),
        Some(1)
    );
}

#[test]
fn scenes_without_a_reference_or_without_another_have_no_robustness() {
    let reference = [lit(0, "normal", 100.0, 0.1)];
    assert_eq!(
        score_said(&evaluate(&["r_light"], &reference), "r_light", "Fz"),
        "no scene but the reference scene"
    );
    let other = [lit(0, "S1", 100.0, 0.1)];
    assert_eq!(
        score_said(&evaluate(&["r_light"], &other), "r_light", "Fz"),
        "no sample of the reference scene"
    );
    let same = [lit(0, "normal", 100.0, 0.5), lit(0, "S1", 100.0, 0.5)];
    assert_eq!(
        score_said(&evaluate(&["r_light"], &same), "r_light", "Fz"),
        "neither light nor error changed"
    );
}

#[test]
fn robustness_to_lighting_by_hand() {
    // Errors 1…5 and 2…10 over five places: means 3 and 6, both with a relative variance of 0.5 / 9. Light 100 → 300:
    // a = 2, b = 1, R = 2/3; slope 2 × 2 / 9; variance (4/9)² × 2 × 0.5 / 9, standard error 4/27; t(4) = 2.776445105.
    let samples: Vec<Sample> = (1_u32..=5)
        .flat_map(|place| {
            let point = place as usize;
            let error = f64::from(place);
            [
                lit(point, "normal", 100.0, error),
                lit(point, "S1", 300.0, 2.0 * error),
            ]
        })
        .collect();
    let evaluation = evaluate(&["r_light"], &samples);
    let score = evaluation.score("r_light", "Fz").expect("a score");
    assert_eq!(score.value, Value::Scalar(2.0 / 3.0));
    assert_eq!(
        score.interval.method().as_deref(),
        Some("delta method by point_id, G=5")
    );
    let [low, high] = score.interval.ends().expect("five places are enough");
    let half = 2.776_445_105 * 4.0 / 27.0;
    close(low, 2.0 / 3.0 - half);
    close(high, 2.0 / 3.0 + half);
    let scene = score.variant("scene:S1").expect("a scene");
    assert_eq!(
        (&scene.value, scene.interval),
        (&score.value, Some(score.interval))
    );
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
fn little_light_and_smaller_errors_are_flagged() {
    let samples = [lit(0, "normal", 100.0, 0.5), lit(0, "S1", 102.0, 0.25)];
    let evaluation = evaluate(&["r_light"], &samples);
    let score = evaluation.score("r_light", "Fz").expect("a score");
    assert_eq!(score.flags, [Flag::LowStimulus, Flag::ImprovedError]);
    assert_eq!(
        score.variant("plus").map(|plus| &plus.value),
        Some(&Value::Scalar(1.0))
    );
}

#[test]
fn shear_that_nobody_measures_leaves_no_normal_presses_to_tell() {
    let wanted = catalogue::select(["sensitivity"]).expect("known names");
    let channels = Channels::new([Channel::PZ, Channel::FZ]).expect("two channels");
    let plan = MetricPlan::new(&wanted, channels, FieldSet::PAIRS);
    let sample = Sample {
        truth: Readings::from_values([0.5, 2.0]),
        ..Sample::default()
    };
    let evaluation = evaluator(&plan, [&sample])
        .finish()
        .expect("the plan's channels");
    assert_eq!(
        variant_said(&evaluation, "sensitivity", "Fz", "normal_only"),
        "there is no channel `Fx`"
    );
    assert_eq!(
        evaluation
            .score("sensitivity", "Fz")
            .map(|score| score.variant("map")),
        Some(None)
    );
    let sheared = Sample {
        truth: Readings::from_values([0.0, 0.0, 0.5, 0.1, 0.0, 2.0]),
        ..Sample::default()
    };
    let evaluation = evaluate(&["sensitivity"], &[sheared]);
    assert_eq!(
        variant_said(&evaluation, "sensitivity", "Fz", "normal_only"),
        "empty"
    );
}

#[test]
fn facts_that_nobody_declared_are_named() {
    let wanted = catalogue::select(METRICS).expect("known names");
    let channels = Channels::new(Channel::SIX).expect("distinct channels");
    let all: FieldSet = Field::ALL.into_iter().collect();
    let plan = MetricPlan::new(&wanted, channels, all);
    let reasons = |plan: &MetricPlan| -> Vec<String> {
        let skipped = plan.skipped().iter();
        skipped
            .map(|skipped| format!("{}: {}", skipped.what, skipped.reason))
            .collect()
    };
    assert_eq!(
        reasons(&plan),
        [
            "metric:uniformity: the sensor's `footprint` is not declared",
            "metric:r_spatial: the sensor's `footprint` is not declared",
        ]
    );
    let opaque = SensorFacts {
        footprint: Some(Footprint::disc(5.0, None).expect("a length")),
        opaque: Some(true),
        ..SensorFacts::default()
    };
    assert_eq!(
        reasons(&plan.with_facts(opaque)),
        [
            "metric:r_spatial: the sensor's `depth_max_mm` is not declared",
            "metric:r_light: the gel is opaque: ambient light cannot reach the camera",
        ]
    );
}

#[test]
fn boards_without_a_name_are_clusters_by_what_is_on_them() {
    let wanted = catalogue::select(["sr"]).expect("known names");
    let gratings = FieldSet::EMPTY
        .with(Field::Kind)
        .with(Field::Spacing)
        .with(Field::PredictedSpacing);
    let plan = MetricPlan::new(&wanted, Channels::default(), gratings);
    let samples: Vec<Sample> = (0..30)
        .map(|row| Sample {
            kind: Some(GratingKind::Line),
            spacing: Some(Nanometre(250_000 + 50_000 * (row % 6))),
            predicted_spacing: Some(Nanometre(300_000)),
            ..Sample::default()
        })
        .collect();
    let evaluation = evaluator(&plan, &samples)
        .finish()
        .expect("the plan's channels");
    let score = evaluation.score("sr", "line").expect("a score");
    assert_eq!(score.value, Value::Scalar(0.5));
    assert_eq!(
        score.interval.method().as_deref(),
        Some("jackknife by point_id, G=6")
    );
    let wilson = score.variant("wilson").and_then(|wilson| wilson.interval);
    assert!(matches!(wilson, Some(Interval::Wilson { low, high }) if low < 0.5 && 0.5 < high));
}

#[test]
fn a_spacing_between_two_nanometres_is_invalid() {
    let channels = Channels::new([Channel::FZ]).expect("one channel");
    let wanted = catalogue::select(["sr"]).expect("known names");
    let all: FieldSet = Field::ALL.into_iter().collect();
    let plan = MetricPlan::new(&wanted, channels.clone(), all);
    let mut kinds = Labels::default();
    (0..2).for_each(|_| kinds.push("line"));
    let column = || vec![Column::full(vec![0.0; 2])];
    let batch = Batch::from_columns(channels, column(), column(), None)
        .with_labels(Field::Kind, kinds)
        .with_numbers(Field::Spacing, Column::full(vec![350_000.0, 350_000.5]))
        .with_numbers(Field::PredictedSpacing, Column::full(vec![350_000.0; 2]));
    let mut evaluator = Evaluator::new(&plan);
    evaluator.update(&batch).expect("the plan's channels");
    let evaluation = evaluator.finish().expect("the plan's channels");
    let score = evaluation.score("sr", "line").expect("a score");
    assert_eq!((score.n, score.n_invalid), (1, 1));
}

#[test]
fn states_of_another_surface_or_other_constants_are_refused() {
    let samples = [pressed(0, [1.0, 1.0, 0.5], 2.0, 0.25)];
    let states = evaluator(&plan(&["uniformity"]), &samples)
        .states()
        .expect("one channel list");
    let other_surface = plan(&["uniformity"]).with_facts(SensorFacts {
        footprint: Some(Footprint::disc(10.0, Some(1.0)).expect("lengths")),
        ..facts()
    });
    let fewer_bins = plan(&["uniformity"]).with_settings(Settings {
        bins: 10,
        ..Settings::default()
    });
    for plan in [other_surface, fewer_bins.expect("ten bins")] {
        let error = Evaluator::new(&plan)
            .merge_states(&states)
            .expect_err("other parameters");
        assert!(
            error.to_string().starts_with("state with parameters"),
            "{error}"
        );
    }
    let refused = plan(&["uniformity"]).with_settings(Settings {
        bins: 0,
        ..Settings::default()
    });
    assert_eq!(
        refused.expect_err("no bin").to_string(),
        "setting `bins` is 0, expected 1 to 1000"
    );
}

#[test]
fn a_state_with_impossible_content_is_refused_and_changes_nothing() {
    let sample = Sample {
        kind: Some(GratingKind::Line),
        spacing: Some(Nanometre(350_000)),
        predicted_spacing: Some(Nanometre(350_000)),
        ..lit(0, "S1", 100.0, 0.5)
    };
    let whole = evaluator(&plan(&METRICS), &[sample])
        .states()
        .expect("the plan's channels");
    let whole = serde_json::to_string(&whole).expect("a state");
    let edits = [
        (r#""counts":[0,0,1]"#, r#""counts":[0,0,0]"#),
        (r#""cells":{"10 10":"#, r#""cells":{"10 20":"#),
        (r#""cells":{"10 10":"#, r#""cells":{"1010":"#),
        (
            r#""cells":{"10 10":{"counts":[1,1]"#,
            r#""cells":{"10 10":{"counts":[0,0]"#,
        ),
        (r#""distance 00":"#, r#""distance 100":"#),
        (r#""distance 00":"#, r#""height 00":"#),
        (r#""S1":{"counts":[1]"#, r#""S1":{"counts":[0]"#),
        (r#""S1":{"counts":[1]"#, r#""S1":{"counts":[1,1]"#),
    ];
    for (from, to) in edits {
        let broken = whole.replacen(from, to, 1);
        assert_ne!(broken, whole, "{from} is in the state {whole}");
        let read: Vec<State> = serde_json::from_str(&broken).expect("JSON of a state");
        let refusals = read.iter().filter(|state| {
            let mut fresh = Evaluator::new(&plan(&METRICS));
            fresh.merge_states(std::slice::from_ref(state)).is_err()
        });
        assert_eq!(refusals.count(), 1, "{to} was taken");
    }
}

#[test]
fn a_report_has_maps_curves_and_variants_as_fields_of_their_metric() {
    let samples: Vec<Sample> = (0..5)
        .map(|point| pressed(point, [1.0, 1.0, 0.5], 2.0, 0.25))
        .collect();
    let two_bins = plan(&METRICS).with_settings(Settings {
        bins: 2,
        ..Settings::default()
    });
    let evaluator = evaluator(&two_bins.expect("two bins"), &samples);
    let evaluation = evaluator.finish().expect("the plan's channels");
    let report = serde_json::to_value(&evaluation).expect("a report");
    let sensitivity = &report["metrics"]["sensitivity"]["Fz"];
    assert_eq!(sensitivity["unit"], "mm/N");
    assert_eq!(sensitivity["slope"]["value"], 0.25);
    assert_eq!(sensitivity["slope"]["ci95"], json!([0.25, 0.25]));
    assert_eq!(
        sensitivity["counts"],
        json!({"gated": 0, "outside": 0, "bins_used": 1})
    );
    assert_eq!(
        sensitivity["map"],
        json!({
            "x_mm": [-12.5, 0.0, 12.5], "y_mm": [-12.5, 0.0, 12.5],
            "values": [[null, null], [null, 0.25]], "counts": [[0, 0], [0, 5]], "unit": "mm/N"
        })
    );
    assert_eq!(
        report["metrics"]["uniformity"]["Fz"]["flags"],
        json!(["one bin"])
    );
    let distance = &report["metrics"]["r_spatial"]["Fz"]["distance"];
    assert_eq!(
        (&distance["x_unit"], &distance["unit"]),
        (&json!("mm"), &json!("N"))
    );
    assert_eq!(distance["values"].as_array().map(Vec::len), Some(100));
    let table = evaluation.to_string();
    assert!(table.contains("sensitivity.slope"), "{table}");
}
