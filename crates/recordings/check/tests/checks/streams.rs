//! Tests of doubled and dropped frames, clocks that jump, blank samples, and omissions of an import.

use std::num::NonZeroUsize;
use std::path::Path;

use taceva_check::{CheckReport, CheckRequest, Severity, check};
use taceva_core::{Clock, Frame, SilentProgress, Stamp};
use taceva_dataset::Dataset;
use taceva_import::{ImportMap, ImportPlan};

use super::{Recording, SAMPLES, codes};

/// Report on a recording with the time stamps `time`, s, after `change`.
pub(super) fn stamped(
    time: impl Fn(u32) -> f64,
    change: impl FnOnce(&mut Recording),
) -> CheckReport {
    let mut recording = Recording::sound();
    for (number, sample) in (0..SAMPLES).zip(&mut recording.samples) {
        sample.stamp = Some(Stamp {
            valid_s: time(number),
            received_s: None,
        });
        // One contact, in which a gap is not a pause.
        sample.point_id = Some("p".to_owned());
    }
    change(&mut recording);
    recording.check("random")
}

pub(super) fn regular(number: u32) -> f64 {
    0.031 * f64::from(number) + 0.007
}

#[track_caller]
pub(super) fn message<'r>(report: &'r CheckReport, code: &str) -> &'r str {
    let finding = report.findings.iter().find(|finding| finding.code == code);
    &finding
        .unwrap_or_else(|| panic!("{:?}", codes(report)))
        .message
}

#[track_caller]
pub(super) fn says_nothing(report: &CheckReport, code: &str) {
    assert!(
        report.findings.iter().all(|finding| finding.code != code),
        "{:#?}",
        report.findings
    );
}

#[test]
fn a_regular_stream_has_no_doubled_frame_no_gap_and_one_clock() {
    let report = stamped(regular, |_| {});
    for code in ["TAC022", "TAC023", "TAC024", "TAC025", "TAC026"] {
        says_nothing(&report, code);
    }
}

#[test]
fn frames_that_are_the_one_before_once_more_are_counted_with_the_true_rate() {
    let report = stamped(regular, |recording| {
        for number in (1..recording.samples.len()).step_by(2) {
            let frame = recording.samples[number - 1].frame.clone();
            recording.samples[number].frame = frame;
        }
    });
    assert_eq!(
        message(&report, "TAC022"),
        "100 of 199 steps repeat the previous frame, up to 2 in a row: the stamps are at 32.2581 Hz, new pictures at 16.0480 Hz"
    );
    // A copy elsewhere is a copy, not a frozen stream.
    let report = stamped(regular, |recording| {
        recording.samples[100].frame = recording.samples[3].frame.clone();
    });
    says_nothing(&report, "TAC022");
}

#[test]
fn steps_of_two_and_four_usual_ones_are_dropped_frames_and_a_pause_is_none() {
    let report = stamped(
        |number| match number {
            0..50 => regular(number),
            50..120 => regular(number + 1),
            _ => regular(number + 4),
        },
        |_| {},
    );
    assert!(
        message(&report, "TAC023")
            .starts_with("4 frames seem to be missing in 2 of 199 steps, which are up to 4 times"),
        "{}",
        message(&report, "TAC023")
    );
    says_nothing(
        &stamped(
            |number| regular(number + if number < 99 { 0 } else { 40 }),
            |_| {},
        ),
        "TAC023",
    );
    // If all steps differ, a missing frame cannot be detected.
    let uneven = |number: u32| 0.02 * f64::from(number) + 0.03 * f64::from(number * number % 7);
    says_nothing(&stamped(|number| uneven(number).max(0.0), |_| {}), "TAC023");
}

