//! Classes whose names are whole numbers: which cells are positions in the list, and which lists are refused.

use super::arrays::npy;
use super::{NO_TIME, imported, imported_from, refused};
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
    // A part that is stated to be digits may be a counter.
    let message = refused(&files, &with("{kind:digits}"));
    assert!(message.contains("which is also the position"), "{message}");
}
