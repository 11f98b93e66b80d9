//! Wanted widths of intervals: predicted before the first press, and noted after the run.

use serde_json::Value;

use super::SMALL;
use crate::support::Bench;
use crate::sweep_scenes::refused::{LAB, REAL};

/// Small scene with the points `points`, all of them tested, that wants the width `width` of the interval of `mae.Fz`.
fn wanting(points: &str, width: &str) -> String {
    let scene = SMALL
        .replace("points = 16", points)
        .replace("name = \"ridge\"", "name = \"ridge\", folds = 3");
    assert_ne!(scene, SMALL);
    format!(
        "{scene}metrics = {{ want = [\"mae\"], want_width = {{ \"mae.Fz\" = \"{width}\" }} }}\n"
    )
}

/// Test folder with a scene of 16 points that wants a width of 20 %, then the results and the messages of its run `r`.
fn with_pilot() -> (Bench, Value, String) {
    let bench = Bench::new();
    bench.write("small.toml", &wanting("points = 16", "20 %"));
    let ran = bench.run("run small.toml --out r --format json");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let results = serde_json::from_str(&ran.out).expect("JSON");
    (bench, results, ran.err)
}

/// Lines about widths that `taceva plan SCENE` prints.
fn planned(bench: &Bench, words: &str) -> String {
    let ran = bench.run(&format!("plan {words}"));
    assert_eq!(ran.code, 0, "{}", ran.err);
    let lines = ran.err.lines();
    let lines: Vec<&str> = lines.filter(|line| line.contains("width: ")).collect();
    lines.join("\n")
}

/// Width of the interval of `mae.Fz`, in per cent.
fn printed_width(results: &Value) -> f64 {
    let ends = &results["studies"][0]["metrics"]["mae"]["Fz"]["ci95"];
    let end = |at: usize| ends[at].as_f64().expect("an end");
    100.0 * (end(1) / end(0) - 1.0)
}

/// Number before ` %` that precedes `words` in `line`.
fn percent_before(line: &str, words: &str) -> f64 {
    let (before, _) = line.split_once(&format!(" % {words}")).expect(line);
    let number = before.rsplit(' ').next().expect("a word");
    number.parse().expect(line)
}

/// Whole number after `words` in `line`.
fn number_after(line: &str, words: &str) -> u32 {
    let (_, after) = line.split_once(words).expect(line);
    let end = after.find(|letter: char| !letter.is_ascii_digit());
    after[..end.unwrap_or(after.len())].parse().expect(line)
}

#[test]
fn a_run_notes_the_width_of_its_interval_and_that_its_points_were_fixed() {
    let (_bench, results, said) = with_pilot();
    let width = printed_width(&results);
    let note = format!(
        "width of the interval of mae.Fz: 20.0 % wanted, {width:.1} % reached with 16 tested contact points; the number of points was fixed in advance"
    );
    let notes = results["studies"][0]["provenance"]["notes"].to_string();
    assert!(notes.contains(&note), "{note}\n{notes}");
    assert!(said.contains(&format!("small: {note}")), "{said}");
}

#[test]
fn a_plan_predicts_the_width_of_its_points_from_a_run_of_the_scene() {
    let (bench, results, _) = with_pilot();
    let width = printed_width(&results);
    let said = planned(&bench, "small.toml --from r");
    let words = "expected with 16 tested contact points, 20.0 % wanted: it needs `points = ";
    // A press that ends early has fewer samples than planned.
    let expected = percent_before(&said, words);
    assert!((expected / width - 1.0).abs() < 0.1, "{said}\n{width}");
    assert!(
        said.contains("predicted from 16 simulated points with ridge"),
        "{said}"
    );
    bench.write("more.toml", &wanting("points = 64", "20 %"));
    let more = planned(&bench, "more.toml --from r");
    assert!(percent_before(&more, "expected") < 0.7 * width, "{more}");
}

#[test]
fn the_points_that_a_plan_proposes_are_expected_to_reach_the_width() {
    let (bench, _, _) = with_pilot();
    let said = planned(&bench, "small.toml --from r");
    let points = number_after(&said, "it needs `points = ");
    assert!(points > 16, "{said}");
    bench.write(
        "enough.toml",
        &wanting(&format!("points = {points}"), "20 %"),
    );
    let enough = planned(&bench, "enough.toml --from r");
    assert!(!enough.contains("it needs"), "{enough}");
    assert!(percent_before(&enough, "expected") <= 20.0, "{enough}");
}

#[test]
fn without_a_run_a_plan_names_the_option_that_predicts_a_width() {
    let bench = Bench::new();
    bench.write("small.toml", &wanting("points = 16", "20 %"));
    let said = planned(&bench, "small.toml");
    assert!(
        said.contains("width: small: mae.Fz: 20.0 % wanted; `--from RUN` predicts the width"),
        "{said}"
    );
}

#[test]
fn a_width_that_a_constant_model_cannot_reach_is_said_before_a_press_with_the_one_that_it_can() {
    let bench = Bench::new();
    let own = "name = \"ridge\", folds = 3, set = { size = \"8x8\" }";
    let scene = wanting("points = 16, points_max = 24", "1 %");
    let scene = scene.replace(own, "name = \"baseline\", folds = 3");
    assert!(scene.contains("baseline"), "{scene}");
    bench.write("small.toml", &scene);
    let results = bench.json("run small.toml --out r");
    let said = planned(&bench, "small.toml --from r");
    let words = "it cannot be reached with `points_max = 24`, which gives ";
    let (_, after) = said.split_once(words).expect(&said);
    let (best, _) = after.split_once(" %").expect(&said);
    let best: f64 = best.parse().expect(&said);
    assert!(1.0 < best && best < printed_width(&results), "{said}");
}

