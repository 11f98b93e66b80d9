//! Rows added to an imported dataset: unchanged rows, refusals, and the scores of an earlier model.

use std::fs;

use crate::support::{Bench, SAMPLES};
use serde_json::Value;

const IMPORT: &str = "import lab --map map.toml";

/// Splits the rows of `lab` into the folders `first` (seven points) and `second` (three points), and imports `first` as the dataset `data`.
pub(crate) fn halves() -> Bench {
    let bench = Bench::new();
    bench.lab();
    // Rows do not store their origin, which differs between folders.
    let map = fs::read_to_string(bench.path("map.toml")).expect("a map");
    bench.write("map.toml", &format!("{map}\n[origin]\n"));
    let labels = fs::read_to_string(bench.path("lab/labels.csv")).expect("drawn");
    let (head, rows) = labels.split_once('\n').expect("a header");
    let rows: Vec<&str> = rows.lines().collect();
    assert_eq!(rows.len(), SAMPLES as usize);
    for (name, own) in [("first", &rows[..42]), ("second", &rows[42..])] {
        bench.write(
            &format!("{name}/labels.csv"),
            &format!("{head}\n{}\n", own.join("\n")),
        );
        fs::create_dir_all(bench.path(&format!("{name}/pictures"))).expect("created");
        for row in own {
            let file = row.split(',').next().expect("a file");
            fs::copy(bench.path("lab").join(file), bench.path(name).join(file)).expect("copied");
        }
    }
    bench.ok("import first --map map.toml --out data -q");
    bench
}

