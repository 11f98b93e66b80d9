//! Bundles of results: made, verified, forged, compared.

pub(crate) mod forgery;
mod hidden;
mod inputs;
mod model;

use std::fs;

use serde_json::Value;

use crate::support::Bench;
use forgery::{accept, edit, manifest, of_another_version, relist};

/// Arguments that bundle a result, except the path of the bundle.
const BUNDLE: &str = "bundle result.json --state result.state --truth truth.csv --pred pred.csv --draft --date 2026-11-28 --out";

/// Writes a table of truth and a table of predictions for presses on a grid. Each error of a prediction is proportional to `error`.
fn tables(bench: &Bench, prediction: &str, error: f64) {
    let mut truth = "id,point_id,Px,Py,Pz,Fz\n".to_owned();
    let mut predicted = "id,Px,Py,Pz,Fz\n".to_owned();
    for row in 0..120_u32 {
        let (x, y) = (f64::from(row % 6) - 2.5, f64::from(row / 6 % 5) - 2.0);
        let depth = 0.2 + 0.1 * f64::from(row % 4);
        let force = depth * (1.0 + 0.02 * x);
        truth += &format!("{row},p{},{x},{y},{depth},{force}\n", row % 30);
        let off = error * (f64::from(row * 7919 % 13) - 6.0);
        predicted += &format!(
            "{row},{},{},{},{}\n",
            x + off,
            y - off,
            depth + off / 9.0,
            force - off / 7.0
        );
    }
    bench.write("truth.csv", &truth);
    bench.write(prediction, &predicted);
}

/// Test folder with the result of `score` on two tables, and the state of that result.
fn bench() -> Bench {
    let bench = Bench::new();
    tables(&bench, "pred.csv", 0.01);
    score(&bench, "pred.csv", "result");
    bench
}

fn score(bench: &Bench, prediction: &str, name: &str) {
    bench.ok(&format!(
        "score --truth truth.csv --pred {prediction} --format json --out {name}.json --state-out {name}.state -q"
    ));
}

/// Verifies the bundle with the arguments `words`, and expects the exit code `code`. Returns the JSON.
fn verified(bench: &Bench, words: &str, code: i32) -> Value {
    let ran = bench.run(&format!("bundle verify {words} --format json -q"));
    assert_eq!(ran.code, code, "{words}\n{}{}", ran.out, ran.err);
    let found = serde_json::from_str(&ran.out).expect("JSON");
    crate::schema::check("bundle-verification", &found);
    found
}

/// Claims of a verification with this verdict.
fn of_verdict<'a>(found: &'a Value, verdict: &str) -> Vec<&'a Value> {
    let claims = found["claims"].as_array().expect("claims");
    claims
        .iter()
        .filter(|claim| claim["verdict"] == verdict)
        .collect()
}

#[test]
fn every_claim_of_scored_tables_is_computed_again_from_folder_and_file() {
    let bench = bench();
    for place in ["b", "b.tar.gz"] {
        let said = bench.ok(&format!("{BUNDLE} {place}"));
        assert!(said.contains("level    predictions: "), "{said}");
        if place == "b" {
            crate::schema::check("bundle", &manifest(&bench, place));
        }
        let found = verified(&bench, place, 0);
        assert_eq!(found["schema"], "taceva.verification/1");
        let claims = found["claims"].as_array().expect("claims");
        assert!(claims.len() > 20, "{} claims", claims.len());
        assert_eq!(of_verdict(&found, "equal").len(), claims.len());
        assert!(claims.iter().all(|claim| claim["level"] == "predictions"));
        assert!(
            claims
                .iter()
                .all(|claim| claim["printed"] == claim["recomputed"])
        );
        assert_eq!(
            found["others"].as_array().map(Vec::len),
            Some(0),
            "{}",
            found["others"]
        );
        for level in found["levels"].as_array().expect("levels") {
            assert_eq!(level["reached"], true, "{level}");
        }
    }
    let text = bench.ok("bundle verify b");
    assert!(text.contains("origin of the samples: unknown"), "{text}");
    assert!(
        text.contains("A seal is a digest, not a signature"),
        "{text}"
    );
}

