//! Tests of angles that wrap around, and of rotations with two representations.

use std::num::NonZeroUsize;

use taceva_core::{Orientation, SilentProgress};
use taceva_dataset::Dataset;
use taceva_import::{ExportForm, ExportPlan};

use super::{FACTS, assert_near, case, imported, lab, map_of, planned};

const CASE: &str = "rotation-vector-sign-flip";

/// Map with a third angle, and with the angles declared as a rotation.
fn declared(map: &str) -> String {
    let with_rz = map.replace(
        "Ry = {",
        "Rz = { from = \"rob.rz\", unit = \"rad\" }\nRy = {",
    );
    with_rz.replace(
        "table = \"cam.csv\"",
        "table = \"cam.csv\"\nrotation = [\"Rx\", \"Ry\", \"Rz\"]",
    )
}

#[track_caller]
fn assert_steady(found: &[f64], expected: f64) {
    for value in found {
        assert!((value - expected).abs() < 0.01, "{value} for {expected}");
    }
}

#[test]
fn a_rotation_vector_of_half_a_turn_that_changes_its_sign_is_refused_or_stays_where_it_is() {
    let folder = case(CASE);
    let problem = planned(&folder, &map_of(CASE)).expect_err("refused");
    for words in ["line", "robot.csv", "more than half a turn of `Rx`"] {
        assert!(problem.contains(words), "{problem}");
    }
    for remedy in [
        "rotation = [",
        "period = 6.28318530717958",
        "pick = \"nearest\"",
    ] {
        assert!(problem.contains(remedy), "{problem}");
    }
    let nearest = std::fs::read_to_string(folder.join("map-nearest.toml")).expect("it is there");
    for map in [map_of(CASE), nearest] {
        let map = declared(&map);
        let rx = imported(&folder, &map, "Rx");
        assert_eq!(rx.len(), 24);
        assert_steady(&rx, 166.295);
        assert_steady(&imported(&folder, &map, "Ry"), -68.887);
        assert_steady(&imported(&folder, &map, "Rz"), 0.0);
    }
}

/// Map of a table `t.csv` with a time column, joined by time to the table `other`. The lines `above` precede `columns`.
fn joined(other: &str, columns: &str, above: &str) -> String {
    format!(
        "map_version = 2\ntable = \"t.csv\"\n{above}[columns]\n{columns}[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n[[join]]\nname = \"rob\"\n\
         table = {other}\ntime = {{ column = \"t\", unit = \"s\" }}\npick = \"linear\"\ntolerance_ms = 2000\nlag_ms = 0\n{FACTS}"
    )
}

const TIMES: &str = "t\n0.25\n0.75\n";

#[test]
fn a_yaw_across_180_degrees_is_refused_and_with_a_period_goes_the_short_way() {
    let files = [
        ("\"r.csv\"", "r.csv", "t,a\n0,170\n1,-170\n"),
        (
            "\"r.jsonl\"",
            "r.jsonl",
            "{\"t\": 0, \"a\": 170}\n{\"t\": 1, \"a\": -170}\n",
        ),
        ("\"r.csv\"", "r.csv", "t,a\n0,350\n1,10\n"),
    ];
    for (number, (other, name, text)) in files.into_iter().enumerate() {
        let folder = lab(&[("t.csv", TIMES), (name, text)]);
        // Columns of JSON are pointers.
        let joined = |other: &str, column: &str, above: &str| {
            let map = joined(other, column, above);
            match number {
                1 => map
                    .replace("\"rob.a\"", "\"rob./a\"")
                    .replace("time = { column = \"t\"", "time = { column = \"/t\""),
                _ => map,
            }
        };
        let column = "yaw = { from = \"rob.a\", unit = \"deg\" }\n";
        let problem = planned(folder.path(), &joined(other, column, "")).expect_err("refused");
        assert!(problem.contains("half a turn of `yaw`"), "{problem}");
        let column = "yaw = { from = \"rob.a\", unit = \"deg\", period = 360 }\n";
        let found = imported(folder.path(), &joined(other, column, ""), "yaw");
        let expected = match number {
            2 => [355.0, 5.0],
            _ => [175.0, -175.0],
        };
        for (found, expected) in found.iter().zip(expected) {
            assert_near(*found, expected);
        }
        assert_eq!(found.len(), 2);
    }
}

