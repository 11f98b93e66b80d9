//! Tests of maps of version 2: labels in paths and cells, tables of other forms, joins, matrices, classes, and rejections.

mod added;
mod arrays;
mod certificates;
mod classes;
mod codecs;
mod dropped;
mod joins;
mod left_out;
mod page;
mod patterns;
mod references;
mod signals;
mod stated;
mod tasks;
mod texts;
mod times;

use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{ImportMap, ImportPlan, ImportSummary};

const FACTS: &str = r#"
[sensor]
model = "drawn gel"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#;
const NO_TIME: &str = "[time]\nclock = \"unknown\"\n";

/// Folder with `files`, each with its path and its text.
pub(crate) fn lab(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (path, text) in files {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().expect("inside")).expect("made");
        std::fs::write(path, text).expect("written");
    }
    folder
}

fn planned(folder: &Path, map: &str) -> Result<ImportPlan, String> {
    let text = format!("map_version = 2\n{map}\n{FACTS}");
    let map = ImportMap::parse("map.toml".as_ref(), &text).map_err(|error| error.to_string())?;
    ImportPlan::new(folder, &map).map_err(|error| error.to_string())
}

/// Summary of an import, with the requested columns as text cells.
fn imported(
    files: &[(&str, &str)],
    map: &str,
    columns: &[&str],
) -> (ImportSummary, Vec<Vec<String>>) {
    imported_from(lab(files).path(), map, columns)
}

/// Imports an existing folder like [`imported`].
fn imported_from(folder: &Path, map: &str, columns: &[&str]) -> (ImportSummary, Vec<Vec<String>>) {
    let plan = planned(folder, map).expect("an import");
    let summary = plan.summary().clone();
    let target = tempfile::tempdir().expect("a folder");
    let target = target.path().join("dataset");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&target).expect("a dataset");
    let column = |name: &&str| {
        let cells = dataset.table().as_text(name).expect("a column");
        cells.into_iter().map(Option::unwrap_or_default).collect()
    };
    (summary, columns.iter().map(column).collect())
}

fn refused(files: &[(&str, &str)], map: &str) -> String {
    planned(lab(files).path(), map).expect_err("refused")
}

#[test]
fn labels_stand_in_the_path_of_a_table_and_a_row_knows_its_place() {
    let map = format!(
        "table = \"*/*.csv\"\n[path]\npattern = \"{{object}}/u{{unit:digits}}_{{depth:number}}.csv\"\n[columns]\nPz = {{ from = \"path.depth\", unit = \"mm\" }}\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[ids]\nunit_id = \"path.unit\"\n[attributes]\nobject = \"path.object\"\nnumber = \"row\"\nplace = \"file\"\n{NO_TIME}"
    );
    let files = [
        ("ball/u1_-0.5.csv", "Fz\n1\n2\n"),
        ("cube/u12_2e-1.csv", "Fz\n3\n"),
    ];
    let columns = ["Pz", "Fz", "unit_id", "object", "number", "place"];
    let (summary, found) = imported(&files, &map, &columns);
    assert_eq!(summary.rows_kept, 3);
    assert_eq!(found[0], ["-0.5", "-0.5", "0.2"]);
    assert_eq!(found[1], ["1.0", "2.0", "3.0"]);
    assert_eq!(found[2], ["1", "1", "12"]);
    assert_eq!(found[3], ["ball", "ball", "cube"]);
    assert_eq!(found[4], ["0", "1", "0"]);
    assert_eq!(
        found[5],
        ["ball/u1_-0.5.csv", "ball/u1_-0.5.csv", "cube/u12_2e-1.csv"]
    );
}