#[test]
fn the_same_inputs_give_the_same_bytes_and_an_existing_bundle_stays() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} one.tar.gz"));
    bench.ok(&format!("{BUNDLE} two.tar.gz"));
    let read = |name: &str| fs::read(bench.path(name)).expect("written");
    assert_eq!(read("one.tar.gz"), read("two.tar.gz"));
    let before = read("one.tar.gz");
    bench.refused(&format!("{BUNDLE} one.tar.gz"), 3, "--force replaces it");
    assert_eq!(read("one.tar.gz"), before);
    bench.write("mine/notes", "mine");
    bench.refused(
        &format!("{BUNDLE} mine --force"),
        3,
        "not a bundle, but only a bundle is replaced",
    );
    bench.write("mine/bundle.json", "{}");
    let words = format!("{BUNDLE} mine --force");
    bench.refused(&words, 3, "`notes`, which no bundle contains");
    assert_eq!(read("mine/notes"), b"mine");
}

#[test]
fn a_bundle_without_author_or_licence_is_refused_unless_it_is_a_draft() {
    let bench = bench();
    let words = "bundle result.json --state result.state --out b";
    bench.refused(words, 2, "or make a draft with --draft");
    bench.refused(&format!("{words} --author Ada"), 2, "--licence SPDX");
    bench.refused(
        &format!("{words} --organization Lab"),
        2,
        "expected NAME <URL>",
    );
    let words = format!("{words} --author Ada --licence CC-BY-4.0 -q");
    bench.ok(&format!("{words} --organization Lab<https://lab.example>"));
    let manifest = manifest(&bench, "b");
    crate::schema::check("bundle", &manifest);
    assert!(manifest["draft"].is_null());
    assert_eq!(manifest["organization"]["url"], "https://lab.example");
    let text = fs::read_to_string(bench.path("b/CITATION.cff")).expect("written");
    assert!(
        text.contains("name: \"Ada\"") && text.contains("license: \"CC-BY-4.0\""),
        "{text}"
    );
}

#[test]
fn a_changed_a_missing_an_added_and_a_linked_file_are_damage() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} whole"));
    for (name, damage, words) in [
        ("changed", "tables/prediction.csv", "expected sha256:"),
        ("lost", "states/0.json", "it is missing"),
        ("added", "states/more.json", "does not list this file"),
        (
            "sealless",
            "bundle.json",
            "was changed after it was sealed; restore it, or make the bundle again with `taceva bundle`",
        ),
    ] {
        bench.shell(&format!("cp -r whole {name}"));
        let path = bench.path(name).join(damage);
        match name {
            "lost" => fs::remove_file(&path).expect("there"),
            "added" => fs::write(&path, "{}").expect("room"),
            "sealless" => edit(&path, |text| text.replacen("2026-11-28", "2026-11-29", 1)),
            _ => edit(&path, |text| text.replacen('1', "2", 1)),
        }
        let found = verified(&bench, name, 3);
        let first = &found["damage"][0];
        assert_eq!(first["path"], damage, "{first}");
        let problem = first["problem"].as_str().expect("words");
        assert!(problem.contains(words), "{name}: {problem}");
        assert!(!problem.contains("taceva reseal"), "{name}: {problem}");
    }
    let ran = bench.run("bundle verify lost");
    let words = "states/0.json: it is missing (broken rule: every listed file is there)";
    assert!(ran.out.contains(words), "{}", ran.out);
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("/etc/passwd", bench.path("whole/link")).expect("room");
        let found = verified(&bench, "whole", 3);
        assert_eq!(
            found["damage"][0]["problem"],
            "a link, expected a regular file"
        );
    }
    bench.shell("rm whole/link");
    let found = verified(&bench, "whole --most 1000", 3);
    let problem = found["damage"][0]["problem"].as_str().expect("words");
    assert!(problem.contains("more than 1000 bytes"), "{problem}");
    bench.write("text.tar.gz", "no archive");
    let found = verified(&bench, "text.tar.gz", 3);
    let problem = found["damage"][0]["problem"].as_str().expect("words");
    assert!(
        problem.contains("not a bundle: expected a folder or a .tar.gz"),
        "{problem}"
    );
    assert_eq!(found["damage"][0]["path"], "text.tar.gz");
    let ran = bench.run("bundle verify result.json");
    assert_eq!(ran.code, 3, "{}", ran.out);
    assert!(ran.out.contains("json: not a bundle: "), "{}", ran.out);
    bench.refused("bundle verify nowhere", 3, "nowhere");
}

