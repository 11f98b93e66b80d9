//! Tests of labels of tasks: read by a map, kept in the dataset, joined, added, exported, and refused.

mod cells;
mod maps;

use std::num::NonZeroUsize;
use std::path::Path;

use super::{lab, planned, refused};
use taceva_core::SilentProgress;
use taceva_dataset::{Dataset, TaskKind, TaskLabel, Version};
use taceva_import::{Addition, ExportForm, ExportPlan, ImportMap, ImportPlan};

const TABLE: &str = "force,stroke,slip_label,cloth,t\n\
    1,a,0,denim,0\n\
    2,a,1,denim,0.5\n\
    3,b,slip,felt,1\n\
    4,b,,wool,1.5\n";
const COLUMNS: &str = "table = \"labels.csv\"\n[columns]\nFz = { from = \"force\", unit = \"N\" }\n\
    [ids]\npoint_id = \"stroke\"\n[attributes]\ntrajectory = \"stroke\"\n\
    [time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n";
const SLIP: &str = "[task.slip]\nkind = \"event\"\nfrom = \"slip_label\"\nnames = [\"no_slip\", \"slip\"]\npositive = \"slip\"\n\
    cluster = \"trajectory\"\ntime = true\nrule = \"shear > 1.6 normal\"\n";
const CLOTH: &str =
    "[task.cloth]\nkind = \"class\"\nfrom = \"cloth\"\nnames = [\"felt\", \"denim\", \"wool\"]\n";
const POSES: &str = "x,y,z,qx,qy,qz,qw,stroke\n\
    0.001,0,0,0,0,0,1,a\n\
    0.002,0.5,-0.25,0,0,0.6,0.8,a\n\
    ,,,,,,,b\n";
const MOVED: &str = "table = \"poses.csv\"\n[ids]\npoint_id = \"stroke\"\n[time]\nclock = \"unknown\"\n\
    [task.moved]\nkind = \"pose\"\nfrom = { t = [\"x\", \"y\", \"z\"], q = [\"qx\", \"qy\", \"qz\", \"qw\"] }\nunit = [\"m\"]\nover = 5\n\
    frame = \"object in finger\"\nthresholds = { t = [\"0.1\", \"0.5\"], r = [\"0.03\", \"0.2\"] }\n";

fn map(tasks: &[&str]) -> String {
    format!("{COLUMNS}{}", tasks.concat())
}

fn imported_to(folder: &Path, map: &str, target: &Path) -> Dataset {
    let plan = planned(folder, map).expect("planned");
    plan.run(target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    Dataset::open(target).expect("a dataset")
}

/// Dataset `set` in `folder`, imported from `TABLE` with the tasks `SLIP` and `CLOTH`.
fn labelled(folder: &Path) -> Dataset {
    let lab = lab(&[("labels.csv", TABLE)]);
    imported_to(lab.path(), &map(&[SLIP, CLOTH]), &folder.join("set"))
}

/// Error of an import of `TABLE` after `from` in the map was replaced by `to`.
#[track_caller]
fn refused_with(from: &str, to: &str) -> String {
    let text = map(&[SLIP, CLOTH]);
    assert!(text.contains(from), "{from}");
    refused(&[("labels.csv", TABLE)], &text.replacen(from, to, 1))
}

#[test]
fn labels_of_tasks_are_read_by_name_and_position_and_kept_with_their_definition() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = labelled(folder.path());
    let [cloth, slip] = dataset.tasks() else {
        panic!("two tasks, by name");
    };
    let classes: Vec<Option<&str>> = (0..4).map(|row| slip.class(row)).collect();
    assert_eq!(classes, [Some("no_slip"), Some("slip"), Some("slip"), None]);
    assert_eq!(cloth.label(3), Some(TaskLabel::Class(2)));
    assert_eq!(cloth.task().cluster, "point_id");
    let task = slip.task();
    assert_eq!(
        (task.kind, task.is_timed, task.cluster.as_str()),
        (TaskKind::Event, true, "trajectory")
    );
    assert_eq!(task.positive.as_deref(), Some("slip"));
    assert_eq!(task.rule.as_deref(), Some("shear > 1.6 normal"));
    let clusters = dataset.clusters_of(task);
    assert_eq!(
        clusters,
        ["a", "a", "b", "b"].map(|text| Some(text.to_owned()))
    );
    assert_eq!(dataset.header().format, Version::WITH_TASKS);
}

