//! Faults of the pictures of a scene, tested with the models of the run.

use std::fs;

use serde_json::Value;

use super::{SMALL, reports};
use crate::support::Bench;

/// Faults of a scene, quick to test.
const STRESS: &str = "stress = { faults = [\"tear\", \"sensor_noise\"], severities = [1, 3] }\n";

/// The small scene with the lines `more` below its seed.
fn scene(more: &str) -> String {
    SMALL.replacen("seed = 7\n", &format!("seed = 7\n{more}"), 1)
}

/// The small scene with the lines `more`, and a metric that reads no prediction.
fn of_sensitivity(more: &str) -> String {
    scene(&format!("metrics = {{ want = [\"sensitivity\"] }}\n{more}"))
}

/// Results of fault tests in the run at `folder`.
fn written(bench: &Bench, folder: &str) -> Vec<Value> {
    let Ok(entries) = fs::read_dir(bench.path(folder).join("stress")) else {
        return Vec::new();
    };
    let paths = entries.map(|entry| entry.expect("readable").path());
    let files = paths.filter(|path| path.is_file()).map(|path| {
        let text = fs::read_to_string(path).expect("reads");
        serde_json::from_str(&text).expect("JSON")
    });
    files.collect()
}

#[test]
fn faults_of_a_scene_stand_beside_its_scores_and_change_none_of_them() {
    let bench = Bench::new();
    bench.write("small.toml", SMALL);
    bench.write("worn.toml", &scene(STRESS));
    bench.ok("run small.toml -q");
    let ran = bench.run("run worn.toml --out worn");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        ran.err.contains("2 faults of 2 severities on about"),
        "{}",
        ran.err
    );
    let found = written(&bench, "worn");
    let [faults] = found.as_slice() else {
        panic!("{found:?}");
    };
    crate::schema::check("stress", faults);
    assert_eq!(faults["list"]["name"], "sensor_noise,tear");
    assert_eq!(faults["seed"], 7);
    assert_eq!(faults["provenance"]["part"], "test");
    let samples = faults["samples"].as_u64().expect("a number");
    assert!(
        samples > 0 && samples < 24,
        "the test part alone: {samples}"
    );
    assert_eq!(
        reports(&bench.path("runs/small-1")),
        reports(&bench.path("worn"))
    );
    let page = fs::read_to_string(bench.path("worn/report.html")).expect("a page");
    assert!(page.contains("<h2 id=\"h-faults\">Faults</h2>"), "{page}");
    bench.ok("report worn --out again -q");
    let again = fs::read_to_string(bench.path("again/report.html")).expect("a page");
    assert!(again.contains("h-faults"), "written again from the files");
}

#[test]
fn a_scene_without_predictions_decodes_no_picture_more_with_faults_than_without() {
    let bench = Bench::new();
    bench.write("plain.toml", &of_sensitivity(""));
    bench.write("worn.toml", &of_sensitivity(STRESS));
    let decoded = |scene: &str, folder: &str| {
        let run = bench.json(&format!("run {scene} --out {folder}"));
        run["studies"][0]["provenance"]["frames_decoded"].clone()
    };
    assert_eq!(decoded("plain.toml", "plain"), decoded("worn.toml", "worn"));
    assert!(written(&bench, "worn").is_empty());
    let report = &reports(&bench.path("worn"))[0].1;
    let report = String::from_utf8_lossy(report);
    assert!(
        report.contains("faults are not tested: no wanted metric reads predictions"),
        "{report}"
    );
    let plan = bench.run("plan worn.toml");
    assert!(
        plan.err
            .contains("not tested: no wanted metric reads predictions"),
        "{}",
        plan.err
    );
}

#[test]
fn a_misspelt_fault_of_a_scene_is_refused_before_any_press() {
    let bench = Bench::new();
    bench.write("worn.toml", &scene("stress = { faults = [\"defocsu\"] }\n"));
    bench.refused(
        "run worn.toml",
        3,
        "line 4: fault `defocsu`: unknown, did you mean `defocus`?",
    );
    bench.refused("plan worn.toml", 3, "did you mean `defocus`?");
    assert!(!bench.path("runs").exists());
}

