//! Recordings of grasps, as groups that a column names.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;

use taceva_results::Samples;

use crate::support::{Bench, Ran};

const MAP: &str = r#"map_version = 2
table = "grasps.csv"
[columns]
Fz = { from = "fz", unit = "N" }
[signals]
from = "c0..15"
unit = "uT"
places = [4, 4]
channels = ["p"]
order = "place-first"
[time]
clock = "unknown"
[attributes]
COLUMNS
[sensor]
model = "lab hand"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#;

/// Test folder with ten grasps of five objects. The force rises during each grasp from another start value. Half of the taxels respond to the force.
fn grasps(columns: &[&str]) -> Bench {
    let bench = Bench::new();
    let mut table = String::from("fz,grasp,object");
    (0..16).for_each(|at| write!(table, ",c{at}").expect("written"));
    for grasp in 0..10 {
        for row in 0..20 {
            let force = f64::from(grasp * 7 % 10) * 2.0 + f64::from(row) * 0.08;
            let object = grasp / 2;
            write!(table, "\n{force:.2},g{grasp},o{object}").expect("written");
            for at in 0..16_i32 {
                let own = f64::from((grasp * 5 + row * 3 + at * 11) % 17);
                write!(table, ",{:.2}", force * f64::from(at % 2) + own).expect("written");
            }
        }
    }
    table.push('\n');
    let lines = columns.iter().copied().map(|pair: &str| {
        let (name, from) = pair.split_once('=').unwrap_or((pair, pair));
        format!("{name} = \"{from}\"")
    });
    let lines: Vec<String> = lines.collect();
    bench.write("lab/grasps.csv", &table);
    bench.write("lab/map.toml", &MAP.replace("COLUMNS", &lines.join("\n")));
    bench.ok("import lab --map lab/map.toml --out data -q");
    bench
}

fn done(bench: &Bench, line: &str) -> String {
    let Ran { code, out, err } = bench.shell(line);
    assert_eq!(code, 0, "{line}\n{out}{err}");
    out
}

#[test]
fn columns_called_grasp_and_group_name_the_groups_of_the_default_split() {
    for (columns, expected) in [
        (&["grasp"][..], "cv:5 by-column:grasp"),
        (&["group=grasp"][..], "cv:5 by-column:group"),
        (&["group=grasp", "object"][..], "cv:5 by-column:object"),
        (&["grasp", "object"][..], "cv:5 by-column:grasp"),
    ] {
        let report = grasps(columns).json("evaluate data --model ridge --metrics mae");
        assert_eq!(report["provenance"]["split"], expected, "{columns:?}");
    }
}

