//! Bundles of evaluations and of runs, and texts beside them.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use taceva_core::Isa;
use taceva_files::seal::digest_of_bytes;

use super::forgery::{accept, edit, manifest, of_another_version, relist};
use super::{BUNDLE, bench, of_verdict, score, verified};
use crate::support::Bench;

/// Scene with two phases: calibration and an idle gel.
pub(super) const SCENE: &str = r#"scene_version = 1
name = "small"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
model = { name = "ridge", set = { size = "8x8" } }
sensor = { driver = "sim/gelsight" }
metrics = { want = ["mae", "noise_equivalent_force"] }
protocol = { calibration = { points = 12, indentations = 2 }, idle = { frames = 12 } }
"#;

/// Test folder with a run of the scene in the folder `run`.
fn run() -> Bench {
    let bench = Bench::new();
    bench.write("small.toml", SCENE);
    bench.ok("run small.toml --out run -q");
    bench
}

#[test]
fn an_evaluation_is_verified_by_its_samples_as_far_as_they_hold_what_metrics_read() {
    let bench = Bench::new();
    bench.record("data", 20);
    bench.ok("evaluate data --model ridge --set size=20x20 --split random --no-cache --format json --out r.json --state-out r.state --samples-out r.samples.csv -q");
    bench.ok("bundle r.json --state r.state --dataset data --draft --out b.tar.gz -q");
    let found = verified(&bench, "b.tar.gz", 0);
    assert_eq!(found["summary"]["differs"], 0, "{}", found["others"]);
    let claims = found["claims"].as_array().expect("claims");
    let errors: Vec<&Value> = claims
        .iter()
        .filter(|claim| claim["metric"] == "mae")
        .collect();
    assert!(!errors.is_empty());
    assert!(errors.iter().all(|claim| claim["level"] == "predictions"));
}

#[test]
fn an_evaluation_without_its_state_names_the_state_that_others_need() {
    let bench = Bench::new();
    bench.record("data", 20);
    bench.ok("evaluate data --model ridge --set size=20x20 --split random --no-cache --format json --out r.json --samples-out r.samples.csv -q");
    let ran = bench.run("bundle r.json --draft --out b");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.out.contains("level    form: "), "{}", ran.out);
    assert!(ran.err.contains("add --state STATE"), "{}", ran.err);
}

#[test]
fn a_run_is_verified_by_its_samples_phase_by_phase() {
    let bench = run();
    bench.ok("bundle run --draft --out b.tar.gz -q");
    let found = verified(&bench, "b.tar.gz", 0);
    let claims = found["claims"].as_array().expect("claims");
    assert_eq!(
        of_verdict(&found, "equal").len(),
        claims.len(),
        "{}",
        found["levels"]
    );
    let errors = claims.iter().filter(|claim| claim["metric"] == "mae");
    let errors: Vec<&Value> = errors.collect();
    assert!(!errors.is_empty());
    assert!(
        errors.iter().all(|claim| claim["level"] == "predictions"),
        "{errors:?}"
    );
}

#[test]
fn a_run_is_verified_to_the_predictions_for_every_claim() {
    let bench = Bench::new();
    bench.write("small.toml", crate::run::SMALL);
    bench.ok("run small.toml --out run -q");
    bench.ok("bundle run --draft --out b -q");
    let found = verified(&bench, "b --level predictions", 0);
    let claims = found["claims"].as_array().expect("claims");
    for metric in ["mae", "drift", "hysteresis", "intrinsic", "r_light", "sr"] {
        let mut names = claims.iter().map(|claim| &claim["metric"]);
        assert!(names.any(|name| name == metric), "{metric}");
    }
    for claim in claims {
        assert_eq!(claim["verdict"], "equal", "{claim}");
        assert_eq!(claim["level"], "predictions", "{claim}");
    }
    assert_eq!(found["others"].as_array().map(Vec::len), Some(0));
}

