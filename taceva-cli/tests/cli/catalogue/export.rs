//! Exports of a catalogue for other programs.

use std::fs;

use serde_json::Value;
use taceva_files::seal::digest_of_bytes;

use super::{bundle, names, packed, score, set_source, text};
use crate::support::Bench;

/// Test folder with a catalogue of one measured and one simulated sensor.
fn catalogue() -> Bench {
    let bench = Bench::new();
    bundle(&bench, "one", "Foo", 0.01);
    bench.ok("catalogue add one --to c --url https://example.org/one.tar.gz");
    score(&bench, "two", "Bar", 0.02);
    set_source(&bench, "two", "simulated");
    bench.ok(&packed("two", "--author Grace --licence MIT"));
    bench.ok("catalogue add two --to c");
    bench
}

/// Digests of the files in the catalogue `c`, by path.
fn digests(bench: &Bench) -> Vec<(String, String)> {
    let folders = ["bundles", "entries"].into_iter();
    let paths = folders.flat_map(|folder| {
        let names = names(bench, folder).into_iter();
        names.map(move |name| format!("{folder}/{name}"))
    });
    let digest = |path: String| {
        let digest = digest_of_bytes(text(bench, &path).as_bytes());
        let digits = digest.strip_prefix("sha256:").expect("a digest");
        (path, digits.to_owned())
    };
    paths.map(digest).collect()
}

#[test]
fn the_hub_gets_every_number_with_its_notes_and_each_task_once() {
    let bench = catalogue();
    bench.ok("catalogue export c --hf hub");
    let read = |name: &str| fs::read_to_string(bench.path(&format!("hub/{name}"))).expect(name);
    for name in ["foo", "bar"] {
        let entry = text(&bench, &format!("entries/{name}.toml"));
        let found = read(&format!(".eval_results/{name}.yaml"));
        let rows = entry.matches("\nmetric = ").count();
        assert_eq!(found.matches("task_id: ").count(), rows, "{found}");
        assert_eq!(found.matches("level predictions").count(), rows, "{found}");
        let badges = found.matches("Nothing here was measured").count();
        assert_eq!(badges, if name == "bar" { rows } else { 0 }, "{found}");
        let addresses = found.matches("https://example.org/one.tar.gz").count();
        assert_eq!(addresses, if name == "foo" { rows } else { 0 }, "{found}");
    }
    let tasks = read("eval.yaml");
    assert_eq!(tasks.matches("id: \"mae_Fz\"").count(), 1, "{tasks}");
    assert!(tasks.contains("2 sensors from 2 bundles"), "{tasks}");
    bench.refused("catalogue export c --hf hub", 3, "--force replaces it");
    bench.ok("catalogue export c --hf hub --force");
}

#[test]
fn the_folder_is_described_with_digests_authors_and_licences() {
    let bench = catalogue();
    bench.ok("catalogue export c --croissant --crate --organization Lab<https://lab.example>");
    let read = |name: &str| -> Value { serde_json::from_str(&text(&bench, name)).expect("JSON") };
    let croissant = read("croissant.json");
    let distribution = croissant["distribution"].as_array().expect("files");
    let listed = |file: &Value, key: &str| file[key].as_str().expect("a text").to_owned();
    let mut found: Vec<(String, String)> = distribution
        .iter()
        .map(|file| (listed(file, "contentUrl"), listed(file, "sha256")))
        .collect();
    found.sort();
    assert_eq!(found, digests(&bench));
    assert_eq!(croissant["license"].as_array().map(Vec::len), Some(2));
    assert_eq!(croissant["creator"].as_array().map(Vec::len), Some(2));
    let described = croissant["description"].as_str().expect("words");
    assert!(
        described.contains("Not everything here was measured"),
        "{described}"
    );
    let graph = read("ro-crate-metadata.json");
    let graph = graph["@graph"].as_array().expect("entities");
    let root = graph.iter().find(|own| own["@id"] == "./").expect("a root");
    assert_eq!(root["publisher"]["@id"], "https://lab.example");
    assert_eq!(
        root["hasPart"].as_array().map(Vec::len),
        Some(distribution.len())
    );
    assert!(
        graph.iter().all(|own| own["@type"] != "CreateAction"),
        "no run made the folder"
    );
    // Forms are no part of what is checked or described.
    bench.ok("catalogue check c");
    bench.ok("catalogue export c --croissant --force");
    assert_eq!(
        read("croissant.json")["distribution"],
        croissant["distribution"]
    );
}

#[test]
fn a_form_must_be_named_and_an_edited_number_is_not_exported() {
    let bench = catalogue();
    bench.refused(
        "catalogue export c",
        2,
        "--hf FOLDER, --croissant or --crate",
    );
    let path = bench.path("c/entries/foo.toml");
    crate::bundle::forgery::edit(&path, |text| text.replacen("\nn = 120", "\nn = 7", 1));
    bench.refused("catalogue export c --hf hub", 3, "`n` of ");
    assert!(!bench.path("hub").exists());
}
