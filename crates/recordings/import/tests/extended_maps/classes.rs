//! Tests of classes named by whole numbers: cells as positions in the list, and rejected lists.

use super::arrays::npy;
use super::{NO_TIME, imported, imported_from, planned, refused};
use taceva_tables::{Cell, ParquetWriter, WrittenColumn, WrittenKind};

fn map(table: &str, force: &str, class: &str) -> String {
    format!(
        "table = \"{table}\"\n[columns]\nFz = {{ from = \"{force}\", unit = \"N\" }}\n[classes]\nc = {class}\n{NO_TIME}"
    )
}

#[test]
fn integers_by_type_are_positions_also_where_a_name_is_the_same_number() {
    let folder = tempfile::tempdir().expect("a folder");
    let columns = [
        WrittenColumn::new("label", WrittenKind::Integer),
        WrittenColumn::new("Fz", WrittenKind::Number),
    ];
    let path = folder.path().join("t.parquet");
    let mut writer = ParquetWriter::create(&path, &columns, &[]).expect("made");
    for label in [1, 0, 2] {
        let row = vec![Cell::Integer(label), Cell::Number(0.5)];
        writer.push(row).expect("written");
    }
    writer.finish().expect("written");
    let numbers: Vec<u8> = [1_i32, 0, 2]
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect();
    std::fs::write(folder.path().join("t.npy"), npy("<i4", "(3,)", &numbers)).expect("written");
    let lines = "{\"label\": 1}\n{\"label\": 0}\n{\"label\": 2}\n";
    std::fs::write(folder.path().join("t.jsonl"), lines).expect("written");
    for (table, force, from) in [
        ("t.parquet", "Fz", "label"),
        ("t.npy", "value", "value"),
        ("t.jsonl", "/label", "/label"),
    ] {
        let class = format!("{{ from = \"{from}\", names = [\"1\", \"10\", \"2\"] }}");
        let (_, found) = imported_from(folder.path(), &map(table, force, &class), &["c"]);
        assert_eq!(found[0], ["10", "1", "2"], "{table}");
    }
}

#[test]
fn integers_of_joined_tables_of_messages_and_of_shards_are_positions_too() {
    let names = "names = [\"1\", \"10\", \"2\"]";
    let files = [
        ("t.csv", "k,Fz\n0,1\n1,2\n2,3\n"),
        (
            "j.jsonl",
            "{\"k\": 0, \"label\": 1}\n{\"k\": 1, \"label\": 0}\n{\"k\": 2, \"label\": 2}\n",
        ),
        ("j.csv", "k,label\n0,1\n1,0\n2,2\n"),
    ];
    let joined = |table: &str, key: &str, label: &str| {
        let class = format!("{{ from = \"j.{label}\", {names} }}");
        let map = map("t.csv", "Fz", &class);
        format!("{map}[[join]]\nname = \"j\"\ntable = \"{table}\"\non = {{ k = \"{key}\" }}\n")
    };
    let (_, found) = imported(&files, &joined("j.jsonl", "/k", "/label"), &["c"]);
    assert_eq!(found[0], ["10", "1", "2"]);
    // A CSV file states no types of its cells.
    let message = refused(&files, &joined("j.csv", "k", "label"));
    assert!(message.contains("which is also the position"), "{message}");

    let folder = tempfile::tempdir().expect("a folder");
    let mut shard = tar::Builder::new(Vec::new());
    for (key, label) in [("a", "1"), ("b", "0"), ("c", "2")] {
        let json = format!("{{\"Fz\": 1.5, \"label\": {label}, \"text\": \"{label}\"}}");
        let mut header = tar::Header::new_ustar();
        header.set_size(json.len() as u64);
        header.set_mode(0o644);
        let path = format!("{key}.json");
        shard
            .append_data(&mut header, path, json.as_bytes())
            .expect("packed");
    }
    let bytes = shard.into_inner().expect("written");
    std::fs::write(folder.path().join("s.tar"), bytes).expect("written");
    let of_shard = |label: &str| {
        map(
            "",
            "json/Fz",
            &format!("{{ from = \"json/{label}\", {names} }}"),
        )
        .replace(
            "table = \"\"",
            "table = { file = \"s.tar\", format = \"webdataset\" }",
        )
    };
    let (_, found) = imported_from(folder.path(), &of_shard("label"), &["c"]);
    assert_eq!(found[0], ["10", "1", "2"]);
    let problem = planned(folder.path(), &of_shard("text")).expect_err("texts");
    assert!(problem.contains("which is also the position"), "{problem}");

    // `header.seq` would be one of ROS 1; the size of a picture is an integer by its schema, too.
    let recordings = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../../tests/recordings/mcap-none"
    );
    let map = "table = { file = \"run.mcap\", rows = \"/tactile/image_raw\" }\n[columns]\nPz = { from = \"width\", unit = \"mm\" }\n[classes]\nc = { from = \"FIELD\", names = [NAMES] }\n[time]\nclock = \"unknown\"\n";
    let of = |field: &str| {
        // More names than the picture has rows, in reverse order.
        let names: Vec<String> = (0..400).map(|at| format!("\"{}\"", 399 - at)).collect();
        let map = map
            .replace("FIELD", field)
            .replace("NAMES", &names.join(", "));
        planned(recordings.as_ref(), &map)
    };
    of("height").expect("an integer by its schema");
    let problem = of("encoding").expect_err("a text");
    assert!(problem.contains("which is also the position"), "{problem}");
}

#[test]
fn a_list_in_which_a_name_is_the_position_of_another_is_refused_for_cells_of_text() {
    let class = "{ from = \"c\", names = [\"1\", \"10\", \"2\"] }";
    let message = refused(&[("t.csv", "Fz,c\n1,1\n")], &map("t.csv", "Fz", class));
    for word in [
        "[classes] c: ",
        "has \"1\", which is also the position of \"10\"",
        "\"class 1\"",
        "`[attributes]`",
    ] {
        assert!(message.contains(word), "{word}: {message}");
    }
}

#[test]
fn names_that_are_their_own_positions_or_none_of_the_list_are_accepted() {
    for (names, cells, expected) in [
        ("\"0\", \"1\", \"2\"", "1,2\n1,0\n", ["2", "0"]),
        ("\"10\", \"20\"", "1,20\n1,10\n", ["20", "10"]),
        ("\"10\", \"20\"", "1,1\n1,0\n", ["20", "10"]),
    ] {
        let class = format!("{{ from = \"c\", names = [{names}] }}");
        let text = format!("Fz,c\n{cells}");
        let (_, found) = imported(&[("t.csv", &text)], &map("t.csv", "Fz", &class), &["c"]);
        assert_eq!(found[0], expected);
    }
}

#[test]
fn folders_that_are_called_by_numbers_are_names() {
    let class = "{ from = \"path.kind\", names = [\"1\", \"10\", \"2\"] }";
    let with = |pattern: &str| {
        let map = map("*/t.csv", "Fz", class);
        format!("{map}[path]\npattern = \"{pattern}/t.csv\"\n")
    };
    let files = [
        ("1/t.csv", "Fz\n1\n"),
        ("10/t.csv", "Fz\n2\n"),
        ("2/t.csv", "Fz\n3\n"),
    ];
    let (_, found) = imported(&files, &with("{kind}"), &["c"]);
    assert_eq!(found[0], ["1", "10", "2"]);
    // A part declared as digits may be a counter.
    let message = refused(&files, &with("{kind:digits}"));
    assert!(message.contains("which is also the position"), "{message}");
}