#[test]
fn times_that_are_edited_give_other_sums_than_the_state_of_the_rate() {
    let bench = Bench::new();
    let want = r#"want = ["mae", "intrinsic"]"#;
    let scene = SCENE.replace(r#"want = ["mae", "noise_equivalent_force"]"#, want);
    bench.write("small.toml", &scene);
    bench.ok("run small.toml --out run -q");
    bench.ok("bundle run --draft --out b -q");
    edit_cells(&bench, |name, cell| match name {
        "t_s" if !cell.is_empty() => (2.0 * cell.parse::<f64>().expect("a time")).to_string(),
        _ => cell.to_owned(),
    });
    let found = verified(&bench, "b", 1);
    let lost = of_verdict(&found, "not recomputable");
    assert!(!lost.is_empty(), "{}", found["summary"]);
    for claim in lost {
        assert_eq!(claim["metric"], "intrinsic", "{claim}");
    }
    assert!(is_other(&found, "state"), "{}", found["others"]);
}

#[test]
fn a_state_of_another_phase_in_the_place_of_that_of_a_phase_differs() {
    let bench = run();
    bench.ok("bundle run --draft --out b -q");
    let results: Value = read(&bench.path("b/results.json"));
    let phases = &results["studies"][0]["provenance"]["phases"];
    assert_eq!(phases["mae"], "calibration", "{phases}");
    let states = fs::read_dir(bench.path("b/states")).expect("a folder");
    let mut states = states.map(|entry| entry.expect("readable").path());
    let is_of_errors = |path: &PathBuf| !read(path)["provenance"]["phases"]["mae"].is_null();
    let state = states.find(is_of_errors).expect("a state of errors");
    let of_idle = |text: String| text.replace(r#""calibration""#, r#""idle""#);
    edit(&state, of_idle);
    accept(&state);
    relist(&bench, "b", of_another_version);
    let found = verified(&bench, "b", 1);
    assert!(is_other(&found, "phases"), "{}", found["others"]);
    // Results that name the other phase too have sums that its rows do not give.
    let named = read(&state)["provenance"]["phases"].clone();
    let path = bench.path("b/results.json");
    edit(&path, |text| {
        let metrics = named.as_object().expect("phases").keys();
        metrics.fold(text, |text, metric| {
            let phase = |name: &str| format!(r#""{metric}": "{name}""#);
            text.replace(&phase("calibration"), &phase("idle"))
        })
    });
    accept(&path);
    relist(&bench, "b", of_another_version);
    let found = verified(&bench, "b", 1);
    assert!(!is_other(&found, "phases"), "{}", found["others"]);
    assert!(is_other(&found, "state"), "{}", found["others"]);
}

#[test]
fn a_table_without_phases_gives_no_claim_of_states_that_name_one() {
    let bench = run();
    bench.ok("bundle run --draft --out b -q");
    edit_table(&bench, |text| text.replacen("protocol", "part", 1));
    let found = verified(&bench, "b", 1);
    let claims = found["claims"].as_array().expect("claims");
    for claim in claims {
        let reason = claim["reason"].as_str().expect("a reason");
        assert!(reason.contains("no single phase"), "{reason}");
    }
}

/// JSON of the file at `path`.
fn read(path: &Path) -> Value {
    let text = fs::read_to_string(path).expect("written");
    serde_json::from_str(&text).expect("JSON")
}

/// True if the part `part` of the results differs from its recomputed form.
fn is_other(found: &Value, part: &str) -> bool {
    let mut others = found["others"].as_array().expect("others").iter();
    others.any(|other| other["part"] == part && other["verdict"] == "differs")
}

/// Replaces each cell in the table of samples of the bundle `b` by the result of `change`, which receives the column name and the cell.
pub(super) fn edit_cells(bench: &Bench, change: impl Fn(&str, &str) -> String) {
    edit_table(bench, |text| {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let names = reader.headers().expect("a head").clone();
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&names).expect("room");
        for record in reader.records() {
            let record = record.expect("a row");
            let cells = names.iter().zip(&record);
            let cells = cells.map(|(name, cell)| change(name, cell));
            writer.write_record(cells).expect("room");
        }
        String::from_utf8(writer.into_inner().expect("room")).expect("a text")
    });
}

/// Changes the table of samples of the bundle `b`, and its digest in the results.
fn edit_table(bench: &Bench, change: impl FnOnce(String) -> String) {
    let table = bench.path("b/tables/samples-0.csv");
    let digest = || digest_of_bytes(&fs::read(&table).expect("written"));
    let old = digest();
    edit(&table, change);
    let new = digest();
    let results = bench.path("b/results.json");
    edit(&results, |text| text.replace(&old, &new));
    accept(&results);
    relist(bench, "b", of_another_version);
}

#[test]
fn an_edited_prediction_of_a_run_leaves_its_claims_below_the_level_that_they_state() {
    let bench = run();
    bench.ok("bundle run --draft --out b -q");
    edit_cells(&bench, |name, cell| match name {
        "Fz_predicted" if !cell.is_empty() => "0.015625".to_owned(),
        _ => cell.to_owned(),
    });
    let found = verified(&bench, "b", 1);
    let lost = of_verdict(&found, "not recomputable");
    assert!(!lost.is_empty(), "{}", found["summary"]);
    for claim in lost {
        let reason = claim["reason"].as_str().expect("a reason");
        assert!(reason.contains("states the level predictions"), "{reason}");
    }
    // A lower level in the manifest hides nothing.
    relist(&bench, "b", |manifest| {
        of_another_version(manifest);
        for claim in manifest["claims"].as_array_mut().expect("claims") {
            claim["level"] = "scores".into();
        }
    });
    let found = verified(&bench, "b", 1);
    assert!(is_other(&found, "state"), "{}", found["others"]);
}

#[test]
fn a_licence_is_an_spdx_identifier_and_a_mistyped_one_gets_the_nearest() {
    let bench = bench();
    for (licence, message) in [
        ("cc-by-4.0", "did you mean `CC-BY-4.0`?"),
        ("CC-BY-4.O", "did you mean `CC-BY-4.0`?"),
        ("public", "expected an SPDX identifier"),
    ] {
        let words = format!("{BUNDLE} b --author Ada --licence {licence}");
        bench.refused(&words, 2, message);
    }
}

#[test]
fn every_claim_is_equal_by_every_instruction_set_of_this_machine() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} b"));
    let sets = Isa::available();
    assert!(sets.contains(&Isa::Portable));
    for set in sets {
        let mut command = bench.command("bundle verify b --level predictions --format json -q");
        let output = command.env("TACEVA_ISA", set.name()).output();
        let output = output.expect("the program starts");
        assert_eq!(output.status.code(), Some(0), "{}", set.name());
        let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let claims = found["claims"].as_array().expect("claims").len();
        assert_eq!(found["summary"]["equal"], claims, "{}", set.name());
    }
}

