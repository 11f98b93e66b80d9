//! Tests of accepted maps, and of rejected maps with the line of the problem.

use super::*;

const GOOD: &str = r#"map_version = 2
table = "labels.csv"
[frame]
column = "file"
channel_order = "gray"
reference = "unknown"
[columns]
Fz = { from = "Fz_N", unit = "N", sign = -1 }
Rx = { from = "rx", unit = "rad" }
[ids]
sample = "sample"
point_id = ["x", "y"]
[time]
clock = "unknown"
[sensor]
model = "TacTip"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#;

fn message(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from}");
    ImportMap::parse(Path::new("m.toml"), &GOOD.replace(from, to))
        .expect_err("wrong")
        .to_string()
}

#[test]
fn a_whole_map_is_understood() {
    let map = ImportMap::parse(Path::new("m.toml"), GOOD).expect("good");
    assert_eq!(map.ids.point_id, ["x", "y"]);
    assert!(map.columns[0].is_negated && !map.columns[1].is_negated);
    assert_eq!(map.facts.sensor.opaque.known(), None);
    assert_eq!(map.frames[0].reference, None);
}

#[test]
fn each_mistake_names_its_line_and_what_is_accepted() {
    for (from, to, expected) in [
        (
            "map_version = 2",
            "map_version = 3",
            "line 1: unknown map version 3",
        ),
        (
            "\"N\"",
            "\"newton\"",
            "line 8: unknown unit `newton`, expected one of mm",
        ),
        ("\"N\"", "\"mm\"", "line 8: channel `Fz` is in N, found mm"),
        (
            "sign = -1",
            "sign = 2",
            "line 8: sign = 2, expected 1 or -1",
        ),
        (
            ", unit = \"N\"",
            "",
            "line 8: the key `unit` is missing; every column states",
        ),
        (
            "clock = \"unknown\"",
            "",
            "the key `clock` is missing; write \"unknown\"",
        ),
        (
            "reference = \"unknown\"\n",
            "",
            "the key `reference` is missing; write \"unknown\"",
        ),
        (
            "serial = \"unknown\"\n",
            "",
            "the key `serial` is missing; write \"unknown\"",
        ),
        (
            "gel = \"unknown\"\n",
            "",
            "the key `gel` is missing; write \"unknown\"",
        ),
        (
            "opaque = \"unknown\"",
            "opaque = \"maybe\"",
            "true, false or \"unknown\"",
        ),
        (
            "opaque = \"unknown\"",
            "opaque = true\nleds = { red = \"up\" }",
            "line 20: unknown variant `up`, expected one of `left`, `right`, `top`, `bottom`",
        ),
        (
            "opaque = \"unknown\"",
            "opaque = true\nleds = { amber = \"left\" }",
            "line 20: `amber`: unknown key; known here: red, green, blue",
        ),
        (
            "column = \"file\"",
            "colunm = \"file\"",
            "line 4: `colunm`: unknown key, did you mean `column`?",
        ),
        (
            "column = \"file\"",
            "column = \"file\"\narray = \"x.npy\"",
            "expected one key for the frames",
        ),
        (
            "\"labels.csv\"",
            "\"../labels.csv\"",
            "line 2: `../labels.csv`: contains `..`, expected a path inside the folder",
        ),
        ("Rx =", "phase =", "line 9: `phase` is the name of an id"),
        (
            "clock = \"unknown\"",
            "clock = \"unix\"\ncolumn = \"t\"",
            "no `unit`",
        ),
        (
            "clock = \"unknown\"",
            "clock = \"unix\"\ncolumn = \"t\"\nunit = \"mm\"",
            "is not a unit of time",
        ),
        (
            "map_version = 2",
            "map_version = 1",
            "line 1: map version 1 is no longer read",
        ),
    ] {
        let message = message(from, to);
        assert!(message.contains(expected), "{from} → {to}: {message}");
    }
}

#[test]
fn a_map_above_one_mebibyte_is_not_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("m.toml");
    std::fs::write(&path, "#".repeat((1 << 20) + 1)).expect("written");
    let message = ImportMap::read(&path).expect_err("large").to_string();
    assert!(message.contains("expected at most 1048576"), "{message}");
}

#[test]
fn the_keys_of_ids_are_all_keys_that_a_map_may_have() {
    let error = toml::from_str::<IdMap>("other = \"x\"").expect_err("no such key");
    let keys = IdMap::KEYS.map(|key| format!("`{key}`")).join(", ");
    let message = error.to_string();
    assert!(message.contains(&format!("one of {keys}")), "{message}");
}
