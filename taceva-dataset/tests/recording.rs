//! A recording survives being killed, and says what it kept.

mod lab;

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use lab::Random;
use taceva_core::{
    Channel, Channels, Clock, Frame, FrameInfo, GratingKind, Nanometre, Phase, PixelFormat,
    Readings, Sample, Stamp,
};
use taceva_dataset::{
    Dataset, DatasetError, Known, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source,
};
use taceva_needs::{Need, skip};

fn spec() -> RecordingSpec {
    RecordingSpec {
        facts: RecordingFacts {
            source: Source::Simulated,
            clock: Clock::Monotonic,
            sensor: SensorFacts {
                model: "bench".into(),
                serial: "1".into(),
                gel: "2".into(),
                opaque: Known::Is(false),
            },
            footprint: None,
        },
        channels: Channels::new([Channel::PZ, Channel::FZ]).expect("distinct"),
    }
}

fn frame(seed: u8) -> Frame {
    let info = FrameInfo {
        width: 4,
        height: 2,
        format: PixelFormat::Rgb8,
    };
    Frame::new(info, (0..24).map(|byte| byte ^ seed).collect()).expect("24 bytes")
}

fn sample(number: u8) -> Sample {
    Sample {
        id: format!("s{number}"),
        point_id: Some(format!("p{}", number % 2)),
        unit_id: Some("1".into()),
        scene_id: Some("dark".into()),
        depth_step: Some(3),
        repeat: Some(u32::from(number)),
        phase: Some(Phase::Unload),
        kind: Some(GratingKind::Line),
        spacing: Some(Nanometre(350_000)),
        stamp: Some(Stamp {
            valid_s: f64::from(number) / 3.0,
            received_s: None,
        }),
        frame: Some(frame(number)),
        truth: Readings::new(vec![Some(f64::from(number) / 7.0), None]),
        ..Sample::default()
    }
}

#[test]
fn what_was_recorded_is_read_back_bit_for_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec()).expect("created");
    for number in 1..=3 {
        let sequence = recorder.append(&sample(number)).expect("recorded");
        assert_eq!(sequence, u64::from(number));
    }
    recorder.append_reference(&frame(99)).expect("recorded");
    let header = recorder.close().expect("closed");
    assert!(!path.join("journal").exists());
    let dataset = Dataset::open(&path).expect("opens");
    assert_eq!(dataset.digest(), header.digest);
    assert_eq!(dataset.reference().expect("decodes"), Some(frame(99)));
    for number in 1..=3_u8 {
        let row = usize::from(number) - 1;
        let decoded = dataset.frame(row).expect("decodes");
        let fields = dataset.table().fields();
        let read = dataset.table().sample(row, fields, decoded);
        let expected = Sample {
            intensity: Some(frame(number).mean_luma()),
            frame_digest: read.frame_digest.clone(),
            ..sample(number)
        };
        assert_eq!(read, expected);
        let digest = read.frame_digest.expect("a frame has a digest");
        assert!(digest.starts_with("sha256:"), "{digest}");
    }
}

/// A texture that stays, noise that does not, and a place that is touched.
fn textured(number: u8, format: PixelFormat) -> Frame {
    let info = FrameInfo {
        width: 40,
        height: 30,
        format,
    };
    let (mut texture, mut noise) = (Random::new(5), Random::new(u64::from(number)));
    let length = info.byte_len().expect("small");
    let bytes = (0..length).map(|at| {
        let still = texture.below(200).to_le_bytes()[0];
        let touched = u8::from(at / 97 == usize::from(number)) * 40;
        let noisy = noise.below(3).to_le_bytes()[0];
        // The high byte of a 16-bit number moves little.
        still.wrapping_add(touched).wrapping_add(noisy)
    });
    Frame::new(info, bytes.collect()).expect("as long as it says")
}

fn recorded(path: &Path, numbers: std::ops::Range<u8>, format: PixelFormat) -> Recorder {
    let mut recorder = Recorder::open(path, &spec()).expect("opened");
    for number in numbers {
        let sample = Sample {
            frame: Some(textured(number, format)),
            ..sample(number)
        };
        recorder.append(&sample).expect("recorded");
    }
    recorder
}

