//! Tests of forces with a zero that the map subtracts, and with the weight of a tool.

use super::{FACTS, NO_TIME, assert_near, codes, imported, lab, planned, summary};

/// Table of forces around a zero that differs between the files `FIRST` and `SECOND`.
const FIRST: &str = "fz,gap,take\n0.10,2,a\n0.12,1,a\n1.11,0,a\n2.11,0,b\n0.11,3,b\n";
const SECOND: &str = "fz,gap,take\n1.60,2,c\n1.62,1,c\n2.61,0,c\n3.61,0,d\n1.61,3,d\n";

fn map(zero: &str) -> String {
    format!(
        "map_version = 2\ntable = \"*.csv\"\n[columns]\nFz = {{ from = \"fz\", unit = \"N\" }}\n{zero}{NO_TIME}{FACTS}"
    )
}

#[test]
fn the_first_rows_of_each_file_and_rows_without_contact_are_its_zero() {
    let folder = lab(&[("1.csv", FIRST), ("2.csv", SECOND)]);
    for zero in [
        "[zero]\nfrom = \"first 2\"\n",
        "[zero]\nfrom = \"without contact\"\ncolumn = \"gap\"\nabove = 0.5\n",
        "[zero]\nfrom = \"without contact\"\ncolumn = \"gap\"\nabove = 0.5\nchannels = [\"Fz\"]\n",
    ] {
        let found = imported(folder.path(), &map(zero), "Fz");
        let expected = [-0.01, 0.01, 1.0, 2.0, 0.0];
        for (found, expected) in found.iter().zip(expected.iter().chain(&expected)) {
            assert_near(*found, *expected);
        }
        assert_eq!(found.len(), 10, "{zero}");
        let summary = summary(folder.path(), &map(zero));
        let taken = &summary.zeros[0];
        assert_near(taken.least, 0.11);
        assert_near(taken.greatest, 1.61);
        assert_eq!((taken.channel.as_str(), taken.blocks), ("Fz", 2));
        assert!(
            summary
                .to_string()
                .contains("zero     Fz minus 0.1100 to 1.6100")
        );
        assert_eq!(codes(&summary), [""; 0]);
    }
}

#[test]
fn a_block_has_a_zero_of_its_own_in_csv_and_json_lines() {
    let lines = "{\"fz\": 0.5, \"gap\": 1, \"take\": \"a\"}\n{\"fz\": 1.5, \"gap\": 0, \"take\": \"a\"}\n{\"fz\": 2.5, \"gap\": 1, \"take\": \"b\"}\n{\"fz\": 2.0, \"gap\": 0, \"take\": \"b\"}\n";
    let json = lab(&[("t.jsonl", lines)]);
    let csv = lab(&[("t.csv", "fz,gap,take\n0.5,1,a\n1.5,0,a\n2.5,1,b\n2,0,b\n")]);
    for (folder, table, at) in [
        (&json, "\"t.jsonl\"", ""),
        (&csv, "\"t.csv\"", ""),
        (&csv, "\"t.csv\"", "sign = -1"),
    ] {
        let sign = match at {
            "" => String::new(),
            at => format!(", {at}"),
        };
        let map = format!(
            "map_version = 2\ntable = {table}\n[columns]\nFz = {{ from = \"fz\", unit = \"N\"{sign} }}\n[zero]\nfrom = \"first 1\"\nblock = \"take\"\n{NO_TIME}{FACTS}"
        );
        // Columns of JSON are pointers.
        let map = match table.contains("jsonl") {
            true => map
                .replace("\"fz\"", "\"/fz\"")
                .replace("\"take\"", "\"/take\""),
            false => map,
        };
        let found = imported(folder.path(), &map, "Fz");
        let turned = if at.is_empty() { 1.0 } else { -1.0 };
        for (found, expected) in found.iter().zip([0.0, 1.0, 0.0, -0.5]) {
            assert_near(*found, turned * expected);
        }
    }
}

#[test]
fn a_zero_beyond_the_recording_or_without_rows_or_columns_is_refused_with_the_line_to_write() {
    let folder = lab(&[("1.csv", FIRST), ("2.csv", SECOND)]);
    for (zero, words) in [
        ("from = \"first 6\"", "write `from = \"first 5\"` or fewer"),
        (
            "from = \"first 3\"\nblock = \"take\"",
            "block `b` keeps only 2",
        ),
        (
            "from = \"without contact\"",
            "needs a column that shows contact",
        ),
        (
            "from = \"without contact\"\ncolumn = \"gap\"\nabove = 50",
            "has none: correct the limit 50 of `gap`",
        ),
        (
            "from = \"without contact\"\ncolumn = \"gap\"\nabove = 1\nbelow = 3",
            "needs a column",
        ),
        (
            "from = \"without contact\"\ncolumn = \"gab\"\nbelow = 1",
            "gab",
        ),
        ("from = \"first 0\"", "expected `from = \"first 10\"`"),
        ("from = \"last 10\"", "expected `from = \"first 10\"`"),
        (
            "from = \"first 1\"\nchannels = [\"Fx\"]",
            "`Fx` is not a channel",
        ),
    ] {
        let problem = planned(folder.path(), &map(&format!("[zero]\n{zero}\n")));
        let problem = problem.expect_err("refused");
        assert!(problem.contains(words), "{zero}: {problem}");
    }
}

