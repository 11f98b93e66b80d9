//! Classification of the spacing of gratings, as a scene states it.

use crate::support::Bench;
use serde_json::Value;

/// Scene with three boards of each kind of grating, pressed four times.
const SCENE: &str = r#"scene_version = 1
name = "gratings"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
model = { name = "ridge" }
sensor = { driver = "sim/vitactip:reduction=16" }
metrics = { want = ["sr"] }
protocol = { gratings = { step_mm = 0.75, presses = 4 } }
"#;

#[test]
fn gratings_are_classified_by_a_network_where_a_scene_says_so() {
    let bench = Bench::new();
    let classified_by =
        |words: &str| SCENE.replace("presses = 4", &format!("presses = 4, {words}"));
    let reports = [
        r#"classified_by = "spectrum""#,
        r#"classified_by = "linfa/logistic", set = { strength = 1 }"#,
        r#"classified_by = "cnn", set = { size = "24x24", epochs = 2, local_mean = 0 }"#,
        r#"classified_by = "cnn-length", set = { size = "24x24", epochs = 2 }"#,
    ]
    .map(|words| {
        bench.write("classified.toml", &classified_by(words));
        bench.json("run classified.toml --force --out classified")["studies"][0].take()
    });
    for (report, by) in reports
        .iter()
        .zip(["discriminants", "logistic", "network", "network"])
    {
        for kind in ["line", "dot"] {
            let share = &report["metrics"]["sr"][kind];
            assert_eq!(share["n"], 12, "{share}");
            assert!(share["value"].is_number(), "{share}");
        }
        let notes = report["provenance"]["notes"].to_string();
        assert!(notes.contains(by), "{notes}");
    }
    // All classifiers have the same presses.
    let dataset = |report: &Value| report["provenance"]["dataset"].clone();
    assert_eq!(dataset(&reports[0]), dataset(&reports[1]));

    bench.write(
        "wrong.toml",
        &classified_by("classified_by = \"cnn\", set = { epoch = 2 }"),
    );
    bench.refused(
        "run wrong.toml",
        3,
        "wrong.toml, line 9: `epoch`: unknown key, did you mean `epochs`?",
    );
    bench.write("wrong.toml", &classified_by("set = { epochs = 2 }"));
    bench.refused("run wrong.toml", 3, "none is accepted here");
}
