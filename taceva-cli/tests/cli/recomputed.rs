//! Numbers of a run, recomputed from its files, and the sensor unit and the models that the run names.

use std::fs;

use serde_json::Value;
use taceva_results::Samples;

use crate::support::Bench;

/// Scene with two units of a sensor, and three boards of each kind of grating, pressed four times.
const SCENE: &str = r#"scene_version = 1
name = "recomputed"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
model = { name = "ridge", set = { size = "8x8" } }
sensor = { driver = "sim/vitactip:reduction=16", units = ["0", "1"] }
metrics = { want = ["sr", "inter_sensor", "noise_equivalent_force"] }
protocol = { calibration = { points = 12, indentations = 2 }, gratings = { step_mm = 0.75, presses = 4 }, surface = { points = 6 }, idle = { frames = 12 } }
"#;

struct Run {
    report: Value,
    samples: Samples,
}

fn run(scene: &str) -> Run {
    let bench = Bench::new();
    bench.write("recomputed.toml", scene);
    let plan = bench.ok("plan recomputed.toml -q");
    assert!(plan.contains("add   metric  skill: "), "{plan}");
    bench.ok("run recomputed.toml --out run -q");
    let read = |name: &str| fs::read_to_string(bench.path(name)).expect("written");
    let report = serde_json::from_str(&read("run/reports/1-recomputed.json")).expect("JSON");
    let samples = Samples::read(&read("run/reports/1-recomputed.samples.csv")).expect("samples");
    Run { report, samples }
}

#[test]
fn shares_of_gratings_decoded_frames_and_the_unit_come_again_from_the_files_of_a_run() {
    let Run { report, samples } = run(SCENE);
    let nanometres = |mm: f64| (mm * 1e6).round();
    for kind in ["line", "dot"] {
        let (mut hits, mut n) = (0_u32, 0_u32);
        for row in 0..samples.rows() {
            let spacing = samples.number("spacing_mm", row);
            let predicted = samples.number("spacing_predicted_mm", row);
            let (Some(spacing), Some(predicted)) = (spacing, predicted) else {
                continue;
            };
            if samples.word("kind", row) == Some(kind) {
                n += 1;
                let off = (nanometres(spacing) - nanometres(predicted)).abs();
                hits += u32::from(off <= nanometres(0.05));
            }
        }
        let score = &report["metrics"]["sr"][kind];
        assert_eq!(score["n"], n, "{kind}");
        let share = f64::from(hits) / f64::from(n);
        let found = score["value"].as_f64().expect("a number");
        assert!((found - share).abs() < 1e-15, "{kind}: {found} for {share}");
    }
    // Each picture once, with those of gratings, and none for a channel that no metric reads.
    let frames = &report["provenance"]["frames_decoded"];
    let seen = (0..samples.rows()).filter(|row| {
        let protocol = samples.word("protocol", *row).unwrap_or_default();
        protocol != "surface-map"
    });
    assert_eq!(frames.as_u64(), Some(seen.count() as u64));
    let predicted: Vec<&str> = samples
        .channels()
        .into_iter()
        .filter(|channel| channel.is_predicted())
        .map(|channel| channel.name)
        .collect();
    assert_eq!(predicted, ["Fx", "Fy", "Fz"]);
    assert_eq!(report["subject"]["serial"], "0");
    let notes = report["provenance"]["notes"].to_string();
    for words in [
        "every score is for unit 0, except inter_sensor for units 0, 1",
        "detection limit: not verified",
    ] {
        assert!(notes.contains(words), "{notes}");
    }
    let noise = &report["metrics"]["noise_equivalent_force"]["Fz"];
    let [low, value, high] = [
        &noise["independent_low"]["value"],
        &noise["value"],
        &noise["independent_high"]["value"],
    ]
    .map(|number| number.as_f64().expect("a number"));
    assert!(low < value && value < high, "{noise}");
}