#[test]
fn frames_lie_in_one_pack_where_what_stays_the_same_is_stored_once() {
    for format in [PixelFormat::Gray8, PixelFormat::Rgb8, PixelFormat::Gray16] {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("set");
        recorded(&path, 0..20, format).close().expect("closed");
        let files = fs::read_dir(path.join("frames")).expect("a folder");
        let names: Vec<_> = files
            .map(|file| file.expect("readable").file_name())
            .collect();
        assert_eq!(names, ["0000.pack"]);
        let dataset = Dataset::open(&path).expect("opens");
        dataset.verify_frames().expect("whole");
        let mut bytes = 0;
        // From the last one on, so that a difference is read before what it is one to.
        for row in (0..20_u8).rev() {
            let decoded = dataset.frame(usize::from(row)).expect("decodes");
            assert_eq!(decoded, Some(textured(row, format)));
            let entry = dataset.table().frames()[usize::from(row)].as_ref();
            let span = entry.and_then(|entry| entry.span).expect("in a pack");
            assert_eq!(span.is_difference, row > 0, "{}", format.name());
            bytes += u64::from(span.length);
        }
        let pack = fs::metadata(path.join("frames/0000.pack")).expect("there");
        assert_eq!(pack.len(), bytes, "nothing between them");
    }
}

#[test]
fn a_frame_that_comes_again_has_the_digest_that_it_had() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec()).expect("created");
    for (number, seen) in [3, 4, 3, 4].into_iter().enumerate() {
        let sample = Sample {
            id: number.to_string(),
            frame: Some(textured(seen, PixelFormat::Gray8)),
            ..sample(1)
        };
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    let dataset = Dataset::open(&path).expect("opens");
    let frames = dataset.table().frames();
    let digest = |row: usize| frames[row].as_ref().map(|entry| entry.digest);
    assert_eq!([digest(0), digest(1)], [digest(2), digest(3)]);
    assert_ne!(digest(0), digest(1));
}

#[test]
fn a_pack_with_a_changed_byte_gives_no_other_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let format = PixelFormat::Gray8;
    recorded(&path, 0..4, format).close().expect("closed");
    let pack = path.join("frames/0000.pack");
    let whole = fs::read(&pack).expect("there");
    for at in (0..whole.len()).step_by(61) {
        let mut damaged = whole.clone();
        damaged[at] ^= 1 << (at % 8);
        fs::write(&pack, &damaged).expect("written");
        let dataset = Dataset::open(&path).expect("the table is whole");
        assert!(dataset.verify_frames().is_err(), "byte {at}");
        let mut refused = 0;
        for row in 0..4_u8 {
            match dataset.frame(usize::from(row)) {
                Err(DatasetError::Digest { .. }) => refused += 1,
                found => assert_eq!(found.expect("whole"), Some(textured(row, format)), "{at}"),
            }
        }
        // Of the first frame the others are differences to: none of them can be told.
        let first = dataset.table().frames()[0]
            .as_ref()
            .and_then(|entry| entry.span);
        let length = first.expect("in a pack").length as usize;
        assert_eq!(refused, if at < length { 4 } else { 1 }, "byte {at}");
    }
}

#[test]
fn what_an_interruption_left_behind_the_last_frame_of_the_journal_is_cut() {
    let folder = tempfile::tempdir().expect("a folder");
    let (once, twice) = (folder.path().join("once"), folder.path().join("twice"));
    let format = PixelFormat::Rgb8;
    recorded(&once, 0..6, format).close().expect("closed");
    drop(recorded(&twice, 0..3, format));
    let pack = twice.join("frames/0000.pack");
    let mut torn = fs::read(&pack).expect("there");
    torn.extend([7; 999]);
    fs::write(&pack, &torn).expect("written");
    fs::write(twice.join("frames/0001.pack"), "torn").expect("written");
    recorded(&twice, 3..6, format).close().expect("closed");
    let bytes = |path: &Path| fs::read(path.join("frames/0000.pack")).expect("there");
    assert_eq!(bytes(&twice), bytes(&once));
    assert!(!twice.join("frames/0001.pack").exists());
    let digest = |path: &Path| Dataset::open(path).expect("opens").digest();
    assert_eq!(digest(&twice), digest(&once));
    // What the journal names and the pack does not hold was lost by somebody else.
    let cut = folder.path().join("cut");
    drop(recorded(&cut, 0..3, format));
    let pack = cut.join("frames/0000.pack");
    let whole = fs::read(&pack).expect("there");
    fs::write(&pack, &whole[..whole.len() - 1]).expect("written");
    let refused = Recorder::resume(&cut);
    assert!(
        matches!(refused, Err(DatasetError::Damaged { .. })),
        "{refused:?}"
    );
}