#[test]
fn a_table_without_a_header_is_read_by_position_and_cells_are_unpacked() {
    let map = "table = { file = \"ft.csv\", header = false }\n[columns]\nFx = { from = \"1[0]\", unit = \"N\" }\nFz = { from = \"1[1]\", unit = \"gf\", offset = 100, scale = 2, sign = -1 }\n[time]\nclock = \"unix\"\ncolumn = 0\nunit = \"s\"\n";
    let files = [(
        "ft.csv",
        "np.float64(1.5),\"[0.1, 200]\"\n2.5,\"[0.2, 50]\"\n",
    )];
    let (summary, found) = imported(&files, map, &["Fx", "Fz", "t_s"]);
    assert_eq!(found[0], ["0.1", "0.2"]);
    // −2 · (200 − 100) and −2 · (50 − 100) gf, at 9.80665 mN a gf.
    assert_eq!(found[1], ["-1.96133", "0.980665"]);
    assert_eq!(found[2], ["1.5", "2.5"]);
    let words = summary.to_string();
    assert!(
        words.contains("Fz [N] = −2 · (`1[1]` − 100) [gf]"),
        "{words}"
    );
}

#[test]
fn json_and_json_lines_are_read_by_pointers() {
    let columns = "[columns]\nFz = { from = \"/ft[2]\", unit = \"N\" }\nPx = { from = \"/pose/0/1\", unit = \"mm\" }\n";
    let row = |fz: &str| format!(r#"{{"ft": [0, 0, {fz}], "pose": [[9, 7.25], []], "who": null}}"#);
    let lines = format!("{}\n\n{}\n", row("0.1"), row("0.30000000000000004"));
    let map = format!("table = \"labels.jsonl\"\n{columns}{NO_TIME}");
    let (_, found) = imported(&[("labels.jsonl", &lines)], &map, &["Fz", "Px"]);
    assert_eq!(found, [["0.1", "0.30000000000000004"], ["7.25", "7.25"]]);
    let whole = format!(r#"{{"a/b": {}, "c": {}}}"#, row("1"), row("2"));
    let map = format!(
        "table = {{ file = \"data.json\", rows = \"/*\" }}\n{columns}[attributes]\nname = \"key\"\nwho = \"/who\"\n{NO_TIME}"
    );
    let (_, found) = imported(&[("data.json", &whole)], &map, &["Fz", "name"]);
    assert_eq!(found, [["1.0", "2.0"], ["a/b", "c"]]);
}

#[test]
fn another_table_is_joined_by_a_key_and_what_has_none_is_left_out_and_counted() {
    let map = format!(
        "table = \"images.csv\"\n[[join]]\nname = \"press\"\ntable = \"presses.csv\"\non = {{ press = \"id\" }}\nunmatched = \"drop\"\n[columns]\nFz = {{ from = \"press.force\", unit = \"N\" }}\n[ids]\nsample = \"name\"\n{NO_TIME}"
    );
    let files = [
        ("images.csv", "name,press\na,1\nb,2\nc,7\nd,1.0\n"),
        ("presses.csv", "id,force\n2,0.2\n1,0.1\n3,0.3\n"),
    ];
    let (summary, found) = imported(&files, &map, &["sample", "Fz"]);
    assert_eq!(found, [["a", "b", "d"], ["0.1", "0.2", "0.1"]]);
    assert_eq!(summary.dropped.get("join press"), Some(&1));
    let join = &summary.joins[0];
    assert_eq!((join.matched, join.unmatched, join.unused), (3, 1, 1));
    assert!(summary.unmentioned_columns.is_empty(), "{summary}");
}

#[test]
fn another_table_is_joined_by_time_with_the_lag_of_its_clock() {
    let map = |pick: &str| {
        format!(
            "table = \"camera.csv\"\n[[join]]\nname = \"ft\"\ntable = {{ file = \"ft.csv\", header = false }}\ntime = {{ column = 0, unit = \"s\" }}\npick = \"{pick}\"\ntolerance_ms = 6\nlag_ms = 40\nunmatched = \"drop\"\nskip = {{ \"1\" = -1 }}\n[columns]\nFz = {{ from = \"ft.1\", unit = \"N\" }}\n[time]\nclock = \"unix\"\ncolumn = \"stamp\"\nunit = \"ms\"\n"
        )
    };
    // The clock of the force transducer shows each instant 40 ms later; its value at 1.05 s is a placeholder.
    let ft = "1.04,10\n1.045,20\n1.05,-1\n1.055,40\n1.2,50\n";
    let files = [
        ("camera.csv", "stamp\n1000\n1004\n1009\n1100\n"),
        ("ft.csv", ft),
    ];
    let (summary, found) = imported(&files, &map("nearest"), &["Fz"]);
    assert_eq!(found[0], ["10.0", "20.0", "20.0"]);
    let join = &summary.joins[0];
    assert_eq!((join.matched, join.unmatched, join.unused), (3, 1, 2));
    assert!((join.greatest_gap_s.expect("by time") - 0.004).abs() < 1e-9);
    let (_, found) = imported(&files, &map("before"), &["Fz"]);
    assert_eq!(found[0], ["10.0", "10.0", "20.0"]);
    let (_, found) = imported(&files, &map("linear"), &["Fz"]);
    let between: Vec<f64> = found[0]
        .iter()
        .map(|cell| cell.parse().expect("a number"))
        .collect();
    // 1049 ms lies between 1045 and 1055, 6 ms from the later: 20 + 0.4 · 20.
    assert!(
        (between[1] - 18.0).abs() < 1e-6 && (between[2] - 28.0).abs() < 1e-6,
        "{between:?}"
    );
}

#[test]
fn rows_and_a_single_row_are_joined_and_the_name_of_the_table_may_follow_the_path() {
    let map = format!(
        "table = \"*/labels.csv\"\n[path]\npattern = \"{{run}}/labels.csv\"\n[[join]]\nname = \"width\"\ntable = \"{{path.run}}/widths.csv\"\non = \"row\"\n[[join]]\nname = \"about\"\ntable = {{ file = \"{{path.run}}/about.json\", rows = \"\" }}\non = \"all\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\nwidth = {{ from = \"width.w\", unit = \"m\" }}\n[attributes]\ngel = \"about./gel/kind\"\n{NO_TIME}"
    );
    let files = [
        ("a/labels.csv", "Fz\n1\n2\n"),
        ("a/widths.csv", "w\n0.01\n0.02\n"),
        ("a/about.json", r#"{"gel": {"kind": "clear"}}"#),
        ("b/labels.csv", "Fz\n3\n"),
        ("b/widths.csv", "w\n0.03\n"),
        ("b/about.json", r#"{"gel": {"kind": "marked"}}"#),
    ];
    let (summary, found) = imported(&files, &map, &["Fz", "width", "gel"]);
    assert_eq!(found[0], ["1.0", "2.0", "3.0"]);
    assert_eq!(found[1], ["10.0", "20.0", "30.0"]);
    assert_eq!(found[2], ["clear", "clear", "marked"]);
    assert_eq!((summary.joins[0].matched, summary.joins[1].unused), (3, 0));
}

#[test]
fn a_matrix_gives_channels_in_the_order_in_which_they_are_written() {
    let map = format!(
        "table = \"v.csv\"\n[[matrix]]\nfrom = [\"v0\", \"v1\"]\noffset = [1, 0]\nby = \"m.csv\"\ngives = {{ Fz = \"N\", Fx = \"mN\" }}\n{NO_TIME}"
    );
    let files = [("v.csv", "v0,v1\n3,5\n,5\n"), ("m.csv", "1,10\n100,1000\n")];
    let (_, found) = imported(&files, &map, &["Fz", "Fx"]);
    assert_eq!(found, [["52.0", ""], ["5.2", ""]]);
    let map = map.replace("\"m.csv\"", "[[1, 2, 3]]");
    assert!(refused(&files, &map).contains("expected 2 rows, one per channel, of 2 numbers"));
}

#[test]
fn classes_are_of_the_list_by_name_or_position_and_a_stranger_is_refused() {
    let map = format!(
        "table = \"t.csv\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[classes]\ntexture = {{ from = \"c\", names = [\"smooth\", \"rough\"] }}\n{NO_TIME}"
    );
    let (_, found) = imported(&[("t.csv", "Fz,c\n1,rough\n1,0\n1,\n")], &map, &["texture"]);
    assert_eq!(found[0], ["rough", "smooth", ""]);
    let message = refused(&[("t.csv", "Fz,c\n1,rough\n1,2\n")], &map);
    assert!(
        message.contains("line 3") && message.contains("smooth, rough"),
        "{message}"
    );
}

#[test]
fn joins_that_match_twice_or_nothing_and_times_that_go_back_are_refused_with_their_place() {
    let keyed = format!(
        "table = \"a.csv\"\n[[join]]\nname = \"b\"\ntable = \"b.csv\"\non = {{ k = \"k\" }}\n[columns]\nFz = {{ from = \"b.f\", unit = \"N\" }}\n{NO_TIME}"
    );
    let main = ("a.csv", "k\n1\n");
    let message = refused(&[main, ("b.csv", "k,f\n1,1\n1,2\n")], &keyed);
    assert!(
        message.contains("line 2") && message.contains("line 3"),
        "{message}"
    );
    let message = refused(&[main, ("b.csv", "k,f\n2,1\n")], &keyed);
    assert!(
        message.contains("a.csv, line 2") && message.contains("unmatched = \"drop\""),
        "{message}"
    );
    let dropped = keyed.replace("on =", "unmatched = \"drop\"\non =");
    let message = refused(&[main, ("b.csv", "k,f\n2,1\n")], &dropped);
    assert!(message.contains("join b 1"), "{message}");
    let timed = "table = \"a.csv\"\n[[join]]\nname = \"b\"\ntable = \"b.csv\"\ntime = { column = \"t\", unit = \"s\" }\ntolerance_ms = 1\nlag_ms = 0\n[columns]\nFz = { from = \"b.f\", unit = \"N\" }\n[time]\nclock = \"unix\"\ncolumn = \"k\"\nunit = \"s\"\n";
    let message = refused(&[main, ("b.csv", "t,f\n2,1\n1,1\n")], timed);
    assert!(
        message.contains("b.csv, line 3") && message.contains("decreases"),
        "{message}"
    );
}

#[test]
fn names_that_lead_nowhere_say_what_there_is() {
    let of = |from: &str| {
        let map = format!(
            "table = \"a.csv\"\n[path]\npattern = \"{{name}}.csv\"\n[[join]]\nname = \"b\"\ntable = \"b.csv\"\non = \"row\"\n[columns]\nFz = {{ from = \"{from}\", unit = \"N\" }}\n{NO_TIME}"
        );
        refused(
            &[("a.csv", "force,ft\n1,\"[1, 2]\"\n"), ("b.csv", "w\n1\n")],
            &map,
        )
    };
    assert!(of("forse").contains("did you mean `force`"));
    assert!(of("path.nam").contains("names name"));
    assert!(of("b.v").contains("the columns are w"));
    assert!(of("ft[2]").contains("no value [2] among the 2"));
    assert!(of("ft").contains("is not a finite number"));
}

#[test]
fn paths_that_leave_the_folder_or_do_not_follow_the_pattern_are_refused() {
    let map = format!(
        "table = \"a.csv\"\n[path]\npattern = \"{{n:digits}}.csv\"\n[columns]\nFz = {{ from = \"path.n\", unit = \"N\" }}\n{NO_TIME}"
    );
    let message = refused(&[("a.csv", "x\n1\n")], &map);
    assert!(
        message.contains("`a.csv` does not follow the pattern"),
        "{message}"
    );
    let map = format!(
        "table = \"a.csv\"\n[path]\npattern = \"{{n}}.png\"\nof = \"x\"\n[[join]]\nname = \"b\"\ntable = \"{{path.n}}.csv\"\non = \"row\"\n[columns]\nFz = {{ from = \"b.w\", unit = \"N\" }}\n{NO_TIME}"
    );
    let message = refused(&[("a.csv", "x\n...png\n")], &map);
    assert!(
        message.contains("no such file") || message.contains("expected a path inside"),
        "{message}"
    );
}

#[test]
fn a_map_of_version_1_is_refused_with_what_to_write() {
    for (more, expected) in [
        (
            "table = \"a.csv\"",
            "line 1: map version 1 is no longer read: write `map_version = 2`",
        ),
        (
            "table = \"a.csv\"\n[frame]\narray = \"x.npy\"\nindex = \"n\"\nchannel_order = \"gray\"\nreference = \"unknown\"",
            "write `map_version = 2`, and in [frame] `array = { file = \"x.npy\" }` instead of `array = \"x.npy\"`",
        ),
    ] {
        let text = format!("map_version = 1\n{more}\n{NO_TIME}{FACTS}");
        let error = ImportMap::parse("map.toml".as_ref(), &text).expect_err(more);
        assert!(error.to_string().contains(expected), "{error}");
    }
}

#[test]
fn a_join_that_is_written_wrongly_names_its_line_and_what_is_missing() {
    let of = |join: &str| {
        let map = format!(
            "table = \"a.csv\"\n[[join]]\nname = \"b\"\ntable = \"b.csv\"\n{join}\n[columns]\nFz = {{ from = \"k\", unit = \"N\" }}\n{NO_TIME}"
        );
        refused(&[("a.csv", "k\n1\n")], &map)
    };
    assert!(of("time = { column = \"t\", unit = \"s\" }").contains("tolerance_ms"));
    assert!(of("").contains("line 3: a join has `on`, or `time`"));
    assert!(of("on = \"rows\"").contains("\"row\" or \"all\""));
    assert!(
        of("on = \"row\"\n[[join]]\nname = \"b\"\ntable = \"c.csv\"\non = \"row\"")
            .contains("two joins are called `b`")
    );
}

#[test]
fn keys_beyond_the_digits_of_a_double_are_distinguished_and_empty_ones_match_nothing() {
    let map = format!(
        "table = \"a.csv\"\n[[join]]\nname = \"b\"\ntable = \"b.csv\"\non = {{ id = \"id\" }}\nunmatched = \"drop\"\n[columns]\nFz = {{ from = \"b.Fz\", unit = \"N\" }}\n{NO_TIME}"
    );
    let files = [
        (
            "a.csv",
            "id\n1700000000000000001\n1700000000000000003\n12e4\n\"\"\n",
        ),
        ("b.csv", "id,Fz\n1700000000000000003,3\n120000,4\n\"\",5\n"),
    ];
    let (summary, found) = imported(&files, &map, &["Fz"]);
    assert_eq!(found[0], ["3.0"]);
    assert_eq!(
        (summary.joins[0].matched, summary.joins[0].unmatched),
        (1, 3)
    );
}

#[test]
fn of_two_rows_at_one_time_the_first_counts() {
    let map = "table = \"a.csv\"\n[[join]]\nname = \"b\"\ntable = \"b.csv\"\ntime = { column = \"t\", unit = \"s\" }\npick = \"nearest\"\ntolerance_ms = 500\nlag_ms = 0\n[columns]\nFz = { from = \"b.Fz\", unit = \"N\" }\n[time]\nclock = \"unknown\"\ncolumn = \"t\"\nunit = \"s\"\n";
    let files = [
        ("a.csv", "t\n0.9\n1.0\n1.1\n"),
        ("b.csv", "t,Fz\n1,10\n1,11\n"),
    ];
    let (_, found) = imported(&files, map, &["Fz"]);
    assert_eq!(found[0], ["10.0", "10.0", "10.0"]);
}

#[test]
fn a_row_without_a_path_is_left_out_by_its_rule_and_is_no_error_of_the_pattern() {
    let map = format!(
        "table = \"a.csv\"\n[path]\nof = \"name\"\npattern = \"x{{x:number}}.png\"\n[columns]\nPx = {{ from = \"path.x\", unit = \"mm\" }}\n{NO_TIME}"
    );
    let files = [("a.csv", "name\nx1.5.png\n\"\"\n")];
    let (summary, found) = imported(&files, &map, &["Px"]);
    assert_eq!(
        (summary.rows_kept, found[0].as_slice()),
        (2, ["1.5".to_owned(), String::new()].as_slice())
    );
}
