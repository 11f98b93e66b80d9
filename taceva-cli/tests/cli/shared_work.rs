//! Work that several metrics need is done once, and unneeded work is skipped.

use std::fs;

use crate::support::Bench;
use serde_json::Value;
use taceva_dataset::Dataset;

/// Scene whose predictions are scored in many ways, and whose pictures of an idle gel are read by no metric.
const SCENE: &str = r#"scene_version = 1
name = "shared"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
model = { name = "ridge", set = { size = "8x8" } }
sensor = { driver = "sim/vitactip:reduction=16" }
metrics = { want = ["mae", "r2", "smape", "crosstalk", "bias_level", "uniformity", "intrinsic", "noise_equivalent_force"] }
protocol = { calibration = { points = 12, indentations = 2 }, surface = { points = 6 }, idle = { frames = 6 } }
"#;

fn read(bench: &Bench, path: &str) -> Value {
    let text = fs::read_to_string(bench.path(path)).expect("written");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn one_training_serves_every_metric_and_only_what_a_metric_reads_is_predicted() {
    let bench = Bench::with_cache();
    bench.write("shared.toml", SCENE);
    bench.ok("run shared.toml --out run -q");
    let stages = read(&bench, "run/stages.json");
    let stages = stages["stages"].as_array().expect("a list");
    let count = |name: &str| stages.iter().filter(|stage| stage["stage"] == name).count();
    assert_eq!((count("fit"), count("predict")), (1, 1));
    let report = read(&bench, "run/reports/1-shared.json");
    let provenance = &report["provenance"];
    let parts = provenance["samples"].as_object().expect("parts");
    let calibration: u64 = parts.values().filter_map(Value::as_u64).sum();
    // Each picture of the calibration once: for training or for prediction.
    assert_eq!(provenance["frames_decoded"], calibration);
    let recording = Dataset::open(&bench.path("run/recordings/1-shared")).expect("recorded");
    let pictures = recording.table().frames().iter().flatten().count() as u64;
    assert_eq!(pictures, calibration, "none is taken that nothing reads");
}
