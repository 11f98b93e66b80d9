//! Bundles that omit data, or state data that their files do not have.

use std::fs;

use serde_json::Value;

use super::forgery::{accept, edit, manifest, of_another_version, relist};
use super::{BUNDLE, bench, of_verdict, verified};
use crate::support::Bench;

/// Test folder with a complete bundle in the folder `b`.
fn made() -> Bench {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} b"));
    bench
}

/// Changes the results of the bundle `b`, and seals them again.
fn change_results(bench: &Bench, change: impl FnOnce(&mut Value)) {
    let path = bench.path("b/results.json");
    let text = fs::read_to_string(&path).expect("written");
    let mut results: Value = serde_json::from_str(&text).expect("JSON");
    change(&mut results);
    let text = serde_json::to_string_pretty(&results).expect("JSON");
    fs::write(&path, text).expect("room");
    accept(&path);
}

/// Removes the state of the bundle `b` and every mention of it. The claims keep their level.
fn drop_state(bench: &Bench) {
    relist(bench, "b", |manifest| {
        of_another_version(manifest);
        let files = manifest["files"].as_array_mut().expect("files");
        files.retain(|file| file["role"] != "state");
        manifest["studies"][0]
            .as_object_mut()
            .expect("a study")
            .remove("states");
        for claim in manifest["claims"].as_array_mut().expect("claims") {
            let from = claim["from"].as_array_mut().expect("files");
            from.retain(|name| name != "states/0.json");
        }
    });
    fs::remove_dir_all(bench.path("b/states")).expect("there");
}

#[test]
fn results_and_states_of_another_major_version_are_refused_with_both() {
    for (name, space, own, other) in [
        (
            "results.json",
            " ",
            "taceva.evaluation/1.0",
            "taceva.evaluation/2.0",
        ),
        ("states/0.json", "", "taceva.state/1.0", "taceva.state/2.0"),
    ] {
        let bench = made();
        let path = bench.path("b").join(name);
        let [old, new] = [own, other].map(|schema| format!("\"schema\":{space}\"{schema}"));
        edit(&path, |text| text.replacen(&old, &new, 1));
        accept(&path);
        relist(&bench, "b", of_another_version);
        let found = verified(&bench, "b", 3);
        let first = &found["damage"][0];
        assert_eq!(first["path"], name, "{first}");
        let problem = first["problem"].as_str().expect("words");
        assert!(
            problem.contains(own) && problem.contains(other),
            "{problem}"
        );
    }
}

#[test]
fn tables_that_are_withheld_leave_the_claims_at_the_scores() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} b --without predictions"));
    let withheld = manifest(&bench, "b")["withheld"].clone();
    assert_eq!(withheld.as_array().map(Vec::len), Some(2), "{withheld}");
    assert!(!bench.path("b/tables").exists());
    let found = verified(&bench, "b", 0);
    let claims = found["claims"].as_array().expect("claims");
    assert!(claims.iter().all(|claim| claim["level"] == "scores"));
    let levels = found["levels"].to_string();
    assert!(
        levels.contains("the maker of the bundle withheld the tables")
            && !levels.contains("--pred"),
        "{levels}"
    );
    verified(&bench, "b --level scores", 0);
    verified(&bench, "b --level predictions", 1);
}

#[test]
fn claims_that_are_left_out_repeated_or_of_other_files_are_damage() {
    let bench = made();
    let whole = manifest(&bench, "b");
    type Forgery = fn(&mut Value);
    let cases: [(&str, Forgery); 4] = [
        ("is not claimed", |manifest| {
            manifest["claims"].as_array_mut().expect("claims").pop();
        }),
        ("is claimed twice", |manifest| {
            let claims = manifest["claims"].as_array_mut().expect("claims");
            claims.push(claims[0].clone());
        }),
        ("not name the files of its study in `from`", |manifest| {
            manifest["claims"][0]["from"] = Value::Array(Vec::new());
        }),
        ("it is named twice in `studies`", |manifest| {
            manifest["studies"][0]["states"] =
                serde_json::json!(["states/0.json", "states/0.json"]);
        }),
    ];
    for (words, change) in cases {
        relist(&bench, "b", |manifest| {
            manifest.clone_from(&whole);
            change(manifest);
        });
        let found = verified(&bench, "b", 3);
        let problem = found["damage"][0]["problem"].as_str().expect("words");
        assert!(problem.contains(words), "{problem}");
    }
}

#[test]
fn a_byte_inside_the_seal_of_the_manifest_is_damage_too() {
    let bench = made();
    let path = bench.path("b/bundle.json");
    edit(&path, |text| {
        text.replacen("\"keys\": \"", "\"keys\": \"x", 1)
    });
    let found = verified(&bench, "b", 3);
    let problem = found["damage"][0]["problem"].as_str().expect("words");
    assert!(problem.contains("not exactly the seal"), "{problem}");
}

