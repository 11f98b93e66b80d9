//! Tests of invalid maps, and of invalid requests for several pictures.

use super::{ROWS, gripper, import, planned, refusal, two, write};
use taceva_dataset::DatasetError;

#[test]
fn lists_of_pictures_that_are_none_are_refused_with_their_line() {
    let lab = gripper();
    let map = two();
    for (from, to, expected) in [
        (
            "name = \"right\"",
            "name = \"left\"",
            "two views are called `left`",
        ),
        ("name = \"right\"\n", "", "each [[frame]] needs a `name`"),
        (
            "name = \"right\"",
            "name = \"right+\"",
            "`right+` is not a valid name of a view",
        ),
        (
            "name = \"right\"",
            "name = \"frame\"",
            "`frame` is not a valid name of a view",
        ),
        (
            "name = \"right\"",
            "nam = \"right\"",
            "`nam`: unknown key, did you mean `name`?",
        ),
        (
            "column = \"right_path\"\n",
            "",
            "expected one key for the frames",
        ),
    ] {
        assert!(map.contains(from), "{from}");
        let problem = refusal(lab.path(), &map.replacen(from, to, 1));
        assert!(
            problem.contains(expected) && problem.contains("map.toml, line "),
            "{from}: {problem}"
        );
        let line: u32 = problem
            .split("line ")
            .nth(1)
            .and_then(|rest| rest.split(':').next()?.parse().ok())
            .expect("a line");
        assert!((8..=12).contains(&line), "{from}: {problem}");
    }
    let (head, tail) = map.split_once("[[frame]]\nname = \"right\"").expect("two");
    let (_, tail) = tail.split_once("[columns]").expect("columns");
    let problem = refusal(lab.path(), &format!("{head}[columns]{tail}"));
    assert!(
        problem.contains("a list of one picture: write [frame]"),
        "{problem}"
    );
    let single = head.replace("[[frame]]", "[frame]");
    let problem = refusal(lab.path(), &format!("{single}[columns]{tail}"));
    assert!(problem.contains("write [[frame]] for each"), "{problem}");
}

#[test]
fn a_view_that_is_not_there_or_named_twice_or_not_named_lists_those_that_are() {
    let (lab, target) = (gripper(), tempfile::tempdir().expect("a folder"));
    let dataset = import(lab.path(), &two(), &target.path().join("set")).expect("imported");
    let unnamed = dataset.frame(0).expect_err("which one");
    assert!(matches!(unnamed, DatasetError::View { asked: None, .. }));
    let problem = unnamed.to_string();
    for expected in ["`left`, `right`", "`--view left`", "`--view left+right`"] {
        assert!(problem.contains(expected), "{problem}");
    }
    for (view, expected) in [
        ("up", "no view `up`, expected one of `left`, `right`"),
        ("left+up", "no view `up`"),
        ("Left", "no view `Left`"),
        ("left+", "no view ``"),
        ("left+left", "`left` is named twice"),
    ] {
        let problem = dataset.seen(view).expect_err(view).to_string();
        assert!(problem.contains(expected), "{problem}");
    }
    let one = two().replace("[[frame]]\nname = \"left\"", "[frame]");
    let (head, tail) = one.split_once("[[frame]]").expect("another");
    let (_, tail) = tail.split_once("[columns]").expect("columns");
    let path = target.path().join("one");
    let one = import(lab.path(), &format!("{head}[columns]{tail}"), &path).expect("imported");
    let problem = one.seen("left").expect_err("one picture").to_string();
    assert!(
        problem.contains("each sample has one picture, without a name"),
        "{problem}"
    );
}

/// Writes a table in which one row has no picture of the right finger.
fn with_a_gap(lab: &tempfile::TempDir) {
    let mut table = "left_path,right_path,Fz_N\n".to_owned();
    for row in 0..ROWS {
        let right = if row == 2 {
            String::new()
        } else {
            format!("right/{row:03}.png")
        };
        table += &format!("left/{row:03}.png,{right},{row}\n");
    }
    write(lab.path(), "labels.csv", table.as_bytes());
}

#[test]
fn a_row_without_the_picture_of_one_view_is_refused_with_its_column_and_the_rule_that_drops_it() {
    let lab = gripper();
    with_a_gap(&lab);
    let problem = refusal(lab.path(), &two());
    for expected in [
        "labels.csv, line 4, column `right_path`",
        "empty",
        "`frames_named = [\"\"]` under [drop]",
    ] {
        assert!(problem.contains(expected), "{problem}");
    }
    let map = format!("{}[drop]\nframes_named = [\"\"]\n", two());
    let plan = planned(lab.path(), &map).expect("planned");
    assert_eq!(plan.summary().rows_kept, u64::from(ROWS) - 1);
    assert_eq!(plan.summary().dropped["frame `` of view right"], 1);
    let target = tempfile::tempdir().expect("a folder");
    let dataset = import(lab.path(), &map, &target.path().join("set")).expect("imported");
    let samples = dataset.table().view("left").expect("a view").frames().len();
    assert_eq!(samples, dataset.table().rows());
}

#[test]
fn a_picture_that_is_missing_or_damaged_or_of_another_size_is_named_by_its_view() {
    for (name, bytes, expected) in [
        ("right/003.png", &b"no picture"[..], "right/003.png"),
        ("left/003.png", &super::right(3), "left/003.png"),
        ("right/004.png", &super::left(4), "right/004.png"),
    ] {
        let lab = gripper();
        write(lab.path(), name, bytes);
        let problem = refusal(lab.path(), &two());
        assert!(
            problem.contains(expected) && problem.contains("column `"),
            "{problem}"
        );
    }
    let lab = gripper();
    std::fs::remove_file(lab.path().join("right/005.png")).expect("removed");
    let problem = refusal(lab.path(), &two());
    assert!(
        problem.contains("column `right_path`") && problem.contains("no such file"),
        "{problem}"
    );
}