#[test]
fn a_dataset_without_tasks_keeps_its_format_and_its_bytes_know_no_task() {
    let lab = lab(&[("labels.csv", TABLE)]);
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = imported_to(lab.path(), COLUMNS, &folder.path().join("set"));
    assert_eq!(dataset.header().format, Version::CURRENT);
    let header = std::fs::read_to_string(folder.path().join("set/dataset.toml")).expect("read");
    assert!(!header.contains("task"), "{header}");
    std::fs::create_dir(folder.path().join("other")).expect("made");
    let with = labelled(&folder.path().join("other"));
    // Readers of the earlier minor version compare the digest in the file, which covers no task.
    let other = std::fs::read_to_string(with.path().join("dataset.toml")).expect("read");
    assert!(
        other.contains(&format!("digest = \"{}\"", dataset.digest())),
        "{other}"
    );
    assert_ne!(with.digest(), dataset.digest());
    // A bundle compares this digest with that of the results.
    assert!(
        other.contains(&format!("digest_with_tasks = \"{}\"", with.digest())),
        "{other}"
    );
}

#[test]
fn other_labels_and_another_definition_give_another_digest() {
    let folder = tempfile::tempdir().expect("a folder");
    let digest = |name: &str, table: &str, map: &str| {
        let lab = lab(&[("labels.csv", table)]);
        imported_to(lab.path(), map, &folder.path().join(name)).digest()
    };
    let tasks = map(&[SLIP]);
    let one = digest("one", TABLE, &tasks);
    assert_eq!(digest("again", TABLE, &tasks), one);
    assert_ne!(
        digest("labels", &TABLE.replace("a,0,", "a,1,"), &tasks),
        one
    );
    assert_ne!(digest("rule", TABLE, &tasks.replace("1.6", "1.5")), one);
}

#[test]
fn the_summary_names_each_task_with_its_labels() {
    let lab = lab(&[("labels.csv", TABLE)]);
    let plan = planned(lab.path(), &map(&[SLIP])).expect("planned");
    let words = plan.summary().to_string();
    let line = "task     slip = event of `slip_label`, 3 of 4 samples labelled (no_slip 1, slip 2), cluster `trajectory`\n";
    assert!(words.contains(line), "{words}");
}

#[test]
fn poses_are_stored_in_millimetres_and_an_empty_pose_is_absent() {
    let folder = tempfile::tempdir().expect("a folder");
    let lab = lab(&[("poses.csv", POSES)]);
    let dataset = imported_to(lab.path(), MOVED, &folder.path().join("set"));
    let moved = &dataset.tasks()[0];
    let turned = TaskLabel::Pose([2.0, 500.0, -250.0, 0.0, 0.0, 0.6, 0.8]);
    assert_eq!((moved.label(1), moved.label(2)), (Some(turned), None));
    let task = moved.task();
    assert_eq!(
        (task.over, task.frame.as_deref()),
        (Some(5), Some("object in finger"))
    );
    let thresholds = task.thresholds.as_ref().expect("stated");
    assert_eq!((thresholds.t.len(), thresholds.r[0].as_str()), (2, "0.03"));
}

#[test]
fn a_quaternion_of_norm_zero_or_nine_tenths_and_a_pose_with_an_empty_cell_are_refused_by_row() {
    for (wrong, part) in [
        ("0,0,0.6,0", "the norm 0.6, expected 1"),
        ("0,0,0,0", "the norm 0, expected 1"),
        ("0,0,0,0.9", "the norm 0.9, expected 1"),
        ("0,0,,0.8", "all seven numbers of a pose"),
    ] {
        let table = POSES.replace("0,0,0.6,0.8", wrong);
        let message = refused(&[("poses.csv", &table)], MOVED);
        for word in ["poses.csv", "line 3", part] {
            assert!(message.contains(word), "{word}: {message}");
        }
    }
}