#[test]
fn a_worn_gel_is_pressed_again_and_its_force_and_pictures_change_together() {
    let bench = Bench::new();
    let gels =
        "stress = { faults = [\"gel_softening\", \"gel_dust\", \"tear\"], severities = [1, 5] }\n";
    let scene = scene(gels).replace("size = \"8x8\"", "size = \"8x8\", difference = true");
    bench.write("worn.toml", &scene);
    let ran = bench.run("run worn.toml --out worn");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        ran.err.contains("again on worn gels, for 2 faults"),
        "{}",
        ran.err
    );
    let found = written(&bench, "worn");
    let faults = &found[0];
    crate::schema::check("stress", faults);
    assert_eq!(faults["list"]["name"], "tear,gel_softening,gel_dust");
    for fault in 1..3 {
        let severities = faults["faults"][fault]["severities"].as_array();
        let severities = severities.expect("severities");
        assert_eq!(severities.len(), 2, "{faults}");
        assert_eq!(severities[1]["severity"], 5);
        assert!(
            severities[1]["stale"]["Fz"]["mae"]["value"].is_number(),
            "{faults}"
        );
        // The worn gel has an untouched picture of its own.
        let fresh = &severities[1]["fresh"]["Fz"]["mae"]["value"];
        assert!(fresh.is_number(), "{faults}");
        let recovers = &faults["faults"][fault]["recovers"]["Fz"];
        assert_ne!(recovers["reason"], "no_fresh_reference", "{faults}");
    }
    let softest = &faults["faults"][1]["severities"][1];
    assert_eq!(softest["parameter"], 0.4);
    assert!(
        softest["stimulus"]
            .as_f64()
            .is_some_and(|change| change > 0.0),
        "{softest}"
    );
}

#[test]
fn a_fault_of_a_gel_is_refused_for_a_recording() {
    let bench = Bench::new();
    bench.record("monday", 24);
    bench.write(
        "real.toml",
        "scene_version = 1\nname = \"real\"\nsensor = { dataset = \"monday\" }\nmodel = { name = \"ridge\", set = { size = \"8x8\" } }\nstress = { faults = [\"temperature\"] }\n",
    );
    bench.refused(
        "run real.toml",
        3,
        "line 5: fault `temperature` changes a simulated gel",
    );
}

#[test]
fn a_fault_of_a_plugin_that_is_not_installed_is_refused_before_any_press() {
    let bench = Bench::new();
    let fault = "[[fault]]\nname = \"fog\"\nplugin = \"org.example.fogged-lens/fog\"\n";
    bench.write("worn.toml", &format!("{}{fault}", scene(STRESS)));
    for command in ["run", "plan"] {
        let words = format!("{command} worn.toml");
        bench.refused(
            &words,
            3,
            "line 13: `org.example.fogged-lens/fog`: no plugin has this estimator",
        );
    }
    let named = scene(STRESS) + &fault.replace("fog\"\np", "dust\"\np");
    bench.write("named.toml", &named);
    bench.refused("run named.toml", 3, "a built-in fault has this name");
    assert!(!bench.path("runs").exists());
}

#[test]
#[cfg(target_os = "linux")]
fn a_fault_of_a_plugin_is_tested_beside_the_others() {
    let bench = Bench::new();
    bench.make_example("estimator", "fogged-lens");
    let fault = "[[fault]]\nname = \"fog\"\nplugin = \"org.example.fogged-lens/fog\"\n";
    bench.write("worn.toml", &format!("{}{fault}", scene(STRESS)));
    let ran = bench.run("run worn.toml --out worn --plugin-dir fogged-lens");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let found = written(&bench, "worn");
    let faults = &found[0];
    crate::schema::check("stress", faults);
    assert_eq!(faults["list"]["name"], "sensor_noise,tear,fog");
    let fog = &faults["faults"][2];
    let stimulus = |at: usize| {
        fog["severities"][at]["stimulus"]
            .as_f64()
            .expect("a number")
    };
    assert!(0.0 < stimulus(0) && stimulus(0) < stimulus(1), "{fog}");
}
