//! Tests that a stream is recorded several frames at a time. Files of a camera are stored unchanged, and lost frames are counted in the header.

use std::fs;
use std::path::Path;

use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder};
use taceva_core::{
    Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample, Stamp,
};
use taceva_dataset::{
    Dataset, DatasetError, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source,
    StreamFacts, Streamed, Version,
};

const INFO: FrameInfo = FrameInfo {
    width: 16,
    height: 8,
    format: PixelFormat::Gray8,
};

fn spec() -> RecordingSpec {
    let facts = RecordingFacts::new(
        Source::Recorded,
        Clock::Monotonic,
        SensorFacts::new("camera"),
    );
    RecordingSpec::new(facts, Channels::new([Channel::FZ]).expect("one"))
}

fn sample(number: u8) -> Sample {
    let pixels = (0..INFO.byte_len().expect("small"))
        .map(|at| number.wrapping_mul(31) ^ at.to_le_bytes()[0])
        .collect();
    Sample::new(format!("frame-{number}"))
        .with_stamp(Stamp::at(std::time::Duration::from_millis(
            100 * u64::from(number),
        )))
        .with_truth(Readings::from_values([f64::from(number)]))
        .with_frame(Frame::new(INFO, pixels).expect("its own length"))
}

fn jpeg(sample: &Sample) -> Vec<u8> {
    let frame = sample.frame.as_ref().expect("it has one");
    let mut file = Vec::new();
    JpegEncoder::new_with_quality(&mut file, 90)
        .write_image(
            frame.bytes(),
            INFO.width,
            INFO.height,
            ExtendedColorType::L8,
        )
        .expect("encoded");
    file
}

fn recorded(path: &Path) -> Recorder {
    let mut recorder = Recorder::create(path, &spec()).expect("new");
    let drawn: Vec<Streamed> = [1, 2].map(|at| Streamed::new(sample(at))).into();
    recorder
        .append_stream(&drawn, StreamFacts::new(true))
        .expect("recorded");
    let sent = sample(3);
    let file = jpeg(&sent);
    let sent = Streamed::new(sent).with_sent(file).expect("whole");
    recorder
        .append_stream(&[sent], StreamFacts::new(true).with_lost(5, 1))
        .expect("recorded");
    recorder
}

#[test]
fn what_was_sent_stays_byte_for_byte_and_what_was_drawn_reads_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("stream");
    let header = recorded(&path).close().expect("closed");
    assert_eq!(header.stream, Some(StreamFacts::new(true).with_lost(5, 1)));
    assert_eq!(header.format, Version::CURRENT);
    let dataset = Dataset::open(&path).expect("whole");
    for row in 0..2 {
        let read = dataset.frame(row).expect("read").expect("a frame");
        let number = u8::try_from(row).expect("small") + 1;
        assert_eq!(Some(read), sample(number).frame);
    }
    let file = jpeg(&sample(3));
    let pack = fs::read(path.join("frames/0000.pack")).expect("a pack");
    assert!(pack.ends_with(&file), "the last file is what was sent");
    assert_eq!(
        dataset.frame(2).expect("read").expect("a frame").info(),
        INFO
    );
    assert_eq!(dataset.damage_inside(2).expect("read"), None);
    assert_eq!(dataset.header().stream, header.stream);
}

#[test]
fn a_torn_record_leaves_none_of_its_frames_and_the_counts_before_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("stream");
    drop(recorded(&path));
    let journal = path.join("journal");
    let bytes = fs::read(&journal).expect("there");
    fs::write(&journal, &bytes[..bytes.len() - 1]).expect("torn");
    let recorder = Recorder::resume(&path).expect("what was whole");
    assert!(recorder.cut_bytes() > 0);
    assert_eq!(recorder.table().samples(), ["frame-1", "frame-2"]);
    let header = recorder.close().expect("closed");
    assert_eq!(header.stream, Some(StreamFacts::new(true)));
}

#[test]
fn a_file_that_is_no_picture_or_cut_is_refused_before_it_is_recorded() {
    let whole = jpeg(&sample(1));
    let mut cut = whole[..whole.len() / 2].to_vec();
    cut.extend(b"\xff\xd9");
    for (bytes, words) in [
        (b"GIF89a".to_vec(), "neither PNG nor JPEG"),
        (whole[..whole.len() - 2].to_vec(), "cut"),
        (cut, "damaged inside"),
    ] {
        let refused = Streamed::new(sample(1)).with_sent(bytes);
        let said = refused.expect_err(words);
        assert!(said.contains(words), "{said}");
    }
}

#[test]
fn two_frames_of_one_name_or_of_two_sizes_are_refused_together() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut recorder = Recorder::create(&folder.path().join("stream"), &spec()).expect("new");
    let twice = [1, 1].map(|at| Streamed::new(sample(at)));
    let refused = recorder.append_stream(&twice, StreamFacts::new(false));
    assert!(matches!(refused, Err(DatasetError::Sample { .. })));
    assert_eq!(recorder.table().rows(), 0);
}

#[test]
fn a_recording_that_is_no_stream_says_nothing_of_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("presses");
    let mut recorder = Recorder::create(&path, &spec()).expect("new");
    recorder.append(&sample(1)).expect("recorded");
    let header = recorder.close().expect("closed");
    assert_eq!(header.stream, None);
}
