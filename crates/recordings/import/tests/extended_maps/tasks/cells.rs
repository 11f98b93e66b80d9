//! Tests of cells: truth values, classes of joined tables, and positions whose unit is in the name of their column.

use super::super::{lab, planned, refused};
use super::{CLOTH, MOVED, POSES, TABLE, imported_to, map};

#[test]
fn true_and_false_are_the_second_and_the_first_of_two_outcomes() {
    let folder = tempfile::tempdir().expect("a folder");
    let lab = lab(&[("g.csv", "grasp,is_gripping\n1,True\n2,False\n3,1\n")]);
    let map = "table = \"g.csv\"\n[ids]\npoint_id = \"grasp\"\n[time]\nclock = \"unknown\"\n[task.held]\nkind = \"outcome\"\nfrom = \"is_gripping\"\nnames = [\"lost\", \"held\"]\n";
    let dataset = imported_to(lab.path(), map, &folder.path().join("set"));
    let held = &dataset.tasks()[0];
    let classes: Vec<Option<&str>> = (0..3).map(|row| held.class(row)).collect();
    assert_eq!(classes, [Some("held"), Some("lost"), Some("held")]);
}

#[test]
fn true_is_the_positive_outcome_at_any_position_and_a_class_with_such_a_name_is_itself() {
    let classes = |names: &str| {
        let lab = lab(&[("g.csv", "grasp,is_gripping\n1,True\n2,FALSE\n")]);
        let map = format!(
            "table = \"g.csv\"\n[ids]\npoint_id = \"grasp\"\n[time]\nclock = \"unknown\"\n[task.held]\nkind = \"outcome\"\n\
             from = \"is_gripping\"\n{names}\n"
        );
        let folder = tempfile::tempdir().expect("a folder");
        let dataset = imported_to(lab.path(), &map, &folder.path().join("set"));
        let held = &dataset.tasks()[0];
        let positive = held.task().positive.clone().expect("a positive class");
        let class = |row| held.class(row).expect("a class").to_owned();
        [positive, class(0), class(1)]
    };
    for (names, expected) in [
        (
            "names = [\"held\", \"lost\"]\npositive = \"held\"",
            ["held", "held", "lost"],
        ),
        ("names = [\"lost\", \"held\"]", ["held", "held", "lost"]),
        ("names = [\"true\", \"false\"]", ["false", "true", "false"]),
    ] {
        assert_eq!(classes(names), expected, "{names}");
    }
    let two = map(&[CLOTH]).replace("\"felt\", \"denim\", \"wool\"", "\"felt\", \"denim\"");
    let table = TABLE.replace("wool", "true");
    let message = refused(&[("labels.csv", &table)], &two);
    assert!(message.contains("`true`: no name of the task"), "{message}");
}

#[test]
fn classes_of_a_joined_table_are_picked_and_never_interpolated() {
    let files = [
        ("a.csv", "t,press\n0.5,a\n1.5,a\n"),
        ("b.csv", "t,cloth\n0.0,0\n1.2,2\n2.0,2\n"),
    ];
    let joined = CLOTH.replace("from = \"cloth\"", "from = \"b.cloth\"");
    let map = |pick: &str| {
        format!(
            "table = \"a.csv\"\n[[join]]\nname = \"b\"\ntable = \"b.csv\"\ntime = {{ column = \"t\", unit = \"s\" }}\npick = \"{pick}\"\n\
             tolerance_ms = 1500\nlag_ms = 0\n[ids]\npoint_id = \"press\"\n[time]\nclock = \"unknown\"\ncolumn = \"t\"\nunit = \"s\"\n{joined}"
        )
    };
    let folder = tempfile::tempdir().expect("a folder");
    let lab = lab(&files);
    let picked = imported_to(lab.path(), &map("nearest"), &folder.path().join("set"));
    let classes = [0, 1].map(|row| picked.tasks()[0].class(row));
    assert_eq!(classes, [Some("felt"), Some("wool")]);
    let message = refused(&files, &map("linear"));
    for word in ["b.csv", "class 2 follows 0", "write `pick = \"nearest\"`"] {
        assert!(message.contains(word), "{word}: {message}");
    }
}

#[test]
fn a_unit_in_the_name_of_a_position_that_contradicts_the_map_is_refused() {
    let table = POSES.replace("x,y,z", "x_m,y,z");
    let map = MOVED.replace("\"x\"", "\"x_m\"");
    let files = [("poses.csv", table.as_str())];
    let message = refused(&files, &map.replace("[\"m\"]", "\"mm\""));
    assert!(message.contains("column `x_m`"), "{message}");
    planned(lab(&files).path(), &map).expect("metres in both");
}
