//! A model without skill gets no verdict in its favour. Robustness is that of the sensor, not of the bounds of a model.

use std::fs;

use crate::support::Bench;
use serde_json::Value;

/// Evaluates `data` with `model`, on enough contact points for intervals, into `NAME.json`, and returns the result.
fn evaluated(bench: &Bench, model: &str, seed: u32, name: &str) -> Value {
    let words = format!(
        "evaluate data --model {model} --seed {seed} --metrics all --format json --out {name}.json --samples-out {name}.samples.csv -q"
    );
    let ran = bench
        .command(&words)
        .args(["--split", "by-point 30/10/60"])
        .output()
        .expect("the program starts");
    assert!(
        ran.status.success(),
        "{}",
        String::from_utf8_lossy(&ran.stderr)
    );
    let text = fs::read_to_string(bench.path(&format!("{name}.json"))).expect("written");
    let report = serde_json::from_str(&text).expect("JSON");
    crate::schema::check("evaluation", &report);
    report
}

fn both() -> (Bench, Value, Value) {
    let bench = Bench::new();
    bench.record("data", 32);
    let ridge = evaluated(&bench, "ridge", 0, "ridge");
    let baseline = evaluated(&bench, "baseline", 0, "baseline");
    (bench, ridge, baseline)
}

const OF_TRUTH: [&str; 5] = [
    "sensitivity",
    "uniformity",
    "hysteresis",
    "inter_sensor",
    "intrinsic",
];

#[test]
fn every_score_of_the_baseline_that_reads_predictions_is_said_to_be_without_skill() {
    let (_, ridge, baseline) = both();
    let mut barred = 0;
    for (metric, channels) in baseline["metrics"].as_object().expect("an object") {
        for (channel, score) in channels.as_object().expect("an object") {
            if OF_TRUTH.contains(&metric.as_str()) || score.get("not_applicable").is_some() {
                continue;
            }
            assert_eq!(
                score["standing"], "no skill",
                "{metric} {channel}: {score:#}"
            );
            barred += 1;
        }
    }
    assert!(barred > 10, "{barred}");
    for channel in ["Px", "Fz"] {
        let skill = &baseline["metrics"]["skill"][channel];
        let value = skill["value"].as_f64().expect("a number");
        assert!(value.abs() < 1e-12, "{skill:#}");
        assert!(
            skill.get("flags").is_none(),
            "the training part is known: {skill:#}"
        );
        let score = &ridge["metrics"]["mae"][channel];
        assert!(score.get("standing").is_none(), "{score:#}");
        let share = score["bounded_share"].as_f64().expect("a share");
        assert!((0.0..=0.05).contains(&share), "{share}");
    }
}

#[test]
fn the_baseline_wins_nothing_in_comparisons_choices_pages_and_acceptances() {
    let (bench, ..) = both();
    let comparison = bench.json("compare baseline.json ridge.json");
    crate::schema::check("comparison", &comparison);
    let answers = comparison["answers"].as_array().expect("a list");
    assert!(answers.len() > 5, "{comparison:#}");
    for answer in answers {
        let metric = answer["metric"].as_str().expect("a text");
        assert_eq!(answer["winner"], Value::Null, "{answer:#}");
        if !OF_TRUTH.contains(&metric) && answer["standings"][0] != Value::Null {
            assert_eq!(answer["standings"][0], "no skill");
            let words = answer["answer"].as_str().expect("a text");
            assert!(
                words.contains("not better than predicting the mean"),
                "{words}"
            );
        }
    }
    bench.ok("compare baseline.json ridge.json --html both.html -q");
    let page = fs::read_to_string(bench.path("both.html")).expect("written");
    assert!(
        !page.contains("</strong> is better than"),
        "a verdict on the page"
    );
    for format in ["text", "csv", "md", "tex"] {
        let table = bench.ok(&format!(
            "compare baseline.json ridge.json --format {format} -q"
        ));
        assert!(!table.contains("is better than"), "{format}: {table}");
    }
    let choice = bench.json("choose --need force --results baseline.json --results ridge.json");
    crate::schema::check("choice", &choice);
    assert_eq!(choice["ranked"].as_array().map(Vec::len), Some(1));
    assert_eq!(choice["ranked"][0]["steps"][0]["standing"], Value::Null);
    let reason = choice["barred"][0]["reason"].as_str().expect("a reason");
    assert!(reason.contains("`force` uses MAE of Fz"), "{reason}");
    assert!(
        reason.contains("not better than predicting the mean"),
        "{reason}"
    );
    bench.write(
        "limits.toml",
        "limits_version = 1\n[[limit]]\nmetric = \"linearity\"\nchannel = \"Px\"\nunit = \"1\"\nmost = 1000\n",
    );
    assert_eq!(bench.run("accept ridge.json --limits limits.toml").code, 0);
    let ran = bench.run("accept baseline.json --limits limits.toml --format json -q");
    assert_eq!(ran.code, 1);
    let acceptance: Value = serde_json::from_str(&ran.out).expect("JSON");
    crate::schema::check("acceptance", &acceptance);
    let finding = &acceptance["findings"][0];
    assert_eq!(
        (&finding["kept"], &finding["standing"]),
        (&Value::Bool(false), &Value::from("no skill"))
    );
    assert!(finding["value"].is_number(), "the value stays: {finding:#}");
}