#[test]
fn an_interrupted_recording_goes_on_and_becomes_the_same_dataset() {
    let folder = tempfile::tempdir().expect("a folder");
    let (once, twice) = (folder.path().join("once"), folder.path().join("twice"));
    let mut recorder = Recorder::create(&once, &spec()).expect("created");
    for number in 1..=4 {
        recorder.append(&sample(number)).expect("recorded");
    }
    let expected = recorder.close().expect("closed").digest;
    let mut recorder = Recorder::create(&twice, &spec()).expect("created");
    recorder.append(&sample(1)).expect("recorded");
    recorder.append(&sample(2)).expect("recorded");
    drop(recorder);
    assert!(matches!(
        Dataset::open(&twice),
        Err(DatasetError::NoDataset { .. })
    ));
    let mut recorder = Recorder::open(&twice, &spec()).expect("resumed");
    assert!(recorder.has("s2") && !recorder.has("s3"));
    recorder.append(&sample(3)).expect("recorded");
    recorder.append(&sample(4)).expect("recorded");
    assert_eq!(recorder.close().expect("closed").digest, expected);
    assert_eq!(lab::contents(&twice), lab::contents(&once));
}

#[test]
fn a_recording_is_written_by_one_at_a_time() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let first = Recorder::create(&path, &spec()).expect("created");
    assert!(matches!(
        Recorder::resume(&path),
        Err(DatasetError::Busy { .. })
    ));
    assert!(matches!(
        Recorder::create(&path, &spec()),
        Err(DatasetError::Busy { .. })
    ));
    drop(first);
    assert!(matches!(
        Recorder::create(&path, &spec()),
        Err(DatasetError::TargetExists { .. })
    ));
    Recorder::resume(&path).expect("free again");
}

#[test]
fn a_closed_recording_is_not_written_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec()).expect("created");
    recorder.append(&sample(1)).expect("recorded");
    recorder.close().expect("closed");
    for outcome in [
        Recorder::resume(&path),
        Recorder::create(&path, &spec()),
        Recorder::open(&path, &spec()),
    ] {
        assert!(
            matches!(outcome, Err(DatasetError::TargetExists { .. })),
            "{outcome:?}"
        );
    }
}

#[test]
fn samples_that_cannot_be_recorded_are_refused_and_lose_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec()).expect("created");
    recorder.append(&sample(1)).expect("recorded");
    let small = FrameInfo {
        width: 1,
        height: 1,
        format: PixelFormat::Gray8,
    };
    for (spoiled, word) in [
        (sample(1), "empty or taken"),
        (
            Sample {
                id: String::new(),
                ..sample(2)
            },
            "empty or taken",
        ),
        (
            Sample {
                truth: Readings::from_values([f64::NAN]),
                ..sample(2)
            },
            "NaN is no finite number",
        ),
        (
            Sample {
                truth: Readings::from_values([0.0; 3]),
                ..sample(2)
            },
            "3 values for 2 channels",
        ),
        (
            Sample {
                stamp: Some(Stamp {
                    valid_s: f64::INFINITY,
                    received_s: None,
                }),
                ..sample(2)
            },
            "inf is no finite number",
        ),
        (
            Sample {
                frame: Some(Frame::new(small, vec![0]).expect("one byte")),
                ..sample(2)
            },
            "expected 4×2 rgb8",
        ),
    ] {
        let message = recorder.append(&spoiled).expect_err(word).to_string();
        assert!(message.contains(word), "{message}");
    }
    recorder.append(&sample(2)).expect("recorded");
    assert_eq!(recorder.close().expect("closed").table.rows, 2);
}

#[test]
fn another_recording_is_not_continued() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    drop(Recorder::create(&path, &spec()).expect("created"));
    let mut other = spec();
    other.facts.sensor.serial = "2".into();
    let error = Recorder::open(&path, &other).expect_err("another sensor");
    assert!(error.to_string().contains("of another sensor"), "{error}");
}