fn json(bench: &Bench, name: &str) -> Value {
    let text = fs::read_to_string(bench.path(name)).expect("written");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn rows_join_a_dataset_whose_table_is_then_that_of_one_import() {
    let bench = halves();
    bench.ok("import second --map map.toml --extend data -q");
    bench.ok(&format!("{IMPORT} --out whole -q"));
    let read = |name: &str| taceva_dataset::Dataset::open(&bench.path(name)).expect("a dataset");
    let (extended, whole) = (read("data"), read("whole"));
    assert_eq!(extended.table().digest(), whole.table().digest());
    // The parts differ: a model would be fitted on other samples.
    assert_ne!(extended.digest(), whole.digest());
    extended.verify_frames().expect("whole");
    for row in [0, 41, 42, 59] {
        assert_eq!(
            extended.frame(row).expect("a frame"),
            whole.frame(row).expect("a frame")
        );
    }
    let [addition] = &extended.header().extended[..] else {
        panic!("{:?}", extended.header().extended);
    };
    assert_eq!((addition.rows, addition.from.as_str()), (42, "second"));
    assert!(
        crate::support::leftovers(
            &bench.path("data"),
            &[
                "dataset.toml",
                "samples.parquet",
                "sources.sha256",
                "frames"
            ]
        )
        .is_empty()
    );
    let report = bench.json("evaluate data --model baseline --split by-point --metrics mae");
    let notes = report["provenance"]["notes"].to_string();
    assert!(
        notes.contains("18 samples were added to 42 on 20"),
        "{notes}"
    );
    assert!(notes.contains("from second"), "{notes}");
}

#[test]
fn no_row_changes_its_part_and_a_model_of_before_is_scored_on_what_it_has_not_seen() {
    let bench = halves();
    let fit = "fit data --model ridge --set size=8 -q";
    for split in ["by-point", "random"] {
        let name = format!("{split}-before");
        bench.ok(&format!(
            "{fit} --split {split} --split-out {name}.json --out {name}.model"
        ));
    }
    bench.ok("import second --map map.toml --extend data -q");
    for split in ["by-point", "random"] {
        let (was, is) = (format!("{split}-before"), format!("{split}-after"));
        bench.ok(&format!(
            "{fit} --split {split} --split-out {is}.json --out {is}.model"
        ));
        let (before, after) = (
            json(&bench, &format!("{was}.json")),
            json(&bench, &format!("{is}.json")),
        );
        let mut added = 0;
        for part in ["train", "validation", "test"] {
            let ids = |file: &Value| -> Vec<String> {
                let ids = file[part].as_array().expect("ids").iter();
                ids.map(|id| id.as_str().expect("an id").to_owned())
                    .collect()
            };
            let (before, after) = (ids(&before), ids(&after));
            assert!(before.iter().all(|id| after.contains(id)), "{split} {part}");
            added += after.len() - before.len();
        }
        assert_eq!(added, 18);
        // The earlier model is scored on the new test part, which holds none of its training samples.
        let scored = bench.json(&format!("evaluate data --with {was}.model --metrics mae"));
        assert_eq!(scored["provenance"]["part"], "test");
        let notes = scored["provenance"]["notes"].to_string();
        let said = "the model was fitted when the dataset had 42 of its 60 samples";
        assert!(notes.contains(said), "{notes}");
        let n = after["test"].as_array().expect("ids").len();
        assert_eq!(scored["metrics"]["mae"]["Fz"]["n"], n, "{split}");
    }
}

#[test]
fn rows_under_another_certificate_need_an_option_and_results_then_name_both() {
    let bench = halves();
    let map = fs::read_to_string(bench.path("map.toml")).expect("a map");
    for number in ["D-K-1", "D-K-2"] {
        let certificate = format!(
            "number = \"{number}\"\nlaboratory = \"a laboratory\"\nissued = 2026-05-12\nserial = \"42\"\nk = 2.0\nU = {{ Fz = \"3.0 mN\" }}\n"
        );
        let name = format!("{number}.toml");
        bench.write(&name, &format!("{map}\n[force.certificate]\n{certificate}"));
    }
    bench.ok("import first --map D-K-1.toml --out certified -q");
    bench.refused(
        "import second --map D-K-2.toml --extend certified",
        3,
        "add these rows with `--new-certificate`",
    );
    bench.ok("import second --map D-K-2.toml --extend certified --new-certificate -q");
    let scored = bench.json("evaluate certified --model ridge --set size=8 --metrics mae");
    let traceability = &scored["provenance"]["traceability"];
    let number = |at: usize| &traceability[at]["certificate"]["number"];
    assert_eq!((number(0), number(1)), (&"D-K-1".into(), &"D-K-2".into()));
}

#[test]
fn states_of_before_and_after_share_rows_and_are_not_joined() {
    let bench = halves();
    bench.ok("fit data --model ridge --set size=8 --out m.model -q");
    bench.ok("evaluate data --with m.model --state-out before.state -q");
    bench.ok("import second --map map.toml --extend data -q");
    bench.ok("evaluate data --with m.model --state-out after.state -q");
    bench.refused("merge before.state after.state", 3, "are already in");
}

#[test]
fn the_same_rows_and_rows_of_something_else_are_refused_and_change_nothing() {
    let bench = halves();
    let before = fs::read(bench.path("data/dataset.toml")).expect("a header");
    bench.refused(
        "import first --map map.toml --extend data",
        3,
        "sample `s00`, new row 0, is already row 0 of the dataset",
    );
    // The same pictures and labels under other names.
    let labels = fs::read_to_string(bench.path("first/labels.csv")).expect("drawn");
    let (head, rows) = labels.split_once('\n').expect("a header");
    let renamed = format!("{head}\n{}", rows.replace(",s", ",again"));
    bench.write("first/labels.csv", &renamed);
    bench.refused(
        "import first --map map.toml --extend data",
        3,
        "42 of 42 rows are already in it",
    );
    // And under other labels, as in a second import of the same recording.
    let relabelled = format!(
        "{head}\n{}",
        rows.replace(",p", "e1,p").replace(",s", ",again")
    );
    bench.write("first/labels.csv", &relabelled);
    bench.refused(
        "import first --map map.toml --extend data",
        3,
        "42 different pictures are already in the dataset, and no recording is added twice",
    );
    let map = fs::read_to_string(bench.path("map.toml")).expect("a map");
    for (key, from, to) in [
        ("sensor.model", "model = \"drawn\"", "model = \"other\""),
        ("sensor.serial", "serial = \"unknown\"", "serial = \"7\""),
        ("sensor.opaque", "opaque = true", "opaque = false"),
        (
            "channels",
            "unit = \"mm\" }",
            "unit = \"mm\" }\nFx = { from = \"place_mm\", unit = \"N\" }",
        ),
        ("clock", "clock = \"unknown\"", "clock = \"unix\""),
    ] {
        bench.write("other.toml", &map.replacen(from, to, 1));
        let refused = bench.run("import second --map other.toml --extend data -q");
        assert_eq!(refused.code, 3, "{key}: {}", refused.err);
        assert!(
            refused.err.contains(&format!("`{key}` is ")),
            "{key}: {}",
            refused.err
        );
    }
    bench.refused(
        "import second --map map.toml --extend nothing",
        3,
        "nothing",
    );
    bench.refused(
        "import second --map map.toml --extend data --out new",
        2,
        "cannot be used with",
    );
    bench.record("recorded", 32);
    assert_eq!(
        fs::read(bench.path("data/dataset.toml")).expect("a header"),
        before
    );
    assert_eq!(
        crate::support::leftovers(
            &bench.path("."),
            &[
                "lab",
                "first",
                "second",
                "drawn",
                "data",
                "map.toml",
                "other.toml",
                "recorded"
            ]
        )
        .into_iter()
        .filter(|name| name.starts_with('.'))
        .collect::<Vec<_>>(),
        Vec::<String>::new()
    );
}

#[test]
fn a_column_that_another_map_reads_otherwise_is_refused_by_its_key() {
    let bench = halves();
    let before = fs::read(bench.path("data/dataset.toml")).expect("a header");
    let map = fs::read_to_string(bench.path("map.toml")).expect("a map");
    let line = map
        .lines()
        .find(|line| line.starts_with("Fz = "))
        .expect("a force");
    let unit = line.split('"').nth(3).expect("a unit");
    let other_unit = if unit == "N" { "mN" } else { "N" };
    for (key, other) in [
        (
            "columns.Fz.unit",
            line.replace(
                &format!("unit = \"{unit}\""),
                &format!("unit = \"{other_unit}\", scale = 1"),
            ),
        ),
        ("columns.Fz.sign", line.replace(" }", ", sign = -1 }")),
        ("columns.Fz.scale", line.replace(" }", ", scale = 2.0 }")),
        ("columns.Fz.offset", line.replace(" }", ", offset = 0.5 }")),
    ] {
        let text = map.replacen(line, &other, 1);
        bench.write("other.toml", &text);
        let refused = bench.run("import second --map other.toml --extend data -q");
        assert_eq!(refused.code, 3, "{key}: {}", refused.err);
        for word in [&format!("`{key}` is "), "rename it in the table"] {
            assert!(refused.err.contains(word), "{key}: {}", refused.err);
        }
    }
    let after = fs::read(bench.path("data/dataset.toml")).expect("a header");
    assert_eq!(after, before);
    // A column of another name may have another unit.
    let labels = fs::read_to_string(bench.path("second/labels.csv")).expect("drawn");
    let column = line.split('"').nth(1).expect("a column");
    bench.write(
        "second/labels.csv",
        &labels.replacen(column, "force_of_the_new_transducer", 1),
    );
    let renamed = map.replace(&format!("\"{column}\""), "\"force_of_the_new_transducer\"");
    let renamed = renamed.replace(
        &format!("unit = \"{unit}\""),
        &format!("unit = \"{other_unit}\", scale = 1"),
    );
    bench.write("renamed.toml", &renamed);
    bench.ok("import second --map renamed.toml --extend data -q");
    let dataset = taceva_dataset::Dataset::open(&bench.path("data")).expect("a dataset");
    let ways = dataset.header().columns.iter();
    let ways: Vec<(&str, &str)> = ways
        .filter(|way| way.label == "Fz")
        .map(|way| (way.from[0].as_str(), way.unit.as_str()))
        .collect();
    assert_eq!(
        ways,
        [(column, unit), ("force_of_the_new_transducer", other_unit)]
    );
}

#[test]
fn what_is_exported_of_it_and_read_again_is_other_data_to_a_model_and_that_is_said() {
    let bench = halves();
    bench.ok("import second --map map.toml --extend data -q");
    bench.ok("fit data --model ridge --set size=8 --out m.model -q");
    bench.ok("export data --format csv --out exported -q");
    bench.ok("import exported --map exported/map.toml --out again -q");
    let read = |name: &str| taceva_dataset::Dataset::open(&bench.path(name)).expect("a dataset");
    let (extended, again) = (read("data"), read("again"));
    assert_eq!(again.table().digest(), extended.table().digest());
    // An export does not store which rows came first, and that order decides the parts.
    assert_ne!(again.digest(), extended.digest());
    let scored = |name: &str| {
        bench.json(&format!("evaluate {name} --with m.model --metrics mae"))["provenance"].clone()
    };
    let notes = scored("again")["notes"].to_string();
    let fitted_on = extended.digest().to_string();
    assert!(
        notes.contains("every sample is scored") && notes.contains(&fitted_on),
        "{notes}"
    );
    let own = scored("data");
    assert_eq!(own["part"], "test");
    assert!(!own["notes"].to_string().contains("every sample"), "{own}");
}
