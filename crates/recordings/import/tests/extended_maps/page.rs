//! Tests that parse the maps of docs/your-recording.md: the complete map in a fence, and every fragment of the table of layouts.

use taceva_import::ImportMap;
use toml::{Table, Value};

const PAGE: &str = include_str!("../../../../../docs/your-recording.md");

/// Lines that all maps share.
const LEAST: &str = r#"
map_version = 2
table = "t.csv"
[columns]
Fz = { from = "Fz", unit = "N" }
[time]
clock = "unknown"
column = "t"
unit = "s"
[sensor]
model = "drawn gel"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#;

/// Required lines of each section of a map, which a fragment of the page omits.
const AROUND: [(&str, &str); 7] = [
    ("frame", "channel_order = \"gray\"\nreference = \"unknown\""),
    ("join", "name = \"j\"\ntable = \"j.csv\""),
    (
        "matrix",
        "from = [\"v0\"]\nby = [[1.0]]\ngives = { Fx = \"N\" }",
    ),
    (
        "signals",
        "from = \"0..1\"\nunit = \"V\"\nplaces = [2, 1]\nchannels = [\"p\"]",
    ),
    ("path", "pattern = \"{n}.csv\""),
    ("classes", ""),
    (
        "task.slip",
        "kind = \"event\"\nfrom = \"slip\"\nnames = [\"no_slip\", \"slip\"]\npositive = \"slip\"\ncluster = \"source_table\"",
    ),
];

/// Section of each key that the page writes without a section.
const OF_KEY: [(&str, &str); 15] = [
    ("table", ""),
    ("rows", "table"),
    ("from", "columns"),
    ("column", "frame"),
    ("array", "frame"),
    ("bytes", "frame"),
    ("video", "frame"),
    ("index", "frame"),
    ("range", "frame"),
    ("bits", "frame"),
    ("on", "join"),
    ("until", "join"),
    ("tolerance_ms", "join"),
    ("lag_ms", "join"),
    ("pattern", "path"),
];

fn parsed(map: &str) -> Result<(), String> {
    let read = ImportMap::parse("map.toml".as_ref(), map);
    read.map(drop).map_err(|error| error.to_string())
}

/// Texts between backquotes in `text`.
fn code(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// Second cell of each row of the table below the heading `Find your layout`. A `|` within code does not separate cells.
fn cells() -> Vec<&'static str> {
    let (_, section) = PAGE.split_once("## Find your layout").expect("a heading");
    let (section, _) = section.split_once("\n## ").expect("another heading");
    let rows = section.lines().filter(|line| line.starts_with("| "));
    rows.skip(1)
        .map(|row| row.split(" | ").nth(1).expect("a second cell"))
        .collect()
}

/// Fragment of a map: its section, its keys, and their values if given.
struct Fragment {
    table: String,
    keys: Vec<String>,
    values: Option<Table>,
}

/// Replaces each `…` by a value that fits the key before it.
fn filled(text: &str) -> String {
    text.replace("[…]", "[\"a\", \"b\"]")
        .replace("{ … }", "{ column = \"t\", unit = \"s\" }")
}

/// Fragments of a map in a cell of the page. A column name is treated as a label.
fn fragments(cell: &str) -> Vec<Fragment> {
    let mut all: Vec<Fragment> = Vec::new();
    // A table name alone, as in "other topics by `[[join]]`", states no key.
    for text in code(cell).into_iter().filter(|text| !text.ends_with("]]")) {
        let (named, rest) = match text.strip_prefix('[') {
            Some(_) => {
                let (head, rest) = text.split_once("] ").expect("a table and a key");
                (Some(head.trim_matches(['[', ']']).to_owned()), rest)
            }
            None => (None, text),
        };
        let rest = filled(rest);
        let values = match rest.starts_with('"') {
            true => toml::from_str(&format!("from = {rest}")).ok(),
            false => toml::from_str::<Table>(&rest).ok(),
        };
        let keys: Vec<String> = match &values {
            Some(values) => values.keys().cloned().collect(),
            None => vec![rest.clone()],
        };
        let known = OF_KEY.iter().find(|(key, _)| *key == keys[0]);
        let table = named
            .or_else(|| (values.is_none()).then(|| all.last().map(|last| last.table.clone()))?)
            .or_else(|| known.map(|(_, table)| (*table).to_owned()));
        let table = table.unwrap_or_else(|| panic!("`{text}` is of no table"));
        all.push(Fragment {
            table,
            keys,
            values,
        });
    }
    all
}

