//! Tests that a damaged dataset is never read as an intact one, and that no input makes the readers panic or hang.

use std::fs;

use crate::lab::{Lab, MAP, jpeg};
use crate::support::{Random, contents};
use taceva_dataset::Dataset;
use taceva_import::{CsvTable, ImportMap};

/// Digest and all frames of the dataset `set` of `lab`; `None` if its reader rejects any part.
fn whole(lab: &Lab) -> Option<Vec<Vec<u8>>> {
    let dataset = Dataset::open(&lab.path("set")).ok()?;
    let mut all = vec![dataset.digest().as_bytes().to_vec()];
    for row in dataset.all_rows() {
        all.push(dataset.frame(row).ok()??.into_bytes());
    }
    Some(all)
}

#[test]
fn a_flipped_bit_in_any_frame_of_a_dataset_is_noticed() {
    let lab = Lab::new();
    lab.replace("map.toml", "\"gray\"", "\"rgb\"");
    for row in 0..5 {
        lab.write(&format!("source/images/{row}.png"), &jpeg(16, 16, row));
    }
    lab.import().expect("imported");
    let path = lab.path("set/frames/0000/000003.jpg");
    let original = fs::read(&path).expect("read");
    for at in 0..original.len() {
        let mut flipped = original.clone();
        flipped[at] ^= 1 << (at % 8);
        fs::write(&path, &flipped).expect("written");
        let dataset = Dataset::open(&lab.path("set")).expect("opens");
        let message = dataset.frame(3).expect_err("damaged").to_string();
        assert!(
            message.contains("000003.jpg: damaged: expected sha256:"),
            "{message}"
        );
        assert!(dataset.frame(2).is_ok());
    }
}

#[test]
fn a_flipped_bit_in_the_table_is_noticed() {
    let lab = Lab::new();
    lab.import().expect("imported");
    let path = lab.path("set/samples.parquet");
    let original = fs::read(&path).expect("read");
    for at in 0..original.len() {
        let mut flipped = original.clone();
        flipped[at] ^= 1 << (at % 8);
        fs::write(&path, &flipped).expect("written");
        let message = Dataset::open(&lab.path("set"))
            .expect_err("damaged")
            .to_string();
        assert!(message.contains("samples.parquet: damaged"), "{message}");
    }
}

#[test]
fn a_header_edited_by_hand_is_noticed_where_it_decides_a_number() {
    for (from, to) in [
        ("unit = \"N\"", "unit = \"mm\""),
        ("name = \"Fz\"", "name = \"Fx\""),
        ("channel_order = \"gray\"", "channel_order = \"rgb\""),
        ("rows = 5", "rows = 4"),
        ("count = 5", "count = 4"),
        ("width = 8", "width = 9"),
    ] {
        let lab = Lab::new();
        lab.import().expect("imported");
        lab.replace("set/dataset.toml", from, to);
        assert_eq!(whole(&lab), None, "{from} → {to}");
    }
}

#[test]
fn mutated_maps_are_refused_or_understood() {
    let mut random = Random::new(1);
    for _ in 0..3_000 {
        let text = random.mutated(MAP.as_bytes());
        if let Ok(text) = String::from_utf8(text) {
            let _ = ImportMap::parse("fuzz.toml".as_ref(), &text);
        }
    }
}

#[test]
fn mutated_tables_are_refused_or_understood() {
    let lab = Lab::new();
    let original = fs::read(lab.path("source/labels.csv")).expect("read");
    let mut random = Random::new(2);
    for _ in 0..2_000 {
        let bytes = random.mutated(&original);
        lab.write("source/fuzz.csv", &bytes);
        let Ok(table) = CsvTable::read(&lab.path("source/fuzz.csv")) else {
            continue;
        };
        for name in table.names() {
            let text = table.text(name).expect("a column");
            assert_eq!(text.len(), table.rows());
            let numbers = table.numbers_with_invalid(name).expect("a column");
            assert_eq!(numbers.len(), table.rows());
            if let Ok(strict) = table.numbers(name) {
                assert!(strict.values().iter().all(|number| number.is_finite()));
            }
        }
    }
}

#[test]
fn mutated_arrays_are_refused_or_understood() {
    let lab = Lab::new();
    let header = "{'descr': '|u1', 'fortran_order': False, 'shape': (6, 3, 4), }";
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend_from_slice(&u16::try_from(header.len()).expect("short").to_le_bytes());
    file.extend_from_slice(header.as_bytes());
    file.extend_from_slice(&[7; 72]);
    lab.replace(
        "map.toml",
        "column = \"file\"",
        "array = \"frames.npy\"\nindex = \"x\"",
    );
    let mut random = Random::new(3);
    for _ in 0..200 {
        lab.write("source/frames.npy", &random.mutated(&file));
        if lab.import().is_ok() {
            assert!(whole(&lab).is_some());
            fs::remove_dir_all(lab.path("set")).expect("removed");
        }
    }
}

#[test]
fn mutated_datasets_are_refused_or_are_the_one_that_was_written() {
    let lab = Lab::new();
    lab.import().expect("imported");
    let original = whole(&lab).expect("whole");
    let files = contents(&lab.path("set"));
    let mut random = Random::new(4);
    for _ in 0..600 {
        let (name, bytes) = &files[random.below(files.len())];
        let path = lab.path("set").join(name);
        fs::write(&path, random.mutated(bytes)).expect("written");
        if let Some(found) = whole(&lab) {
            assert_eq!(found, original, "{}", name.display());
        }
        fs::write(&path, bytes).expect("written");
    }
}
