//! Tests of texts in lists, and of ids of several texts. No text may be truncated, and no two ids merged.

use super::arrays::npy;
use super::{NO_TIME, imported, imported_from, refused};
use taceva_tables::{Cell, ParquetWriter, WrittenColumn, WrittenKind};

const TAGS: [[&str; 2]; 2] = [["soft", "cube, red"], ["a;b c", "null"]];

fn map(table: &str, rest: &str) -> String {
    format!("table = {table}\n{rest}\n{NO_TIME}")
}

fn labels(force: &str, list: &str) -> String {
    format!(
        "[columns]\nFz = {{ from = \"{force}\", unit = \"N\" }}\n[attributes]\na = \"{list}[0]\"\nb = \"{list}[1]\"\n"
    )
}

fn check(found: &[Vec<String>], form: &str) {
    assert_eq!(found[0], ["soft", "a;b c"], "{form}");
    assert_eq!(found[1], ["cube, red", "null"], "{form}");
}

#[test]
fn texts_in_the_lists_of_json_and_parquet_are_whole() {
    let lines = "{\"f\": 1, \"tags\": [\"soft\",\"cube, red\"]}\n{\"f\": 2, \"tags\": [\"a;b c\",\"null\"]}\n";
    let of_json = map("\"t.jsonl\"", &labels("/f", "/tags"));
    let (_, found) = imported(&[("t.jsonl", lines)], &of_json, &["a", "b"]);
    check(&found, "JSON");
    let folder = tempfile::tempdir().expect("a folder");
    let columns = [
        WrittenColumn::new("tags", WrittenKind::Texts),
        WrittenColumn::new("f", WrittenKind::Number),
    ];
    let path = folder.path().join("t.parquet");
    let mut writer = ParquetWriter::create(&path, &columns, &[]).expect("made");
    for tags in TAGS {
        let tags = tags.map(|tag| Cell::Text(tag.to_owned()));
        let row = vec![Cell::List(tags.to_vec()), Cell::Number(0.5)];
        writer.push(row).expect("written");
    }
    writer.finish().expect("written");
    let of_parquet = map("\"t.parquet\"", &labels("f", "tags"));
    let (_, found) = imported_from(folder.path(), &of_parquet, &["a", "b"]);
    check(&found, "Parquet");
}

#[test]
fn texts_in_arrays_of_two_axes_are_whole() {
    let letters = TAGS.iter().flatten().flat_map(|tag| {
        let letters = tag.chars().map(u32::from);
        letters.chain(std::iter::repeat(0)).take(9)
    });
    let bytes: Vec<u8> = letters.flat_map(u32::to_le_bytes).collect();
    let folder = tempfile::tempdir().expect("a folder");
    let array = npy("<U9", "(2, 2)", &bytes);
    std::fs::write(folder.path().join("s.npy"), array).expect("written");
    std::fs::write(folder.path().join("t.csv"), "f\n1\n2\n").expect("written");
    let join = "[[join]]\nname = \"s\"\ntable = \"s.npy\"\non = \"row\"\n";
    let map = map("\"t.csv\"", &format!("{join}{}", labels("f", "s.value")));
    let (_, found) = imported_from(folder.path(), &map, &["a", "b"]);
    check(&found, "NumPy");
}

#[test]
fn a_null_in_a_list_of_json_is_an_absent_value() {
    let lines =
        "{\"f\": [1, null], \"tags\": [null, \"b\"]}\n{\"f\": [2, 3], \"tags\": [\"c\", null]}\n";
    let map = map("\"t.jsonl\"", &labels("/f[0]", "/tags"));
    let (_, found) = imported(&[("t.jsonl", lines)], &map, &["a", "b"]);
    assert_eq!(found, [["", "c"], ["b", ""]]);
}

#[test]
fn a_number_in_quotes_is_not_cut_at_its_comma() {
    let text = "f\n\"['1,5','2']\"\n";
    let of = |from: &str| {
        let columns = format!("[columns]\nFz = {{ from = \"{from}\", unit = \"N\" }}");
        map("\"t.csv\"", &columns)
    };
    let message = refused(&[("t.csv", text)], &of("f[0]"));
    assert!(message.contains("`1,5`"), "{message}");
    let (_, found) = imported(&[("t.csv", text)], &of("f[1]"), &["Fz"]);
    assert_eq!(found[0], ["2.0"]);
}

#[test]
fn points_of_other_cells_are_other_points() {
    let columns =
        "[columns]\nFz = { from = \"f\", unit = \"N\" }\n[ids]\npoint_id = [\"p\", \"q\"]";
    let text = "f,p,q\n1,a:b,c\n2,a,b:c\n3,1.5,x\n";
    let map = map("\"t.csv\"", columns);
    let (_, found) = imported(&[("t.csv", text)], &map, &["point_id"]);
    assert_eq!(found[0], ["a\\:b:c", "a:b\\:c", "1.5:x"]);
}

#[test]
fn an_open_unit_behind_the_name_of_a_column_with_a_number_sign_is_refused_as_open() {
    let columns = "[columns]\nFz = { from = \"a#b\", unit = \"?\" }\n";
    let problem = refused(&[("t.csv", "a#b\n1\n")], &map("\"t.csv\"", columns));
    assert!(
        problem.contains("is a unit that a draft leaves open"),
        "{problem}"
    );
}
