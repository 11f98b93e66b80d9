//! Bundles with their model, which predicts the recording again to verify the claims.

use std::fs;

use super::forgery::{manifest, relist};
use super::{of_verdict, verified};
use crate::support::Bench;

/// Arguments that bundle the evaluation of a fitted model, without the model.
const BUNDLE: &str = "bundle r.json --state r.state --draft --date 2026-11-28 --out b";

/// Test folder with the recording `data`, a fitted model and the evaluation of the model on it.
fn bench() -> Bench {
    let bench = Bench::new();
    bench.record("data", 20);
    bench.ok("fit data --model ridge --set size=8 --split random --out m.taceva -q");
    bench.ok("evaluate data --with m.taceva --metrics mae --format json --out r.json --state-out r.state --samples-out r.samples.csv -q");
    bench
}

#[test]
fn a_model_in_a_bundle_gives_every_claim_again_on_its_recording() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} --model m.taceva"));
    crate::schema::check("bundle", &manifest(&bench, "b"));
    let found = verified(&bench, "b --level model --dataset data", 0);
    let claims = found["claims"].as_array().expect("claims");
    assert!(!claims.is_empty());
    assert_eq!(of_verdict(&found, "equal").len(), claims.len(), "{found}");
    assert!(claims.iter().all(|claim| claim["level"] == "model"));
    // Without the recording a bundle is verified as deep as before.
    let found = verified(&bench, "b", 0);
    let claims = found["claims"].as_array().expect("claims");
    assert!(claims.iter().all(|claim| claim["level"] == "predictions"));
}

#[test]
fn a_model_is_fitted_again_by_its_card_when_that_is_asked_for() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} --model m.taceva"));
    let found = verified(&bench, "b --level fit --dataset data", 0);
    let claims = found["claims"].as_array().expect("claims");
    assert_eq!(of_verdict(&found, "equal").len(), claims.len(), "{found}");
    assert!(claims.iter().all(|claim| claim["level"] == "fit"));
    // A model of another recording has nothing to be fitted on.
    bench.record_with_noise("other", 20, 1);
    bench.ok("evaluate other --with m.taceva --metrics mae --format json --out r.json --state-out r.state --samples-out r.samples.csv --force -q");
    bench.ok(&format!("{BUNDLE} --model m.taceva --force"));
    verified(&bench, "b --level model --dataset other", 0);
    let found = verified(&bench, "b --level fit --dataset other", 1);
    let levels = found["levels"].to_string();
    assert!(
        levels.contains("the model was fitted on another recording"),
        "{levels}"
    );
}

#[test]
fn predictions_by_another_instruction_set_are_equal_or_within() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} --model m.taceva"));
    let mut command = bench.command("bundle verify b --level model --dataset data -q");
    let output = command.env("TACEVA_ISA", "portable").output();
    let output = output.expect("the program starts");
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("level    model: reached"), "{said}");
}

#[test]
fn a_bundle_states_the_instruction_sets_that_its_program_could_use() {
    let bench = bench();
    let mut command = bench.command(&format!("{BUNDLE} -q"));
    let output = command.env("TACEVA_ISA", "portable").output();
    let output = output.expect("the program starts");
    assert_eq!(output.status.code(), Some(0));
    let text = fs::read_to_string(bench.path("b/environment.json")).expect("written");
    let environment: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let expected = serde_json::json!(["portable"]);
    assert_eq!(environment["instruction_sets"], expected, "{text}");
    let machine = environment["machine"].as_str().expect("words");
    assert!(machine.contains("`taceva bundle`"), "{machine}");
}

#[test]
fn the_level_of_the_model_says_what_is_missing() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} --model m.taceva"));
    let reason = |words: &str, code: i32| {
        let found = verified(&bench, words, code);
        let levels = found["levels"].as_array().expect("levels").clone();
        let model = levels.into_iter().find(|own| own["level"] == "model");
        let model = model.expect("the level");
        assert_eq!(model["reached"], false, "{model}");
        model["reason"].as_str().expect("words").to_owned()
    };
    let without = reason("b --level model", 1);
    assert!(
        without.contains("no recording: name sha256:") && without.contains("by --dataset"),
        "{without}"
    );
    // Another recording is never accepted in its place.
    bench.record_with_noise("other", 20, 1);
    let other = reason("b --dataset other", 1);
    assert!(
        other.contains("the recording is sha256:")
            && other.contains("and the results are of sha256:"),
        "{other}"
    );
    bench.ok(&format!("{BUNDLE} --force"));
    let withheld = manifest(&bench, "b")["withheld"].clone();
    assert_eq!(withheld[0]["role"], "model", "{withheld}");
    let model = fs::read(bench.path("m.taceva")).expect("written");
    let digest = taceva_files::seal::digest_of_bytes(&model);
    assert_eq!(withheld[0]["digest"], digest);
    let absent = reason("b --dataset data", 0);
    assert!(
        absent.contains("no model: make the bundle again with --model"),
        "{absent}"
    );
}

