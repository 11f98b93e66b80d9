//! Tests of links in place of files of an existing recording: the link targets keep their bytes.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use taceva_core::{Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample};
use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
use taceva_tests::power_cut::{read_tree, write_tree};
use taceva_tests::{Form, Lab, scratch, taceva};

/// Result of a command on a recording that contains a link.
struct Ended {
    /// Path that the link replaced.
    name: String,
    code: Option<i32>,
    message: String,
}

/// Runs the command `words` once for each file and folder of `recording`. `DATA` in `words` is a copy of the recording in which a link replaces this
/// file or folder.
fn with_links(recording: &Path, words: &[&str]) -> Vec<Ended> {
    let whole = read_tree(recording).expect("readable");
    let mut ended = Vec::new();
    for name in whole.keys().filter(|name| !name.is_empty()) {
        let folder = scratch();
        let path = |name: &str| folder.path().join(name);
        let (data, theirs) = (path("data"), path("theirs"));
        for made in [&data, &theirs] {
            std::fs::create_dir(made).expect("made");
        }
        write_tree(&whole, &data).expect("room");
        std::fs::rename(data.join(name), theirs.join("target")).expect("moved");
        std::os::unix::fs::symlink(theirs.join("target"), data.join(name)).expect("linked");
        let before = read_tree(&theirs).expect("readable");
        let words = words.iter().map(|word| match *word {
            "DATA" => data.clone(),
            word => PathBuf::from(word),
        });
        let output = Command::new(taceva())
            .args(words)
            .env("HOME", folder.path())
            .env("XDG_CACHE_HOME", path("cache"))
            .stdin(Stdio::null())
            .output()
            .expect("built");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        let after = read_tree(&theirs).expect("readable");
        assert!(after == before, "{name}: changed elsewhere: {message}");
        ended.push(Ended {
            name: name.clone(),
            code: output.status.code(),
            message,
        });
    }
    ended
}

/// Creates an interrupted recording with a frame and a reference.
fn interrupted(path: &Path) {
    let facts = RecordingFacts::new(Source::Recorded, Clock::Monotonic, SensorFacts::new("gel"));
    let spec = RecordingSpec::new(facts, Channels::new([Channel::FZ]).expect("one"));
    let info = FrameInfo {
        width: 2,
        height: 2,
        format: PixelFormat::Gray8,
    };
    let frame = Frame::new(info, vec![7; 4]).expect("four bytes");
    let mut recorder = Recorder::create(path, &spec).expect("created");
    recorder.append_reference(&frame).expect("recorded");
    let sample = Sample::new("press 1").with_truth(Readings::from_values([0.5]));
    recorder
        .append(&sample.with_frame(frame))
        .expect("recorded");
}

#[test]
fn an_interrupted_recording_with_a_link_in_it_is_refused_in_words() {
    let folder = scratch();
    let recording = folder.path().join("recording");
    interrupted(&recording);
    let ended = with_links(&recording, &["capture", "DATA", "--close"]);
    assert_eq!(ended.len(), 4);
    for Ended {
        name,
        code,
        message,
    } in ended
    {
        let is_refused = code == Some(3) && message.contains("a symbolic link");
        assert!(is_refused, "{name}: {code:?}: {message}");
    }
}

#[test]
fn rows_are_added_to_a_dataset_with_links_in_it_without_a_change_elsewhere() {
    let (lab, more) = (Lab::drawn(Form::Png, 6), Lab::drawn_from(Form::Png, 500, 6));
    let folder = scratch();
    let dataset = folder.path().join("dataset");
    let imported = Command::new(taceva())
        .arg("import")
        .arg(lab.path())
        .arg("--map")
        .arg(lab.map())
        .arg("--out")
        .arg(&dataset)
        .arg("-q")
        .status()
        .expect("built");
    assert!(imported.success());
    let from = more.path().display().to_string();
    let map = more.map().display().to_string();
    let words = ["import", &from, "--map", &map, "--extend", "DATA", "-q"];
    let ended = with_links(&dataset, &words);
    assert!(ended.len() > 6, "{}", ended.len());
    for Ended {
        name,
        code,
        message,
    } in ended
    {
        // Added or refused: neither a panic nor a signal.
        let is_orderly = code.is_some_and(|code| code < 100);
        assert!(is_orderly, "{name}: {code:?}: {message}");
    }
}
