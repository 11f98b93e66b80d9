//! Tests of recordings of frames that were reduced before they were recorded.

use taceva_core::{Frame, FrameInfo, PixelFormat};
use taceva_dataset::{Dataset, DatasetError, Recorder, RecordingSpec, ReducedFrames};

use super::{frame, sample, spec};

const CAMERA: FrameInfo = FrameInfo {
    width: 9,
    height: 5,
    format: PixelFormat::Rgb16,
};

fn reduced() -> RecordingSpec {
    spec().with_reduced(ReducedFrames::area_averages(CAMERA))
}

#[test]
fn a_header_says_from_what_frames_were_reduced_also_of_a_recording_that_was_gone_on_with() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &reduced()).expect("created");
    recorder.append(&sample(1)).expect("recorded");
    drop(recorder);
    let mut recorder = Recorder::open(&path, &reduced()).expect("resumed");
    recorder.append(&sample(2)).expect("recorded");
    recorder.append_reference(&frame(9)).expect("recorded");
    let header = recorder.close().expect("closed");
    assert_eq!(header.format.to_string(), "1.0");
    let dataset = Dataset::open(&path).expect("opens");
    let frames = dataset.header().frames.as_ref().expect("frames");
    assert_eq!(frames.reduced, Some(ReducedFrames::area_averages(CAMERA)));
    assert_eq!(frames.of_camera(), CAMERA);
    assert_eq!(frames.info, frame(1).info());
    assert_eq!(dataset.frame(1).expect("decodes"), Some(frame(2)));
}

#[test]
fn a_recording_of_frames_as_they_came_says_nothing_of_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec()).expect("created");
    recorder.append(&sample(1)).expect("recorded");
    let header = recorder.close().expect("closed");
    let frames = header.frames.expect("frames");
    assert_eq!(
        (frames.reduced.as_ref(), frames.of_camera()),
        (None, frame(1).info())
    );
    let text = std::fs::read_to_string(path.join("dataset.toml")).expect("reads");
    assert!(!text.contains("reduced"), "{text}");
}

#[test]
fn a_recording_that_was_begun_with_other_frames_is_not_gone_on_with() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &reduced()).expect("created");
    recorder.append(&sample(1)).expect("recorded");
    drop(recorder);
    let larger = FrameInfo {
        width: 12,
        ..CAMERA
    };
    let other = spec().with_reduced(ReducedFrames::area_averages(larger));
    for spec in [spec(), other] {
        let error = Recorder::open(&path, &spec).expect_err("another camera");
        assert!(matches!(error, DatasetError::Request { .. }), "{error}");
        let error = error.to_string();
        assert!(error.contains("or reduction of frames"), "{error}");
    }
    Recorder::open(&path, &reduced()).expect("the same");
}

#[test]
fn a_frame_that_was_not_reduced_is_refused_with_what_was_expected() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &reduced()).expect("created");
    for info in [
        CAMERA,
        FrameInfo {
            width: 10,
            height: 5,
            format: PixelFormat::Rgb8,
        },
        FrameInfo {
            width: 9,
            height: 6,
            format: PixelFormat::Rgb8,
        },
        FrameInfo {
            width: 4,
            height: 2,
            format: PixelFormat::Gray8,
        },
    ] {
        let bytes = vec![0; info.byte_len().expect("small")];
        let foreign = Frame::new(info, bytes).expect("whole");
        let error = recorder.append(&sample(1).with_frame(foreign.clone()));
        let error = error.expect_err("not reduced").to_string();
        let expected = format!(
            "a frame of {info}, expected a frame reduced from 9×5 rgb16: no larger, and in rgb8"
        );
        assert!(error.contains(&expected), "{error}");
        let error = recorder
            .append_reference(&foreign)
            .expect_err("not reduced");
        assert!(error.to_string().contains(&expected), "{error}");
    }
    recorder.append(&sample(1)).expect("recorded");
}
