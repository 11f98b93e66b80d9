//! Tests that a press is recorded as a whole. An interruption keeps all of its samples or none.

use std::fs;
use std::path::Path;

use taceva_core::{
    Channel, Channels, Clock, FieldSet, Frame, FrameInfo, Limit, PixelFormat, PressOutcome,
    Readings, Sample,
};
use taceva_dataset::{
    Dataset, DatasetError, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source,
};

fn spec() -> RecordingSpec {
    let sensor = SensorFacts::new("bench")
        .with_serial("1")
        .with_gel("2")
        .with_opaque(false);
    let facts = RecordingFacts::new(Source::Simulated, Clock::Monotonic, sensor);
    RecordingSpec::new(
        facts,
        Channels::new([Channel::PX, Channel::FZ]).expect("distinct"),
    )
}

fn sample(press: &str, number: u8, width: u32) -> Sample {
    let info = FrameInfo {
        width,
        height: 1,
        format: PixelFormat::Gray8,
    };
    let pixels = (0..width).map(|_| number).collect();
    Sample::new(format!("{press}/{number}"))
        .with_truth(Readings::from_values([0.25, f64::from(number)]))
        .with_frame(Frame::new(info, pixels).expect("its own length"))
}

fn press(name: &str) -> Vec<Sample> {
    (0..3).map(|number| sample(name, number, 4)).collect()
}

fn recorded(path: &Path) -> Recorder {
    let mut recorder = Recorder::create(path, &spec()).expect("new");
    recorder
        .append_press("a", PressOutcome::Complete, &press("a"))
        .expect("recorded");
    recorder
        .append_press("b", PressOutcome::Limited(Limit::NormalForce), &[])
        .expect("recorded");
    recorder
}

#[test]
fn a_torn_press_leaves_none_of_its_samples_and_can_be_made_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let whole = folder.path().join("whole");
    let mut recorder = recorded(&whole);
    let before = fs::metadata(whole.join("journal")).expect("there").len();
    recorder
        .append_press("c", PressOutcome::Complete, &press("c"))
        .expect("recorded");
    drop(recorder);
    let bytes = fs::read(whole.join("journal")).expect("reads");
    let before = usize::try_from(before).expect("small");
    for end in (before..bytes.len()).step_by(97) {
        fs::write(whole.join("journal"), &bytes[..end]).expect("torn");
        let mut resumed = Recorder::resume(&whole).expect("resumes");
        assert_eq!(resumed.table().rows(), 3);
        assert!(resumed.has_press("a") && resumed.has_press("b") && !resumed.has_press("c"));
        resumed
            .append_press("c", PressOutcome::Complete, &press("c"))
            .expect("made again");
    }
    let resumed = Recorder::open(&whole, &spec()).expect("of the same");
    let digest = resumed.close().expect("closes").digest;
    let dataset = Dataset::open(&whole).expect("a dataset");
    assert_eq!((dataset.table().rows(), dataset.digest()), (6, digest));
    assert_eq!(dataset.table().samples()[5], "c/2");
    let uninterrupted = folder.path().join("uninterrupted");
    let mut recorder = recorded(&uninterrupted);
    recorder
        .append_press("c", PressOutcome::Complete, &press("c"))
        .expect("recorded");
    assert_eq!(recorder.close().expect("closes").digest, digest);
}

#[test]
fn a_press_that_is_refused_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut recorder = recorded(&folder.path().join("r"));
    let refused = [
        ("", press("x")),
        ("a", press("x")),
        ("x", vec![sample("x", 0, 4), sample("x", 0, 4)]),
        ("x", vec![sample("x", 0, 4), sample("x", 1, 5)]),
        ("x", press("a")),
    ];
    for (name, samples) in refused {
        let error = recorder
            .append_press(name, PressOutcome::Complete, &samples)
            .expect_err(name);
        assert!(matches!(error, DatasetError::Sample { .. }), "{error}");
    }
    assert_eq!(recorder.table().rows(), 3);
    assert!(!recorder.has_press("x"));
}

#[test]
fn a_press_that_a_limit_ended_is_counted_by_its_limit_though_it_has_no_sample() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("r");
    let mut recorder = recorded(&path);
    let mut samples = press("c");
    samples[2].limited_by = Some(Limit::ShearForce);
    let ended = PressOutcome::Limited(Limit::ShearForce);
    recorder
        .append_press("c", ended, &samples)
        .expect("recorded");
    // An interruption leaves only the journal.
    drop(recorder);
    let header = Recorder::resume(&path).expect("resumes").close();
    let counts = [
        (PressOutcome::Complete, 1),
        (PressOutcome::Limited(Limit::NormalForce), 1),
        (ended, 1),
    ];
    assert_eq!(header.expect("closes").presses, counts.into());
    let dataset = Dataset::open(&path).expect("a dataset");
    assert_eq!(dataset.header().presses, counts.into());
    let limited = dataset.table().limited_by();
    assert_eq!(limited[5], Some(Limit::ShearForce));
    assert!(limited[..5].iter().all(Option::is_none));
    let sample = dataset.table().sample(5, FieldSet::EMPTY, None);
    assert_eq!(sample.limited_by, Some(Limit::ShearForce));
}

#[test]
fn the_uncertainty_of_the_zero_of_depths_outlives_an_interruption_and_others_have_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("r");
    let mut recorder = recorded(&path);
    let mut samples = press("c");
    for sample in &mut samples[..2] {
        sample.zero_u_mm = Some(0.1 / 3.0);
    }
    recorder
        .append_press("c", PressOutcome::Complete, &samples)
        .expect("recorded");
    drop(recorder);
    Recorder::resume(&path)
        .expect("resumes")
        .close()
        .expect("closes");
    let dataset = Dataset::open(&path).expect("a dataset");
    let stated = Some(0.1 / 3.0);
    let expected = [None, None, None, stated, stated, None];
    assert_eq!(dataset.table().zero_u_mm(), expected);
    let sample = dataset.table().sample(4, FieldSet::EMPTY, None);
    assert_eq!(sample.zero_u_mm, stated);
}

#[test]
fn a_table_without_fitted_zeros_has_no_column_of_their_uncertainty() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("r");
    recorded(&path).close().expect("closes");
    let dataset = Dataset::open(&path).expect("a dataset");
    let columns = dataset.table().columns();
    assert!(columns.iter().all(|column| column.name != "zero_u_mm"));
}

#[test]
fn an_uncertainty_that_is_no_number_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut recorder = recorded(&folder.path().join("r"));
    let mut samples = press("c");
    samples[1].zero_u_mm = Some(f64::NAN);
    let refused = recorder.append_press("c", PressOutcome::Complete, &samples);
    assert!(matches!(refused, Err(DatasetError::Sample { .. })));
}