#[test]
fn control_characters_of_a_bundle_reach_no_terminal() {
    let bench = made();
    edit(&bench.path("b/environment.json"), |text| {
        text.replacen("taceva.environment/1", "x\\u001b[2J", 1)
    });
    relist(&bench, "b", |_| {});
    let ran = bench.run("bundle verify b");
    assert_eq!(ran.code, 3, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("schema `x\\u{1b}[2J`"), "{}", ran.out);
}

#[test]
fn a_claim_that_states_a_level_without_its_files_is_not_verified() {
    let bench = made();
    drop_state(&bench);
    let found = verified(&bench, "b", 1);
    let claims = found["claims"].as_array().expect("claims").len();
    let stopped = of_verdict(&found, "not recomputable");
    assert_eq!(stopped.len(), claims);
    let reason = stopped[0]["reason"].as_str().expect("words");
    assert!(
        reason.contains("states the level predictions, but the check reached only form"),
        "{reason}"
    );
    // An honest one is verified as deep as it goes, and no deeper.
    relist(&bench, "b", |manifest| {
        for claim in manifest["claims"].as_array_mut().expect("claims") {
            claim["level"] = "form".into();
        }
    });
    let found = verified(&bench, "b", 0);
    assert!(
        found["remarks"].to_string().contains("were not compared"),
        "{}",
        found["remarks"]
    );
    verified(&bench, "b --level scores", 1);
}

#[test]
fn a_level_that_no_claim_can_reach_is_no_success_without_claims() {
    let bench = made();
    drop_state(&bench);
    change_results(&bench, |results| {
        results["metrics"] = Value::Object(serde_json::Map::new())
    });
    relist(&bench, "b", |manifest| {
        manifest["claims"] = Value::Array(Vec::new());
    });
    verified(&bench, "b --level scores", 1);
}

#[test]
fn a_score_that_the_results_lack_is_found_in_the_state() {
    let bench = made();
    let metric = manifest(&bench, "b")["claims"][0]["metric"].clone();
    let name = metric.as_str().expect("a name");
    change_results(&bench, |results| {
        let metrics = results["metrics"].as_object_mut().expect("metrics");
        metrics.remove(name).expect("there");
    });
    relist(&bench, "b", |manifest| {
        of_another_version(manifest);
        let claims = manifest["claims"].as_array_mut().expect("claims");
        claims.retain(|claim| claim["metric"] != metric);
    });
    let found = verified(&bench, "b", 1);
    let reason = found["others"][0]["reason"].as_str().expect("words");
    assert!(reason.contains("results.json lacks it"), "{reason}");
}

#[test]
fn a_number_of_samples_that_is_edited_everywhere_differs_from_the_state() {
    let bench = made();
    let first = manifest(&bench, "b")["claims"][0].clone();
    let [metric, channel] = ["metric", "channel"].map(|key| first[key].as_str().expect("a name"));
    change_results(&bench, |results| {
        results["metrics"][metric][channel]["n"] = 4000.into()
    });
    relist(&bench, "b", |manifest| {
        of_another_version(manifest);
        for claim in manifest["claims"].as_array_mut().expect("claims") {
            if claim["metric"] == first["metric"] && claim["channel"] == first["channel"] {
                claim["n"] = 4000.into();
            }
        }
    });
    let found = verified(&bench, "b --tolerance 1e9", 1);
    let differing = of_verdict(&found, "differs");
    let reason = differing[0]["reason"].as_str().expect("words");
    assert!(reason.contains("expected 4000"), "{reason}");
}

#[test]
fn inputs_and_settings_that_the_results_rename_differ_from_the_state() {
    let bench = made();
    change_results(&bench, |results| {
        results["provenance"]["tables"]["truth"] = format!("sha256:{}", "0".repeat(64)).into();
        results["subject"]["sensor"] = "Another".into();
        results["provenance"]["devices"] = serde_json::json!({"force_rate_hz": "500"});
    });
    relist(&bench, "b", of_another_version);
    let found = verified(&bench, "b", 1);
    let others = found["others"].as_array().expect("others");
    let parts: Vec<&str> = others
        .iter()
        .filter_map(|other| other["part"].as_str())
        .collect();
    // Edited JSON has another order of variants, which differs too.
    assert_eq!(
        parts.get(..3),
        Some(["subject", "tables", "devices"].as_slice())
    );
    let remarks = found["remarks"].to_string();
    assert!(remarks.contains("Edited: results, "), "{remarks}");
}

#[cfg(unix)]
#[test]
fn a_pipe_is_no_bundle_and_is_not_waited_for() {
    let bench = Bench::new();
    assert_eq!(bench.shell("mkfifo pipe.tar.gz").code, 0);
    let found = verified(&bench, "pipe.tar.gz", 3);
    let problem = found["damage"][0]["problem"].as_str().expect("words");
    assert!(problem.contains("not a regular file"), "{problem}");
}
