//! A run fits models of libraries like built-in ones.
#![cfg(all(feature = "linfa", feature = "smartcore"))]

use crate::support::Bench;

/// Scene with thirty contact points, pressed four times each.
const SCENE: &str = r#"scene_version = 1
name = "library"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
sensor = { driver = "sim/vitactip:reduction=16" }
metrics = { want = ["mae"] }
protocol = { calibration = { points = 30, indentations = 4 } }
"#;

#[test]
fn a_run_fits_models_of_both_libraries_and_they_are_nearer_than_the_mean() {
    let bench = Bench::new();
    bench.write("scene.toml", SCENE);
    let mae = |model: &str| {
        let words = format!("run scene.toml --force --out run --set size=8x8 --model {model}");
        let study = bench.json(&words)["studies"][0].take();
        let error = study["metrics"]["mae"]["Px"]["value"].as_f64();
        error.unwrap_or_else(|| panic!("{model}: {study}"))
    };
    let mean = mae("baseline");
    for model in ["linfa/elastic-net", "smartcore/random-forest"] {
        let error = mae(model);
        assert!(error < 0.8 * mean, "{model}: {error}, the mean {mean}");
    }
    bench.refused(
        "run scene.toml --force --out run --model linfa/elastic-nett",
        2,
        "did you mean `linfa/elastic-net`",
    );
}
