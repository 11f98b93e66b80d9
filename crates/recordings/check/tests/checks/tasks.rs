//! Tests of labels of tasks: classes missing from a part, contradictory labels, quaternions without norm 1, and clusters in two parts.

use std::fmt::Write as _;
use std::num::NonZeroUsize;

use taceva_check::{CheckReport, CheckRequest, Finding, Severity, check};
use taceva_core::{Channel, Channels, Clock, SilentProgress};
use taceva_dataset::internal::{Beside, layout, write_table_and_header};
use taceva_dataset::{
    Dataset, RecordingFacts, Row, SensorFacts, Source, Table, Task, TaskKind, TaskLabel,
};

use super::lab::{PICTURES, SENSOR, imported, imported_and_split, pictures};

/// Map of a table with materials of clips in declared parts. The cluster is the clip.
const MATERIALS: &str = "map_version = 2\ntable = \"t.csv\"\n[ids]\npart = \"part\"\n[attributes]\nclip = \"clip\"\n\
    [task.material]\nkind = \"class\"\nfrom = \"material\"\nnames = [\"cloth\", \"grass\", \"stone\"]\ncluster = \"clip\"\n\
    [time]\nclock = \"unknown\"\n";

fn only<'r>(report: &'r CheckReport, code: &str) -> Vec<&'r Finding> {
    let found = report.findings.iter();
    found.filter(|finding| finding.code == code).collect()
}

/// Findings with `code` in a table with the columns part, clip and material, and no pictures. The parts are those of the table.
fn materials(rows: &str, code: &str) -> CheckReport {
    checked(rows, code, Some("declared"))
}

/// Findings like those of [`materials`], with the split `split`.
fn checked(rows: &str, code: &str, split: Option<&str>) -> CheckReport {
    let table = format!("part,clip,material\n{rows}");
    let map = format!("{MATERIALS}{SENSOR}");
    let files = [("t.csv", table.into_bytes())];
    imported_and_split(&files, &map, &[code], split)
}

#[test]
fn a_drawn_list_of_touch_clips_names_the_hundred_of_106_that_are_learnt_from() {
    let mut rows = String::new();
    for clip in 0..150_u32 {
        let material = clip % 3;
        // Clips 0 to 99 are in both parts, 100 to 105 are only tested, and the others are only learnt from.
        for frame in 0..4 {
            let part = match (clip, frame) {
                (0..=99, 3) | (100..=105, _) => "test",
                _ => "train",
            };
            let _ = writeln!(rows, "{part},clip {clip},{material}");
        }
    }
    let report = materials(&rows, "TAC007");
    let shared: Vec<&Finding> = only(&report, "TAC007")
        .into_iter()
        .filter(|finding| finding.message.contains("100 of 106"))
        .collect();
    assert_eq!(shared.len(), 1, "{:?}", report.findings);
    assert_eq!(
        shared[0].message,
        "task `material`: 100 of 106 clusters (`clip`) of the test part are also in the training or validation part"
    );
    assert_eq!(
        (shared[0].severity, shared[0].count),
        (Severity::Error, 100)
    );
}

#[test]
fn clips_that_are_whole_in_one_part_share_no_cluster() {
    let mut rows = String::new();
    for clip in 0..12_u32 {
        let part = if clip < 8 { "train" } else { "test" };
        for _ in 0..2 {
            let _ = writeln!(rows, "{part},clip {clip},{}", clip % 3);
        }
    }
    let report = materials(&rows, "TAC007");
    let is_shared = |finding: &&Finding| finding.message.contains("clusters (");
    assert!(
        !report.findings.iter().any(|finding| is_shared(&finding)),
        "{:?}",
        report.findings
    );
}

#[test]
fn clusters_that_the_default_split_shares_are_a_warning_and_no_error() {
    let mut rows = String::new();
    for row in 0..40_u32 {
        let _ = writeln!(rows, ",clip {},{}", row % 4, row % 2);
    }
    let report = checked(&rows, "TAC007", None);
    let shared = only(&report, "TAC007").into_iter();
    let shared = shared.filter(|finding| finding.message.contains("clusters ("));
    let severities: Vec<Severity> = shared.map(|finding| finding.severity).collect();
    assert_eq!(severities, [Severity::Warning], "{:?}", report.findings);
    let report = checked(&rows, "TAC007", Some("random"));
    assert!(
        report
            .findings
            .iter()
            .any(|finding| finding.severity == Severity::Error),
        "{:?}",
        report.findings
    );
}

