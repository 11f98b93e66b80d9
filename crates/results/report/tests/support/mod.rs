//! Synthetic results with every kind of value, from formulas, read like any other result.

#![allow(dead_code, reason = "the benchmark uses a part")]

use std::collections::BTreeMap;
use std::fmt::Write;

use serde_json::{Value, json};
use taceva_metrics::{Standing, catalogue};
use taceva_report::Study;
use taceva_results::{ResultsError, Samples};

/// The six channels.
pub(crate) const SIX: [&str; 6] = ["Px", "Py", "Pz", "Fx", "Fy", "Fz"];

/// The only study of a result, which is sealed before it is read.
pub(crate) fn study(result: &Value) -> Study {
    read(result).expect("a result").remove(0)
}

/// Studies of a result, which is sealed before it is read.
pub(crate) fn read(result: &Value) -> Result<Vec<Study>, ResultsError> {
    let mut result = result.clone();
    state_standings(&mut result["metrics"]);
    let sealed = taceva_files::seal::json::seal(&result.to_string()).expect("an object");
    Study::read(&sealed)
}

/// Sets the standing of each score from the R² of its channels and from its flags, as an evaluation does.
fn state_standings(metrics: &mut Value) {
    let of_r2 = |r2: &Value| {
        let low = r2["ci95"].as_array().and_then(|ends| ends[0].as_f64());
        Standing::of_value(low, r2["value"].as_f64())
    };
    let skills: BTreeMap<String, Standing> = match metrics["r2"].as_object() {
        Some(r2) => r2
            .iter()
            .map(|(channel, r2)| (channel.clone(), of_r2(r2)))
            .collect(),
        None => BTreeMap::new(),
    };
    let skill_of = |channel: &str| {
        skills
            .get(channel)
            .copied()
            .unwrap_or(Standing::SkillUnknown)
    };
    for (metric, channels) in metrics.as_object_mut().into_iter().flatten() {
        let Some(metric) = catalogue::find(metric) else {
            continue;
        };
        for (channel, score) in channels.as_object_mut().into_iter().flatten() {
            let of = score["of"].as_array().cloned().unwrap_or_default();
            let of: Vec<&str> = match of.is_empty() {
                true => vec![channel],
                false => of.iter().filter_map(Value::as_str).collect(),
            };
            let is_low = score["flags"] == json!(["low stimulus"]);
            let by_flag = if is_low {
                Standing::LowStimulus
            } else {
                Standing::Counts
            };
            let standing = Standing::of_channels(metric, of, skill_of).max(by_flag);
            if let (Some(words), true) = (standing.words(), score.get("standing").is_none()) {
                score["standing"] = words.into();
            }
        }
    }
}

/// A synthetic study with `sensor` in every name field, `rows` samples of the calibration phase, and some samples of every other phase.
pub(crate) fn drawn(sensor: &str, rows: usize, scale: f64) -> Study {
    let mut study = study(&results(sensor, scale));
    study.samples = Some(Samples::read(&samples(sensor, rows, scale)).expect("samples"));
    study
}

fn unit(channel: &str) -> &'static str {
    if channel.starts_with('P') { "mm" } else { "N" }
}

fn number(value: f64, unit: &str) -> Value {
    json!({
        "value": value, "unit": unit, "n": 80, "n_invalid": 0, "ci95": [value * 0.9, value * 1.1],
        "method": "jackknife by point_id, G=20", "definition": "drawn/1"
    })
}

