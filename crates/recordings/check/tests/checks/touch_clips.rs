//! Tests of generated clips in the layout of Touch and Go, of which 100 of 106 tested clips are also training clips.

use std::fmt::Write as _;
use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;

use taceva_check::{CheckReport, CheckRequest, Severity, check};
use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{ImportPlan, Preset};

/// Split that takes the part of a picture from the list that names the picture.
const LISTS: &str = "by-column:source_table=train:train.txt;test:test.txt";

/// Report on the clips of two lists. Each entry is the number of a clip and of a picture in it. All pictures are copies of one JPEG.
fn checked(test: &[(u32, u32)], train: &[(u32, u32)]) -> CheckReport {
    let picture = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../recordings/dataset/tests/fixtures/jpeg/baseline-444.jpg"
    );
    let picture = fs::read(picture).expect("a picture");
    let folder = tempfile::tempdir().expect("a folder");
    for (name, rows) in [("test.txt", test), ("train.txt", train)] {
        let mut list = String::new();
        for (clip, number) in rows {
            let _ = writeln!(list, "clip_{clip:03}/{number:010}.jpg,{}", clip % 20);
            let frames = format!("dataset/clip_{clip:03}/gelsight_frame");
            let frames = folder.path().join(frames);
            fs::create_dir_all(&frames).expect("made");
            fs::write(frames.join(format!("{number:010}.jpg")), &picture).expect("written");
        }
        fs::write(folder.path().join(name), list).expect("written");
    }
    let preset = Preset::from_name("touch-and-go").expect("a preset");
    let map = preset.map(folder.path()).expect("a map");
    let plan = ImportPlan::new(folder.path(), &map).expect("planned");
    let target = folder.path().join("set");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    report_on(&target)
}

fn report_on(dataset: &Path) -> CheckReport {
    let dataset = Dataset::open(dataset).expect("a dataset");
    let request = CheckRequest {
        only: vec!["TAC007".to_owned()],
        split: Some(LISTS.to_owned()),
        seed: 0,
        jobs: NonZeroUsize::MIN,
    };
    check(&dataset, &request, &SilentProgress).expect("checked")
}

#[test]
fn the_lists_of_touch_and_go_share_a_hundred_of_106_tested_clips() {
    let test: Vec<(u32, u32)> = (0..106).map(|clip| (clip, 0)).collect();
    let mut train: Vec<(u32, u32)> = (0..100).map(|clip| (clip, 1)).collect();
    train.extend((106..140).map(|clip| (clip, 1)));
    let report = checked(&test, &train);
    let mut shared = report.findings.iter();
    let shared = shared.find(|finding| finding.message.contains("clusters (`clip`)"));
    let shared = shared.unwrap_or_else(|| panic!("{:?}", report.findings));
    assert_eq!(
        shared.message,
        "task `material`: 100 of 106 clusters (`clip`) of the test part are also in the training or validation part"
    );
    assert_eq!((shared.severity, shared.count), (Severity::Error, 100));
}

#[test]
fn lists_of_distinct_clips_share_none() {
    let test: Vec<(u32, u32)> = (0..4).map(|clip| (clip, 0)).collect();
    let train: Vec<(u32, u32)> = (4..12).map(|clip| (clip, 0)).collect();
    let report = checked(&test, &train);
    let mut findings = report.findings.iter();
    assert!(
        !findings.any(|finding| finding.message.contains("clusters (")),
        "{:?}",
        report.findings
    );
}