#[test]
fn a_page_has_a_tick_for_every_level_that_a_claim_reached() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} b --name <b>"));
    bench.ok("bundle verify b --html v.html");
    let read = |name: &str| fs::read_to_string(bench.path(name)).expect("written");
    let page = read("v.html");
    for words in [
        "mae of Fz",
        "predictions",
        "✓",
        "&lt;b&gt;",
        "A seal is a digest",
    ] {
        assert!(page.contains(words), "{words}");
    }
    // The note alone has one.
    assert_eq!(page.matches('✗').count(), 1, "{page}");
    assert!(!page.contains("of <b>"), "{page}");
    relist(&bench, "b", |manifest| {
        manifest["claims"][0]["value"] = 123.5.into()
    });
    let ran = bench.run("bundle verify b --html w.html");
    assert_eq!(ran.code, 1, "{}", ran.err);
    let page = read("w.html");
    // The first ✗ of the page is that of the claim, and the last one explains it.
    assert_eq!(page.matches('✗').count(), 2, "{page}");
    assert!(page.contains("123.5"), "{page}");
    bench.refused("bundle verify b --html w.html", 3, "--force replaces it");
}

#[cfg(unix)]
#[test]
fn a_full_disk_ends_a_verification_and_is_no_damage() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} b.tar.gz"));
    let ran = bench.shell("trap '' XFSZ; ulimit -f 1; exec taceva bundle verify b.tar.gz -q");
    assert_eq!(ran.code, 3, "{}{}", ran.out, ran.err);
    let words = "b.tar.gz: cannot be unpacked into ";
    assert!(ran.err.contains(words), "{}", ran.err);
    assert!(ran.err.contains("TMPDIR"), "{}", ran.err);
    assert!(!ran.out.contains("damage"), "{}", ran.out);
}