#[test]
fn radians_that_begin_again_and_a_scale_of_the_map_are_as_degrees() {
    let folder = lab(&[
        ("t.csv", TIMES),
        ("r.csv", "t,a,steps\n0,3.0,1700\n1,-3.0,-1700\n"),
    ]);
    for (cells, period, expected) in [
        (
            "from = \"rob.a\", unit = \"rad\"",
            "6.283185307179586",
            175.943_6,
        ),
        (
            "from = \"rob.steps\", unit = \"deg\", scale = 0.1",
            "360",
            175.0,
        ),
    ] {
        let map = |more: &str| joined("\"r.csv\"", &format!("a = {{ {cells}{more} }}\n"), "");
        let problem = planned(folder.path(), &map("")).expect_err("refused");
        assert!(problem.contains("half a turn"), "{problem}");
        let remedy = format!("`period = {period}`");
        assert!(problem.contains(&remedy), "{problem}");
        let found = imported(folder.path(), &map(&format!(", period = {period}")), "a");
        assert!((found[0] - expected).abs() < 1e-3, "{found:?}");
        assert!((found[0] + found[1]).abs() < 1e-9, "{found:?}");
    }
    // Less than half a turn apart, or no angle: interpolated as before.
    let near = lab(&[("t.csv", TIMES), ("r.csv", "t,a\n0,10\n1,20\n")]);
    let column = "a = { from = \"rob.a\", unit = \"deg\" }\n";
    let found = imported(near.path(), &joined("\"r.csv\"", column, ""), "a");
    assert_eq!(found, [12.5, 17.5]);
    let far = lab(&[("t.csv", TIMES), ("r.csv", "t,a\n0,-300\n1,300\n")]);
    let column = "a = { from = \"rob.a\", unit = \"mm\" }\n";
    let found = imported(far.path(), &joined("\"r.csv\"", column, ""), "a");
    assert_eq!(found, [-150.0, 150.0]);
}

const QUATERNION: &str = "rotation = [\"qx\", \"qy\", \"qz\", \"qw\"]\n";
const QUATERNION_COLUMNS: &str = "qx = { from = \"rob.x\", unit = \"1\" }\nqy = { from = \"rob.y\", unit = \"1\" }\nqz = { from = \"rob.z\", unit = \"1\" }\nqw = { from = \"rob.w\", unit = \"1\" }\n";

#[test]
fn a_quaternion_that_changes_its_sign_is_joined_by_the_shortest_turn() {
    // 30 and 60 degrees about z, the second by its negative.
    let (half, quarter) = (15.0_f64.to_radians(), 30.0_f64.to_radians());
    let text = format!(
        "t,x,y,z,w\n0,0,0,{},{}\n1,0,0,{},{}\n",
        half.sin(),
        half.cos(),
        -quarter.sin(),
        -quarter.cos()
    );
    let folder = lab(&[("t.csv", TIMES), ("r.csv", &text)]);
    let map = joined("\"r.csv\"", QUATERNION_COLUMNS, QUATERNION);
    let columns = ["qx", "qy", "qz", "qw"].map(|name| imported(folder.path(), &map, name));
    for (row, degrees) in [(0, 37.5), (1, 52.5)] {
        let parts = [0, 1, 2, 3].map(|part: usize| columns[part][row]);
        let found = Orientation::of_quaternion(parts).expect("a unit quaternion");
        let turn = Orientation::of_vector([0.0, 0.0, f64::to_radians(degrees)]);
        assert!(found.angle_to(turn).0 < 1e-6, "{parts:?}");
    }
    assert!(columns[3].iter().all(|w| *w > 0.0), "{columns:?}");
}

#[test]
fn a_rotation_vector_of_no_length_is_the_identity_and_a_quaternion_of_none_is_refused() {
    let folder = lab(&[
        ("t.csv", TIMES),
        ("r.csv", "t,x,y,z,w\n0,0,0,0,0\n1,0,0,0.2,0\n"),
    ]);
    let columns = "Rx = { from = \"rob.x\", unit = \"rad\" }\nRy = { from = \"rob.y\", unit = \"rad\" }\nRz = { from = \"rob.z\", unit = \"rad\" }\n";
    let map = joined(
        "\"r.csv\"",
        columns,
        "rotation = [\"Rx\", \"Ry\", \"Rz\"]\n",
    );
    let found = imported(folder.path(), &map, "Rz");
    assert_near(found[0], 0.05_f64.to_degrees());
    assert_near(found[1], 0.15_f64.to_degrees());
    let map = joined("\"r.csv\"", QUATERNION_COLUMNS, QUATERNION);
    for map in [map.clone(), map.replace("linear", "nearest")] {
        let problem = planned(folder.path(), &map).expect_err("refused");
        assert!(problem.contains("its norm is 0"), "{problem}");
    }
}

