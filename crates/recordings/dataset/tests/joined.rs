//! Tests of several recordings read as one: assignment of rows, frames and signals.

use std::path::{Path, PathBuf};

use taceva_core::{
    Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample, SignalInfo, Signals,
    Unit,
};
use taceva_dataset::{
    Dataset, DatasetError, Recorder, RecordingFacts, RecordingSpec, SensorFacts, SignalsSpec,
    Source,
};

/// Recording of three samples with frames and signals, whose values count up from `first`. The first row is without contact.
fn record(folder: &Path, name: &str, first: u8, clock: Clock) -> PathBuf {
    record_with(folder, name, (first, 0.0), clock)
}

/// Recording like in [`record`], with labels that are larger by `more`.
fn record_with(folder: &Path, name: &str, (first, more): (u8, f64), clock: Clock) -> PathBuf {
    let path = folder.join(name);
    let facts = RecordingFacts::new(Source::Synthetic, clock, SensorFacts::new("drawn"));
    let taxels = SignalInfo::new(1, 2, 1, Unit::Count).expect("two taxels");
    let signals = SignalsSpec::new(taxels, ["pressure"]).expect("one name");
    let channels = Channels::new([Channel::FZ]).expect("one");
    let spec = RecordingSpec::new(facts, channels).with_signals(signals.with_rest([[0, 0]]));
    let mut recorder = Recorder::create(&path, &spec).expect("a new recording");
    let info = FrameInfo {
        width: 2,
        height: 1,
        format: PixelFormat::Gray8,
    };
    let reference = Frame::new(info, vec![first, first]).expect("whole");
    recorder.append_reference(&reference).expect("recorded");
    for number in first..first + 3 {
        let values = vec![f32::from(number), 1.0];
        recorder
            .append(
                &Sample::new(number.to_string())
                    .with_point_id("p1".to_owned())
                    .with_frame(Frame::new(info, vec![number, 90]).expect("whole"))
                    .with_signals(Signals::new(taxels, values).expect("finite"))
                    .with_truth(Readings::from_values([f64::from(number) + more])),
            )
            .expect("recorded");
    }
    recorder.close().expect("closed");
    path
}

#[test]
fn rows_frames_signals_and_references_are_those_of_the_recordings() {
    let folder = tempfile::tempdir().expect("a folder");
    let paths = [("a", 10), ("b", 20), ("c", 30)]
        .map(|(name, first)| record(folder.path(), name, first, Clock::Unknown));
    let open = || paths.iter().map(|path| Dataset::open(path).expect("opens"));
    let joined = Dataset::joined(open().collect()).expect("alike");
    assert_eq!(joined.table().rows(), 9);
    let points: Vec<_> = joined.table().point_id().iter().flatten().collect();
    assert_eq!((points[0].as_str(), points[8].as_str()), ("a/p1", "c/p1"));
    for (row, (recording, number)) in
        (0..9).map(|row| (row, (row / 3, 10 * (row / 3 + 1) + row % 3)))
    {
        let byte = u8::try_from(number).expect("small");
        let frame = joined.frame(row).expect("read").expect("a frame");
        assert_eq!(frame.bytes(), [byte, 90]);
        let entry = joined.table().frames()[row].as_ref().expect("a frame");
        let own = Dataset::open(&paths[recording]).expect("opens");
        let own_entry = own.table().frames()[row % 3].as_ref().expect("a frame");
        assert_eq!(
            joined.frame_bytes(entry).expect("read"),
            own.frame_bytes(own_entry).expect("read")
        );
        let signals = joined.signals(row).expect("read").expect("signals");
        assert_eq!(signals.values(), [f32::from(byte), 1.0]);
        assert_eq!(joined.damage_inside(row).expect("read"), None);
    }
    assert_eq!(joined.rest_rows().collect::<Vec<_>>(), [0, 3, 6]);
    assert_eq!(joined.reference().expect("read"), None, "each has its own");
    assert_eq!(joined.rest().expect("read"), None, "each has its own");
    joined.verify_frames().expect("whole");
    assert!(joined.frame(9).is_err());
    let again = Dataset::joined(open().collect()).expect("alike");
    assert_eq!(again.digest(), joined.digest());
    let turned = Dataset::joined(open().rev().collect()).expect("alike");
    assert_ne!(turned.digest(), joined.digest());
}

#[test]
fn a_single_recording_is_returned_as_it_is_and_none_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = record(folder.path(), "a", 10, Clock::Unknown);
    let own = Dataset::open(&path).expect("opens");
    let digest = own.digest();
    let one = Dataset::joined(vec![own]).expect("one");
    assert!(one.recordings().is_empty() && one.digest() == digest);
    assert_eq!(one.table().samples()[0], "10");
    assert!(matches!(
        Dataset::joined(Vec::new()),
        Err(DatasetError::Request { .. })
    ));
}

#[test]
fn clocks_may_differ_and_are_then_unknown() {
    let folder = tempfile::tempdir().expect("a folder");
    let one = record(folder.path(), "a", 10, Clock::Monotonic);
    let other = record(folder.path(), "b", 20, Clock::Unix);
    let both = [one, other].map(|path| Dataset::open(&path).expect("opens"));
    let joined = Dataset::joined(both.into()).expect("alike");
    assert_eq!(joined.header().clock, Clock::Unknown);
}

#[test]
fn what_differs_is_named_with_both_recordings() {
    let folder = tempfile::tempdir().expect("a folder");
    let one = record(folder.path(), "a", 10, Clock::Unknown);
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("drawn"));
    let channels = Channels::new([Channel::PZ]).expect("one");
    let path = folder.path().join("z");
    let recorder = Recorder::create(&path, &RecordingSpec::new(facts, channels));
    recorder.expect("a new recording").close().expect("closed");
    let both = [one, path].map(|path| Dataset::open(&path).expect("opens"));
    let error = Dataset::joined(both.into())
        .expect_err("other channels")
        .to_string();
    assert!(
        error.contains("/a and ") && error.contains("/z cannot be joined into one"),
        "{error}"
    );
    assert!(
        error.contains("`channels` is Fz [N] in the first recording and Pz [mm] in the second"),
        "{error}"
    );
}

#[test]
fn recordings_that_share_a_sample_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let paths = [("a", 10), ("b", 12)]
        .map(|(name, first)| record(folder.path(), name, first, Clock::Unknown));
    let open = paths.iter().map(|path| Dataset::open(path).expect("opens"));
    let error = Dataset::joined(open.collect()).expect_err("one sample is in both");
    assert!(
        error
            .to_string()
            .contains("sample `12` of the first recording and sample `12` of the second have the same frame and labels"),
        "{error}"
    );
}

#[test]
fn recordings_that_share_pictures_under_other_labels_are_two_imports_of_one_and_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let joined = |name: &str, first: u8| {
        let one = folder.path().join("one");
        let one = match one.exists() {
            true => one,
            false => record(folder.path(), "one", 10, Clock::Unknown),
        };
        let other = record_with(folder.path(), name, (first, 1e-5), Clock::Unknown);
        let open = [one, other].map(|path| Dataset::open(&path).expect("opens"));
        Dataset::joined(open.into())
    };
    let error = joined("again", 10)
        .expect_err("the same pictures")
        .to_string();
    assert!(
        error.contains("sample `12` of the first recording and sample `12` of the second have the same picture with other labels"),
        "{error}"
    );
    // One or two dark pictures may be equal by chance.
    joined("beside", 11).expect("two pictures");
}