#[test]
fn a_class_in_one_fold_of_the_default_split_is_never_learnt_and_one_in_several_folds_is() {
    // The task has five folds of eight clips each.
    let found = |stones: usize| {
        let mut rows = String::new();
        for row in 0..40_usize {
            let material = if row < stones { "stone" } else { "cloth" };
            let _ = writeln!(rows, ",clip {row},{material}");
        }
        let report = checked(&rows, "TAC030", None);
        let found = only(&report, "TAC030").into_iter();
        let found = found.filter(|finding| finding.severity == Severity::Warning);
        found
            .map(|finding| finding.message.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        found(1),
        ["task `material`: every fold but one has no sample of 1 of 3 classes: stone"]
    );
    // No fold has more than 8 of 40 samples.
    assert_eq!(found(9), Vec::<String>::new());
}

#[test]
fn the_folds_of_a_task_keep_its_clusters_whole_although_those_of_the_labels_do_not() {
    // Four clips. Folds of single samples have stones each; folds of whole clips do not.
    let found = |clips_of_stone: usize| {
        let mut rows = String::new();
        for row in 0..40_usize {
            let material = match row % 4 < clips_of_stone {
                true => "stone",
                false => "cloth",
            };
            let _ = writeln!(rows, ",clip {},{material}", row % 4);
        }
        let report = checked(&rows, "TAC030", None);
        let found = only(&report, "TAC030").into_iter();
        let found = found.filter(|finding| finding.severity == Severity::Warning);
        let messages = found.map(|finding| finding.message.clone());
        messages.collect::<Vec<_>>()
    };
    assert_eq!(
        found(1),
        ["task `material`: every fold but one has no sample of 1 of 3 classes: stone"]
    );
    assert_eq!(found(2), Vec::<String>::new());
}

#[test]
fn a_task_of_one_cluster_has_no_folds_and_no_finding_about_them() {
    let names = ["cloth", "grass", "stone"];
    let rows: String = (0..40)
        .map(|row| format!(",clip,{}\n", names[row % 3]))
        .collect();
    let report = checked(&rows, "TAC030", None);
    assert!(only(&report, "TAC030").is_empty(), "{:?}", report.findings);
    assert!(report.skipped.is_empty(), "{:?}", report.skipped);
}

#[test]
fn a_class_that_is_never_learnt_and_one_that_no_sample_has_are_named() {
    let report = materials(
        "train,a,cloth\ntrain,b,cloth\ntest,c,cloth\ntest,d,grass\n",
        "TAC030",
    );
    let messages: Vec<(Severity, &str)> = only(&report, "TAC030")
        .iter()
        .map(|finding| (finding.severity, finding.message.as_str()))
        .collect();
    assert_eq!(
        messages,
        [
            (
                Severity::Warning,
                "task `material`: the training part has no sample of 1 of 3 classes: grass"
            ),
            (
                Severity::Note,
                "task `material`: the recording has no sample of 1 of 3 classes: stone"
            ),
        ]
    );
    let whole =
        "train,a,cloth\ntrain,b,grass\ntrain,c,stone\ntest,d,cloth\ntest,e,grass\ntest,f,stone\n";
    assert!(only(&materials(whole, "TAC030"), "TAC030").is_empty());
}

#[test]
fn one_picture_with_two_labels_is_a_warning_and_with_one_label_none() {
    let found = |labels: [u32; 4]| {
        // The second and the fourth picture are copies of the first and the third.
        let bytes = pictures(&[1.0, 2.0]);
        let header = bytes.len() - 2 * 24 * 16;
        let (one, two) = bytes[header..].split_at(24 * 16);
        let all = [&pictures(&[0.0; 4])[..header], one, one, two, two].concat();
        let mut table = "clip,slip\n".to_owned();
        for (row, label) in labels.iter().enumerate() {
            let _ = writeln!(table, "{row},{label}");
        }
        let map = format!(
            "map_version = 2\ntable = \"t.csv\"\n{PICTURES}[attributes]\nclip = \"clip\"\n[task.slip]\nkind = \"event\"\n\
             from = \"slip\"\nnames = [\"no_slip\", \"slip\"]\npositive = \"slip\"\ncluster = \"clip\"\n[time]\nclock = \"unknown\"\n{SENSOR}"
        );
        let files = [("t.csv", table.into_bytes()), ("f.npy", all)];
        imported(&files, &map, &["TAC031"])
    };
    let report = found([0, 1, 1, 1]);
    let [finding] = only(&report, "TAC031")[..] else {
        panic!("{:?}", report.findings);
    };
    assert_eq!(
        finding.message,
        "task `slip`: 1 of 4 samples repeat the frame of an earlier sample with another label, the first `0` as no_slip and `1` as slip"
    );
    assert_eq!(finding.severity, Severity::Warning);
    assert!(only(&found([0, 0, 1, 1]), "TAC031").is_empty());
}

#[test]
fn a_quaternion_of_another_norm_is_an_error_with_its_sample() {
    let folder = tempfile::tempdir().expect("a folder");
    let moved = Task::new("moved", TaskKind::Pose, "point_id");
    let channels = Channels::new([Channel::FZ]).expect("one");
    let mut table = Table::new(channels, Vec::new()).with_tasks([moved]);
    for (name, w) in [("a", 1.0), ("b", 0.9), ("c", 1.0 + 5e-7)] {
        let mut row = Row::new(name);
        row.point_id = Some(name.to_owned());
        row.truth = vec![Some(0.5)];
        row.tasks = vec![Some(TaskLabel::Pose([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, w]))];
        table.push(row);
    }
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("m"));
    let place = |name: &str| folder.path().join(name);
    write_table_and_header(
        &place(layout::SAMPLES),
        &place(layout::HEADER),
        &facts,
        &table,
        None,
        Beside::default(),
    )
    .expect("written");
    let dataset = Dataset::open(folder.path()).expect("a dataset");
    let request = CheckRequest {
        only: vec!["TAC032".to_owned()],
        split: None,
        seed: 0,
        jobs: NonZeroUsize::MIN,
    };
    let report = check(&dataset, &request, &SilentProgress).expect("checked");
    let [finding] = only(&report, "TAC032")[..] else {
        panic!("{:?}", report.findings);
    };
    assert_eq!(
        finding.message,
        "task `moved`: 1 of 3 poses have a quaternion that is not a rotation, the first with norm 0.9"
    );
    assert_eq!(
        (finding.samples[0].as_str(), finding.severity),
        ("b", Severity::Error)
    );
}