#[test]
fn rotations_and_periods_that_no_angles_are_are_refused_by_their_line() {
    let folder = lab(&[("t.csv", TIMES), ("r.csv", "t,x,y,z\n0,0,0,0\n1,0,0,0.2\n")]);
    let columns = "Rx = { from = \"rob.x\", unit = \"rad\" }\nRy = { from = \"t\", unit = \"rad\" }\nFz = { from = \"rob.z\", unit = \"N\" }\n";
    for (above, columns, words) in [
        (
            "rotation = [\"Rx\", \"Ry\", \"Rz\"]\n",
            columns,
            "add `Rz = {",
        ),
        (
            "rotation = [\"Rx\", \"Ry\", \"Fz\"]\n",
            columns,
            "`Fz` is a part of `rotation`",
        ),
        ("rotation = [\"Rx\", \"Ry\"]\n", columns, "lists 2 channels"),
        (
            "rotation = [\"Rx\", \"Rx\", \"Ry\"]\n",
            columns,
            "names `Rx` twice",
        ),
        (
            "rotation = [\"Rx\", \"Ry\", \"Rz\"]\n",
            "Rx = { from = \"rob.x\", unit = \"rad\" }\nRy = { from = \"t\", unit = \"rad\" }\nRz = { from = \"rob.z\", unit = \"rad\" }\n",
            "one table and one unit",
        ),
        (
            "",
            "Fz = { from = \"rob.z\", unit = \"N\", period = 360 }\n",
            "period = 360 of `Fz`",
        ),
        (
            "",
            "a = { from = \"rob.z\", unit = \"rad\", period = 360 }\n",
            "period = 360 of `a`: expected 6.283185307179586 in rad, or `unit = \"deg\"`",
        ),
        (
            "",
            "a = { from = \"rob.z\", unit = \"rad\", period = 7.1 }\n",
            "expected whole degrees in rad, such as 6.283185307179586",
        ),
        (
            "",
            "a = { from = \"rob.z\", unit = \"deg\", period = 6.2832 }\n",
            "period = 6.2832 of `a`: expected 360 in deg, or `unit = \"rad\"`",
        ),
        (
            "",
            "a = { from = \"rob.z\", unit = \"deg\", period = 90.5 }\n",
            "a whole number of degrees from 1 to 360",
        ),
    ] {
        let problem = planned(folder.path(), &joined("\"r.csv\"", columns, above));
        let problem = problem.expect_err("refused");
        assert!(problem.contains(words), "{problem}");
        assert!(problem.contains("line"), "{problem}");
    }
}

#[test]
fn the_dataset_says_which_channels_are_rotations_and_which_begin_again() {
    let folder = case(CASE);
    let map = declared(&map_of(CASE)).replace(
        "Fz = {",
        "tool = { from = \"rob.rz\", unit = \"rad\", period = 3.1416 }\nFz = {",
    );
    let target = tempfile::tempdir().expect("a folder");
    let target = target.path().join("dataset");
    let plan = planned(&folder, &map).expect("planned");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&target).expect("a dataset");
    let header = dataset.header();
    assert_eq!(header.rotations, [["Rx", "Ry", "Rz"]]);
    let tool = header.channels.by_name("tool").expect("a channel");
    assert_eq!(tool.period(), Some(180));
    assert_eq!(dataset.table().channels().by_name("tool"), Some(tool));
}

#[test]
fn an_exported_dataset_comes_back_with_its_periods_and_rotations() {
    let folder = lab(&[(
        "t.csv",
        "t,x,y,z,yaw\n0,0.1,0,0,179\n1,0.2,0,0,-179\n2,0.3,0,0,-170\n",
    )]);
    let parts =
        ["x", "y", "z"].map(|axis| format!("R{axis} = {{ from = \"{axis}\", unit = \"rad\" }}\n"));
    let map = format!(
        "map_version = 2\ntable = \"t.csv\"\nrotation = [\"Rx\", \"Ry\", \"Rz\"]\n[columns]\n{}yaw = {{ from = \"yaw\", unit = \"deg\", period = 360 }}\n\
         [time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n{FACTS}",
        parts.concat()
    );
    let dataset = folder.path().join("dataset");
    let plan = planned(folder.path(), &map).expect("planned");
    plan.run(&dataset, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let opened = Dataset::open(&dataset).expect("a dataset");
    let target = folder.path().join("exported");
    let plan = ExportPlan::new(&opened, ExportForm::Csv).expect("planned");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("exported");
    let map = std::fs::read_to_string(target.join("map.toml")).expect("written");
    let again = folder.path().join("again");
    let plan = planned(&target, &map).expect("planned");
    plan.run(&again, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let again = Dataset::open(&again).expect("a dataset");
    assert_eq!(again.header().rotations, opened.header().rotations);
    assert_eq!(again.header().channels, opened.header().channels);
}
