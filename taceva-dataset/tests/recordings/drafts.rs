//! Drafts of maps: of which recordings they leave nothing open but units, signs and the name of the sensor.

use taceva_dataset::MapDraft;

use crate::expected::differences;
use crate::{copy, folder, own_map};

/// The recording as its lab has it: without the map and what is expected of it.
fn bare(name: &str) -> tempfile::TempDir {
    let target = tempfile::tempdir().expect("a folder");
    copy(&folder(name), target.path());
    for own in ["map.toml", "expected.json"] {
        std::fs::remove_file(target.path().join(own)).expect("it was there");
    }
    target
}

/// The draft of a map for the recording, its units, signs, offsets, scales and sensor filled in from the map of its lab.
fn finished_draft(name: &str) -> Result<String, String> {
    let draft = MapDraft::of(bare(name).path()).map_err(|error| error.to_string())?;
    let own: toml::Table = own_map(name).parse().expect("TOML");
    let mut finished = String::new();
    for line in draft.text().lines() {
        let channel = line.split(" = ").next().unwrap_or_default();
        let facts = own.get("columns").and_then(|columns| columns.get(channel));
        let fact = |key: &str| {
            facts
                .and_then(|facts| facts.get(key))
                .map(|fact| format!(", {key} = {fact}"))
        };
        if line == "model = \"?\"" {
            finished += "model = \"a sensor of the lab\"\n";
            continue;
        }
        if line == "unit = \"?\"" {
            let unit = own.get("signals").and_then(|signals| signals.get("unit"));
            finished += &format!("unit = {}\n", unit.expect("a unit"));
            continue;
        }
        let unit = fact("unit").unwrap_or_else(|| match channel.as_bytes().first() {
            Some(b'F') => ", unit = \"N\"".to_owned(),
            Some(b'T') => ", unit = \"Nm\"".to_owned(),
            _ => ", unit = \"mm\"".to_owned(),
        });
        let others = ["sign", "offset", "scale"].map(|key| fact(key).unwrap_or_default());
        finished += &line.replace(", unit = \"?\"", &format!("{unit}{}", others.concat()));
        finished.push('\n');
    }
    Ok(finished)
}

/// Folders whose drafts leave more open than units and signs.
const MORE_OPEN: [&str; 11] = [
    // Not read at all: data layout version 5.
    "hdf5-fletcher-latest",
    "hdf5-gzip-shuffle-latest",
    "hdf5-lzf-latest",
    // How much later one clock shows the same instant stands nowhere.
    "join-time",
    // That the columns are volts, of which a matrix beside them makes forces.
    "matrix",
    "mcap-lz4",
    "mcap-none",
    "mcap-zstd",
    // Which numbers are black and full, where they are neither pixels nor shares.
    "npy-int16",
    // Three recordings lie beside each other, of which the map wants one.
    "pickle",
    // That -1 g means nothing was weighed, and that the other table is the taxels.
    "taxels-csv",
];

#[test]
fn a_draft_needs_nothing_but_units_of_most_recordings() {
    let mut names: Vec<String> = std::fs::read_dir(folder(""))
        .expect("recordings")
        .flatten()
        .filter(|entry| entry.path().join("map.toml").is_file())
        .map(|entry| entry.file_name().into_string().expect("a name"))
        .collect();
    names.sort();
    let mut open = Vec::new();
    for name in &names {
        let problems = match finished_draft(name) {
            Ok(map) => differences(name, &map),
            Err(problem) => vec![problem],
        };
        if !problems.is_empty() {
            open.push(name.as_str());
        }
    }
    assert_eq!(
        open,
        MORE_OPEN,
        "{} of {}",
        names.len() - open.len(),
        names.len()
    );
}
