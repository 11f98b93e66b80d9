//! Tests of rejected exports, and of the state after an interrupted export.

use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::{
    Channel, Channels, Clock, Frame, FrameInfo, Instrument, PixelFormat, Progress, Readings,
    Sample, SignalInfo, Signals, SilentProgress, Traceability, Unit,
};
use taceva_dataset::{
    Dataset, DatasetError, Recorder, RecordingFacts, RecordingSpec, SensorFacts, SignalsSpec,
    Source,
};
use taceva_import::{ExportForm, ExportPlan, ImportError};

use super::drawn::{exported, skin};

/// Progress receiver that cancels at once.
#[derive(Debug)]
struct Stopped;

impl Progress for Stopped {
    fn is_cancelled(&self) -> bool {
        true
    }
}

fn export(
    dataset: &Dataset,
    (form, target): (ExportForm, &Path),
    progress: &dyn Progress,
) -> Result<(), ImportError> {
    let plan = ExportPlan::new(dataset, form)?;
    plan.run(target, NonZeroUsize::MIN, progress).map(drop)
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("there").flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn an_export_that_is_stopped_or_has_no_free_place_leaves_nothing_new() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = skin(folder.path());
    let target = folder.path().join("exported");
    for form in ExportForm::ALL {
        let stopped = export(&dataset, (form, &target), &Stopped);
        assert!(
            matches!(stopped, Err(ImportError::Dataset(DatasetError::Cancelled))),
            "{form:?}"
        );
        assert_eq!(names(folder.path()), ["skin"], "{form:?}");
    }
    fs::create_dir(&target).expect("made");
    for form in ExportForm::ALL {
        let taken = export(&dataset, (form, &target), &SilentProgress);
        assert!(
            matches!(
                taken,
                Err(ImportError::Dataset(DatasetError::TargetExists { .. }))
            ),
            "{form:?}"
        );
    }
    assert_eq!(names(&target), Vec::<String>::new());
}

#[test]
fn what_a_kill_left_is_cleared_by_the_next_export_and_what_a_stranger_left_is_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = skin(folder.path());
    let left = folder.path().join(".taceva-staged-a1b2c3");
    fs::create_dir_all(left.join("skin.csv/frames")).expect("made");
    fs::write(left.join("skin.csv/labels.csv"), "half").expect("written");
    let target = folder.path().join("skin.csv");
    exported(&dataset, ExportForm::Csv);
    assert!(left.join("skin.csv/labels.csv").exists(), "a stranger's");
    fs::remove_dir_all(&target).expect("removed");
    fs::write(left.join(".taceva-temporary"), "").expect("written");
    exported(&dataset, ExportForm::Csv);
    assert_eq!(names(folder.path()), ["skin", "skin.csv"]);
    assert_eq!(names(&target), ["labels.csv", "map.toml"]);
}

fn recorder(path: &Path) -> Recorder {
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("gel"));
    let channels = Channels::new([Channel::FZ]).expect("distinct");
    Recorder::create(path, &RecordingSpec::new(facts, channels)).expect("new")
}

fn sample(name: &str) -> Sample {
    Sample::new(name).with_truth(Readings::from_values([0.5]))
}

#[test]
fn a_dataset_without_samples_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("empty");
    recorder(&path).close().expect("closed");
    let dataset = Dataset::open(&path).expect("a dataset");
    for form in ExportForm::ALL {
        let refused = export(
            &dataset,
            (form, &folder.path().join("out")),
            &SilentProgress,
        );
        let message = refused.expect_err("nothing").to_string();
        assert!(
            message.ends_with("no samples: there is nothing to export"),
            "{message}"
        );
    }
}

#[test]
fn samples_without_a_picture_are_kept_where_the_form_can_and_named_where_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("some");
    let mut recorder = recorder(&path);
    let info = FrameInfo {
        width: 2,
        height: 1,
        format: PixelFormat::Gray8,
    };
    let frame = Frame::new(info, vec![7, 90]).expect("whole");
    recorder
        .append(&sample("with").with_frame(frame))
        .expect("recorded");
    recorder.append(&sample("without")).expect("recorded");
    recorder.close().expect("closed");
    let dataset = Dataset::open(&path).expect("a dataset");
    for form in [ExportForm::Csv, ExportForm::HuggingFace] {
        let (_, report) = exported(&dataset, form);
        assert_eq!((report.samples, report.pictures), (2, 1));
        assert_eq!(
            report.left_out,
            ["missing pictures of samples, which an import refuses"]
        );
    }
    for form in [ExportForm::Hdf5, ExportForm::LeRobot] {
        let refused = export(
            &dataset,
            (form, &folder.path().join("out")),
            &SilentProgress,
        );
        let message = refused.expect_err("one is missing").to_string();
        assert!(
            message.starts_with("sample `without`: no picture, and this format needs pictures"),
            "{message}"
        );
        assert!(!folder.path().join("out").exists());
    }
}