/// Returns the section called `name` of `map`, which is created if missing.
fn table_of<'m>(map: &'m mut Table, name: &str) -> &'m mut Table {
    let around = AROUND.iter().find(|(table, _)| *table == name);
    let around = around.map_or("", |(_, text)| text);
    let around: Table = toml::from_str(around).expect("TOML");
    let begun = match name {
        "join" | "matrix" => Value::Array(vec![Value::Table(around)]),
        _ => Value::Table(around),
    };
    let own = match name.split_once('.') {
        Some((outer, inner)) => {
            let outer = map.entry(outer).or_insert(Value::Table(Table::new()));
            let outer = outer.as_table_mut().expect("a table");
            outer.entry(inner).or_insert(begun)
        }
        None => map.entry(name).or_insert(begun),
    };
    match own {
        Value::Array(tables) => tables[0].as_table_mut().expect("a table"),
        own => own.as_table_mut().expect("a table"),
    }
}

/// Smallest map that contains `fragments`.
fn map_of(fragments: &[Fragment]) -> Table {
    let mut map: Table = toml::from_str(LEAST).expect("TOML");
    for Fragment { table, values, .. } in fragments {
        let Some(values) = values.clone() else {
            continue;
        };
        match table.as_str() {
            "" => map.extend(values),
            "columns" => {
                let columns = map["columns"].as_table_mut().expect("a table");
                columns["Fz"]
                    .as_table_mut()
                    .expect("a table")
                    .extend(values);
            }
            "table" => {
                // `rows` needs a form with groups or members.
                let file = if map["table"].is_table() {
                    map["table"]["file"].clone()
                } else {
                    "a.h5".into()
                };
                let mut table = Table::from_iter([("file".to_owned(), file)]);
                table.extend(values);
                map.insert("table".to_owned(), Value::Table(table));
            }
            name => table_of(&mut map, name).extend(values),
        }
    }
    complete(&mut map);
    map
}

/// Adds the required keys of a join or a frame.
fn complete(map: &mut Table) {
    if map.contains_key("join") {
        let join = table_of(map, "join");
        if join.contains_key("time") {
            for key in ["tolerance_ms", "lag_ms"] {
                join.entry(key).or_insert(Value::Float(1.0));
            }
        } else if !join.contains_key("on") && !join.contains_key("until") {
            join.insert("on".to_owned(), "row".into());
        }
    }
    if map.contains_key("frame") {
        let frame = table_of(map, "frame");
        let places = ["column", "pattern", "array", "bytes", "video"];
        if !places.iter().any(|place| frame.contains_key(*place)) {
            frame.insert("array".to_owned(), "images".into());
        }
    }
}

#[test]
fn every_fragment_of_the_table_of_layouts_is_read_as_a_map_says_it() {
    let cells = cells();
    assert!(cells.len() > 20, "{cells:?}");
    let mut read = 0;
    for cell in &cells {
        let fragments = fragments(cell);
        let map = toml::to_string(&map_of(&fragments)).expect("TOML");
        parsed(&map).unwrap_or_else(|problem| panic!("{cell}: {problem}\n{map}"));
        read += fragments.iter().filter(|own| own.values.is_some()).count();
    }
    assert!(read > 25, "{read} with values");
}

#[test]
fn every_key_that_the_table_of_layouts_names_without_a_value_is_one() {
    let said = |table: &str, key: &str| {
        let mut map = map_of(&[]);
        // No key takes a date, so a known key is refused by its type and an unknown one by its name.
        let wrong = Value::Datetime("2026-11-26".parse().expect("a date"));
        table_of(&mut map, table).insert(key.to_owned(), wrong);
        parsed(&toml::to_string(&map).expect("TOML")).expect_err("a date")
    };
    assert!(said("signals", "plaices").contains("unknown key"));
    let mut named = 0;
    for cell in cells() {
        for Fragment {
            table,
            keys,
            values,
        } in fragments(cell)
        {
            if values.is_some() {
                continue;
            }
            if table.is_empty() || table == "frame" {
                panic!("`{}` of {cell}", keys[0]);
            }
            let problem = said(&table, &keys[0]);
            assert!(!problem.contains("unknown key"), "{cell}: {problem}");
            named += 1;
        }
    }
    assert!(named >= 8, "{named}");
}

#[test]
fn the_whole_map_of_the_page_is_read_once_what_only_a_lab_knows_is_filled_in() {
    let maps = PAGE
        .split("```\n")
        .filter(|block| block.starts_with("# A draft from"));
    let maps: Vec<&str> = maps.collect();
    assert_eq!(maps.len(), 1, "maps in a fence");
    let open = parsed(maps[0]).expect_err("it is a draft");
    assert!(open.contains("a draft leaves open"), "{open}");
    let mut filled = String::new();
    for line in maps[0].lines() {
        let unit = match line.get(..1) {
            Some("F") => "N",
            Some("T") => "Nm",
            _ => "drawn gel",
        };
        filled += &line.replace("\"?\"", &format!("\"{unit}\""));
        filled.push('\n');
    }
    parsed(&filled).expect("a map");
}
