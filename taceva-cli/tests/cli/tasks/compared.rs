//! Comparisons of scores of tasks, and limits on them.

use std::fmt::Write as _;

use serde_json::Value;

use crate::support::Bench;

/// Number of strokes of [`labels`].
const STROKES: u32 = 24;
/// Number of frames of a stroke. Slip begins at the fifth frame.
const FRAMES: u32 = 10;

/// Writes a table of labels of 24 strokes. `offset` shifts the column of seconds, so that the table has another digest.
fn labels(bench: &Bench, name: &str, offset: u32) {
    let mut table = "id,stroke,second,slip\n".to_owned();
    for stroke in 0..STROKES {
        for frame in 0..FRAMES {
            let label = if frame >= 4 { "slip" } else { "no_slip" };
            let id = stroke * FRAMES + frame;
            writeln!(table, "{id},s{stroke:02},{},{label}", frame + offset).expect("text");
        }
    }
    bench.write(name, &table);
}

/// Writes and scores predictions in which slip begins `late` frames after its label. Writes `NAME.json` and `NAME.state`.
fn model(bench: &Bench, name: &str, options: &str, late: impl Fn(u32) -> u32) {
    let mut table = "id,slip\n".to_owned();
    for stroke in 0..STROKES {
        for frame in 0..FRAMES {
            let slips = frame >= 4 + late(stroke);
            let label = if slips { "slip" } else { "no_slip" };
            writeln!(table, "{},{label}", stroke * FRAMES + frame).expect("text");
        }
    }
    bench.write(&format!("{name}.csv"), &table);
    bench.ok(&format!(
        "score --truth truth.csv --pred {name}.csv --task slip=outcome:positive=slip:names=no_slip|slip --cluster stroke {options} \
         --format json --out {name}.json --state-out {name}.state --force -q"
    ));
}

/// Test folder with two models: `a` predicts slip half a frame late on average over the strokes, `b` one and a half frames.
fn two() -> Bench {
    let bench = Bench::new();
    labels(&bench, "truth.csv", 0);
    model(&bench, "a", "", |stroke| stroke % 2);
    model(&bench, "b", "", |stroke| 1 + stroke / 2 % 2);
    bench
}

/// Answer of `comparison` for the score `score`.
fn answer<'r>(comparison: &'r Value, score: &str) -> &'r Value {
    let answers = comparison["answers"].as_array().expect("a list");
    let found = answers.iter().find(|answer| answer["score"] == score);
    found.unwrap_or_else(|| panic!("no {score} in {comparison:#}"))
}

#[test]
fn two_models_of_the_same_labels_are_compared_stroke_by_stroke() {
    let bench = two();
    let comparison = bench.json("compare a.json b.json");
    crate::schema::check("task-comparison", &comparison);
    let f1 = answer(&comparison, "f1");
    // Of 144 frames that slip, a misses 12 and b misses 36.
    assert_eq!(
        f1["values"],
        serde_json::json!([264.0 / 276.0, 216.0 / 252.0])
    );
    assert_eq!(
        (&f1["paired"], &f1["winner"]),
        (&Value::Bool(true), &Value::from("a"))
    );
    let difference = f1["difference"]["value"].as_f64().expect("a number");
    assert!(
        (difference - (264.0 / 276.0 - 216.0 / 252.0)).abs() < 1e-9,
        "{f1:#}"
    );
    assert!(f1["difference"]["p_holm"].as_f64() > f1["difference"]["p"].as_f64());
    // Neither model predicts a slip too early.
    let precision = answer(&comparison, "precision");
    assert_eq!(
        (&precision["winner"], &precision["difference"]["p"]),
        (&Value::Null, &Value::from(1.0))
    );
    // States alone are enough, and say the same.
    let of_states = bench.json("compare a.state b.state");
    assert_eq!(of_states["answers"], comparison["answers"]);
    // The winner does not depend on the order.
    let reversed = bench.json("compare b.json a.json");
    assert_eq!(answer(&reversed, "f1")["winner"], "a");
}

