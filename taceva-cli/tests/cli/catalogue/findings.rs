//! Findings of `taceva catalogue check`, and additions that would make one.

use std::fs;

use serde_json::Value;

use super::{bundle, forge, names, text};
use crate::bundle::forgery::edit;
use crate::support::Bench;

/// Findings in the catalogue `c`, as file and words.
fn findings(bench: &Bench) -> Vec<String> {
    let ran = bench.run("catalogue check c --format json -q");
    let found: Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(found["schema"], "taceva.catalogue-check/1");
    let rows = found["rows"].as_array().expect("rows").iter();
    let cell = |row: &Value, name: &str| row[name].as_str().expect("a text").to_owned();
    let rows = rows.map(|row| {
        let [file, line, finding] = ["file", "line", "finding"].map(|name| cell(row, name));
        format!("{file}:{line}: {finding}")
    });
    let rows: Vec<String> = rows.collect();
    assert_eq!(ran.code, i32::from(!rows.is_empty()), "{}", ran.out);
    rows
}

/// Fails unless one finding has all of `words`.
fn has(found: &[String], words: &[&str]) {
    let is_it = |finding: &String| words.iter().all(|word| finding.contains(word));
    assert!(found.iter().any(is_it), "{words:?}: {found:#?}");
}

/// Test folder with a catalogue that has one bundle of the sensor Foo.
fn catalogue() -> Bench {
    let bench = Bench::new();
    bundle(&bench, "one", "Foo", 0.01);
    bench.ok("catalogue add one --to c");
    bench
}

/// Replaces the first line that begins with `start` in the catalogue entry of the sensor Foo.
fn replace_line(bench: &Bench, start: &str, new: &str) {
    edit(&bench.path("c/entries/foo.toml"), |text| {
        let at = text.lines().position(|line| line.starts_with(start));
        let at = at.expect("such a line");
        let lines = text.lines().enumerate();
        let lines = lines.map(|(number, line)| if number == at { new } else { line });
        lines.collect::<Vec<_>>().join("\n")
    });
}

#[test]
fn a_catalogue_without_a_fault_gets_its_index() {
    let bench = catalogue();
    assert!(findings(&bench).is_empty());
    let said = bench.ok("catalogue check c");
    assert!(
        said.starts_with("0 findings in 1 entry, 1 bundle and "),
        "{said}"
    );
    assert_eq!(said.lines().count(), 1, "a table without rows: {said}");
    let index: Value = serde_json::from_str(&text(&bench, "index.json")).expect("JSON");
    assert_eq!(index["schema"], "taceva.catalogue-index/1");
    assert_eq!(index["entries"][0]["name"], "Foo");
    assert_eq!(index["bundles"][0]["licence"], "CC-BY-4.0");
    bench.write("empty/notes", "none");
    bench.refused("catalogue check empty", 3, "not a catalogue: expected");
}

#[test]
fn a_number_that_its_manifest_does_not_hold_is_found() {
    for (start, new, key) in [
        ("value = ", "value = 123.5", "`value`"),
        ("n = ", "n = 7", "`n`"),
        ("definition = ", "definition = \"mae/9\"", "`definition`"),
        ("by = ", "by = [\"Grace\"]", "`by`"),
        ("source = ", "source = \"unknown\"", "expected recorded"),
        ("verified = ", "verified = \"fit\"", "`verified`"),
        ("metric = ", "metric = \"drift\"", "is not in the manifest"),
    ] {
        let bench = catalogue();
        replace_line(&bench, start, new);
        has(&findings(&bench), &["entries/foo.toml", key]);
    }
}

#[test]
fn an_edited_number_is_neither_compared_nor_chosen_nor_shown() {
    let bench = catalogue();
    replace_line(&bench, "value = ", "value = 123.5");
    for words in [
        "compare Foo GelSight --catalogue c",
        "choose --catalogue c --need force",
        "catalogue site c --out pages",
    ] {
        bench.refused(words, 3, "entries/foo.toml:");
        bench.refused(words, 3, "`value` of ");
        bench.refused(words, 3, "run `taceva catalogue check c`");
    }
    assert!(!bench.path("pages").exists());
}