#[test]
fn a_picture_without_contact_alone_is_named_as_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("alone");
    let mut recorder = recorder(&path);
    recorder.append(&sample("a")).expect("recorded");
    let info = FrameInfo {
        width: 2,
        height: 1,
        format: PixelFormat::Gray8,
    };
    let frame = Frame::new(info, vec![7, 90]).expect("whole");
    recorder.append_reference(&frame).expect("recorded");
    recorder.close().expect("closed");
    let dataset = Dataset::open(&path).expect("a dataset");
    for form in ExportForm::ALL {
        let (out, report) = exported(&dataset, form);
        let left = "the picture without contact, since no sample has one";
        let expected = dataset.header().frames.as_ref().map(|_| left.to_owned());
        assert_eq!(report.left_out, Vec::from_iter(expected), "{form:?}");
        let map = fs::read_to_string(out.join("map.toml")).expect("a map");
        assert!(!map.contains("[frame]"), "{map}");
    }
}

#[test]
fn several_entries_of_an_instrument_and_the_driver_of_a_sensor_are_named_as_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("traced");
    let of = |instrument, driver: &str| Traceability::new(instrument).with_driver(driver, None);
    let force = ["lab/one", "lab/other"].map(|driver| of(Instrument::Force, driver));
    let sensor = of(Instrument::Sensor, "lab/camera");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("gel"))
        .with_traceability(force.into_iter().chain([sensor]).collect());
    let channels = Channels::new([Channel::FZ]).expect("distinct");
    let spec = RecordingSpec::new(facts, channels);
    let mut recorder = Recorder::create(&path, &spec).expect("new");
    recorder.append(&sample("a")).expect("recorded");
    recorder.close().expect("closed");
    let dataset = Dataset::open(&path).expect("a dataset");
    let (out, report) = exported(&dataset, ExportForm::Csv);
    assert_eq!(
        report.left_out,
        [
            "instruments with several certificates",
            "driver and serial number beside the certificate of the sensor"
        ]
    );
    let map = fs::read_to_string(out.join("map.toml")).expect("a map");
    assert!(!map.contains("lab/"), "{map}");
}

#[test]
fn texts_that_a_form_cannot_hold_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("texts");
    let mut recorder = recorder(&path);
    recorder.append(&sample("a\0b")).expect("recorded");
    recorder
        .append(&sample(" padded ").with_point_id("x".repeat(5000)))
        .expect("recorded");
    recorder.close().expect("closed");
    let dataset = Dataset::open(&path).expect("a dataset");
    let target = folder.path().join("out");
    let refused = export(&dataset, (ExportForm::Hdf5, &target), &SilentProgress);
    let message = refused.expect_err("a zero").to_string();
    assert!(
        message.contains("`sample` contains a NUL character"),
        "{message}"
    );
    let (_, report) = exported(&dataset, ExportForm::Csv);
    assert_eq!(
        report.left_out,
        ["blanks around texts, which an import strips"]
    );
}

#[test]
fn a_channel_that_is_called_as_a_taxel_has_no_place_in_a_table_and_one_elsewhere() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("names");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("skin"));
    let info = SignalInfo::new(1, 2, 1, Unit::Count).expect("a grid");
    let channel = Channel::named("taxel_0_1_p", Unit::Newton).expect("a name");
    let spec = RecordingSpec::new(facts, Channels::new([channel]).expect("distinct"));
    let signals = SignalsSpec::new(info, ["p"]).expect("named");
    let mut recorder = Recorder::create(&path, &spec.with_signals(signals)).expect("new");
    let signals = Signals::new(info, vec![1.0, 2.0]).expect("whole");
    recorder
        .append(&sample("a").with_signals(signals))
        .expect("recorded");
    recorder.close().expect("closed");
    let dataset = Dataset::open(&path).expect("a dataset");
    let target = folder.path().join("out");
    let refused = export(&dataset, (ExportForm::Csv, &target), &SilentProgress);
    let message = refused.expect_err("twice").to_string();
    assert!(message.contains("has the name `taxel_0_1_p`"), "{message}");
    for form in [
        ExportForm::HuggingFace,
        ExportForm::Hdf5,
        ExportForm::LeRobot,
    ] {
        exported(&dataset, form);
    }
}
