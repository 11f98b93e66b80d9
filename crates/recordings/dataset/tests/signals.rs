//! Tests of taxel signals beside the table of labels: recorded, resumed, read on request, and verified.

use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::{
    Channel, Channels, Clock, Field, FieldSet, PressOutcome, Readings, Sample, SampleSink,
    SignalInfo, Signals, SilentProgress, SinkError, Unit,
};
use taceva_dataset::{
    Dataset, DatasetError, Header, Pass, Recorder, RecordingFacts, RecordingSpec, SensorFacts,
    SignalsSpec, Source,
};

fn info() -> SignalInfo {
    SignalInfo::new(5, 1, 3, Unit::Microtesla).expect("fifteen numbers")
}

fn spec() -> RecordingSpec {
    let facts = RecordingFacts::new(
        Source::Synthetic,
        Clock::Unknown,
        SensorFacts::new("a drawn skin"),
    );
    let taxels = SignalsSpec::new(info(), ["x", "y", "z"]).expect("three names");
    RecordingSpec::new(facts, Channels::new([Channel::FZ]).expect("one"))
        .with_signals(taxels.with_rest([[0, 1]]))
}

fn values(row: u16) -> Vec<f32> {
    (0..15_u16)
        .map(|place| f32::from(row) + f32::from(place) / 15.0)
        .collect()
}

fn sample(row: u16) -> Sample {
    let signals = Signals::new(info(), values(row)).expect("finite");
    Sample::new(format!("press {row}"))
        .with_truth(Readings::from_values([f64::from(row)]))
        .with_signals(signals)
}

fn recorded(path: &Path, rows: u16) -> Header {
    let mut recorder = Recorder::create(path, &spec()).expect("created");
    for row in 0..rows {
        recorder.append(&sample(row)).expect("recorded");
    }
    recorder.close().expect("closed")
}

/// Sink that requests the fields of its first part, and keeps the signals in its second part.
struct Keep(FieldSet, Vec<Option<Signals>>);

impl SampleSink for Keep {
    fn fields(&self) -> FieldSet {
        self.0
    }
    fn accept(&mut self, sample: &Sample) -> Result<(), SinkError> {
        self.1.push(sample.signals.clone());
        Ok(())
    }
}

fn streamed(dataset: &Dataset, fields: FieldSet) -> Result<Vec<Option<Signals>>, DatasetError> {
    let mut sink = Keep(fields, Vec::new());
    let rows = dataset.all_rows();
    let pass = Pass::new(&rows, NonZeroUsize::new(3).expect("three"), &SilentProgress);
    dataset.stream(pass, &mut sink)?;
    Ok(sink.1)
}

#[test]
fn signals_are_recorded_and_streamed_in_the_order_of_rows() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let header = recorded(&path, 7);
    let dataset = Dataset::open(&path).expect("opens");
    assert_eq!(dataset.header(), &header);
    assert!(dataset.fields().contains(Field::Signals) && !dataset.fields().contains(Field::Frame));
    let found = streamed(&dataset, FieldSet::EMPTY.with(Field::Signals)).expect("read");
    for (row, signals) in (0..).zip(found) {
        assert_eq!(signals.expect("asked for").values(), values(row));
    }
    // The mean of the two rows without contact.
    let rest = dataset.rest().expect("read").expect("known");
    for (place, rest) in rest.values().iter().enumerate() {
        let [first, second] = [0, 1].map(|row| f64::from(values(row)[place]));
        // Half a unit in the last place of single precision.
        assert!((f64::from(*rest) - (first + second) / 2.0).abs() <= f64::from(f32::EPSILON) / 2.0);
    }
    dataset.verify_frames().expect("whole");
}

#[test]
fn what_nobody_asks_for_is_not_read_and_what_is_damaged_is_noticed_when_it_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    recorded(&path, 4);
    let file = path.join("signals.parquet");
    let original = fs::read(&file).expect("there");
    let mut flipped = original.clone();
    flipped[original.len() / 2] ^= 4;
    fs::write(&file, &flipped).expect("written");
    let dataset = Dataset::open(&path).expect("opens");
    let without = streamed(&dataset, FieldSet::PAIRS).expect("labels alone");
    assert!(without.iter().all(Option::is_none));
    let message = dataset.signals(0).expect_err("damaged").to_string();
    assert!(
        message.contains("signals.parquet: damaged: expected sha256:"),
        "{message}"
    );
    assert!(dataset.verify_frames().is_err());
    fs::remove_file(&file).expect("removed");
    let dataset = Dataset::open(&path).expect("opens");
    assert!(matches!(dataset.signals(0), Err(DatasetError::Io { .. })));
}