#[test]
fn readers_see_values_intervals_constants_and_answers() {
    let bench = two();
    let text = bench.ok("compare a.json b.json --metrics f1 -q");
    for part in [
        "best constant",
        "0.75",
        "240 in 24",
        "slip f1: a better than b by 0.0994",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(!text.contains("kappa"), "{text}");
    for format in ["md", "csv", "tex"] {
        let text = bench.ok(&format!("compare a.json b.json --format {format} -q"));
        assert!(
            text.contains("f1") && text.contains("kappa"),
            "{format}: {text}"
        );
    }
}

#[test]
fn without_states_the_intervals_of_both_decide_and_a_note_names_the_option() {
    let bench = two();
    std::fs::remove_file(bench.path("b.state")).expect("written");
    let comparison = bench.json("compare a.json b.json --metrics f1");
    assert_eq!(answer(&comparison, "f1")["paired"], false);
    let notes = comparison["notes"].to_string();
    assert!(
        notes.contains("b has no state") && notes.contains("--state-out"),
        "{notes}"
    );
}

#[test]
fn models_of_other_labels_are_compared_by_their_intervals() {
    let bench = two();
    labels(&bench, "truth.csv", 1);
    model(&bench, "b", "", |stroke| 1 + stroke / 2 % 2);
    let comparison = bench.json("compare a.json b.json --metrics f1");
    let f1 = answer(&comparison, "f1");
    assert_eq!(
        (&f1["paired"], &f1["winner"]),
        (&Value::Bool(false), &Value::from("a"))
    );
    assert!(comparison["notes"].to_string().contains("different labels"));
}

#[test]
fn scores_of_other_definitions_are_not_ranked() {
    let bench = two();
    model(&bench, "b", "--debounce slip=2", |stroke| stroke % 2);
    let comparison = bench.json("compare a.json b.json --metrics f1");
    let f1 = answer(&comparison, "f1");
    assert_eq!(
        (&f1["winner"], &f1["difference"]),
        (&Value::Null, &Value::Null)
    );
    let words = f1["answer"].as_str().expect("words");
    assert!(
        words.contains("definitions") && words.contains("debounce 2"),
        "{words}"
    );
}

#[test]
fn a_model_that_a_constant_equals_is_not_ranked() {
    let bench = two();
    // The constant prediction itself.
    bench.write("b.csv", &slips_alone());
    bench.ok(
        "score --truth truth.csv --pred b.csv --task slip=outcome:positive=slip:names=no_slip|slip --cluster stroke --format json --out b.json \
         --state-out b.state --force -q",
    );
    let comparison = bench.json("compare a.json b.json --metrics f1");
    let words = answer(&comparison, "f1")["answer"].as_str().expect("words");
    assert!(
        words.contains("b: not shown to be better than the best constant prediction, 0.75"),
        "{words}"
    );
    // A limit on such a score is not decided.
    let limit = "[[limit]]\nmetric = \"f1\"\nchannel = \"slip\"\nunit = \"1\"\nleast = 0.5\n";
    bench.write("limits.toml", &format!("limits_version = 2\n{limit}"));
    let ran = bench.run("accept b.json --limits limits.toml --format json -q");
    let acceptance: Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(acceptance["findings"][0]["verdict"], "undecided");
    assert_eq!(ran.code, 1, "{}", ran.err);
}

/// Table that predicts slip in every frame.
fn slips_alone() -> String {
    let rows = (0..STROKES * FRAMES).map(|id| format!("{id},slip\n"));
    format!("id,slip\n{}", rows.collect::<String>())
}

#[test]
fn results_of_channels_single_results_and_options_of_channels_are_refused() {
    let bench = two();
    bench.refused("compare a.json", 2, "expected at least two");
    bench.refused("compare a.json GelSight", 2, "no scores of tasks");
    bench.refused(
        "compare a.json b.json --margin f1=0.1",
        2,
        "--margin is for scores of channels",
    );
    bench.refused(
        "compare a.json b.json --metrics mae",
        2,
        "--metrics mae: no result has this score",
    );
    bench.refused("compare a.json a.json", 2, "named twice");
}

#[test]
fn limits_on_a_score_of_a_task_have_the_four_verdicts() {
    let bench = two();
    let mut limits = "limits_version = 2\n[decision]\nrule = \"guarded\"\n".to_owned();
    for least in ["0.9", "0.955", "0.96", "0.99"] {
        write!(
            limits,
            "[[limit]]\nmetric = \"f1\"\nchannel = \"slip\"\nunit = \"1\"\nleast = {least}\n"
        )
        .expect("text");
    }
    bench.write("limits.toml", &limits);
    let ran = bench.run("accept a.json --limits limits.toml --format json -q");
    assert_eq!(ran.code, 1, "{}", ran.err);
    let acceptance: Value = serde_json::from_str(&ran.out).expect("JSON");
    crate::schema::check("acceptance", &acceptance);
    let findings = acceptance["findings"].as_array().expect("a list");
    let verdicts: Vec<&str> = findings
        .iter()
        .filter_map(|of| of["verdict"].as_str())
        .collect();
    assert_eq!(
        verdicts,
        ["pass", "conditional pass", "conditional fail", "fail"]
    );
    assert_eq!(findings[0]["value"], 264.0 / 276.0);
    assert_eq!(findings[0]["n"], 240);
}

#[test]
fn limits_reach_variants_and_a_missing_task_is_named() {
    let bench = two();
    let limit = |metric: &str, channel: &str| {
        format!(
            "[[limit]]\nmetric = \"{metric}\"\nchannel = \"{channel}\"\nunit = \"1\"\nleast = 0.9\n"
        )
    };
    let text = limit("f1_macro.class slip", "slip") + &limit("f1", "slop");
    bench.write("limits.toml", &format!("limits_version = 2\n{text}"));
    let ran = bench.run("accept a.state --limits limits.toml --format json -q");
    let acceptance: Value = serde_json::from_str(&ran.out).expect("JSON");
    let [first, second] = [0_usize, 1].map(|at| &acceptance["findings"][at]);
    assert_eq!(
        (&first["verdict"], &first["value"]),
        (&Value::from("pass"), &Value::from(264.0 / 276.0))
    );
    assert!(
        second["reason"]
            .as_str()
            .is_some_and(|words| words.contains("did you mean channel `slip`?"))
    );
    bench.refused(
        "accept --template a.json",
        2,
        "--template writes limits of channels",
    );
}
