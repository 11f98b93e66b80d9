//! Tests that every array of every file equals what the library of the format reads.

use std::collections::BTreeMap;
use std::fs;

use serde_json::Value;
use taceva_arrays::{ArrayFile, ArrayFormat};

use crate::digest::{at, by_rows, digest};

#[test]
fn every_array_is_what_its_own_library_reads() {
    let text = fs::read_to_string(at("expected.json")).expect("make.py wrote it");
    let files: BTreeMap<String, BTreeMap<String, Value>> =
        serde_json::from_str(&text).expect("JSON");
    let mut wrong = Vec::new();
    let mut arrays = 0;
    for (name, expected) in &files {
        let path = at(name);
        let format = ArrayFormat::of(&path).expect("an ending that is known");
        let is_hdf5 = format == ArrayFormat::Hdf5 || name.ends_with("seven-3.mat");
        if is_hdf5 && !cfg!(feature = "hdf5") {
            continue;
        }
        let file = match ArrayFile::open(&path, format) {
            Ok(file) => file,
            Err(error) => {
                wrong.push(error.to_string());
                continue;
            }
        };
        let mut listed = file.names();
        listed.sort_unstable();
        let mut there: Vec<&String> = expected.keys().collect();
        there.sort_unstable();
        if there
            .iter()
            .map(|name| name.as_str())
            .ne(listed.iter().map(String::as_str))
        {
            wrong.push(format!("{name}: {listed:?}, its library lists {there:?}"));
            continue;
        }
        for (array, expected) in expected {
            arrays += 1;
            let info = file.info(array).expect("listed");
            let found = (serde_json::json!(info.shape), info.element.to_string());
            if found
                != (
                    expected["shape"].clone(),
                    expected["element"].as_str().expect("text").to_owned(),
                )
            {
                wrong.push(format!("{name} `{array}`: {found:?}, expected {expected}"));
                continue;
            }
            let whole = match file.read(array, 0..info.rows()) {
                Ok(whole) => whole,
                Err(error) => {
                    wrong.push(error.to_string());
                    continue;
                }
            };
            assert_eq!(whole.shape, info.shape, "{name} `{array}`");
            let sums = [
                digest(&whole.values),
                by_rows(&file, array, 1),
                by_rows(&file, array, 3),
            ];
            if sums.iter().any(|sum| *sum != expected["sha256"]) {
                wrong.push(format!(
                    "{name} `{array}`: {sums:?} of all rows, one by one and by threes, expected {}",
                    expected["sha256"]
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(
        files.len() > 40 && arrays > 50,
        "{} files, {arrays} arrays",
        files.len()
    );
}
