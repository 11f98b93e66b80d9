//! Tests that frames are stored in packs, as differences to the first frame of each pack.

use std::fs;
use std::path::Path;

use taceva_core::{Frame, FrameInfo, PixelFormat};
use taceva_dataset::{Dataset, DatasetError, Recorder};

use super::{sample, spec};
use crate::support::Random;

/// Frame with static texture, changing noise, and a touched region.
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
        let sample = sample(number).with_frame(textured(number, format));
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
        // In reverse, so that a difference is read before its first frame.
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
fn a_frame_whose_difference_would_be_longer_is_stored_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let info = FrameInfo {
        width: 40,
        height: 30,
        format: PixelFormat::Gray8,
    };
    let mut random = Random::new(3);
    let noise: Vec<u8> = (0..1_200)
        .map(|_| random.below(200).to_le_bytes()[0])
        .collect();
    let frames =
        [noise, vec![90; 1_200]].map(|bytes| Frame::new(info, bytes).expect("of 40×30 pixels"));
    let mut recorder = Recorder::open(&path, &spec()).expect("opened");
    for (number, frame) in (0_u8..).zip(&frames) {
        let sample = sample(number).with_frame(frame.clone());
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    let dataset = Dataset::open(&path).expect("opens");
    dataset.verify_frames().expect("whole");
    for (row, frame) in frames.iter().enumerate() {
        let decoded = dataset.frame(row).expect("decodes");
        assert_eq!(decoded.as_ref(), Some(frame));
        let entry = dataset.table().frames()[row].as_ref();
        let span = entry.and_then(|entry| entry.span).expect("in a pack");
        assert!(!span.is_difference, "{row}");
    }
}

#[test]
fn a_frame_that_comes_again_has_the_digest_that_it_had() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec()).expect("created");
    for (number, seen) in [3, 4, 3, 4].into_iter().enumerate() {
        let mut sample = sample(1).with_frame(textured(seen, PixelFormat::Gray8));
        sample.id = number.to_string();
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
        // The others are differences to the first frame, so none of them can be decoded.
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
    // The journal names bytes that the pack lacks: they were lost outside the program.
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