#[test]
fn too_few_points_for_an_interval_leave_open_whether_there_is_skill() {
    let bench = Bench::new();
    bench.record("data", 32);
    let report = bench.json("evaluate data --model ridge --split by-point --metrics mae");
    let skill = &report["metrics"]["skill"]["Fz"];
    assert!(skill["ci95"]["undefined"].is_string(), "{skill:#}");
    assert!(
        skill["value"].as_f64().is_some_and(|skill| skill > 0.0),
        "{skill:#}"
    );
    crate::schema::check("evaluation", &report);
    let standing = &report["metrics"]["mae"]["Fz"]["standing"];
    assert_eq!(standing, "skill not known: no interval");
    for model in ["ridge", "pls"] {
        bench.ok(&format!(
            "evaluate data --model {model} --split by-point --metrics mae --format json --out {model}.json -q"
        ));
    }
    let comparison = bench.json("compare ridge.json pls.json");
    crate::schema::check("comparison", &comparison);
    for answer in comparison["answers"].as_array().expect("a list") {
        assert_eq!(answer["winner"], Value::Null, "{answer:#}");
    }
}

#[test]
fn what_a_model_has_seen_shows_no_skill_on_others() {
    let bench = Bench::new();
    bench.record("data", 32);
    let report = bench.json("evaluate data --model ridge --part all --metrics mae");
    assert_eq!(report["metrics"]["mae"]["Fz"]["standing"], "skill unknown");
    let report = bench.json("evaluate data --model baseline --part all --metrics mae");
    assert_eq!(report["metrics"]["mae"]["Fz"]["standing"], "no skill");
    let text = bench.ok("evaluate data --model baseline --part all --metrics mae -q");
    for words in [
        "standing   not better than predicting the mean: ",
        "remedy     More contact points, or a score of every point (--split cv:5), would narrow the interval of the score.",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
}

#[test]
fn a_cross_validation_is_not_asked_to_score_every_point() {
    let bench = Bench::new();
    bench.record("data", 32);
    let text = bench.ok("evaluate data --model baseline --split cv:5 --metrics mae -q");
    let remedy = "remedy     More contact points would narrow the interval of the score.\n";
    assert!(text.contains(remedy), "{text}");
}

#[test]
fn two_models_on_different_test_parts_stand_side_by_side_and_get_no_verdict() {
    let bench = Bench::new();
    bench.record("data", 32);
    for (seed, name) in [(1, "one"), (1, "same"), (2, "two")] {
        evaluated(&bench, "ridge", seed, name);
    }
    let said = |words: &str| {
        let comparison = bench.json(words);
        let notes = comparison["notes"].as_array().expect("a list");
        let notes = notes.iter().filter_map(|note| note.as_str());
        notes
            .filter(|note| note.starts_with("skill was measured"))
            .count()
    };
    assert_eq!(said("compare one.json same.json"), 0);
    assert_eq!(said("compare one.json two.json"), 1);
    assert_eq!(said("compare one.json two.json --metrics mae"), 0);
    assert_eq!(said("compare one.json two.json --metrics skill"), 1);
    let text = bench.ok("compare one.json two.json --metrics mae -q");
    for words in [
        "Tested on ",
        "no winner: the test parts differ: ",
        " was tested on part test, split by-point 30/10/60, seed 1, and ",
        "evaluate both with one --split, --seed and --part",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let same = bench.ok("compare one.json same.json --metrics mae -q");
    assert!(!same.contains("the test parts differ"), "{same}");
}

#[test]
fn tables_without_a_training_part_are_measured_by_the_mean_of_truth_and_say_so() {
    let bench = Bench::new();
    bench.write(
        "t.csv",
        "id,point_id,Fz\n1,a,0.1\n2,b,0.2\n3,c,0.3\n4,d,0.4\n5,e,0.5\n6,f,0.6\n",
    );
    bench.write(
        "p.csv",
        "id,Fz\n1,0.11\n2,0.21\n3,0.32\n4,0.41\n5,0.52\n6,0.61\n",
    );
    let report = bench.json("score --truth t.csv --pred p.csv --metrics mae --state-out s.state");
    let skill = &report["metrics"]["skill"]["Fz"];
    assert_eq!(skill["flags"][0], "constant is the mean of truth");
    let constant = skill["constant"]["value"].as_f64().expect("a number");
    assert!((constant - 0.35).abs() < 1e-12, "{constant}");
    assert!(report["metrics"]["mae"]["Fz"].get("standing").is_none());
    let text = bench.ok("score --truth t.csv --pred p.csv --metrics mae -q");
    assert!(
        text.contains("skill Fz: constant is the mean of truth"),
        "{text}"
    );
}

/// Scene of one translucent sensor under several lights.
const LIGHT: &str = r#"scene_version = 1
name = "light"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
lighting = { driver = "sim/lighting" }
model = { name = "ridge" }
metrics = { want = ["r_light"] }
protocol = { calibration = { points = 80, indentations = 1 }, lighting = { points = 8 } }
[[study]]
name = "dome"
sensor = { driver = "sim/vitactip:reduction=16" }
"#;

#[test]
fn robustness_to_light_is_of_predictions_beyond_the_bounds_and_says_how_many_those_are() {
    let bench = Bench::new();
    bench.write("light.toml", LIGHT);
    bench.ok("run light.toml --out ran -q");
    let text = fs::read_to_string(bench.path("ran/results.json")).expect("written");
    let results: Value = serde_json::from_str(&text).expect("JSON");
    crate::schema::check("run", &results);
    let metrics = &results["studies"][0]["metrics"];
    // Skill is computed without a request, on the presses of the calibration.
    assert!(metrics["skill"]["Fz"]["value"].is_number(), "{metrics:#}");
    let light = &metrics["r_light"]["Fz"];
    let share = light["bounded_share"].as_f64().expect("a share");
    if share > 0.05 {
        let standing = light["standing"].as_str().expect("barred");
        assert!(["bounded", "no skill"].contains(&standing), "{light:#}");
    }
    let recording = "ran/recordings/1-dome";
    bench.ok(&format!(
        "fit {recording} --model ridge --channels Pz,Fz --out m.model -q"
    ));
    let all = format!("{recording} --with m.model --part all");
    let evaluated = bench.json(&format!("evaluate {all} --metrics r_light,mae"));
    bench.ok(&format!(
        "predict {all} --out bounded.csv --truth-out truth.csv -q"
    ));
    bench.ok(&format!("predict {all} --out free.csv --unbounded -q"));
    let scored = |table: &str, metric: &str| {
        let report = bench.json(&format!(
            "score --truth truth.csv --pred {table} --metrics {metric}"
        ));
        report["metrics"][metric]["Pz"]["value"].clone()
    };
    let own = |metric: &str| evaluated["metrics"][metric]["Pz"]["value"].clone();
    assert!(own("r_light").is_number(), "{evaluated:#}");
    assert_eq!(scored("free.csv", "r_light"), own("r_light"));
    assert_ne!(scored("bounded.csv", "r_light"), own("r_light"));
    assert_eq!(scored("bounded.csv", "mae"), own("mae"));
    assert_ne!(scored("free.csv", "mae"), own("mae"));
}