#[test]
fn depth_maps_without_a_valid_pixel_and_depths_in_another_unit_are_named_by_sample() {
    let found = |unit: &str, invalid: f32| {
        let table = "force,press\n1,a\n2,b\n";
        let map = format!(
            "map_version = 2\ntable = \"t.csv\"\n[columns]\nFz = {{ from = \"force\", unit = \"N\" }}\n[ids]\npoint_id = \"press\"\n\
             [task.shape]\nkind = \"depth\"\narray = \"d.npy\"\nunit = \"{unit}\"\n[time]\nclock = \"unknown\"\n{SENSOR}"
        );
        let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 1, 2), }\n";
        let length = u16::try_from(header.len()).expect("short");
        let mut array = [b"\x93NUMPY\x01\x00", &length.to_le_bytes()[..]].concat();
        array.extend(header.as_bytes());
        for number in [0.0, 100.0, f32::NAN, invalid] {
            array.extend(number.to_le_bytes());
        }
        let files = [("t.csv", table.as_bytes().to_vec()), ("d.npy", array)];
        // Depth maps have no classes, and thus no folds that lack one.
        let report = imported(&files, &map, &["TAC030", "TAC033"]);
        assert!(only(&report, "TAC030").is_empty());
        report
    };
    let report = found("um", f32::NAN);
    let [finding] = only(&report, "TAC033")[..] else {
        panic!("{:?}", report.findings);
    };
    assert_eq!(
        finding.message,
        "task `shape`: 1 of 2 depth maps have no valid pixel"
    );
    assert_eq!(
        (finding.samples[0].as_str(), finding.severity),
        ("1", Severity::Warning)
    );
    let report = found("mm", 0.5);
    let [finding] = only(&report, "TAC033")[..] else {
        panic!("{:?}", report.findings);
    };
    assert_eq!(
        finding.message,
        "task `shape`: 1 of 2 depth maps have depths above 50 mm, up to 100 mm: their unit or scale may be wrong"
    );
    assert!(only(&found("um", 0.5), "TAC033").is_empty());
}