#[test]
fn pictures_in_a_bundle_are_predicted_again_without_the_recording() {
    let bench = Bench::imported();
    bench.ok("fit data --model ridge --set size=8 --split random --out m.taceva -q");
    bench.ok("evaluate data --with m.taceva --metrics mae --format json --out r.json --state-out r.state --samples-out r.samples.csv -q");
    let words = format!("{BUNDLE} --model m.taceva --with frames");
    bench.refused(
        &words,
        3,
        "no recording with pictures: name it by --dataset",
    );
    let shut = format!("{words} --dataset data --without predictions");
    bench.refused(&shut, 3, "--with frames adds the labels of the recording");
    let said = bench.run(&format!("{words} --dataset data"));
    assert_eq!(said.code, 0, "{}", said.err);
    assert!(said.err.contains("frames/ has "), "{}", said.err);
    let made = manifest(&bench, "b");
    crate::schema::check("bundle", &made);
    assert!(made["withheld"].is_null(), "{}", made["withheld"]);
    let files = made["files"].as_array().expect("files").iter();
    let pictures = files.filter_map(|file| file["path"].as_str());
    let pictures: Vec<&str> = pictures.filter(|path| path.ends_with(".png")).collect();
    // Pictures of the fit stay away.
    let scored = made["claims"][0]["n"].as_u64().expect("a number");
    assert_eq!(pictures.len() as u64, scored, "{pictures:?}");
    fs::rename(bench.path("data"), bench.path("away")).expect("there");
    let found = verified(&bench, "b --level model", 0);
    let claims = found["claims"].as_array().expect("claims");
    assert_eq!(of_verdict(&found, "equal").len(), claims.len(), "{found}");
    assert!(claims.iter().all(|claim| claim["level"] == "model"));
    // A picture is that of the recording, whatever the manifest lists.
    fs::copy(
        bench.path("b").join(pictures[0]),
        bench.path("b").join(pictures[1]),
    )
    .expect("room");
    relist(&bench, "b", super::forgery::of_another_version);
    let found = verified(&bench, "b --level model", 1);
    let lost = of_verdict(&found, "not recomputable");
    assert_eq!(lost.len(), claims.len(), "{found}");
    // Their folder is not read twice.
    relist(&bench, "b", |manifest| {
        manifest["studies"][0]["frames"] = serde_json::json!(["frames/0", "frames/0"]);
    });
    let found = verified(&bench, "b", 3);
    let problem = found["damage"][0]["problem"].as_str().expect("words");
    assert!(problem.contains("named twice"), "{problem}");
}

#[test]
fn a_bundle_without_pictures_states_the_digest_of_their_recording() {
    let bench = bench();
    bench.ok(BUNDLE);
    let withheld = manifest(&bench, "b")["withheld"].clone();
    let withheld = withheld.as_array().expect("withheld files");
    let frames = withheld.iter().find(|own| own["role"] == "frames");
    let results = fs::read_to_string(bench.path("r.json")).expect("written");
    let results: serde_json::Value = serde_json::from_str(&results).expect("JSON");
    let frames = frames.expect("pictures");
    assert_eq!(frames["digest"], results["provenance"]["dataset"]);
}

#[test]
fn a_model_of_other_results_is_refused_when_a_bundle_is_made_and_when_it_is_verified() {
    let bench = bench();
    bench.ok("fit data --model ridge --set size=4 --split random --out other.taceva -q");
    let words = format!("{BUNDLE} --model other.taceva");
    bench.refused(&words, 3, "but the results name sha256:");
    assert!(!bench.path("b").exists());
    bench.refused(
        &format!("{BUNDLE} --with model"),
        3,
        "give it by --model FILE",
    );
    bench.ok(&format!("{BUNDLE} --model m.taceva"));
    fs::copy(bench.path("other.taceva"), bench.path("b/model/0.taceva")).expect("room");
    let found = verified(&bench, "b --dataset data", 3);
    assert_eq!(found["damage"][0]["path"], "model/0.taceva");
    relist(&bench, "b", |_| {});
    let found = verified(&bench, "b --dataset data", 3);
    let problem = found["damage"][0]["problem"].as_str().expect("words");
    assert!(
        problem.contains("another digest than `model.digest`"),
        "{problem}"
    );
}

#[test]
fn a_run_keeps_its_models_on_request_and_they_predict_its_samples_again() {
    let bench = Bench::new();
    let scene = format!(
        "{}report = {{ keep = [\"models\"] }}\n",
        super::inputs::SCENE
    );
    bench.write("small.toml", &scene);
    bench.ok("run small.toml --out run -q");
    let kept: Vec<_> = fs::read_dir(bench.path("run/models"))
        .expect("kept")
        .collect();
    assert_eq!(kept.len(), 1);
    bench.ok("bundle run --with model,frames --draft --out c -q");
    verified(&bench, "c --level model", 0);
    bench.ok("bundle run --with model --draft --out b -q");
    let recording = fs::read_dir(bench.path("run/recordings")).expect("recorded");
    let recording = recording.map(|entry| entry.expect("readable").file_name());
    let recording: Vec<_> = recording
        .filter(|name| name.to_string_lossy().starts_with('1'))
        .collect();
    let [recording] = &recording[..] else {
        panic!("one recording: {recording:?}");
    };
    let words = format!("b --dataset run/recordings/{}", recording.to_string_lossy());
    let found = verified(&bench, &words, 0);
    let remarks = found["remarks"].to_string();
    assert!(
        remarks.contains("Study 0: the model reproduces the predictions of"),
        "{remarks}"
    );
    // No claim of this run reads times, but they are those of the recording.
    super::inputs::edit_cells(&bench, |name, cell| match name {
        "t_s" if !cell.is_empty() => (1.0 + cell.parse::<f64>().expect("a time")).to_string(),
        _ => cell.to_owned(),
    });
    verified(&bench, "b --level predictions", 0);
    let found = verified(&bench, &words, 1);
    let others = found["others"].to_string();
    assert!(others.contains("`t_s` in line "), "{others}");
}
