//! Tests of drafts of tables and arrays of taxels.

use taceva_import::{ImportMap, MapDraft};

use super::import;

/// Layouts of taxels: a headerless table with a leading time beside the table of a scale, and an array alone.
#[test]
fn a_draft_of_taxel_tables_needs_units_alone() {
    let lab = tempfile::tempdir().expect("a folder");
    let magnetic = lab.path().join("magnetic/0_probe");
    std::fs::create_dir_all(&magnetic).expect("made");
    let (mut sensor, mut states) = (String::new(), String::new());
    for n in 0..40_u32 {
        let t = 1_700_000_000.0 + 0.05 * f64::from(n);
        let numbers: Vec<String> = (0..15)
            .map(|taxel| format!("{}.5", (n * 7 + taxel * 3) % 50))
            .collect();
        sensor += &format!("{t},{}\n", numbers.join(","));
        states += &format!("{t},{n}.25,2.5,-3.5,{}.75\n", n % 9);
    }
    std::fs::write(magnetic.join("sensor_post_baselines.csv"), sensor).expect("written");
    std::fs::write(magnetic.join("states.csv"), states).expect("written");
    let draft = MapDraft::of(&lab.path().join("magnetic")).expect("a draft");
    for part in [
        "sensor_post_baselines.csv\", header = false",
        "[signals]\nfrom = \"1..15\"\nunit = \"?\"\nplaces = [5, 1]",
        "name = \"states\"",
    ] {
        assert!(draft.text().contains(part), "{part}: {}", draft.text());
    }
    let finished = draft
        .text()
        .replace(", unit = \"?\" }", ", unit = \"N\" }")
        .replace("unit = \"?\"", "unit = \"uT\"")
        .replace("model = \"?\"", "model = \"magnetic\"");
    let map = ImportMap::parse("map.toml".as_ref(), &finished)
        .unwrap_or_else(|error| panic!("{error}: {finished}"));
    let dataset = import(&lab.path().join("magnetic"), &map, &lab.path().join("set"));
    assert_eq!(dataset.table().rows(), 40);
    let signals = dataset.signals(1).expect("read").expect("there");
    assert_eq!(signals.values()[..3], [7.5, 10.5, 13.5]);

    // (3, 48) numbers of 32 bits, as NumPy writes them.
    let mut array = b"\x93NUMPY\x01\0\x76\0".to_vec();
    let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 48), }";
    array.extend(format!("{header:<117}\n").bytes());
    array.extend((0..144_u16).flat_map(|number| f32::from(number).to_le_bytes()));
    std::fs::create_dir(lab.path().join("grid")).expect("made");
    std::fs::write(lab.path().join("grid/run.npy"), array).expect("written");
    let draft = MapDraft::of(&lab.path().join("grid")).expect("a draft");
    let expected = "[signals]\nfrom = \"value\"\nunit = \"?\"\nplaces = [4, 4]";
    assert!(draft.text().contains(expected), "{}", draft.text());
    let finished = draft
        .text()
        .replace("unit = \"?\"", "unit = \"count\"")
        .replace("model = \"?\"", "model = \"grid\"");
    let map = ImportMap::parse("map.toml".as_ref(), &finished).expect("a map");
    let dataset = import(&lab.path().join("grid"), &map, &lab.path().join("taxels"));
    assert_eq!(
        dataset.signals(2).expect("read").expect("there").values()[..1],
        [96.0]
    );
}