#[test]
fn a_creation_that_was_cut_short_is_begun_anew() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    for leftover in [None, Some(&b""[..]), Some(b"\x05\x00\x00"), Some(&[0; 100])] {
        fs::create_dir_all(path.join("frames")).expect("created");
        if let Some(bytes) = leftover {
            fs::write(path.join("journal"), bytes).expect("written");
        }
        assert!(matches!(
            Recorder::resume(&path),
            Err(DatasetError::NoDataset { .. })
        ));
        let mut recorder = Recorder::open(&path, &spec()).expect("created");
        recorder.append(&sample(1)).expect("recorded");
        recorder.close().expect("closed");
        fs::remove_dir_all(&path).expect("removed");
    }
}

#[test]
fn an_interrupted_close_is_finished() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec()).expect("created");
    recorder.append(&sample(1)).expect("recorded");
    let journal = fs::read(path.join("journal")).expect("read");
    let digest = recorder.close().expect("closed").digest;
    // Before the header was renamed: the journal decides.
    fs::write(path.join("journal"), &journal).expect("written");
    fs::remove_file(path.join("dataset.toml")).expect("removed");
    let recorder = Recorder::resume(&path).expect("resumed");
    assert_eq!(recorder.close().expect("closed").digest, digest);
    // After it was: the journal is a leftover.
    fs::write(path.join("journal"), &journal).expect("written");
    assert!(matches!(
        Recorder::resume(&path),
        Err(DatasetError::TargetExists { .. })
    ));
    assert!(!path.join("journal").exists());
    assert_eq!(Dataset::open(&path).expect("opens").digest(), digest);
}

#[test]
fn mutated_journals_are_refused_or_lose_only_a_tail() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec()).expect("created");
    for number in 1..=4 {
        recorder.append(&sample(number)).expect("recorded");
    }
    let table = recorder.table().clone();
    drop(recorder);
    let journal = fs::read(path.join("journal")).expect("read");
    let mut random = Random::new(5);
    for _ in 0..2_000 {
        fs::write(path.join("journal"), random.mutated(&journal)).expect("written");
        if let Ok(recorder) = Recorder::resume(&path) {
            let kept = recorder.table();
            assert_eq!(kept.samples(), &table.samples()[..kept.rows()]);
        }
    }
}

/// The example recorder, built beside this test.
fn example() -> Option<PathBuf> {
    let here = std::env::current_exe().ok()?;
    let built = here.parent()?.parent()?.join("examples/record");
    built.exists().then_some(built)
}

fn start(example: &Path, folder: &Path) -> Child {
    Command::new(example)
        .arg(folder)
        .arg("60")
        .stdout(Stdio::piped())
        .spawn()
        .expect("the example runs")
}

#[cfg(unix)]
#[test]
fn nothing_acknowledged_is_lost_when_the_recorder_is_killed() {
    let Some(example) = example() else {
        let why = "`record` is built by `cargo test` of the whole package";
        skip(Need::Example, why);
        return;
    };
    let mut random = Random::new(6);
    for _ in 0..6 {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("set");
        let mut acknowledged = 0;
        for _ in 0..3 {
            let mut child = start(&example, &path);
            let output = child.stdout.take().expect("piped");
            let mut lines = BufReader::new(output);
            let patience = 1 + random.below(15);
            for _ in 0..patience {
                let mut line = String::new();
                lines.read_line(&mut line).expect("read");
                if let Some(number) = line.trim().strip_prefix("ACK ") {
                    acknowledged = number.parse().expect("a number");
                }
            }
            child.kill().expect("killed");
            child.wait().expect("gone");
            let mut rest = String::new();
            lines.read_to_string(&mut rest).expect("read");
            // What was printed before the kill counts, read by us or not.
            for number in rest.lines().filter_map(|line| line.strip_prefix("ACK ")) {
                acknowledged = number.parse().unwrap_or(acknowledged);
            }
            if !path.join("dataset.toml").exists() {
                let rows = Recorder::resume(&path).map_or(0, |recorder| recorder.table().rows());
                assert!(
                    rows >= acknowledged,
                    "{rows} of {acknowledged} acknowledged"
                );
            }
        }
        let finished = start(&example, &path).wait_with_output().expect("finishes");
        assert!(finished.status.success());
        let dataset = Dataset::open(&path).expect("opens");
        assert_eq!(dataset.table().rows(), 60);
        for row in dataset.all_rows() {
            assert!(dataset.frame(row).expect("whole").is_some());
        }
    }
}
