//! The estimator of a plugin in its child process: fitted, stored, used, and named in a scene.

#![cfg(target_os = "linux")]

use std::fs;
use std::io::Write;
use std::process::Command;

use crate::support::Bench;

const MODEL: &str = "org.example.nearest/nearest";

/// Test folder with the recording `set`, and the estimator of the template, built without a network.
fn with_estimator() -> Bench {
    let bench = Bench::new();
    bench.record("set", 16);
    bench.make_plugin("estimator", "nearest");
    bench
}

/// A study of the simulated bench whose model is an estimator of a plugin.
const SCENE: &str = r#"scene_version = 1
name = "near"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
sensor = { driver = "sim/vitactip:reduction=16" }
protocol = { calibration = { points = 10, indentations = 2 } }
metrics = { want = ["mae"] }

[model]
name = "org.example.nearest/nearest"
set = { size = "8x8", neighbours = 2 }
"#;

#[test]
fn the_estimator_of_a_plugin_is_fitted_kept_asked_and_named_in_a_scene() {
    let bench = with_estimator();
    let with = "--plugin-dir nearest";
    let set = "--set size=8x8 --set neighbours=1";
    let fitted = bench.ok(&format!(
        "fit set --model {MODEL} {set} --out near.model {with}"
    ));
    assert!(fitted.contains(MODEL), "{fitted}");

    // A stored and loaded model gives the same predictions.
    let kept = bench.json(&format!("evaluate set --with near.model {with}"));
    let at_once = bench.json(&format!(
        "evaluate set --model {MODEL} --split by-point {set} {with}"
    ));
    assert_eq!(kept["metrics"], at_once["metrics"]);
    let mae = kept["metrics"]["mae"]["Fz"]["value"].as_f64();
    assert!(mae.is_some_and(|mae| mae > 0.0 && mae < 0.3), "{kept}");
    bench.ok(&format!(
        "predict set --with near.model --out near.csv {with}"
    ));
    let rows = fs::read_to_string(bench.path("near.csv")).expect("written");
    assert!(rows.lines().count() > 6, "{rows}");

    bench.write("near.toml", SCENE);
    let run = bench.json(&format!("run near.toml {with}"));
    let report = &run["studies"][0];
    assert_eq!(report["provenance"]["model"]["name"], MODEL, "{report}");
    assert!(
        report["metrics"]["mae"]["Fz"]["value"].as_f64().is_some(),
        "{report}"
    );
    // The model file in place of the model name.
    let finished = SCENE.split("[model]").next().expect("text");
    bench.write(
        "finished.toml",
        &format!("{finished}[model]\nfile = \"sim.model\"\n"),
    );
    let recording = "runs/near-1/recordings/1-near";
    bench.ok(&format!(
        "fit {recording} --model {MODEL} {set} --out sim.model {with}"
    ));
    bench.ok(&format!("run finished.toml {with} -q"));
}

#[test]
fn without_its_plugin_a_model_is_refused_by_name() {
    let bench = with_estimator();
    bench.ok(&format!(
        "fit set --model {MODEL} --set size=8x8 --out near.model --plugin-dir nearest"
    ));
    bench.refused(
        "evaluate set --with near.model",
        3,
        "fitted by `org.example.nearest/nearest` of the plugin `org.example.nearest`, which was not found",
    );
    bench.refused(
        &format!("fit set --model {MODEL} --out other.model"),
        2,
        "no available plugin has the model `org.example.nearest/nearest`: give the folder of its plugin.toml by `--plugin-dir`",
    );
    bench.refused(
        "fit set --model org.example.nearest/nearst --out other.model --plugin-dir nearest",
        2,
        "did you mean `org.example.nearest/nearest`?",
    );
    bench.refused(
        &format!(
            "fit set --model {MODEL} --set neighbors=2 --out other.model --plugin-dir nearest"
        ),
        2,
        "did you mean `neighbours`?",
    );
    bench.refused(
        &format!(
            "fit set --model {MODEL} --set neighbours=0 --out other.model --plugin-dir nearest"
        ),
        2,
        "1 to 1000",
    );
    assert!(!bench.path("other.model").exists());
}

#[test]
fn the_model_of_a_bundle_never_loads_its_plugin() {
    let bench = with_estimator();
    let with = "--plugin-dir nearest -q";
    bench.ok(&format!(
        "fit set --model {MODEL} --set size=8x8 --out near.model {with}"
    ));
    bench.ok(&format!(
        "evaluate set --with near.model --metrics mae --format json --out r.json --state-out r.state --samples-out r.samples.csv {with}"
    ));
    bench.ok("bundle r.json --state r.state --model near.model --draft --out b -q");
    let words = format!("bundle verify b --level model --dataset set {with}");
    let ran = bench.run(&words);
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    let reason = "level    model: not reached: study 0: the model was fitted by `org.example.nearest/nearest` of the plugin `org.example.nearest`, and no plugin is loaded";
    assert!(ran.out.contains(reason), "{}", ran.out);
}

#[test]
fn another_build_is_told_of_and_refused_where_the_manifest_demands_one() {
    let bench = with_estimator();
    let with = "--plugin-dir nearest";
    bench.ok(&format!(
        "fit set --model {MODEL} --set size=8x8 --out near.model {with}"
    ));
    let quiet = bench.run(&format!("evaluate set --with near.model {with}"));
    assert!(!quiet.err.contains("sha256"), "{}", quiet.err);

    // Bytes after the last section make another build with the same code.
    let library = bench.path("nearest/target/release/libnearest.so");
    let mut file = fs::OpenOptions::new()
        .append(true)
        .open(&library)
        .expect("there");
    file.write_all(b"another build").expect("written");
    drop(file);
    let told = bench.run(&format!("evaluate set --with near.model {with}"));
    assert_eq!(told.code, 0, "{}", told.err);
    assert!(
        told.err.contains("org.example.nearest: ")
            && told.err.contains("the model was fitted by sha256:")
            && told
                .err
                .contains("is used: the plugin changed since the fit; fit again"),
        "{}",
        told.err
    );

    let digest = Command::new("sha256sum")
        .arg(&library)
        .output()
        .expect("it is there");
    let digest = String::from_utf8(digest.stdout).expect("text");
    let digest = digest.split_whitespace().next().expect("a digest");
    let manifest = bench.path("nearest/plugin.toml");
    let text = fs::read_to_string(&manifest).expect("there");
    let pinned = text.replace(
        "libnearest.so\" }",
        &format!("libnearest.so\", sha256 = \"{digest}\" }}"),
    );
    assert_ne!(pinned, text);
    fs::write(&manifest, pinned).expect("written");
    bench.refused(
        &format!("evaluate set --with near.model {with}"),
        3,
        "the manifest allows only",
    );
}