#[test]
fn one_place_has_no_width_and_this_is_said_before_a_press() {
    let (bench, _, _) = with_pilot();
    let of_points = |points: &str| wanting(points, "20 %").replace(", folds = 3", "");
    bench.write("one.toml", &of_points("points = 1"));
    let said = planned(&bench, "one.toml");
    assert!(
        said.contains("20.0 % cannot be reached with ") && said.contains("an interval needs 5"),
        "{said}"
    );
    let said = planned(&bench, "one.toml --from r");
    assert!(said.contains("no interval with "), "{said}");
    // The test part has a tenth of the points.
    let points = number_after(&said, "it needs `points = ");
    assert!(points >= 50, "{said}");
    bench.write("enough.toml", &of_points(&format!("points = {points}")));
    let enough = planned(&bench, "enough.toml --from r");
    let tested = format!("expected with {} tested contact points", points / 10);
    assert!(enough.contains(&tested), "{enough}");
    assert!(percent_before(&enough, "expected") <= 20.0, "{enough}");
}

#[test]
fn a_width_on_a_real_rig_is_predicted_and_nothing_is_pressed() {
    let (bench, _, _) = with_pilot();
    bench.write("lab.toml", LAB);
    let metrics = "want = [\"accuracy\"]";
    let wanted = format!("{metrics}, want_width = {{ \"mae.Fz\" = \"50 %\" }}");
    bench.write("real.toml", &REAL.replace(metrics, &wanted));
    let said = planned(&bench, "real.toml --from r");
    assert!(
        said.contains("width: real: mae.Fz: no interval with 1 tested contact point, 50.0 % wanted: it needs `points = "),
        "{said}"
    );
    assert!(
        said.contains("predicted from 16 simulated points"),
        "{said}"
    );
    assert!(!bench.path("runs").exists());
}

#[test]
fn the_results_of_a_run_belong_to_the_studies_of_the_same_name_and_unit_in_any_order() {
    let bench = Bench::new();
    let sensor = SMALL.lines().find(|line| line.starts_with("sensor"));
    let sensor = sensor.expect("one");
    let small = wanting("points = 16", "20 %").replace(sensor, "");
    let [first, second] = ["vitactip", "magictac"].map(|model| {
        format!(
            "[[study]]\nname = \"{model}\"\nsensor = {{ driver = \"sim/{model}:reduction=16\", units = [\"0\", \"1\"] }}\n"
        )
    });
    bench.write("two.toml", &format!("{small}{first}{second}"));
    bench.ok("run two.toml --out r -q");
    let expected = |scene: &str, name: &str| {
        let said = planned(&bench, &format!("{scene} --from r"));
        let start = format!("width: {name}: mae.Fz: ");
        let (_, after) = said.split_once(&start).expect(&said);
        let (percent, _) = after.split_once(" % expected").expect(&said);
        percent.to_owned()
    };
    bench.write("turned.toml", &format!("{small}{second}{first}"));
    let widths = ["vitactip", "magictac"].map(|name| expected("two.toml", name));
    assert_ne!(widths[0], widths[1], "two sensors");
    let turned = ["vitactip", "magictac"].map(|name| expected("turned.toml", name));
    assert_eq!(turned, widths);
    let other = second.replace("units = [\"0\"", "units = [\"2\"");
    bench.write("other.toml", &format!("{small}{first}{other}"));
    let said = planned(&bench, "other.toml --from r");
    assert!(said.contains("width: vitactip: mae.Fz: "), "{said}");
    assert!(
        said.contains("width: magictac: not predicted, because the earlier run has no result of this study on unit 2, only of `vitactip` on unit 0, 1; `magictac` on unit 0, 1"),
        "{said}"
    );
}

#[test]
fn a_plan_names_the_model_of_the_scene_if_the_run_fitted_another_model() {
    let (bench, _, _) = with_pilot();
    let own = "name = \"ridge\", folds = 3, set = { size = \"8x8\" }";
    let said = |model: &str| {
        let scene = wanting("points = 16", "20 %");
        assert!(scene.contains(own), "{scene}");
        let other = format!("name = \"{model}\", folds = 3");
        bench.write("other.toml", &scene.replace(own, &other));
        planned(&bench, "other.toml --from r")
    };
    // A preset is another name for a model, and `auto` may have chosen the model of the run.
    for (model, named) in [("pls", Some("pls")), ("fast", Some("cnn")), ("auto", None)] {
        let said = said(model);
        let words = match named {
            Some(named) => format!("16 simulated points with ridge, and the scene names {named}"),
            None => "16 simulated points with ridge".to_owned(),
        };
        assert!(said.ends_with(&words), "{said}");
    }
}

#[test]
fn results_of_other_studies_and_a_scene_without_a_wanted_width_are_refused() {
    let (bench, _, _) = with_pilot();
    bench.write("plain.toml", SMALL);
    bench.refused(
        "plan plain.toml --from r",
        2,
        "--from r: the scene names no `want_width` under [metrics], so there is no width to predict",
    );
    let two = "[[study]]\nname = \"a\"\n[[study]]\nname = \"b\"\n";
    let two = format!("{}{two}", wanting("points = 16", "20 %"));
    bench.write("two.toml", &two);
    bench.refused(
        "plan two.toml --from r",
        2,
        "--from r: the run has no result of a study of this scene, only of `small` on unit 0, 1; name a run of this scene",
    );
    let unread = bench.run("plan small.toml --from nowhere -q");
    assert_ne!(unread.code, 0);
    assert!(unread.err.contains("cannot read nowhere"), "{}", unread.err);
}