#[test]
fn signals_decide_the_digest_that_the_header_states() {
    let folder = tempfile::tempdir().expect("a folder");
    let [with, without] = ["with", "without"].map(|name| folder.path().join(name));
    let header = recorded(&with, 4);
    let mut spec = spec();
    spec.signals = None;
    let mut recorder = Recorder::create(&without, &spec).expect("created");
    for row in 0..4 {
        recorder
            .append(&sample(row).with_signals(None))
            .expect("recorded");
    }
    let plain = recorder.close().expect("closed");
    assert_ne!(header.digest, plain.digest);
    let text = fs::read_to_string(with.join("dataset.toml")).expect("there");
    assert!(
        text.contains(&format!("digest = \"{}\"", header.digest)),
        "{text}"
    );
}

#[test]
fn a_header_that_says_something_else_of_the_taxels_is_refused() {
    for (from, to) in [
        ("unit = \"uT\"", "unit = \"V\""),
        ("rows = 5", "rows = 1"),
        ("\"x\", \"y\"", "\"y\", \"x\""),
        ("rest = [[0, 1]]", "rest = [[0, 2]]"),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("set");
        recorded(&path, 4);
        let header = path.join("dataset.toml");
        let text = fs::read_to_string(&header).expect("there");
        let edited = text.replacen(from, to, 1);
        assert_ne!(text, edited, "{from} is not in {text}");
        fs::write(&header, edited).expect("written");
        assert!(Dataset::open(&path).is_err(), "{from} → {to}");
        // Also after the edit is accepted, by the digest of the content.
        let text = fs::read_to_string(&header).expect("there");
        let sealed =
            taceva_files::seal::toml_text::reseal(&text, "2026-01-01", "a test").expect("sealed");
        fs::write(&header, sealed).expect("written");
        let read = Dataset::open(&path).and_then(|dataset| dataset.verify_frames());
        assert!(read.is_err(), "{from} → {to}");
    }
}

#[test]
fn a_recording_of_taxels_is_resumed_with_every_number() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec()).expect("created");
    recorder.append(&sample(0)).expect("recorded");
    let press = [1, 2].map(sample);
    recorder
        .append_press("press", PressOutcome::Complete, &press)
        .expect("recorded");
    drop(recorder);
    let mut resumed = Recorder::open(&path, &spec()).expect("resumed");
    resumed.append(&sample(3)).expect("recorded");
    let header = resumed.close().expect("closed");
    let at_once = folder.path().join("at once");
    let mut recorder = Recorder::create(&at_once, &spec()).expect("created");
    for row in 0..4 {
        recorder.append(&sample(row)).expect("recorded");
    }
    assert_eq!(recorder.close().expect("closed").signals, header.signals);
    let dataset = Dataset::open(&path).expect("opens");
    assert_eq!(
        dataset.signals(3).expect("read").expect("there").values(),
        values(3)
    );
    let names = fs::read_dir(&path).expect("there").flatten();
    assert!(
        names
            .map(|name| name.file_name())
            .all(|name| !name.to_string_lossy().contains("partial"))
    );
}

#[test]
fn a_sample_without_the_signals_of_its_recording_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut recorder = Recorder::create(&folder.path().join("set"), &spec()).expect("created");
    let message = recorder
        .append(&Sample::new("bare"))
        .expect_err("none")
        .to_string();
    assert!(
        message.contains("no signals, expected signals of 5×1 places of 3 in uT"),
        "{message}"
    );
    let other = SignalInfo::new(1, 1, 1, Unit::Count).expect("one");
    let signals = Signals::new(other, vec![1.0]).expect("finite");
    assert!(recorder.append(&sample(0).with_signals(signals)).is_err());
    recorder.append(&sample(0)).expect("recorded");
}