#[test]
fn a_claim_that_is_edited_in_the_manifest_differs_at_the_scores_with_both_numbers() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} b"));
    let value = manifest(&bench, "b")["claims"][0]["value"]
        .as_f64()
        .expect("a number");
    relist(&bench, "b", |manifest| {
        manifest["claims"][0]["value"] = (value + 1.0).into()
    });
    let found = verified(&bench, "b", 1);
    let differing = of_verdict(&found, "differs");
    let [claim] = differing[..] else {
        panic!("one claim differs: {}", found["summary"]);
    };
    assert_eq!(claim["level"], "scores");
    assert_eq!(claim["printed"], value + 1.0);
    assert_eq!(claim["recomputed"], value);
    let found = verified(&bench, "b --tolerance 2", 1);
    assert_eq!(
        of_verdict(&found, "differs").len(),
        1,
        "a claim that the results lack"
    );
}

#[test]
fn results_and_state_that_are_changed_alike_differ_from_the_predictions() {
    let bench = bench();
    tables(&bench, "better.csv", 0.005);
    score(&bench, "better.csv", "better");
    bench.ok(
        "bundle better.json --state better.state --truth truth.csv --pred better.csv --draft --date 2026-11-28 -q --out b",
    );
    // Scores of better predictions, beside the tables of the true ones.
    let digest = |name: &str| {
        let text = fs::read_to_string(bench.path(name)).expect("written");
        let result: Value = serde_json::from_str(&text).expect("JSON");
        let digest = result["provenance"]["tables"]["prediction"].as_str();
        digest.expect("a digest").to_owned()
    };
    let (own, other) = (digest("result.json"), digest("better.json"));
    for name in ["results.json", "states/0.json"] {
        let path = bench.path("b").join(name);
        edit(&path, |text| text.replace(&other, &own));
        accept(&path);
    }
    fs::copy(
        bench.path("pred.csv"),
        bench.path("b/tables/prediction.csv"),
    )
    .expect("room");
    relist(&bench, "b", of_another_version);
    let found = verified(&bench, "b", 1);
    let differing = of_verdict(&found, "differs");
    assert!(!differing.is_empty(), "{}", found["summary"]);
    for claim in &differing {
        let reason = claim["reason"].as_str().unwrap_or_default();
        let is_lost = reason.ends_with("is undefined in the tables");
        assert!(is_lost || claim["level"] == "predictions", "{claim}");
    }
    // Without the tables nothing shows it.
    let found = verified(&bench, "b --level scores", 0);
    assert_eq!(found["summary"]["differs"], 0);
}

#[test]
fn a_state_of_another_setting_makes_claims_not_recomputable() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} b"));
    let path = bench.path("b/states/0.json");
    edit(&path, |text| {
        text.replacen("\"gate_n\":0.02", "\"gate_n\":0.05", 1)
    });
    accept(&path);
    relist(&bench, "b", of_another_version);
    let found = verified(&bench, "b", 1);
    assert!(
        !of_verdict(&found, "not recomputable").is_empty(),
        "{}",
        found["summary"]
    );
}

