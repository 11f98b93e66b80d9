//! Errors of a fitted model over the life of a gel.

use std::fs;

use serde_json::Value;
use taceva_sim::{Model, Parameters};

use crate::support::Bench;

/// Test folder with a model fitted on `seen`, and recordings after 0, 1000 and 2000 presses.
fn bench() -> Bench {
    let bench = Bench::new();
    bench.record_with_noise("seen", 24, 0);
    bench.ok("fit seen --model ridge --set size=8x8 --out m.taceva -q");
    for (name, noise, presses) in [("new", 2, 0), ("used", 3, 1000), ("old", 4, 2000)] {
        bench.record_with_noise(name, 24, noise);
        state_presses(&bench, name, presses);
    }
    bench
}

/// Adds the number of presses to the header, as a user does.
fn state_presses(bench: &Bench, name: &str, presses: u32) {
    let path = bench.path(&format!("{name}/dataset.toml"));
    let text = fs::read_to_string(&path).expect("a header");
    let stated = format!("[sensor]\npresses_since_gel = {presses}\n");
    assert!(text.contains("[sensor]\n"), "{text}");
    fs::write(&path, text.replacen("[sensor]\n", &stated, 1)).expect("written");
    bench.ok(&format!("reseal {name} --reason counted -q"));
}

const WEAR: &str = "wear old new used --model m.taceva";

#[test]
fn json_has_the_published_form_in_the_order_of_the_presses() {
    let bench = bench();
    let report = bench.json(&format!("{WEAR} --limit mae.Fz=2000mN"));
    crate::schema::check("wear", &report);
    assert_eq!(report["by"], "presses");
    let gel = &report["gels"][0];
    let names = gel["recordings"].as_array().expect("three recordings");
    let names: Vec<&str> = names
        .iter()
        .filter_map(|of| of["recording"].as_str())
        .collect();
    assert_eq!(names, ["new", "used", "old"]);
    assert_eq!(gel["recordings"][2]["presses_since_gel"], 2000);
    assert_eq!(gel["channels"]["Fz"]["limit"]["limit"], 2.0);
    assert!(gel["channels"]["Px"]["limit"].is_null());
    assert!(gel["channels"]["Fz"]["slope"]["value"].is_number(), "{gel}");
    let said = report["not_measured"].as_str().expect("drawn pictures");
    assert!(said.contains("synthetic"), "{said}");
    // Two recordings have no growth, and the reason is of the published form, too.
    let two = bench.json("wear new old --model m.taceva");
    crate::schema::check("wear", &two);
    let slope = &two["gels"][0]["channels"]["Fz"]["slope"];
    assert_eq!(slope["reason"], "too_few_recordings");
}

#[test]
fn the_table_has_a_row_for_each_recording_and_states_the_growth() {
    let bench = bench();
    for format in ["text", "md"] {
        let said = bench.ok(&format!("{WEAR} --limit mae.Fz=2N --format {format} -q"));
        let rows = said.lines().filter(|line| line.contains("2000"));
        assert!(rows.count() >= 1, "{said}");
        assert!(said.contains("the error is multiplied by"), "{said}");
        assert!(said.contains("the limit 2 N"), "{said}");
        assert!(said.contains("Nothing here was measured"), "{said}");
    }
    let csv = bench.ok(&format!("{WEAR} --format csv -q"));
    let head = "gel,recording,presses_since_gel,day,stimulus,channel,unit,mae,ci95_low,ci95_high";
    assert!(csv.starts_with(head), "{csv}");
    let mut rows = csv.lines().skip(1);
    assert!(rows.clone().all(|row| row.ends_with(",synthetic")), "{csv}");
    assert_eq!(rows.clone().count(), 6, "{csv}");
    let is_force = |row: &str| row.starts_with("1,used,1000,,") && row.contains(",Fz,N,");
    assert!(rows.any(is_force), "{csv}");
}

#[test]
fn a_result_is_written_to_a_file_once() {
    let bench = bench();
    let words = format!("{WEAR} --format json --out wear.json");
    bench.ok(&format!("{words} -q"));
    let text = fs::read_to_string(bench.path("wear.json")).expect("written");
    assert!(text.contains("taceva.wear/1"), "{text}");
    bench.refused(&words, 3, "wear.json exists already; --force replaces it");
}

#[test]
fn a_recording_and_its_state_before_rows_were_added_are_refused() {
    let bench = crate::extended::halves();
    bench.ok("fit data --model ridge --set size=8x8 --out m.taceva -q");
    bench.ok("import first --map map.toml --out longer -q");
    bench.ok("import second --map map.toml --extend longer -q");
    bench.refused(
        "wear data longer --model m.taceva",
        2,
        "data and longer are one recording or states of one recording",
    );
}

#[test]
fn one_recording_no_day_wrong_limits_and_models_are_refused_by_name() {
    let bench = bench();
    bench.refused(
        "wear new --model m.taceva",
        2,
        "new: one recording, expected two or more recordings of one unit",
    );
    bench.refused(
        &format!("{WEAR} --by date"),
        2,
        "no day: `recorded_on` is not stated in dataset.toml",
    );
    for limit in ["Fz=0.1N", "rmse.Fz=0.1N", "mae.Fz"] {
        let expected = format!("--limit `{limit}`: expected mae.CHANNEL=AMOUNT");
        bench.refused(&format!("{WEAR} --limit {limit}"), 2, &expected);
    }
    bench.refused(
        &format!("{WEAR} --limit mae.Fz=0.1N --limit mae.Fz=0.2N"),
        2,
        "two limits of this channel",
    );
    bench.refused(
        &format!("{WEAR} --limit mae.Fz=1mm"),
        2,
        "mae.Fz has a limit in mm, expected a limit in N",
    );
    bench.refused(
        "wear new old --model ridge",
        2,
        "--model ridge: no such file",
    );
}