#[test]
fn a_class_that_is_not_in_names_is_refused_with_its_row_and_the_nearest_name() {
    let table = TABLE.replace("b,slip,", "b,slipp,");
    let message = refused(&[("labels.csv", &table)], &map(&[SLIP]));
    for word in [
        "labels.csv, line 4",
        "`slipp`",
        "did you mean `slip`?",
        "no_slip, slip",
    ] {
        assert!(message.contains(word), "{word}: {message}");
    }
    let table = TABLE.replace("b,slip,", "b,2,");
    let message = refused(&[("labels.csv", &table)], &map(&[SLIP]));
    assert!(
        message.contains("`2`: no name of the task; its names are no_slip, slip"),
        "{message}"
    );
}

#[test]
fn names_twice_and_a_positive_that_is_no_name_are_refused_with_the_line() {
    let message = refused_with("\"denim\", \"wool\"", "\"denim\", \"felt\"");
    assert!(message.contains("`names` has `felt` twice"), "{message}");
    let message = refused_with("positive = \"slip\"", "positive = \"slipp\"");
    for word in [
        "map.toml, line",
        "`positive` is `slipp`",
        "did you mean `slip`?",
    ] {
        assert!(message.contains(word), "{word}: {message}");
    }
    let message = refused_with("positive = \"slip\"\n", "");
    assert!(
        message.contains("[task.slip] needs `positive`"),
        "{message}"
    );
    let message = refused_with(
        "[\"no_slip\", \"slip\"]",
        "[\"no_slip\", \"slip\", \"stick\"]",
    );
    assert!(
        message.contains("kind `event` needs two names"),
        "{message}"
    );
    let message = refused_with("\"felt\", \"denim\", \"wool\"", "\"felt\"");
    assert!(
        message.contains("`names` has 1 class, expected 2 to 4096"),
        "{message}"
    );
    let message = refused_with("\"felt\", \"denim\"", "\"1\", \"denim\"");
    assert!(
        message.contains("also the position of `denim`"),
        "{message}"
    );
}

#[test]
fn a_task_without_a_cluster_is_refused_where_no_contact_point_is_mapped() {
    let unnamed = map(&[CLOTH]).replace("[ids]\npoint_id = \"stroke\"\n", "");
    let message = refused(&[("labels.csv", TABLE)], &unnamed);
    for word in [
        "[task.cloth] needs `cluster`",
        "state `cluster`",
        "trajectory",
    ] {
        assert!(message.contains(word), "{word}: {message}");
    }
    let message = refused_with("cluster = \"trajectory\"", "cluster = \"trajectry\"");
    assert!(message.contains("did you mean `trajectory`"), "{message}");
    let table = TABLE.replace("2,a,1", "2,,1");
    let message = refused(&[("labels.csv", &table)], &map(&[SLIP]));
    assert!(
        message.contains("its cluster `trajectory` is empty"),
        "{message}"
    );
}

#[test]
fn times_without_a_column_and_kinds_that_are_not_read_are_refused() {
    let untimed = map(&[SLIP]).replace("column = \"t\"\nunit = \"s\"\n", "");
    let message = refused(&[("labels.csv", TABLE)], &untimed);
    assert!(message.contains("[time] has no `column`"), "{message}");
    let message = refused_with("\"class\"", "\"spectrum\"");
    assert!(
        message.contains("`spectrum` is not a kind of task: expected class, event"),
        "{message}"
    );
    let message = refused_with("\"class\"", "\"clas\"");
    assert!(message.contains("did you mean `class`"), "{message}");
}

#[test]
fn limits_that_do_not_ascend_and_keys_of_the_other_kind_are_refused() {
    let message = refused(
        &[("poses.csv", POSES)],
        &MOVED.replace("\"0.1\", \"0.5\"", "\"0.5\", \"0.1\""),
    );
    assert!(message.contains("`thresholds` has `0.1`"), "{message}");
    let message = refused(
        &[("poses.csv", POSES)],
        &MOVED.replace(", r = [\"0.03\", \"0.2\"]", ""),
    );
    assert!(
        message.contains("`thresholds` needs `t`, limits of translations"),
        "{message}"
    );
    let message = refused(&[("poses.csv", POSES)], &MOVED.replace("[\"m\"]", "\"N\""));
    assert!(message.contains("not a unit of length"), "{message}");
    let message = refused(
        &[("poses.csv", POSES)],
        &format!("{MOVED}names = [\"a\"]\n"),
    );
    assert!(message.contains("a pose needs `from = { t ="), "{message}");
    let message = refused_with("time = true", "over = 5");
    assert!(message.contains("`kind = \"pose\"` only"), "{message}");
}