#[test]
fn stamps_of_two_clocks_a_clock_that_was_set_and_one_that_is_not_the_stated_are_noticed() {
    let two = stamped(
        |number| regular(number) + if number < 80 { 0.0 } else { 1.7e9 },
        |recording| recording.clock = Clock::Unix,
    );
    assert!(
        message(&two, "TAC024")
            .starts_with("these samples have stamps of two clocks: 1 step is longer"),
        "{}",
        message(&two, "TAC024")
    );
    let set = stamped(
        |number| regular(number) + if number < 80 { 0.0 } else { 3600.0 },
        |_| {},
    );
    assert!(
        message(&set, "TAC024").starts_with("1 step within a contact is over 100 times"),
        "{}",
        message(&set, "TAC024")
    );
    let running = stamped(|number| 1.7e9 + regular(number), |_| {});
    assert!(message(&running, "TAC024").contains("`monotonic`"));
    let young = stamped(regular, |recording| recording.clock = Clock::Unix);
    assert!(message(&young, "TAC024").contains("before 1990"));
}

#[test]
fn frames_of_one_colour_are_blank() {
    let report = stamped(regular, |recording| {
        for sample in recording.samples.iter_mut().take(3) {
            let info = sample.frame.as_ref().expect("set").info();
            let bytes = [40, 60, 80].repeat(64);
            sample.frame = Some(Frame::new(info, bytes).expect("whole"));
        }
    });
    assert_eq!(
        message(&report, "TAC025"),
        "3 of 200 frames have a single colour"
    );
}

#[test]
fn frames_of_one_colour_are_found_by_a_check_that_is_asked_for_alone() {
    let report = imported_and_checked(blank_lab().path(), BLANK_MAP, &["TAC025"]);
    assert_eq!(
        message(&report, "TAC025"),
        "2 of 2 frames have a single colour"
    );
}

/// Report of the checks with the codes `only` on `files`, imported by `map`.
fn imported(files: &[(&str, &str)], map: &str, only: &[&str]) -> CheckReport {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("written");
    }
    let text = format!(
        "map_version = 2\n{map}\n[sensor]\nmodel = \"m\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = true\n"
    );
    imported_and_checked(folder.path(), &text, only)
}

fn imported_and_checked(folder: &Path, map: &str, only: &[&str]) -> CheckReport {
    let map = ImportMap::parse("map.toml".as_ref(), map).expect("a map");
    let plan = ImportPlan::new(folder, &map).expect("planned");
    let target = folder.join("dataset");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&target).expect("a dataset");
    let request = CheckRequest {
        only: only.iter().map(|code| (*code).to_owned()).collect(),
        split: None,
        seed: 0,
        jobs: NonZeroUsize::MIN,
    };
    check(&dataset, &request, &SilentProgress).expect("checked")
}

#[test]
fn rows_that_a_join_left_out_are_repeated_by_the_check_and_a_whole_import_says_nothing() {
    let map = |rest: &str| {
        format!(
            "table = \"run.csv\"\n[[join]]\nname = \"ft\"\ntable = \"ft.csv\"\non = {{ k = \"k\" }}\nunmatched = \"drop\"\n{rest}[columns]\nFz = {{ from = \"ft.Fz\", unit = \"N\" }}\n[time]\nclock = \"unknown\"\n"
        )
    };
    let report = imported(
        &[
            ("run.csv", "k\n1\n2\n3\n"),
            ("ft.csv", "k,Fz\n1,0.5\n2,0.25\n7,1\n"),
        ],
        &map(""),
        &["TAC021"],
    );
    assert_eq!(
        codes(&report),
        [("TAC021", Severity::Warning), ("TAC021", Severity::Note)]
    );
    assert_eq!(
        message(&report, "TAC021"),
        "1 row is not in the recording, because no row of a joined table matches it (join ft 1; 2 rows are kept)"
    );
    let whole = [
        ("run.csv", "k\n1\n2\n"),
        ("ft.csv", "k,Fz\n1,0.5\n2,0.25\n"),
    ];
    says_nothing(&imported(&whole, &map(""), &["TAC021"]), "TAC021");
}

