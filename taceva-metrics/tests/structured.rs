//! Golden values of scores by grating, place and scene, bit for bit: in order, backwards, and shuffled, split and merged.

#![expect(clippy::print_stdout, reason = "says how many values were compared")]

#[path = "golden/structured.rs"]
mod structured;

use structured::{
    Comparison, Random, check_keys, exact, in_every_way, real, section, signed, text, whole,
};
use taceva_core::{
    Channel, Channels, Field, FieldSet, Footprint, GratingKind, Nanometre, Readings, Sample,
};
use taceva_metrics::{
    Evaluation, MetricPlan, SensorFacts, Settings, UndefinedReason, Value as Finished, catalogue,
};

fn plan(metrics: &[&str], channels: &[Channel], facts: SensorFacts) -> MetricPlan {
    let wanted = catalogue::select(metrics.iter().copied()).expect("known names");
    let channels = Channels::new(channels.iter().cloned()).expect("distinct channels");
    let available: FieldSet = Field::ALL.into_iter().collect();
    let plan = MetricPlan::new(&wanted, channels, available).with_facts(facts);
    assert_eq!(plan.skipped(), []);
    plan
}

fn with(plan: &MetricPlan, settings: Settings) -> MetricPlan {
    plan.clone()
        .with_settings(settings)
        .expect("settings with a meaning")
}

fn value(evaluation: &Evaluation, metric: &str, label: &str) -> Option<f64> {
    evaluation.score(metric, label)?.value.scalar()
}

fn variant(evaluation: &Evaluation, metric: &str, label: &str, name: &str) -> Option<f64> {
    evaluation
        .score(metric, label)?
        .variant(name)?
        .value
        .scalar()
}

fn millimetres(nanometres: i64) -> f64 {
    Nanometre(nanometres).to_millimetres()
}

fn point(row: usize) -> Option<String> {
    Some(format!("point {}", row % 50))
}

fn spacing_sample(row: usize, truth: Nanometre, predicted: Nanometre) -> Sample {
    Sample {
        point_id: point(row),
        kind: Some(GratingKind::Line),
        spacing: Some(truth),
        predicted_spacing: Some(predicted),
        ..Sample::default()
    }
}

/// The share of `samples` within `tolerance`, which must be the same in every way.
fn success_rates(samples: &[Sample], tolerance: Nanometre) -> Vec<(&'static str, Evaluation)> {
    let plan = plan(&["sr"], &[], SensorFacts::default());
    let settings = Settings {
        resolution_tolerance: tolerance,
        ..Settings::default()
    };
    in_every_way(&with(&plan, settings), samples)
}