#[test]
fn shares_of_predictions_beyond_the_bounds_come_again_from_the_table_of_samples() {
    let scene = SCENE
        .replace(
            r#""sr", "inter_sensor", "noise_equivalent_force""#,
            r#""r_spatial""#,
        )
        .replace(r#"units = ["0", "1"]"#, r#"units = ["0"]"#)
        .replace("idle = {", "spatial = { points = 30 }, idle = {");
    let Run { report, samples } = run(&scene);
    let rows = samples.of_protocol("spatial");
    let mut greatest = 0.0_f64;
    for channel in ["Px", "Py", "Pz", "Fx", "Fy", "Fz"] {
        let score = &report["metrics"]["r_spatial"][channel];
        if score.is_null() {
            continue;
        }
        let of = samples.channel(channel).expect("a channel");
        let own = format!("{channel}_predicted_unbounded");
        let (mut beyond, mut n) = (0_u32, 0_u32);
        for &row in &rows {
            let Some(bounded) = of.prediction(row) else {
                continue;
            };
            n += 1;
            let unbounded = samples.number(&own, row).unwrap_or(bounded);
            beyond += u32::from((unbounded - bounded).abs() > 0.0);
        }
        let share = score["bounded_share"].as_f64().unwrap_or(0.0);
        let again = f64::from(beyond) / f64::from(n);
        assert!(
            (share - again).abs() < 1e-15,
            "{channel}: {share} for {again}"
        );
        greatest = greatest.max(again);
    }
    // A share of zero would prove nothing.
    assert!(greatest > 0.0, "{}", report["metrics"]);
}

#[test]
fn both_branches_of_a_press_are_predicted_on_request() {
    let scene = |asked: &str| {
        let small = SCENE.replace("\"sr\", \"inter_sensor\", ", "\"mae\", \"hysteresis\", ");
        let branches = format!("hysteresis = {{ points = 2, depth_step_mm = 0.5{asked} }}");
        small.replace("gratings = { step_mm = 0.75, presses = 4 }", &branches)
    };
    let Run { samples, .. } = run(&scene(", predicted = true"));
    let rows = samples.of_protocol("load-unload");
    let force = samples.channel("Fz").expect("a channel");
    for phase in ["load", "unload"] {
        let mut own = rows.iter().copied();
        assert!(own.any(|row| samples.word("phase", row) == Some(phase)));
    }
    assert!(rows.iter().all(|row| force.pair(*row).is_some()));
    let Run { samples, .. } = run(&scene(""));
    let rows = samples.of_protocol("load-unload");
    let force = samples.channel("Fz").expect("a channel");
    assert!(!rows.is_empty() && rows.iter().all(|row| force.prediction(*row).is_none()));
}

#[test]
fn repeated_presses_of_a_second_unit_on_request_are_a_gauge_study_and_no_score() {
    let scene = |asked: &str| {
        let small = SCENE.replace("\"sr\", \"inter_sensor\", ", "\"mae\", \"repeatability\", ");
        let repeats =
            format!("repeatability = {{ points = 3, trials = 2, depth_step_mm = 0.5{asked} }}");
        small.replace("gratings = { step_mm = 0.75, presses = 4 }", &repeats)
    };
    let bench = Bench::new();
    let n = |name: &str, asked: &str| {
        bench.write(&format!("{name}.toml"), &scene(asked));
        bench.ok(&format!("run {name}.toml --out {name} -q"));
        let report = bench.path(name).join("reports/1-recomputed.json");
        let report = fs::read_to_string(report).expect("written");
        let report: Value = serde_json::from_str(&report).expect("JSON");
        report["metrics"]["repeatability"]["Fz"]["n"].clone()
    };
    let one = n("one", "");
    assert!(one.as_u64() > Some(0), "{one}");
    assert_eq!(n("every", ", every_unit = true"), one);
    let table = "every/reports/1-recomputed.samples.csv";
    let found = bench.json(&format!("gauge {table} --channels Fz --drop-incomplete"));
    assert_eq!(found["operators"], 2, "{found}");
    let samples = fs::read_to_string(bench.path(table)).expect("written");
    assert!(samples.contains("other-units"), "the word of the protocol");
}