/// Map of a table and a log, joined by time.
const LOG_MAP: &str = "table = \"run.csv\"\n[[join]]\nname = \"ft\"\ntable = \"ft.csv\"\ntime = { column = \"t\", unit = \"s\" }\ntolerance_ms = 20\nlag_ms = 0\nunmatched = \"drop\"\n[columns]\nFz = { from = \"ft.Fz\", unit = \"N\" }\n[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n";

#[test]
fn unused_rows_of_a_slow_log_are_noted_although_few_rows_are_kept() {
    let run: String = (0..10).map(|row| format!("{row}\n")).collect();
    let ft: String = (7..16).map(|row| format!("{row},{row}\n")).collect();
    let (run, ft) = (format!("t\n{run}"), format!("t,Fz\n{ft}"));
    let files = [("run.csv", run.as_str()), ("ft.csv", ft.as_str())];
    let report = imported(&files, LOG_MAP, &["TAC021"]);
    let notes = report.findings.iter();
    let mut notes = notes.filter(|finding| finding.severity == Severity::Note);
    let said = &notes.next().expect("a note").message;
    assert!(
        said.starts_with("6 rows of joined tables match no row"),
        "{said}"
    );
}

#[test]
fn unused_rows_of_a_log_are_noted_unless_it_is_faster_than_the_table() {
    let run: String = (0..10).map(|row| format!("{row}\n")).collect();
    for (rows, expected) in [
        (91, None),
        (15, Some("5 rows of joined tables match no row")),
    ] {
        let every = if expected.is_none() { 0.1 } else { 1.0 };
        let ft = (0..rows).map(|row| format!("{:.1},{row}\n", every * f64::from(row)));
        let files = [
            ("run.csv", format!("t\n{run}")),
            ("ft.csv", format!("t,Fz\n{}", ft.collect::<String>())),
        ];
        let files = [
            (files[0].0, files[0].1.as_str()),
            (files[1].0, files[1].1.as_str()),
        ];
        let report = imported(&files, LOG_MAP, &["TAC021"]);
        match expected {
            None => says_nothing(&report, "TAC021"),
            Some(expected) => {
                let said = message(&report, "TAC021");
                assert!(said.starts_with(expected), "{said}");
            }
        }
    }
}

#[test]
fn frames_in_jpeg_are_said_to_depend_on_their_decoder() {
    let fixture = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../recordings/dataset/tests/fixtures/jpeg/baseline-gray.jpg"
    );
    let jpeg = std::fs::read(fixture).expect("readable");
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("1.jpg"), jpeg).expect("written");
    std::fs::write(folder.path().join("labels.csv"), "file,Fz\n1.jpg,1\n").expect("written");
    let text = "map_version = 2\ntable = \"labels.csv\"\n[frame]\ncolumn = \"file\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = { from = \"Fz\", unit = \"N\" }\n[time]\nclock = \"unknown\"\n[sensor]\nmodel = \"m\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = true\n";
    let report = imported_and_checked(folder.path(), text, &["lossy-frames"]);
    assert!(message(&report, "TAC026").starts_with("1 frame is JPEG"));
}

const BLANK_MAP: &str = "map_version = 2\ntable = \"l.csv\"\n[frame]\narray = { file = \"f.npy\" }\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = { from = \"Fz\", unit = \"N\" }\n[time]\nclock = \"unknown\"\n[sensor]\nmodel = \"m\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = true\n";

/// Folder with two frames, each of a single colour.
fn blank_lab() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let header = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 2, 2), }";
    let length = u16::try_from(header.len()).expect("short");
    let head = [b"\x93NUMPY\x01\x00", &length.to_le_bytes()[..]].concat();
    let frames = [&head[..], header.as_bytes(), &[7; 8]].concat();
    std::fs::write(folder.path().join("f.npy"), frames).expect("written");
    std::fs::write(folder.path().join("l.csv"), "Fz\n1\n2\n").expect("written");
    folder
}