/// JSON of a synthetic study.
pub(crate) fn results(sensor: &str, scale: f64) -> Value {
    let curve = |x_unit: &str, unit: &str, values: Vec<Option<f64>>| {
        let x: Vec<f64> = (0..values.len())
            .map(|at| 0.05 + at as f64 * 0.05)
            .collect();
        let counts: Vec<u64> = values
            .iter()
            .map(|value| if value.is_some() { 9 } else { 0 })
            .collect();
        json!({"x": x, "x_unit": x_unit, "values": values, "counts": counts, "unit": unit})
    };
    let wave = |at: usize| Some(scale * (0.3 + 0.1 * (at as f64 * 0.7).sin()));
    let gapped = |at: usize| wave(at).filter(|_| at % 7 != 3);
    let mut metrics = json!({});
    for channel in SIX.into_iter().chain(["Pxy", "Fxy"]) {
        let unit = unit(channel);
        metrics["mae"][channel] = number(0.1 * scale, unit);
        metrics["r2"][channel] = number(1.0 - 0.05 * scale, "1");
        let mut spatial = number(0.02 * scale, unit);
        spatial["distance"] = curve("mm", unit, (0..40).map(gapped).collect());
        spatial["depth"] = curve("mm", unit, (0..30).map(wave).collect());
        metrics["r_spatial"][channel] = spatial;
        let mut light = number(0.3 / scale, "1");
        light["scenes"] = json!({"rows": ["S1", "S2"], "columns": ["intensity_ratio", "error_ratio"],
            "values": [[1.4, 2.0 * scale], [2.3, 8.0 * scale]], "unit": "1"});
        metrics["r_light"][channel] = light;
        let mut repeatability = number(0.01 * scale, unit);
        repeatability["curve"] = curve("1", unit, (0..10).map(gapped).collect());
        metrics["repeatability"][channel] = repeatability;
        let mut bias = number(0.01 * scale, unit);
        bias["curve"] = curve(unit, unit, (0..12).map(wave).collect());
        metrics["bias_level"][channel] = bias;
        let mut tolerance = number(0.5, "1");
        tolerance["curve"] = curve(unit, "1", (0..8).map(wave).collect());
        metrics["tolerance"][channel] = tolerance;
    }
    for kind in ["line", "dot"] {
        let mut sr = number(0.9, "1");
        let told = (0..20).map(|at| Some((0.7 + at as f64 * 0.02).min(1.0)));
        sr["curve"] = curve("mm", "1", told.collect());
        metrics["sr"][kind] = sr;
    }
    let edges: Vec<f64> = (0..=20).map(|at| at as f64 - 10.0).collect();
    let cell = |row: usize, column: usize| {
        (!(row + column).is_multiple_of(5)).then_some(scale * (1.0 + row as f64 * 0.1))
    };
    let values: Vec<Vec<Option<f64>>> = (0..20)
        .map(|row| (0..20).map(|column| cell(row, column)).collect())
        .collect();
    let mut sensitivity = number(2.0 * scale, "mm/N");
    sensitivity["map"] = json!({"x_mm": edges, "y_mm": edges, "values": values, "counts": vec![vec![3; 20]; 20], "unit": "mm/N"});
    metrics["sensitivity"]["Fz"] = sensitivity;
    metrics["uniformity"]["Fz"] = number(0.8, "1");
    let mut hysteresis = number(0.2 * scale, "N·mm");
    hysteresis["ratio"] = number(0.1 * scale, "1");
    metrics["hysteresis"]["Fz"] = hysteresis;
    metrics["inter_sensor"]["surface_z"] = number(0.1, "mm");
    metrics["intrinsic"]["frame_rate"] = number(30.0 * scale, "Hz");
    metrics["noise_equivalent_force"]["Fz"] = json!({"undefined": "no sample is without contact", "n": 0, "n_invalid": 0, "definition": "drawn/1"});
    let matrix: Vec<Vec<f64>> = (0..6)
        .map(|row| {
            (0..6)
                .map(|column| if row == column { 0.9 } else { -0.1 })
                .collect()
        })
        .collect();
    let mut crosstalk = number(0.1, "1");
    crosstalk["matrix"] = json!({"rows": SIX, "columns": SIX, "values": matrix, "unit": "1"});
    metrics["crosstalk"]["all"] = crosstalk;
    json!({
        "schema": "taceva.evaluation/1.0",
        "subject": {"sensor": sensor, "serial": sensor, "gel": sensor, "source": "synthetic"},
        "metrics": metrics,
        "skipped": [{"what": sensor, "reason": sensor}],
        "provenance": {"taceva": "0.1.0", "dataset": sensor, "model": {"name": sensor, "settings": {"key": sensor}, "digest": sensor, "fitted_on": sensor}, "split": sensor, "notes": [sensor]}
    })
}

fn quoted(word: &str) -> String {
    format!("\"{}\"", word.replace('"', "\"\""))
}

/// Table of samples of a synthetic study.
pub(crate) fn samples(sensor: &str, rows: usize, scale: f64) -> String {
    let mut table =
        String::from("id,protocol,point_id,unit_id,scene,depth_step,phase,intensity,surface_z");
    for channel in SIX {
        write!(table, ",{channel},{channel}_predicted").expect("a text");
    }
    table.push('\n');
    let name = quoted(sensor);
    let mut row = |number: usize, protocol: &str, beside: [&str; 6], spread: f64| {
        write!(
            table,
            "{},{protocol}",
            quoted(&format!("{sensor} {number}"))
        )
        .expect("a text");
        let point = quoted(&format!("{sensor} {}", number % 24));
        let [unit, scene, step, phase, intensity, height] = beside;
        write!(
            table,
            ",{point},{unit},{scene},{step},{phase},{intensity},{height}"
        )
        .expect("a text");
        for (at, _) in SIX.iter().enumerate() {
            let turn = number as f64 * (0.61 + at as f64 * 0.17);
            let truth =
                turn.sin() * if at < 2 { 8.0 } else { 1.0 } + if at % 3 == 2 { 1.5 } else { 0.0 };
            let predicted = truth + scale * spread * (turn * 7.3).cos();
            write!(table, ",{truth:.4},{predicted:.4}").expect("a text");
        }
        table.push('\n');
    };
    for number in 0..rows {
        row(number, "calibration", ["0", "", "", "", "", ""], 0.1);
    }
    for number in 0..96 {
        let scene = ["", "S1", "S2", "S3"][number / 24];
        let scene = if scene.is_empty() {
            String::new()
        } else {
            format!("{}{scene}", &name[..name.len() - 1]) + "\""
        };
        let light = ["20", "30", "40", "55"][number / 24];
        row(
            number,
            "light-sweep",
            ["0", &scene, "", "", light, ""],
            0.1 + (number / 24) as f64 * 0.2,
        );
    }
    for number in 0..120 {
        let step = (number / 24 % 2).to_string();
        row(
            number,
            "repeatability",
            ["0", "", &step, "", "", ""],
            0.05 * (number / 48) as f64,
        );
        let phase = if number % 48 < 24 { "load" } else { "unload" };
        row(number, "load-unload", ["0", "", "", phase, "", ""], 0.1);
    }
    for number in 0..48 {
        let unit = if number < 24 { "0" } else { "1" };
        let height = format!("{:.3}", (number as f64 * 0.37).sin() * 0.1);
        row(
            number % 24,
            "surface-map",
            [unit, "", "", "", "", &height],
            0.0,
        );
    }
    table
}