#[test]
fn rows_of_a_zero_that_differ_like_contacts_are_warned_of_and_the_dataset_keeps_the_warning() {
    let folder = lab(&[("1.csv", FIRST), ("2.csv", SECOND)]);
    let map = map("[zero]\nfrom = \"first 4\"\n");
    let found = summary(folder.path(), &map);
    assert_eq!(codes(&found), ["zero-spread"]);
    let target = tempfile::tempdir().expect("a folder");
    let target = target.path().join("dataset");
    let plan = planned(folder.path(), &map).expect("planned");
    plan.run(
        &target,
        std::num::NonZeroUsize::MIN,
        &taceva_core::SilentProgress,
    )
    .expect("imported");
    let dataset = taceva_dataset::Dataset::open(&target).expect("a dataset");
    let header = dataset.header();
    assert!(
        header.warnings[0].starts_with("zero-spread: "),
        "{:?}",
        header.warnings
    );
    assert_eq!(
        header.columns[0].zero.as_deref(),
        Some("mean of the first 4 rows of each table")
    );
}

/// Table of readings of a tool of 1 kg, 100 mm in front of the transducer: at rest, and turned by 90 degrees about x.
const TOOL: &str = "fx,fy,fz,tx,ty,tz,rx,ry,rz,x,y,z,w\n\
     0,0,-9.80665,0,0,0,0,0,0,0,0,0,1\n0,-9.80665,0,0.980665,0,0,1.5707963267948966,0,0,0.7071067811865476,0,0,0.7071067811865476\n\
     0,-9.80665,2,0.980665,0,0,1.5707963267948966,0,0,-0.7071067811865476,0,0,-0.7071067811865476\n";

fn gravity(rest: &str, sign: &str) -> String {
    let forces = ["x", "y", "z"].map(|axis| {
        format!(
            "F{axis} = {{ from = \"f{axis}\", unit = \"N\"{sign} }}\nT{axis} = {{ from = \"t{axis}\", unit = \"N·m\"{sign} }}\n"
        )
    });
    format!(
        "map_version = 2\ntable = \"t.csv\"\n[columns]\n{}[gravity]\n{rest}{NO_TIME}{FACTS}",
        forces.concat()
    )
}

#[test]
fn the_weight_of_a_tool_that_turns_leaves_the_force_of_contact_by_vector_and_quaternion() {
    let folder = lab(&[("t.csv", TOOL)]);
    let body = "mass = 1\ncentre = [0, 0, 100]\n";
    for orientation in [
        "orientation = [\"rx\", \"ry\", \"rz\"]\nunit = \"rad\"\n",
        "orientation = [\"x\", \"y\", \"z\", \"w\"]\n",
    ] {
        for (sign, expected) in [("", 2.0), (", sign = -1", -2.0)] {
            let map = gravity(&format!("{body}{orientation}"), sign);
            for (channel, last) in [("Fx", 0.0), ("Fy", 0.0), ("Fz", expected), ("Tx", 0.0)] {
                let found = imported(folder.path(), &map, channel);
                for (found, expected) in found.iter().zip([0.0, 0.0, last]) {
                    assert!((found - expected).abs() < 1e-9, "{channel}: {found}");
                }
            }
            let summary = summary(folder.path(), &map);
            assert!(
                summary
                    .to_string()
                    .contains("gravity  forces and torques minus")
            );
        }
    }
}

#[test]
fn gravity_without_orientation_or_with_half_of_one_is_refused() {
    let folder = lab(&[("t.csv", TOOL), ("e.csv", "")]);
    let body = "mass = 1\ncentre = [0, 0, 100]\n";
    for (rest, words) in [
        (body.to_owned(), "[gravity] needs `orientation`"),
        (
            format!("{body}orientation = [\"rx\", \"ry\"]\n"),
            "three columns",
        ),
        (
            format!("{body}orientation = [\"rx\", \"ry\", \"rz\"]\n"),
            "`unit = \"rad\"` or \"deg\"",
        ),
        (
            format!("{body}orientation = [\"rx\", \"ry\", \"rz\", \"w\"]\n")
                .replace("mass = 1", "mass = 0"),
            "`mass` must be in kg",
        ),
        (
            format!("{body}orientation = [\"fx\", \"fy\", \"rz\", \"rz\"]\n"),
            "is not a unit quaternion",
        ),
    ] {
        let problem = planned(folder.path(), &gravity(&rest, "")).expect_err("refused");
        assert!(problem.contains(words), "{problem}");
    }
}