#[test]
fn success_rates_are_the_counts_of_whole_nanometres() {
    let golden = section(
        "sr",
        &[
            "params",
            "tick_nm",
            "recipe",
            "counts_k0_to_k20",
            "n",
            "float_trap",
            "float_counts_on_recipe",
            "continuous",
            "continuous_rule",
        ],
    );
    let params = &golden["params"];
    check_keys(params, &["n", "seed", "tick_nm", "lo", "hi"]);
    let (tick, low, high) = (
        signed(&params["tick_nm"]),
        signed(&params["lo"]),
        signed(&params["hi"]),
    );
    let n = whole(&params["n"]);
    let mut random = Random(whole(&params["seed"]));
    let samples: Vec<Sample> = (0..usize::try_from(n).expect("a count"))
        .map(|row| {
            let level = low + random.below(high - low + 1);
            let error = random.below(7);
            let predicted = (level + error - 3).clamp(low, high);
            spacing_sample(row, Nanometre(level * tick), Nanometre(predicted * tick))
        })
        .collect();
    let mut comparison = Comparison::default();
    let counts = golden["counts_k0_to_k20"].as_array().expect("counts");
    for (k, count) in (0..).zip(counts) {
        #[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
        let share = whole(count) as f64 / n as f64;
        for (way, evaluation) in success_rates(&samples, Nanometre(k * tick)) {
            comparison.bits(
                &format!("SR({k}) {way}"),
                value(&evaluation, "sr", "line"),
                share,
            );
            comparison.count("n", evaluation.score("sr", "line").map(|score| score.n), n);
            let curve = evaluation
                .score("sr", "line")
                .and_then(|score| score.variant("curve"));
            let Some(Finished::Curve(curve)) = curve.map(|curve| &curve.value) else {
                panic!("a success rate has a curve");
            };
            if tick == 50_000 {
                let at = usize::try_from(k).expect("a level");
                comparison.count("curve", curve.counts.get(at).copied(), whole(count));
            }
        }
    }
    for case in golden["float_trap"]["first"].as_array().expect("cases") {
        let [a, b, k] = [0, 1, 2].map(|at| signed(&case[at]));
        let sample = spacing_sample(0, Nanometre(a * tick), Nanometre(b * tick));
        let expected = if (a - b).abs() <= k { 1.0 } else { 0.0 };
        for (way, evaluation) in success_rates(&[sample], Nanometre(k * tick)) {
            comparison.bits(
                &format!("{case} {way}"),
                value(&evaluation, "sr", "line"),
                expected,
            );
        }
    }
    for case in golden["continuous"].as_array().expect("cases") {
        check_keys(case, &["r_mm", "rhat_mm", "eps_mm", "in"]);
        let length = |key: &str| text(&case[key]).parse::<Nanometre>().expect("a length");
        let sample = spacing_sample(0, length("r_mm"), length("rhat_mm"));
        let expected = if case["in"].as_bool().expect("yes or no") {
            1.0
        } else {
            0.0
        };
        for (way, evaluation) in success_rates(&[sample], length("eps_mm")) {
            comparison.bits(
                &format!("{case} {way}"),
                value(&evaluation, "sr", "line"),
                expected,
            );
        }
    }
    println!("compared {} values of sr", comparison.done());
}

#[test]
fn sensitivity_and_uniformity_are_rationals_rounded_once() {
    let golden = section(
        "su",
        &[
            "params",
            "recipe",
            "bin",
            "gated",
            "kept",
            "nonempty",
            "nmin1",
            "nmin5",
            "slope_through_origin",
        ],
    );
    let params = &golden["params"];
    check_keys(
        params,
        &["n", "seed", "R_nm", "G", "z_scale", "F_scale", "gate_N"],
    );
    let half = signed(&params["R_nm"]);
    let bins = signed(&params["G"]);
    let gate = real(&params["gate_N"]);
    let mut random = Random(whole(&params["seed"]));
    let samples: Vec<Sample> = (0..usize::try_from(whole(&params["n"])).expect("a count"))
        .map(|row| {
            let mut x = random.below(2 * half + 1) - half;
            let y = random.below(2 * half + 1) - half;
            let z = random.unit() * real(&params["z_scale"]);
            let mut force = random.unit() * real(&params["F_scale"]);
            if row % 97 == 0 {
                x = random.below(bins + 1) * (2 * half / bins) - half;
            }
            if row % 501 == 0 {
                force = 0.02;
            }
            Sample {
                point_id: point(row),
                truth: Readings::from_values([millimetres(x), millimetres(y), z, force]),
                ..Sample::default()
            }
        })
        .collect();
    let side = millimetres(half);
    let facts = SensorFacts {
        footprint: Some(Footprint::rectangle(side, side, None).expect("a length")),
        ..SensorFacts::default()
    };
    let plan = plan(
        &["sensitivity", "uniformity"],
        &[Channel::PX, Channel::PY, Channel::PZ, Channel::FZ],
        facts,
    );
    let settings = Settings {
        bins: u32::try_from(bins).expect("few bins"),
        gate: taceva_core::Newton(gate),
        ..Settings::default()
    };
    let mut comparison = Comparison::default();
    for (key, n_min) in [("nmin1", 1), ("nmin5", 5)] {
        let expected = &golden[key];
        check_keys(
            expected,
            &["bins_used", "mu", "sigma_pop", "sigma_sample", "U", "truth"],
        );
        for ddof in [0, 1] {
            let settings = Settings {
                n_min,
                ddof,
                ..settings
            };
            for (way, evaluation) in in_every_way(&with(&plan, settings), &samples) {
                let what = |name: &str| format!("{key} {name} ddof {ddof} {way}");
                let of = |name| variant(&evaluation, "uniformity", "Fz", name);
                let score = evaluation.score("uniformity", "Fz").expect("a score");
                let sigma = if ddof == 0 {
                    "sigma_pop"
                } else {
                    "sigma_sample"
                };
                comparison.bits(&what("mu"), of("mean"), exact(&expected["mu"]));
                comparison.bits(&what(sigma), of("deviation"), exact(&expected[sigma]));
                comparison.count(
                    &what("bins"),
                    score.count("bins_used"),
                    whole(&expected["bins_used"]),
                );
                comparison.count(&what("kept"), Some(score.n), whole(&golden["kept"]));
                comparison.count(
                    &what("gated"),
                    score.count("gated"),
                    whole(&golden["gated"]),
                );
                if ddof == 0 {
                    comparison.bits(&what("U"), score.value.scalar(), exact(&expected["U"]));
                    let five = exact(&golden["nmin5"]["U"]);
                    comparison.bits(&what("U of 5"), of("n_min_5"), five);
                }
                let slope = exact(&golden["slope_through_origin"]["value"]);
                let found = variant(&evaluation, "sensitivity", "Fz", "slope");
                comparison.bits(&what("slope"), found, slope);
                let map = evaluation
                    .score("sensitivity", "Fz")
                    .and_then(|score| score.variant("map"));
                let Some(Finished::Map(map)) = map.map(|map| &map.value) else {
                    panic!("sensitivity has a map");
                };
                let nonempty = map
                    .counts
                    .iter()
                    .flatten()
                    .filter(|count| **count > 0)
                    .count();
                comparison.count(
                    &what("cells"),
                    Some(nonempty as u64),
                    whole(&golden["nonempty"]),
                );
            }
        }
    }
    println!("compared {} values of su", comparison.done());
}

