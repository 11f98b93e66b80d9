//! Tests of samples, folders and links that a recorder rejects.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use taceva_core::{Frame, FrameInfo, PixelFormat, Readings, Stamp};
use taceva_dataset::{Dataset, DatasetError, Recorder};

use super::{frame, sample, spec};

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
            {
                let mut nameless = sample(2);
                nameless.id = String::new();
                nameless
            },
            "empty or taken",
        ),
        (
            sample(2).with_truth(Readings::from_values([f64::NAN])),
            "NaN is not a finite number",
        ),
        (
            sample(2).with_truth(Readings::from_values([0.0; 3])),
            "3 values, expected at most 2",
        ),
        (
            sample(2).with_stamp(Stamp {
                valid_s: f64::INFINITY,
                received_s: None,
            }),
            "inf is not a finite number",
        ),
        (
            sample(2).with_frame(Frame::new(small, vec![0]).expect("one byte")),
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
    assert!(error.to_string().contains("has another sensor"), "{error}");
}

#[cfg(unix)]
#[test]
fn links_at_names_of_a_recording_lead_nothing_elsewhere() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().expect("a folder");
    let theirs = folder.path().join("theirs");
    let thesis = theirs.join("thesis.tex");
    std::fs::create_dir(&theirs).expect("made");
    std::fs::write(&thesis, "theirs").expect("written");
    // Links from before the recording, in a folder that looks like an interrupted creation.
    for (name, leads_to) in [("journal", &thesis), ("frames", &theirs)] {
        let path = folder.path().join(format!("begun-{name}"));
        std::fs::create_dir(&path).expect("made");
        symlink(leads_to, path.join(name)).expect("linked");
        let refused = Recorder::create(&path, &spec()).expect_err("a link");
        assert!(
            matches!(refused, DatasetError::TargetExists { .. }),
            "{name}: {refused}"
        );
    }
    // Link at the name of the first pack, before the first frame.
    let path = folder.path().join("pack");
    let mut recorder = Recorder::create(&path, &spec()).expect("created");
    let frames = path.join("frames");
    let packs = (0..3).map(|number| frames.join(format!("{number:04}.pack")));
    packs.for_each(|pack| symlink(&thesis, pack).expect("linked"));
    recorder.append(&sample(1)).expect_err("a link");
    drop(recorder);
    // Links made during the recording, at the names of its last files.
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec()).expect("created");
    recorder.append(&sample(1)).expect("recorded");
    for name in ["samples.parquet", "dataset.toml"] {
        symlink(&thesis, path.join(format!("{name}.partial"))).expect("linked");
        symlink(&thesis, path.join(name)).expect("linked");
    }
    recorder.close().expect("closed");
    let dataset = Dataset::open(&path).expect("opens");
    assert_eq!(dataset.table().rows(), 1);
    assert!(!path.join("dataset.toml").is_symlink());
    assert_eq!(std::fs::read_to_string(&thesis).expect("there"), "theirs");
    assert_eq!(theirs.read_dir().expect("there").count(), 1);
}

/// Relative paths of the files and folders of a recording, with the content of files.
fn entries(recording: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut entries = BTreeMap::new();
    for folder in [recording.to_owned(), recording.join("frames")] {
        for entry in folder.read_dir().into_iter().flatten() {
            let path = entry.expect("readable").path();
            let bytes = std::fs::read(&path).unwrap_or_default();
            let name = path.strip_prefix(recording).expect("below it");
            entries.insert(name.to_owned(), bytes);
        }
    }
    entries
}

/// Creates an interrupted recording with a reference and two frames.
fn interrupted(path: &Path) {
    let mut recorder = Recorder::create(path, &spec()).expect("created");
    recorder.append_reference(&frame(0)).expect("recorded");
    recorder.append(&sample(1)).expect("recorded");
    recorder.append(&sample(2)).expect("recorded");
}

#[cfg(unix)]
#[test]
fn a_link_in_place_of_any_file_of_a_recording_is_refused_and_its_target_keeps_its_bytes() {
    let folder = tempfile::tempdir().expect("a folder");
    let whole = folder.path().join("whole");
    interrupted(&whole);
    let mut names: Vec<PathBuf> = entries(&whole).into_keys().collect();
    assert_eq!(names.len(), 4, "{names:?}");
    // Names that are unused until the recording is closed.
    let later = ["dataset.toml", "samples.parquet", "predictions.csv"];
    let later = later.map(|name| [name.to_owned(), format!("{name}.partial")]);
    names.extend(later.into_iter().flatten().map(PathBuf::from));
    for name in names {
        let folder = tempfile::tempdir().expect("a folder");
        let (path, theirs) = (folder.path().join("set"), folder.path().join("theirs"));
        interrupted(&path);
        std::fs::create_dir(&theirs).expect("made");
        let (link, target) = (path.join(&name), theirs.join("target"));
        match link.exists() {
            true => std::fs::rename(&link, &target).expect("moved"),
            false => std::fs::write(&target, "theirs").expect("written"),
        }
        std::os::unix::fs::symlink(&target, &link).expect("linked");
        let before = [entries(&theirs), entries(&target), entries(&path)];
        for resumed in [Recorder::resume(&path), Recorder::open(&path, &spec())] {
            let error = resumed.expect_err("a link").to_string();
            let (link, target) = (link.display(), target.display());
            let ways = [
                format!("{link}: damaged: a symbolic link to {target}"),
                format!("`rm {link} && mv {target} {link}`"),
                "move the whole recording to the disk of the target".to_owned(),
            ];
            for way in ways {
                assert!(error.contains(&way), "{}: {error}", name.display());
            }
        }
        let after = [entries(&theirs), entries(&target), entries(&path)];
        assert_eq!(after, before, "{}", name.display());
    }
}

#[cfg(unix)]
#[test]
fn frames_on_another_disk_are_put_back_by_the_command_of_the_message() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    interrupted(&path);
    std::fs::rename(path.join("frames"), folder.path().join("disk")).expect("moved");
    std::os::unix::fs::symlink("../disk", path.join("frames")).expect("linked");
    let error = Recorder::resume(&path).expect_err("a link").to_string();
    let (_, command) = error.split_once('`').expect("a command");
    let (command, _) = command.split_once('`').expect("its end");
    let done = std::process::Command::new("sh")
        .args(["-c", command])
        .status();
    assert!(done.expect("there is a shell").success(), "{command}");
    let recorder = Recorder::resume(&path).expect("resumed");
    recorder.close().expect("closed");
    assert_eq!(Dataset::open(&path).expect("opens").table().rows(), 2);
}