#[test]
fn a_manifest_that_is_missing_changed_or_without_numbers_is_found() {
    let bench = catalogue();
    let name = names(&bench, "bundles").remove(0);
    let path = bench.path("c/bundles").join(&name);
    edit(&path, |text| text.replacen("Ada", "Eve", 1));
    let found = findings(&bench);
    has(&found, &["bundles/", "expected the digest in its name"]);
    has(&found, &["entries/foo.toml", "missing or damaged"]);
    let entry = text(&bench, "entries/foo.toml");
    let rows = entry.matches("[[measured]]").count();
    let numbers = format!("{rows} numbers of this entry");
    has(&found, &["entries/foo.toml", numbers.as_str()]);
    assert_eq!(
        found.len(),
        2,
        "one of the file, one of its numbers: {found:#?}"
    );
    fs::remove_file(&path).expect("there");
    has(
        &findings(&bench),
        &["entries/foo.toml", "missing or damaged"],
    );
    let bench = catalogue();
    fs::remove_file(bench.path("c/entries/foo.toml")).expect("there");
    has(
        &findings(&bench),
        &["bundles/", "no entry has the numbers of this manifest"],
    );
    // The rows of an addition that was cut off are written by the same command.
    bench.ok("catalogue add one --to c");
    assert!(findings(&bench).is_empty());
}

#[test]
fn a_number_of_a_bundle_that_no_entry_holds_is_found() {
    let bench = catalogue();
    let path = bench.path("c/entries/foo.toml");
    let rows = text(&bench, "entries/foo.toml")
        .matches("[[measured]]")
        .count();
    edit(&path, |text| {
        let (others, _) = text.rsplit_once("[[measured]]").expect("rows");
        others.to_owned()
    });
    let words = format!("entries hold {} of {rows} numbers", rows - 1);
    let found = findings(&bench);
    has(&found, &["bundles/", words.as_str()]);
    assert_eq!(found.len(), 1, "{found:#?}");
    // The remedy that the finding names.
    edit(&path, |text| {
        let (head, _) = text.split_once("[[measured]]").expect("rows");
        head.to_owned()
    });
    bench.ok("catalogue add one --to c");
    assert!(findings(&bench).is_empty());
}

#[test]
fn a_licence_that_is_no_spdx_identifier_and_a_draft_are_found() {
    let bench = catalogue();
    forge(&bench, "foo", |manifest| {
        manifest["licence"] = "CC-BY-4".into()
    });
    has(
        &findings(&bench),
        &["`CC-BY-4`", "SPDX identifier", "did you mean `CC-BY-4.0`?"],
    );
    let bench = catalogue();
    forge(&bench, "foo", |manifest| manifest["draft"] = true.into());
    has(&findings(&bench), &["bundles/", "a draft, expected"]);
}

#[test]
fn the_origin_of_a_number_is_that_of_its_study_in_the_manifest() {
    let of_studies: fn(&mut Value) = |manifest| manifest["source"] = "several".into();
    // A manifest of an earlier version.
    let as_a_whole: fn(&mut Value) = |manifest| {
        let study = manifest["studies"][0].as_object_mut().expect("a study");
        study.remove("source").expect("stated");
    };
    for change in [of_studies, as_a_whole] {
        let bench = catalogue();
        forge(&bench, "foo", change);
        assert!(findings(&bench).is_empty());
        edit(&bench.path("c/entries/foo.toml"), |text| {
            let text = text.replace("[[measured]]", "[[simulated]]");
            text.replace("source = \"recorded\"", "source = \"simulated\"")
        });
        has(&findings(&bench), &["`source` of ", "expected recorded"]);
    }
}

#[test]
fn bundles_at_hand_are_verified_again_and_must_be_those_of_the_catalogue() {
    let bench = catalogue();
    bench.ok("catalogue check c --bundle one");
    bundle(&bench, "two", "Foo", 0.02);
    edit(&bench.path("one/tables/prediction.csv"), |text| {
        text.replacen('1', "2", 1)
    });
    let ran = bench.run("catalogue check c --bundle one --bundle two --format csv");
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    for words in [
        "one,,damaged: tables/prediction.csv",
        "two,,its manifest is not in the catalogue",
    ] {
        assert!(ran.out.replace('"', "").contains(words), "{}", ran.out);
    }
    bench.refused("catalogue check c --bundle nowhere", 3, "nowhere");
}

#[test]
fn the_same_results_and_the_same_row_twice_are_found() {
    let bench = catalogue();
    let name = names(&bench, "bundles").remove(0);
    let before = text(&bench, &format!("bundles/{name}"));
    forge(&bench, "foo", |manifest| manifest["name"] = "again".into());
    bench.write(&format!("c/bundles/{name}"), &before);
    has(&findings(&bench), &["the same results as bundles/"]);
    let bench = catalogue();
    edit(&bench.path("c/entries/foo.toml"), |text| {
        let (_, rows) = text.split_once("[[measured]]").expect("rows");
        let first = rows.split("[[measured]]").next().expect("a row");
        format!("{text}\n[[measured]]{first}")
    });
    has(&findings(&bench), &["entries/foo.toml", "is listed twice"]);
}

