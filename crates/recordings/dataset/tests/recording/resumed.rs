//! Tests that an interrupted recording is resumed with the same result.

use std::fs;

use taceva_dataset::{Dataset, DatasetError, Recorder};

use super::{sample, spec};
use crate::support::{Random, contents};

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
    assert_eq!(contents(&twice), contents(&once));
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
    // Interrupted before the header was renamed: the journal decides.
    fs::write(path.join("journal"), &journal).expect("written");
    fs::remove_file(path.join("dataset.toml")).expect("removed");
    let recorder = Recorder::resume(&path).expect("resumed");
    assert_eq!(recorder.close().expect("closed").digest, digest);
    // Interrupted after the header was renamed: the journal is a leftover.
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

#[test]
fn what_was_set_of_the_camera_is_kept_and_a_recording_goes_on_with_the_same_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let with = |exposure_ms: &str| {
        let mut spec = spec();
        let settings = [("exposure_ms".to_owned(), exposure_ms.to_owned())];
        spec.facts = spec.facts.with_settings(settings.into());
        spec
    };
    let mut recorder = Recorder::create(&path, &with("15.7")).expect("created");
    recorder.append(&sample(1)).expect("recorded");
    drop(recorder);
    let other = Recorder::open(&path, &with("20.0")).map(drop);
    let other = other.expect_err("pictures of two exposures are no recording");
    let words = "the setting `exposure_ms` is `20.0`, expected `15.7`";
    assert!(other.to_string().contains(words), "{other}");
    let mut recorder = Recorder::open(&path, &with("15.7")).expect("resumed");
    recorder.append(&sample(2)).expect("recorded");
    recorder.close().expect("closed");
    let header = Dataset::open(&path).expect("whole").header().clone();
    assert_eq!(
        header.settings.get("exposure_ms").map(String::as_str),
        Some("15.7")
    );
}

#[test]
fn a_recording_of_a_build_that_kept_fewer_settings_goes_on_and_one_whose_setting_is_gone_does_not()
{
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let with = |names: &[&str]| {
        let mut spec = spec();
        let settings = names
            .iter()
            .map(|name| ((*name).to_owned(), "5".to_owned()));
        spec.facts = spec.facts.with_settings(settings.collect());
        spec
    };
    drop(Recorder::create(&path, &with(&["gain"])).expect("created"));
    drop(Recorder::open(&path, &with(&["force_serial", "gain"])).expect("resumed"));
    let gone = Recorder::open(&path, &with(&["force_serial"])).map(drop);
    let gone = gone.expect_err("the gain is unknown").to_string();
    let words = "the setting `gain` is not stated by the device, expected `5`";
    assert!(gone.contains(words), "{gone}");
}