#[test]
fn a_fit_validated_at_random_says_that_neighbours_were_learnt() {
    let bench = grasps(&["grasp"]);
    let said = bench.ok("fit data --model ridge --split random --out one.taceva");
    assert!(said.contains("the scores are optimistic"), "{said}");
    let line = "taceva fit data --model ridge --split 'cv:5 random' --out m.taceva";
    let said = done(&bench, line);
    for words in [
        "a model that had not seen its own label",
        "the scores are optimistic; divide with --split 'cv:5 by-column:grasp'",
        "tested on neighbours of training samples",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn a_cross_validated_fit_chooses_its_strength_by_the_groups_of_its_split() {
    let bench = grasps(&["grasp", "object"]);
    let fitted = |split: &str, out: &str| {
        let line = format!("taceva fit data --model ridge --split '{split}' --out {out}.taceva");
        done(&bench, &line)
    };
    let by_object = fitted("cv:5 by-column:object", "object");
    for words in [
        "a model that had not seen its group of `object`",
        "N, with each group of `object` left out in turn",
    ] {
        assert!(by_object.contains(words), "{words}: {by_object}");
    }
    assert!(!by_object.contains("optimistic"), "{by_object}");
    let of_all = fitted("all", "all");
    let words = "N, with each sample left out in turn";
    assert!(of_all.contains(words), "{words}: {of_all}");
}

#[test]
fn a_fit_validated_at_random_names_the_contact_points_that_chose_its_strength() {
    let bench = grasps(&["grasp"]);
    let points = "[time]\n";
    let map = MAP.replace("COLUMNS", "grasp = \"grasp\"");
    let map = map.replace(points, "[ids]\npoint_id = \"grasp\"\n[time]\n");
    bench.write("lab/points.toml", &map);
    bench.ok("import lab --map lab/points.toml --out points -q");
    let line = "taceva fit points --model ridge --split 'cv:5 random' --out m.taceva";
    let said = done(&bench, line);
    for words in [
        "a model that had not seen its own label",
        "N, with each contact point left out in turn",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn samples_whose_neighbours_resemble_each_other_are_not_independent() {
    let bench = grasps(&["grasp"]);
    bench.refused(
        "evaluate data --model ridge --metrics mae --independent",
        2,
        "--independent: neighbours in the table resemble each other (Fz by ",
    );
}

#[test]
fn files_of_a_cross_validation_state_the_group_and_the_fold_of_each_sample() {
    let bench = grasps(&["grasp", "object"]);
    let line = "taceva evaluate data --model ridge --metrics mae --split 'cv:5 by-column:object' --split-out split.json \
                --samples-out samples.csv --format json --out result.json -q";
    done(&bench, line);
    let read = |name: &str| fs::read_to_string(bench.path(name)).expect("written");
    let split: serde_json::Value = serde_json::from_str(&read("split.json")).expect("JSON");
    let folds = split["folds"].as_array().expect("folds");
    let sizes = folds.iter().map(|fold| fold.as_array().map_or(0, Vec::len));
    assert_eq!(sizes.collect::<Vec<_>>(), [40; 5]);
    let samples = Samples::read(&read("samples.csv")).expect("samples");
    let mut fold_of = BTreeMap::new();
    for row in 0..samples.rows() {
        let group = samples.word(Samples::GROUP, row).expect("a group");
        let fold = samples.word(Samples::FOLD, row).expect("a fold");
        assert_eq!(*fold_of.entry(group).or_insert(fold), fold, "{group}");
    }
    let folds: BTreeSet<&str> = fold_of.values().copied().collect();
    assert_eq!((fold_of.len(), folds.len()), (5, 5));
}

#[test]
fn intervals_name_the_column_of_their_groups_and_the_metrics_of_each_method() {
    let bench = grasps(&["grasp", "object"]);
    let line =
        "taceva evaluate data --model ridge --metrics mae,r2 --split 'cv:5 by-column:object'";
    let text = done(&bench, line);
    let lines: Vec<&str> = text
        .lines()
        .filter(|line| line.starts_with("intervals  "))
        .collect();
    let [first, ..] = lines.as_slice() else {
        panic!("{text}");
    };
    assert!(
        first.starts_with("intervals  jackknife by object, G=5"),
        "{first}"
    );
    let is_one = lines.len() == 1;
    assert!(
        is_one || lines.iter().all(|line| line.ends_with(')')),
        "{text}"
    );
}

#[test]
fn requested_metrics_that_the_main_table_leaves_out_are_named() {
    let bench = grasps(&["grasp"]);
    for table in ["--format tex", "--table main --format md"] {
        let ran = bench.run(&format!(
            "evaluate data --model ridge --metrics mae,rmse,bias,r2 {table}"
        ));
        assert_eq!(ran.code, 0, "{}", ran.err);
        let words = "the main table leaves out rmse, bias: --table all prints every score";
        assert!(ran.err.contains(words), "{table}: {}", ran.err);
    }
    let ran = bench.run("evaluate data --model ridge --metrics mae,r2 --format tex");
    assert!(!ran.err.contains("leaves out"), "{}", ran.err);
}

#[test]
fn a_page_table_names_scores_without_a_value_instead_of_their_rows() {
    let bench = grasps(&["grasp"]);
    let table = bench.ok("evaluate data --model ridge --metrics mae,crosstalk --format md -q");
    assert!(table.starts_with("| metric | Fz |\n"), "{table}");
    assert!(!table.contains("undefined"), "{table}");
    assert!(table.contains(" No value: crosstalk all."), "{table}");
}

#[test]
fn predictions_name_how_many_are_outside_and_their_truth_has_groups() {
    let bench = grasps(&["grasp"]);
    bench.ok("fit data --model ridge --channels Fz --out m.taceva -q");
    let own = bench.ok("predict data --with m.taceva --part all --out p.csv --truth-out t.csv");
    assert!(own.contains("200 predictions of the part `all`"), "{own}");
    let scored = bench.json("score --truth t.csv --pred p.csv --metrics mae");
    let mae = &scored["metrics"]["mae"]["Fz"];
    assert!(mae["ci95"].is_array(), "{mae}");
    // The same table with taxels ten times as loud is nothing that the model has seen.
    let table = fs::read_to_string(bench.path("lab/grasps.csv")).expect("there");
    let mut louder = String::new();
    for (number, line) in table.lines().enumerate() {
        let cells = line.split(',').enumerate().map(|(at, cell)| {
            let number = cell.parse::<f64>().ok().filter(|_| number > 0 && at > 2);
            number.map_or_else(|| cell.to_owned(), |number| format!("{:.1}", 10.0 * number))
        });
        louder += &cells.collect::<Vec<_>>().join(",");
        louder.push('\n');
    }
    bench.write("lab/grasps.csv", &louder);
    bench.ok("import lab --map lab/map.toml --out other -q");
    let said = bench.ok("predict other --with m.taceva --out q.csv");
    assert!(
        said.contains("samples are unlike those of the fit (distance > 1)"),
        "{said}"
    );
    assert!(
        said.contains("bounds   Fz clipped to the bound of "),
        "{said}"
    );
}

#[test]
fn a_split_by_grasps_says_that_their_objects_may_have_been_learnt() {
    let bench = grasps(&["grasp", "object"]);
    let text = bench.ok("evaluate data --model ridge --metrics mae");
    let note = "10 of 10 groups of `grasp` share their `object` with others";
    assert!(text.contains(note), "{text}");
    assert!(text.contains("--split 'cv:5 by-column:object'"), "{text}");
    let line = "taceva evaluate data --model ridge --metrics mae --split 'cv:5 by-column:object'";
    let text = done(&bench, line);
    assert!(!text.contains("share their"), "{text}");
}

#[test]
fn a_single_split_by_grasps_with_repeated_points_says_so_too() {
    let bench = grasps(&["grasp", "object"]);
    let map = fs::read_to_string(bench.path("lab/map.toml")).expect("there");
    bench.write(
        "lab/map.toml",
        &format!("{map}[ids]\npoint_id = \"grasp\"\n"),
    );
    bench.ok("import lab --map lab/map.toml --out points -q");
    let text = bench.ok("evaluate points --model ridge --metrics mae --split by-column:grasp");
    let note = "10 of 10 groups of `grasp` share their `object` with others";
    assert!(text.contains(note), "{text}");
}

#[test]
fn few_groups_have_their_errors_in_json_text_and_page() {
    let bench = grasps(&["grasp", "object"]);
    let line = "taceva evaluate data --model ridge --metrics mae --split 'cv:5 by-column:object' --html page.html";
    let text = done(&bench, line);
    assert!(
        text.contains("no intervals: an interval needs several groups"),
        "{text}"
    );
    let report: serde_json::Value =
        serde_json::from_str(&done(&bench, &format!("{line} --force --format json -q")))
            .expect("JSON");
    crate::schema::check("evaluation", &report);
    let groups = report["by_group"].as_array().expect("groups");
    assert_eq!(groups.len(), 5);
    assert_eq!(groups[0]["group"], "o0");
    let maes = groups
        .iter()
        .filter_map(|own| own["errors"][0]["mae"].as_f64());
    let mean = maes.sum::<f64>() / 5.0;
    let mae = report["metrics"]["mae"]["Fz"]["value"]
        .as_f64()
        .expect("a number");
    assert!((mean - mae).abs() < 1e-9, "{mean} {mae}");
    let page = fs::read_to_string(bench.path("page.html")).expect("written");
    assert!(page.contains("Errors of each group of the split"));
}

#[test]
fn text_states_the_limits_of_tolerance_and_of_the_gate() {
    let bench = grasps(&["grasp"]);
    let text = bench.ok("evaluate data --model ridge --metrics tolerance,smape_gated");
    for line in [
        "limit      tolerance: within 0.05 of the truth, in the unit of the channel",
        "limit      smape_gated: truth of at least 0.02, in the unit of the channel",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
}