#[test]
fn a_bundle_says_which_of_its_files_name_the_operator_and_how_to_leave_the_name_out() {
    let bench = Bench::new();
    bench.record_by("data", 32, "Lovelace");
    bench.ok("evaluate data --model ridge --metrics mae --format json --out r.json --state-out r.state --samples-out r.samples.csv -q");
    let words =
        "bundle r.json --state r.state --author Lovelace --licence CC-BY-4.0 --date 2026-11-28";
    let named = bench.run(&format!("{words} --dataset data --out b"));
    assert_eq!(named.code, 0, "{}", named.err);
    let said = "the bundle publishes the name of the operator, Lovelace, in ";
    let (_, after) = named.err.split_once(said).expect(&named.err);
    let (files, remedy) = after.split_once(", where a seal forbids").expect(after);
    for file in ["results.json", "dataset.toml"] {
        assert!(files.contains(file), "{files}");
    }
    assert!(!files.contains("CITATION.cff"), "an author: {files}");
    assert!(
        remedy.contains("without `name` under [operator]"),
        "{remedy}"
    );
    for file in files.split(", ") {
        let text = fs::read_to_string(bench.path(&format!("b/{file}"))).expect("a text");
        assert!(text.contains("Lovelace"), "{file}");
    }
    verified(&bench, "b", 0);
    let other = Bench::new();
    other.record("data", 32);
    other.ok("evaluate data --model ridge --metrics mae --format json --out r.json --state-out r.state --samples-out r.samples.csv -q");
    let unnamed = other.run(&format!("{words} --dataset data --out b"));
    assert_eq!(unnamed.code, 0, "{}", unnamed.err);
    assert!(!unnamed.err.contains("operator"), "{}", unnamed.err);
}

#[test]
fn texts_are_redacted_and_counted() {
    let bench = bench();
    bench.write(
        "rig.toml",
        "address = \"10.0.0.7\"\nmap = \"/home/user/map.toml\"\nserial = \"X81\"\n",
    );
    bench.ok(&format!("{BUNDLE} b --text rig.toml --redact hosts,paths"));
    let text = fs::read_to_string(bench.path("b/rig.toml")).expect("written");
    assert_eq!(
        text,
        "address = \"redacted\"\nmap = \"redacted\"\nserial = \"X81\"\n"
    );
    assert_eq!(manifest(&bench, "b")["redacted"]["rig.toml"], 2);
    verified(&bench, "b", 0);
    // What was scored is not redacted, and the command says so.
    let text = fs::read_to_string(bench.path("truth.csv")).expect("written");
    bench.write("truth.csv", &text.replace("\n7,p7,", "\n7,/home/user/p7,"));
    score(&bench, "pred.csv", "marked");
    let ran = bench.run(
        "bundle marked.json --state marked.state --truth truth.csv --pred pred.csv --draft --redact paths --out c",
    );
    assert_eq!(ran.code, 0, "{}", ran.err);
    let words = "--redact does not change tables/truth.csv, which is sealed or was scored: it contains 1 word";
    assert!(ran.err.contains(words), "{}", ran.err);
    bench.write("notes.toml", "");
    bench.refused(
        &format!("{BUNDLE} d --text notes.toml"),
        3,
        "expected a file with one of the names scene.toml",
    );
}
