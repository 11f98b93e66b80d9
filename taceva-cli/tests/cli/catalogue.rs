//! Catalogues of bundles in a folder: adding, checking, comparing, choosing and showing.

mod export;
mod findings;
mod pages;

use std::fs;

use serde_json::Value;
use taceva_files::seal::{digest_of_bytes, json};

use crate::bundle::forgery::{accept, edit};
use crate::support::Bench;

/// Table of the truth, with ten presses at each of twelve points.
fn truth() -> String {
    let mut truth = "id,point_id,Px,Py,Pz,Fz\n".to_owned();
    for row in 0..120_u32 {
        let [x, y, depth, force] = press(row);
        truth += &format!("{row},p{},{x},{y},{depth},{force}\n", row % 12);
    }
    truth
}

fn press(row: u32) -> [f64; 4] {
    let (x, y) = (f64::from(row % 4) - 1.5, f64::from(row / 4 % 3) - 1.0);
    let depth = 0.2 + 0.1 * f64::from(row / 12 % 5);
    [x, y, depth, depth * (1.0 + 0.02 * x)]
}

/// Table of predictions. Each error is proportional to `error`.
fn predictions(error: f64) -> String {
    let mut predicted = "id,Px,Py,Pz,Fz\n".to_owned();
    for row in 0..120_u32 {
        let [x, y, depth, force] = press(row);
        let off = error * (f64::from(row * 7919 % 13) - 6.0);
        predicted += &format!(
            "{row},{},{},{},{}\n",
            x + off,
            y - off,
            depth + off / 9.0,
            force - off / 7.0
        );
    }
    predicted
}

/// Scores predictions of the sensor `model`; writes `NAME.json` and `NAME.state`.
fn score(bench: &Bench, name: &str, model: &str, error: f64) {
    bench.write("truth.csv", &truth());
    bench.write(&format!("{name}.csv"), &predictions(error));
    bench.write("sensor.toml", &format!("model = {}\n", Value::from(model)));
    bench.ok(&format!(
        "score --truth truth.csv --pred {name}.csv --sensor sensor.toml --metrics accuracy --format json --out {name}.json --state-out {name}.state -q"
    ));
}

/// States the origin of the samples of `NAME.json`.
fn set_source(bench: &Bench, name: &str, source: &str) {
    for (file, space) in [("json", " "), ("state", "")] {
        let path = bench.path(&format!("{name}.{file}"));
        let [old, new] = ["unknown", source].map(|own| format!("\"source\":{space}\"{own}\""));
        edit(&path, |text| text.replacen(&old, &new, 1));
        accept(&path);
    }
}

/// Arguments that bundle `NAME.json` in the folder `NAME`.
fn packed(name: &str, more: &str) -> String {
    format!(
        "bundle {name}.json --state {name}.state --truth truth.csv --pred {name}.csv --date 2026-11-28 --out {name} -q {more}"
    )
}

/// Makes a bundle in the folder `name`, of recorded samples of the sensor `model`.
fn bundle(bench: &Bench, name: &str, model: &str, error: f64) {
    score(bench, name, model, error);
    set_source(bench, name, "recorded");
    bench.ok(&packed(name, "--author Ada --licence CC-BY-4.0"));
}

/// Text of a file in the catalogue `c`.
fn text(bench: &Bench, path: &str) -> String {
    fs::read_to_string(bench.path("c").join(path)).expect("written")
}