#[test]
fn a_state_of_other_tables_is_refused_when_a_bundle_is_made() {
    let bench = bench();
    tables(&bench, "better.csv", 0.005);
    score(&bench, "better.csv", "better");
    let words = "bundle result.json --state better.state --draft --out b";
    bench.refused(words, 3, "name the state and the tables of this result");
    assert!(!bench.path("b").exists());
    let words = "bundle result.json --state result.state --draft --out b";
    let swapped = format!("{words} --truth pred.csv --pred truth.csv");
    bench.refused(&swapped, 3, "--truth and --pred are swapped");
    let ran = bench.run(&format!("{words} --truth truth.csv --pred better.csv"));
    assert_eq!(ran.code, 3, "{}", ran.err);
    let named = "result.state: the state was summed from other tables";
    assert!(ran.err.contains(named), "{}", ran.err);
    assert!(!ran.err.contains(".taceva-"), "{}", ran.err);
    let words = "bundle result.json --draft --out b";
    bench.refused(words, 3, "no state and no table to compute");
}

#[test]
fn simulated_results_say_everywhere_that_nothing_was_measured() {
    let bench = bench();
    for (name, space) in [("result.json", " "), ("result.state", "")] {
        let path = bench.path(name);
        let [old, new] = ["unknown", "simulated"].map(|own| format!("\"source\":{space}\"{own}\""));
        edit(&path, |text| text.replacen(&old, &new, 1));
        accept(&path);
    }
    bench.ok(&format!("{BUNDLE} b"));
    let badge = "Nothing here was measured: the samples are simulated.";
    assert_eq!(manifest(&bench, "b")["badge"], badge);
    let card = fs::read_to_string(bench.path("b/README.md")).expect("written");
    assert!(card.contains(badge), "{card}");
    assert!(bench.ok("bundle verify b").contains(badge));
    relist(&bench, "b", |manifest| {
        manifest["source"] = "recorded".into();
        manifest["studies"][0]["source"] = "recorded".into();
        manifest["badge"] = Value::Null;
    });
    let found = verified(&bench, "b", 3);
    assert_eq!(found["damage"][0]["path"], "bundle.json");
    // Results that hide it too are not those of the state.
    let results = bench.path("b/results.json");
    edit(&results, |text| {
        text.replacen("\"source\": \"simulated\"", "\"source\": \"recorded\"", 1)
    });
    accept(&results);
    relist(&bench, "b", of_another_version);
    let found = verified(&bench, "b", 1);
    assert_eq!(found["others"][0]["part"], "subject", "{}", found["others"]);
}

#[test]
fn another_schema_and_deep_nesting_are_refused_with_their_reason() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} b"));
    relist(&bench, "b", |manifest| {
        manifest["schema"] = "taceva.bundle/2".into()
    });
    let found = verified(&bench, "b", 3);
    let problem = found["damage"][0]["problem"].as_str().expect("words");
    assert!(
        problem.contains("`taceva.bundle/2`") && problem.contains("`taceva.bundle/1`"),
        "{problem}"
    );
    for name in ["bundle.json", "states/0.json"] {
        bench.ok(&format!("{BUNDLE} b --force"));
        bench.write(&format!("b/{name}"), &"[".repeat(100_000));
        if name != "bundle.json" {
            relist(&bench, "b", of_another_version);
        }
        let found = verified(&bench, "b", 3);
        assert_eq!(found["damage"][0]["path"], name);
    }
}

#[test]
fn two_bundles_are_compared_by_claims_and_samples() {
    let bench = bench();
    bench.ok(&format!("{BUNDLE} one"));
    tables(&bench, "better.csv", 0.005);
    score(&bench, "better.csv", "better");
    bench.ok("bundle better.json --state better.state --truth truth.csv --pred better.csv --draft --date 2026-11-28 -q --out two");
    let found = bench.json("bundle diff one two");
    crate::schema::check("bundle-comparison", &found);
    assert_eq!(found["has_same_samples"], true);
    assert!(
        found["claims"]
            .as_array()
            .is_some_and(|claims| !claims.is_empty())
    );
    assert_eq!(found["definitions"].as_array().map(Vec::len), Some(0));
    let same = bench.json("bundle diff one one");
    assert_eq!(same["claims"].as_array().map(Vec::len), Some(0));
    let said = bench.ok("bundle diff one two");
    assert!(
        said.contains("samples  the same") && said.contains("neither bundle was verified"),
        "{said}"
    );
}