#[test]
fn every_form_of_export_brings_tasks_back_with_the_same_digest() {
    let folder = tempfile::tempdir().expect("a folder");
    let lab = lab(&[("poses.csv", POSES)]);
    let poses = imported_to(lab.path(), MOVED, &folder.path().join("poses"));
    for dataset in [labelled(folder.path()), poses] {
        for form in ExportForm::ALL {
            let name = form.name();
            let to = dataset.path().with_extension(name);
            let plan = ExportPlan::new(&dataset, form).expect("a plan");
            let report = plan
                .run(&to, NonZeroUsize::MIN, &SilentProgress)
                .expect("exported");
            let map =
                ImportMap::read(&report.map).unwrap_or_else(|error| panic!("{name}: {error}"));
            let plan = ImportPlan::new(&to, &map).unwrap_or_else(|error| panic!("{name}: {error}"));
            let target = dataset.path().with_extension(format!("{name}-again"));
            plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
                .expect("imported");
            let again = Dataset::open(&target).expect("a dataset");
            let definitions = |dataset: &Dataset| {
                let tasks = dataset.tasks().iter();
                tasks.map(|own| own.task().definition()).collect::<Vec<_>>()
            };
            assert_eq!(definitions(&again), definitions(&dataset), "{name}");
            assert_eq!(again.digest(), dataset.digest(), "{name}");
        }
    }
}

#[test]
fn joined_recordings_keep_their_tasks_and_equal_clusters_stay_distinct() {
    let folder = tempfile::tempdir().expect("a folder");
    let import = |name: &str, table: &str, tasks: &[&str]| {
        let lab = lab(&[("labels.csv", table)]);
        imported_to(lab.path(), &map(tasks), &folder.path().join(name))
    };
    let other = TABLE.replace("0.5\n", "0.625\n");
    let both = Dataset::joined(vec![
        import("monday", TABLE, &[SLIP, CLOTH]),
        import("tuesday", &other, &[SLIP]),
    ]);
    let both = both.expect("alike");
    let [cloth, slip] = both.tasks() else {
        panic!("two tasks");
    };
    assert_eq!((slip.class(5), cloth.label(5)), (Some("slip"), None));
    let clusters = both.clusters_of(slip.task());
    assert_eq!(clusters[0].as_deref(), Some("monday/a"));
    assert_eq!(clusters[4].as_deref(), Some("tuesday/a"));
    let points = both.clusters_of(cloth.task());
    assert_eq!(points[4].as_deref(), Some("tuesday/a"));

    let swapped = SLIP.replace("[\"no_slip\", \"slip\"]", "[\"slip\", \"no_slip\"]");
    let unlike = Dataset::joined(vec![
        import("wednesday", TABLE, &[SLIP]),
        import("thursday", &other, &[&swapped]),
    ]);
    let message = unlike.expect_err("other names").to_string();
    assert!(message.contains("the task `slip: "), "{message}");
}

#[test]
fn rows_are_added_with_labels_of_the_same_tasks_and_refused_with_others() {
    let folder = tempfile::tempdir().expect("a folder");
    let before = labelled(folder.path());
    let later = lab(&[(
        "labels.csv",
        "force,stroke,slip_label,cloth,t\n5,c,1,felt,9\n",
    )]);
    let added = Addition::new("2026-11-29", "tuesday");
    let jobs = NonZeroUsize::MIN;
    let plan = planned(later.path(), &map(&[SLIP])).expect("planned");
    let message = plan
        .extend(before.path(), &added, jobs, &SilentProgress)
        .expect_err("a task less")
        .to_string();
    assert!(message.contains("`task` is "), "{message}");
    let plan = planned(later.path(), &map(&[SLIP, CLOTH])).expect("planned");
    plan.extend(before.path(), &added, jobs, &SilentProgress)
        .expect("added");
    let after = Dataset::open(before.path()).expect("a dataset");
    assert_eq!(after.tasks()[1].class(4), Some("slip"));
    assert_eq!(after.tasks()[0].class(0), Some("denim"));
    assert_eq!(after.header().extended[0].digest, before.digest());
}