#[test]
fn spatial_robustness_is_formed_in_whole_nanometres() {
    let golden = section(
        "r_spatial",
        &[
            "params",
            "recipe",
            "bin",
            "counts_dist",
            "counts_depth",
            "float_trap",
            "nmin1_pop",
            "nmin5_pop",
            "nmin1_sample",
        ],
    );
    let params = &golden["params"];
    check_keys(params, &["n", "seed", "Rm_nm", "Dm_nm", "bins", "scale"]);
    let (reach, deepest) = (signed(&params["Rm_nm"]), signed(&params["Dm_nm"]));
    assert_eq!(
        whole(&params["bins"]),
        100,
        "the definition has a hundred bins"
    );
    let mut random = Random(whole(&params["seed"]));
    let samples: Vec<Sample> = (0..usize::try_from(whole(&params["n"])).expect("a count"))
        .map(|row| {
            let (mut x, mut y);
            loop {
                x = random.below(2 * reach + 1) - reach;
                y = random.below(2 * reach + 1) - reach;
                if x * x + y * y <= reach * reach {
                    break;
                }
            }
            let mut depth = random.below(deepest + 1);
            if row % 40 == 0 {
                x = random.below(101) * (reach / 100);
                y = 0;
            }
            if row % 50 == 0 {
                depth = random.below(101) * (deepest / 100);
            }
            let error = (real(&params["scale"]) * random.bell()).abs();
            let place = [x, y, depth].map(|length| Some(millimetres(length)));
            let truth = place.into_iter().chain([Some(0.0)]).collect();
            Sample {
                point_id: point(row),
                truth: Readings::new(truth),
                prediction: Some(Readings::new(vec![None, None, None, Some(error)])),
                ..Sample::default()
            }
        })
        .collect();
    let footprint = Footprint::disc(millimetres(reach), Some(millimetres(deepest)));
    let facts = SensorFacts {
        footprint: Some(footprint.expect("lengths")),
        ..SensorFacts::default()
    };
    let channels = [Channel::PX, Channel::PY, Channel::PZ, Channel::FZ];
    let plan = plan(&["r_spatial"], &channels, facts);
    let mut comparison = Comparison::default();
    for (key, n_min, ddof) in [
        ("nmin1_pop", 1, 0),
        ("nmin5_pop", 5, 0),
        ("nmin1_sample", 1, 1),
    ] {
        let expected = &golden[key];
        check_keys(
            expected,
            &[
                "bins_dist",
                "bins_depth",
                "std_dist",
                "std_depth",
                "R",
                "truth_R",
            ],
        );
        let settings = Settings {
            n_min,
            ddof,
            ..Settings::default()
        };
        for (way, evaluation) in in_every_way(&with(&plan, settings), &samples) {
            let what = |name: &str| format!("{key} {name} {way}");
            let of = |name| variant(&evaluation, "r_spatial", "Fz", name);
            let score = evaluation.score("r_spatial", "Fz").expect("a score");
            comparison.bits(&what("R"), score.value.scalar(), exact(&expected["R"]));
            comparison.bits(
                &what("distance"),
                of("std_distance"),
                exact(&expected["std_dist"]),
            );
            comparison.bits(
                &what("depth"),
                of("std_depth"),
                exact(&expected["std_depth"]),
            );
            let bins = [("bins_distance", "bins_dist"), ("bins_depth", "bins_depth")];
            for (name, key) in bins {
                comparison.count(&what(name), score.count(name), whole(&expected[key]));
            }
            for (name, key) in [("distance", "counts_dist"), ("depth", "counts_depth")] {
                let curve = score.variant(name).map(|curve| &curve.value);
                let Some(Finished::Curve(curve)) = curve else {
                    panic!("there is a curve over {name}");
                };
                for (bin, count) in golden[key].as_array().expect("counts").iter().enumerate() {
                    comparison.count(&what(key), curve.counts.get(bin).copied(), whole(count));
                }
            }
        }
    }
    println!("compared {} values of r_spatial", comparison.done());
}