/// Names of the files in a folder of the catalogue `c`.
fn names(bench: &Bench, folder: &str) -> Vec<String> {
    let entries = fs::read_dir(bench.path("c").join(folder)).expect("a folder");
    let names = entries.map(|entry| entry.expect("readable").file_name());
    let mut names: Vec<String> = names
        .map(|name| name.to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// Changes the manifest of the first bundle in the entry `entry`. The new manifest has a valid seal and is stored under its own digest.
fn forge(bench: &Bench, entry: &str, change: impl FnOnce(&mut Value)) {
    let rows = text(bench, &format!("entries/{entry}.toml"));
    let (_, rest) = rows.split_once("bundle = \"sha256:").expect("a bundle");
    let (old, _) = rest.split_once('"').expect("a digest");
    let mut manifest: Value =
        serde_json::from_str(&text(bench, &format!("bundles/{old}.json"))).expect("JSON");
    change(&mut manifest);
    manifest.as_object_mut().expect("an object").remove("seal");
    let sealed = json::seal(&manifest.to_string()).expect("an object");
    let digest = digest_of_bytes(sealed.as_bytes());
    let digits = digest.strip_prefix("sha256:").expect("a digest");
    fs::remove_file(bench.path("c/bundles").join(format!("{old}.json"))).expect("there");
    bench.write(&format!("c/bundles/{digits}.json"), &sealed);
    edit(
        &bench.path("c/entries").join(format!("{entry}.toml")),
        |text| text.replace(old, digits),
    );
}

#[test]
fn a_bundle_is_verified_and_each_of_its_numbers_states_how_deep() {
    let bench = Bench::new();
    bundle(&bench, "deep", "Foo", 0.01);
    bundle(&bench, "flat", "Foo", 0.02);
    bench.ok(&packed(
        "flat",
        "--author Ada --licence CC-BY-4.0 --without predictions --force",
    ));
    let said = bench.ok("catalogue add deep --to c --url https://example.org/deep");
    assert!(said.contains("level predictions or deeper"), "{said}");
    let said = bench.ok("catalogue add flat --to c");
    assert!(said.contains("level scores or deeper"), "{said}");
    let entry = text(&bench, "entries/foo.toml");
    for words in [
        "catalogue_version = 2",
        "name = \"Foo\"",
        "verified = \"predictions\"",
        "verified = \"scores\"",
        "url = \"https://example.org/deep\"",
        "source = \"recorded\"",
        "date = 2026-11-28",
        "by = [\"Ada\"]",
        "definition = \"mae/1\"",
    ] {
        assert!(entry.contains(words), "{words} in {entry}");
    }
    assert!(!entry.contains("[[simulated]]"), "{entry}");
    let rows = entry.matches("[[measured]]").count();
    let claims = |name: &str| {
        let manifest = crate::bundle::forgery::manifest(&bench, name);
        manifest["claims"].as_array().map_or(0, Vec::len)
    };
    assert_eq!(rows, claims("deep") + claims("flat"));
    assert_eq!(names(&bench, "bundles").len(), 2);
    assert_eq!(names(&bench, ""), ["bundles", "entries"]);
}

#[test]
fn simulated_and_synthetic_numbers_never_stand_among_measured_ones() {
    let bench = Bench::new();
    for (name, source, error) in [("one", "simulated", 0.01), ("two", "synthetic", 0.02)] {
        score(&bench, name, "Foo", error);
        set_source(&bench, name, source);
        bench.ok(&packed(name, "--author Ada --licence CC-BY-4.0"));
        let said = bench.ok(&format!("catalogue add {name} --to c"));
        assert!(
            said.contains(" 0 measured") && said.contains("Nothing here was measured"),
            "{said}"
        );
    }
    let entry = text(&bench, "entries/foo.toml");
    assert!(
        entry.contains("[[simulated]]") && !entry.contains("[[measured]]"),
        "{entry}"
    );
    bench.ok("catalogue check c");
    let path = bench.path("c/entries/foo.toml");
    edit(&path, |text| text.replace("[[simulated]]", "[[measured]]"));
    let checked = || bench.run("catalogue check c --format csv");
    let ran = checked();
    assert_eq!(ran.code, 1, "{}", ran.out);
    assert!(ran.out.contains("other origins belong in"), "{}", ran.out);
    edit(&path, |text| {
        let text = text.replace("source = \"simulated\"", "source = \"recorded\"");
        text.replace("source = \"synthetic\"", "source = \"recorded\"")
    });
    let ran = checked();
    assert_eq!(ran.code, 1, "{}", ran.out);
    assert!(ran.out.contains("expected simulated"), "{}", ran.out);
}

#[test]
fn numbers_whose_origin_nobody_states_do_not_pass_as_measured() {
    let bench = Bench::new();
    score(&bench, "one", "Foo", 0.01);
    bench.ok(&packed("one", "--author Ada --licence CC-BY-4.0"));
    let said = bench.ok("catalogue add one --to c");
    assert!(said.contains(" 0 measured, "), "{said}");
    let entry = text(&bench, "entries/foo.toml");
    assert!(
        entry.contains("[[unknown]]") && !entry.contains("[[measured]]"),
        "{entry}"
    );
    bench.ok("catalogue check c");
    let chosen = bench.ok("choose --catalogue c --need force --format json");
    assert!(!chosen.contains("Foo"), "{chosen}");
    bench.ok("catalogue site c --out pages -q");
    let page = fs::read_to_string(bench.path("pages/foo.html")).expect("written");
    assert!(page.contains("id=\"unknown\"") && !page.contains("id=\"measured\""));
}

#[test]
fn the_same_bundle_and_the_same_results_are_added_once() {
    let bench = Bench::new();
    bundle(&bench, "one", "Foo", 0.01);
    bench.ok("catalogue add one --to c");
    let before = text(&bench, "entries/foo.toml");
    bench.refused("catalogue add one --to c", 3, "already in the catalogue");
    bench.ok(&packed("one", "--author Grace --licence CC-BY-4.0 --force"));
    let message = "its results are already in the catalogue";
    bench.refused("catalogue add one --to c", 3, message);
    assert_eq!(text(&bench, "entries/foo.toml"), before);
    assert_eq!(names(&bench, "bundles").len(), 1);
}

#[test]
fn a_draft_a_damaged_bundle_and_an_edited_claim_are_refused() {
    let bench = Bench::new();
    score(&bench, "one", "Foo", 0.01);
    bench.ok(&packed("one", "--draft"));
    bench.refused("catalogue add one --to c", 3, "a draft, expected");
    bench.ok(&packed("one", "--author Ada --licence CC-BY-4.0 --force"));
    crate::bundle::forgery::relist(&bench, "one", |manifest| {
        manifest["claims"][0]["value"] = 123.5.into();
    });
    bench.refused("catalogue add one --to c", 1, "not verified");
    bench.ok(&packed("one", "--author Ada --licence CC-BY-4.0 --force"));
    edit(&bench.path("one/results.json"), |text| text + " ");
    bench.refused("catalogue add one --to c", 3, "damaged: results.json");
    assert!(!bench.path("c").exists(), "nothing was written");
    // Tables alone name no sensor.
    bench.ok("score --truth truth.csv --pred one.csv --format json --out none.json --state-out none.state -q");
    bench.shell("cp one.csv none.csv");
    bench.ok(&packed("none", "--author Ada --licence CC-BY-4.0"));
    bench.refused("catalogue add none --to c", 3, "names no sensor");
}

#[test]
fn published_numbers_of_a_built_in_sensor_stay_beside_measured_ones() {
    let bench = Bench::new();
    bundle(&bench, "one", "GelSight Mini", 0.01);
    bench.ok("catalogue add one --to c");
    let entry = text(&bench, "entries/gelsight.toml");
    assert!(entry.contains("name = \"GelSight\""), "{entry}");
    bench.ok("catalogue site c --out pages -q");
    let page = fs::read_to_string(bench.path("pages/gelsight.html")).expect("written");
    assert!(
        page.contains("0.0325") && page.contains("id=\"measured\""),
        "both are shown"
    );
    let compared = bench.json("compare GelSight --catalogue c --metrics mae");
    let answers = compared["answers"].as_array().expect("answers");
    assert!(!answers.is_empty());
    for answer in answers {
        let words = answer["answer"].as_str().expect("words");
        assert!(words.contains("different samples"), "{words}");
    }
    edit(&bench.path("c/entries/gelsight.toml"), |text| {
        let size = "[size]\nmm = [1.0]\nsource = \"x\"\nread_from = \"text\"\nconditions = \"x\"\n";
        format!("{text}\n{size}")
    });
    let ran = bench.run("catalogue check c");
    assert_eq!(ran.code, 1, "{}", ran.out);
    assert!(ran.out.contains("built-in catalogue"), "{}", ran.out);
}

#[test]
fn sensors_and_numbers_of_a_folder_are_listed_and_shown_with_their_level() {
    let bench = Bench::new();
    for (name, model) in [("one", "Foo"), ("two", "GelSight Mini")] {
        bundle(&bench, name, model, 0.01);
        bench.ok(&format!("catalogue add {name} --to c"));
    }
    let listed = bench.json("catalogue list --catalogue c");
    let rows = listed["rows"].as_array().expect("rows");
    let of = |name: &str| rows.iter().find(|row| row["sensor"] == name);
    let entry = text(&bench, "entries/foo.toml");
    let count = entry.matches("[[measured]]").count().to_string();
    assert_eq!(of("Foo").expect("listed")["of bundles"], count.as_str());
    assert_eq!(of("TacTip").expect("built in")["of bundles"], "0");
    let shown = bench.ok("catalogue show GelSight --catalogue c --format csv");
    assert!(shown.contains("0.0325"), "the published number: {shown}");
    let own = shown
        .lines()
        .find(|line| line.contains("level predictions"));
    let own = own.unwrap_or_else(|| panic!("no number of the bundle: {shown}"));
    assert!(own.contains("measured") && own.contains("by Ada"), "{own}");
    bench.ok("catalogue show Foo --catalogue c");
    bench.refused("catalogue show Foo", 2, "no such name in the catalogue");
    bench.refused("catalogue list --catalogue nowhere", 3, "nowhere");
    let plain = bench.json("catalogue list");
    assert!(plain["rows"][0].get("of bundles").is_none());
}

#[test]
fn numbers_of_other_samples_or_definitions_stand_side_by_side_without_a_rank() {
    let bench = Bench::new();
    for (name, model, error) in [("one", "Foo", 0.01), ("two", "Bar", 0.02)] {
        bundle(&bench, name, model, error);
        bench.ok(&format!("catalogue add {name} --to c"));
    }
    let answered = || {
        let compared = bench.json("compare Foo Bar --catalogue c --metrics mae");
        crate::schema::check("comparison", &compared);
        compared["answers"].to_string()
    };
    let same = answered();
    assert!(same.contains("\"mae\""), "{same}");
    assert!(
        !same.contains("other samples") && !same.contains("definitions"),
        "{same}"
    );
    let said = bench.ok("compare Foo Bar --catalogue c --metrics mae");
    assert!(said.contains("Foo (measured, predictions, "), "{said}");
    // Published numbers and measured ones rest on different samples.
    let chosen = bench.json("choose --catalogue c --need force");
    crate::schema::check("choice", &chosen);
    let listed = |list: &str| chosen[list].to_string();
    assert!(
        listed("apart").contains("Foo (measured, predictions, "),
        "{chosen:#}"
    );
    assert!(!listed("ranked").contains("(measured"), "{chosen:#}");
    let path = bench.path("c/entries/bar.toml");
    let redefine = |from: &str, to: &str| {
        forge(&bench, "bar", |manifest| {
            for claim in manifest["claims"].as_array_mut().expect("claims") {
                if claim["definition"] == from {
                    claim["definition"] = to.into();
                }
            }
        });
        let [from, to] = [from, to].map(|own| format!("definition = \"{own}\""));
        edit(&path, |text| text.replace(&from, &to));
    };
    redefine("mae/1", "mae/9");
    let differing = answered();
    assert!(
        differing.contains("`mae/1` and `mae/9` differ"),
        "{differing}"
    );
    redefine("mae/9", "mae/1");
    let (mut own, other) = (String::new(), format!("sha256:{}", "0".repeat(64)));
    forge(&bench, "bar", |manifest| {
        let samples = manifest["samples_digest"].as_str().expect("a digest");
        own = samples.to_owned();
        manifest["samples_digest"] = other.as_str().into();
    });
    edit(&path, |text| text.replace(&own, &other));
    let differing = answered();
    assert!(
        differing.contains("the scores are from different samples"),
        "{differing}"
    );
}