#[test]
fn a_scene_with_loads_gives_a_recording_of_each_stage_that_states_the_presses_on_the_gel() {
    let bench = Bench::new();
    let scene = r#"scene_version = 1
name = "gel"
seed = 7
sensor = { driver = "sim/vitactip:reduction=16" }
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
metrics = { want = ["sensitivity"] }
[protocol]
calibration = { points = 6, indentations = 1 }
wear = { load = "compression", cycles = [0, 3], force_N = 0.2, presses_since_gel = 50 }
"#;
    bench.write("gel.toml", scene);
    let plan = bench.ok("plan gel.toml");
    assert!(plan.contains("3 cycles of compression to 0.2 N"), "{plan}");
    bench.ok("run gel.toml --out worn -q");
    let paths = recordings(&bench, "worn");
    let headers = paths.iter().map(|path| {
        let header = bench.path(path).join("dataset.toml");
        fs::read_to_string(header).expect("a header")
    });
    let headers: Vec<String> = headers.collect();
    // Six measured presses and three cycles lie between the two.
    let presses = ["presses_since_gel = 50\n", "presses_since_gel = 59\n"];
    assert_eq!(headers.len(), presses.len(), "{paths:?}");
    for (header, presses) in headers.iter().zip(presses) {
        assert!(header.contains("model = \"gel\""), "{header}");
        assert!(header.contains(presses), "{header}");
    }
}

/// Recordings in the run at `folder`, in their order.
fn recordings(bench: &Bench, folder: &str) -> Vec<String> {
    let entries = fs::read_dir(bench.path(folder).join("recordings")).expect("a folder");
    let names = entries.map(|entry| entry.expect("readable").file_name());
    let paths = names.map(|name| format!("{folder}/recordings/{}", name.to_string_lossy()));
    let mut paths: Vec<String> = paths
        .filter(|path| bench.path(path).join("dataset.toml").is_file())
        .collect();
    paths.sort();
    paths
}

/// Scene of a gel with a fast rate of ageing: 43 presses of 1 N halve its stiffness.
fn loaded(sensor: &str, seed: u32, protocol: &str) -> String {
    let table = Parameters::ageing_table(Model::GelSight.table()).expect("a table");
    let rate = "value = 0.02, unit = \"1/kN\"";
    assert_eq!(table.matches(rate).count(), 2, "{table}");
    let table = table.replace(rate, "value = 16.0, unit = \"1/kN\"");
    format!(
        r#"scene_version = 1
name = "gel"
seed = {seed}
robot = {{ driver = "sim/robot" }}
force = {{ driver = "sim/force-transducer" }}
model = {{ name = "ridge", set = {{ size = "8x8" }} }}
metrics = {{ want = ["mae"] }}
[sensor]
driver = '''{sensor}table={table}'''
[protocol]
spatial = {{ points = 5 }}
{protocol}
"#
    )
}

/// Error of Fz in each recording of a comparison.
fn errors(report: &Value) -> Vec<f64> {
    let recordings = report["gels"][0]["recordings"].as_array();
    let recordings = recordings.expect("recordings").iter();
    let errors = recordings.map(|of| of["mae"]["Fz"]["value"].as_f64().expect("an error"));
    errors.collect()
}

#[test]
fn a_simulated_gel_that_ages_by_loads_has_a_growing_error_and_another_has_none() {
    let bench = Bench::new();
    let many = "calibration = { points = 120, indentations = 3 }";
    bench.write("fresh.toml", &loaded("sim/gelsight:", 8, many));
    bench.ok("run fresh.toml --out fresh -q");
    let fresh = recordings(&bench, "fresh").join(" ");
    bench.ok(&format!(
        "fit {fresh} --model ridge --set size=16x16 --out m.taceva -q"
    ));
    let load = |cycles: &str| {
        format!(
            "calibration = {{ points = 12, indentations = 2 }}\nwear = {{ load = \"compression\", cycles = {cycles}, force_N = 0.5 }}"
        )
    };
    let compared = |name: &str, sensor: &str, cycles: &str| {
        bench.write(&format!("{name}.toml"), &loaded(sensor, 7, &load(cycles)));
        bench.ok(&format!("run {name}.toml --out {name} -q"));
        let stages = recordings(&bench, name).join(" ");
        bench.json(&format!("wear {stages} --model m.taceva"))
    };
    let worn = compared("worn", "sim/gelsight:ages=true;", "[0, 5, 10, 15, 20]");
    assert_eq!(worn["gels"].as_array().map(Vec::len), Some(1), "{worn}");
    let grown = errors(&worn);
    assert_eq!(grown.len(), 5);
    assert!(grown[4] > 1.3 * grown[0], "{grown:?}");
    let force = &worn["gels"][0]["channels"]["Fz"];
    let [least, value] = [&force["slope"]["ci95"][0], &force["slope"]["value"]]
        .map(|number| number.as_f64().expect("five recordings"));
    assert!(0.0 < least && least < value, "{force}");
    assert!(force["first_different"].is_string(), "{force}");
    // The same loads on a gel that does not age.
    let new = compared("new", "sim/gelsight:", "[0, 5]");
    let same = errors(&new);
    assert!((same[1] / same[0] - 1.0).abs() < 0.2, "{same:?}");
    let force = &new["gels"][0]["channels"]["Fz"];
    assert!(force["first_different"].is_null(), "{force}");
}