#[test]
fn names_alike_are_refused_and_found() {
    let bench = Bench::new();
    for (name, model, error) in [("one", "Foo Mini", 0.01), ("two", "FooMini", 0.02)] {
        bundle(&bench, name, model, error);
    }
    bundle(&bench, "three", "GelSightMini", 0.03);
    bench.refused("catalogue add three --to c", 3, "resembles `GelSight`");
    assert!(!bench.path("c").exists(), "a refusal leaves no folder");
    bench.ok("catalogue add one --to c");
    bench.refused("catalogue add two --to c", 3, "resembles `Foo Mini`");
    // An entry of another name, as by hand.
    let entry = text(&bench, "entries/foo-mini.toml");
    let (head, _) = entry.split_once("[[measured]]").expect("rows");
    bench.write(
        "c/entries/foomini.toml",
        &head.replace("Foo Mini", "FooMini"),
    );
    has(
        &findings(&bench),
        &["entries/foomini.toml", "resembles a name of `Foo Mini`"],
    );
    fs::remove_file(bench.path("c/entries/foomini.toml")).expect("there");
    edit(&bench.path("c/entries/foo-mini.toml"), |text| {
        text.replacen(
            "name = \"Foo Mini\"",
            "name = \"Foo Mini\"\naliases = [\"FooMini\"]",
            1,
        )
    });
    bench.ok("catalogue add two --to c");
    assert!(findings(&bench).is_empty());
}

#[test]
fn a_name_with_blanks_at_its_ends_is_refused_and_found() {
    let bench = Bench::new();
    bundle(&bench, "one", " Foo ", 0.01);
    let rule = "no blanks at the ends";
    bench.refused("catalogue add one --to c", 3, rule);
    assert!(!bench.path("c").exists(), "a refusal leaves no folder");
    let bench = catalogue();
    replace_line(&bench, "name = ", "name = \"Foo \"");
    has(&findings(&bench), &["entries/foo.toml", rule]);
}

#[test]
fn bad_toml_is_named_by_file_line_and_expectation() {
    let bench = catalogue();
    let head = "catalogue_version = 2\nname = \"Foo\"\nkind = \"sensor\"\nmechanism = []\n";
    let whole = text(&bench, "entries/foo.toml");
    for (entry, line, expected) in [
        (format!("{head}colour = 1\n"), ":5:", "expected one of"),
        (format!("{head}aliases = 1\n"), ":5:", "expected a sequence"),
        (
            whole.replacen("\"predictions\"", "\"deep\"", 1),
            ":6:",
            "`deep`: expected files, form, scores",
        ),
        (
            whole.replacen("unit = \"", "unit = \"x", 1),
            ":6:",
            "expected a unit such as mm",
        ),
        (
            whole.replacen("verified = ", "url = \"https://a b\"\nverified = ", 1),
            ":6:",
            "`https://a b`: expected an address",
        ),
        (
            whole.replacen("catalogue_version = 2", "catalogue_version = 3", 1),
            "",
            "`3`: expected 1 or 2",
        ),
        (
            whole.replacen("catalogue_version = 2", "catalogue_version = 1", 1),
            "",
            "expected 2, which has [[measured]]",
        ),
    ] {
        bench.write("c/entries/foo.toml", &entry);
        let found = findings(&bench);
        has(&found, &["entries/foo.toml", line, expected]);
        let is_spared = found.iter().all(|own| !own.contains("remove the file"));
        assert!(is_spared, "its manifest stays: {found:#?}");
        bench.refused("catalogue site c --out pages", 3, "entries/foo.toml");
    }
}

#[cfg(unix)]
#[test]
fn nothing_is_written_or_read_through_a_link() {
    use std::os::unix::fs::symlink;

    let bench = catalogue();
    bundle(&bench, "two", "Foo", 0.02);
    let entry = bench.path("c/entries/foo.toml");
    fs::rename(&entry, bench.path("elsewhere.toml")).expect("room");
    let before = fs::read(bench.path("elsewhere.toml")).expect("there");
    symlink(bench.path("elsewhere.toml"), &entry).expect("room");
    bench.refused("catalogue add two --to c", 3, "a link");
    has(&findings(&bench), &["entries/foo.toml", "a link"]);
    assert_eq!(
        fs::read(bench.path("elsewhere.toml")).expect("there"),
        before
    );
    fs::rename(bench.path("c/entries"), bench.path("entries")).expect("room");
    symlink(bench.path("entries"), bench.path("c/entries")).expect("room");
    bench.refused("catalogue add two --to c", 3, "a link");
    bench.refused("catalogue check c", 3, "a link");
}