#[test]
fn robustness_to_lighting_is_one_rational_of_four_numbers() {
    let golden = section("r_light", &[]);
    let plan = plan(&["r_light"], &[Channel::FZ], SensorFacts::default());
    let mut comparison = Comparison::default();
    for case in golden.as_array().expect("cases") {
        check_keys(
            case,
            &["Ic", "Io", "MAEc", "MAEo", "dec", "status", "R", "R_plus"],
        );
        let sample = |row: usize, scene: &str, intensity: &str, error: &str| Sample {
            point_id: point(row),
            scene_id: Some(scene.to_owned()),
            intensity: Some(exact(&case[intensity])),
            truth: Readings::from_values([0.0]),
            prediction: Some(Readings::from_values([exact(&case[error])])),
            ..Sample::default()
        };
        let samples: Vec<Sample> = (0..6)
            .flat_map(|row| {
                [
                    sample(row, "normal", "Io", "MAEo"),
                    sample(row, "S1", "Ic", "MAEc"),
                ]
            })
            .collect();
        for (way, evaluation) in in_every_way(&plan, &samples) {
            let what = format!("{} {way}", case["dec"]);
            let score = evaluation.score("r_light", "Fz").expect("a score");
            let expected = match text(&case["status"]) {
                "ok" => {
                    comparison.bits(&what, score.value.scalar(), exact(&case["R"]));
                    let plus = text(&case["R_plus"]).parse().expect("a number");
                    let found = variant(&evaluation, "r_light", "Fz", "plus");
                    comparison.bits(&format!("plus of {what}"), found, plus);
                    let own = variant(&evaluation, "r_light", "Fz", "scene:S1");
                    comparison.bits(&format!("scene of {what}"), own, exact(&case["R"]));
                    continue;
                }
                "undefined_no_change" => UndefinedReason::NoChange,
                "undefined_zero_intensity" => UndefinedReason::ZeroIntensity,
                "undefined_zero_baseline_mae" => UndefinedReason::ZeroBaseline,
                other => panic!("status `{other}` is not known to this reader"),
            };
            assert!(case["R"].is_null() && case["R_plus"].is_null());
            assert_eq!(score.value, Finished::Undefined(expected), "{what}");
            comparison.count(&what, Some(score.n), 12);
        }
    }
    println!("compared {} values of r_light", comparison.done());
}

#[test]
fn scores_by_place_scene_and_grating_are_the_same_on_every_instruction_set() {
    structured::again_on_every_instruction_set();
}
