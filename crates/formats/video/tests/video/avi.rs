//! Tests of AVI files with Motion JPEG: unchanged packets, and indices that must match them.

use std::path::{Path, PathBuf};

use crate::support::{bytes, damage, digests, expected, path, sha256};
use taceva_video::{Colours, Decoders, Picture, Video, VideoError};

const CLIPS: [&str; 3] = ["ball_1.avi", "cube_1.avi", "cube_2.avi"];

fn open(path: &Path) -> Result<Video, VideoError> {
    Video::open(path, &Decoders::default())
}

#[test]
fn packets_are_those_that_the_peer_reads_byte_for_byte() {
    let expected = expected("avi-mjpeg", "packets_sha256");
    assert_eq!(expected.len(), 3);
    for (number, digest) in expected {
        // Clips of 8 frames in the order of their names.
        let name = CLIPS[usize::try_from(number / 8).expect("small")];
        let clip = open(&path("avi-mjpeg", name)).expect("opens");
        assert_eq!(
            digests(&clip, &[number % 8], Colours::Rgb),
            [(number % 8, digest)]
        );
    }
}

#[test]
fn what_the_headers_say_is_known_before_a_frame_is_read() {
    let clip = open(&path("avi-mjpeg", "ball_1.avi")).expect("opens");
    let info = clip.info();
    assert_eq!((info.width, info.height, info.frames), (64, 48, 8));
    assert_eq!(
        (info.codec.as_str(), info.pixel_format.as_str()),
        ("MJPEG", "yuvj420p")
    );
    assert_eq!((info.lossy, &info.decoder), (Some(true), &None));
    let times = info.times_s.as_ref().expect("a rate");
    assert!((times[7] - 7.0 / 30.0).abs() < 1e-12);
}

#[test]
fn a_frame_beyond_the_clip_says_how_many_there_are() {
    let clip = open(&path("avi-mjpeg", "ball_1.avi")).expect("opens");
    let visit = |sorted: &[u64]| {
        let error = clip.visit(sorted, Colours::Luma, &mut |_, _| Ok::<(), String>(()));
        error.expect_err("refused").to_string()
    };
    assert!(
        visit(&[0, 8]).contains("frame 8 was requested, but there are 8 frames, counted from 0")
    );
    assert!(visit(&[3, 3]).contains("frame 3 is requested after frame 3"));
    let stopped = clip.visit(&[0, 1], Colours::Luma, &mut |index, _| match index {
        0 => Err("enough"),
        other => panic!("frame {other} after the last that was wanted"),
    });
    assert_eq!(stopped.expect_err("stopped").to_string(), "enough");
}

/// Writes a copy of the clip to `folder`, with its bytes altered by `change`.
fn changed(folder: &Path, change: impl FnOnce(&mut Vec<u8>)) -> PathBuf {
    let mut bytes = std::fs::read(path("avi-mjpeg", "ball_1.avi")).expect("readable");
    change(&mut bytes);
    let copy = folder.join("copy.avi");
    std::fs::write(&copy, bytes).expect("written");
    copy
}

fn find(bytes: &[u8], letters: &[u8; 4]) -> usize {
    bytes
        .windows(4)
        .position(|four| four == letters)
        .expect("there")
}

/// Corrects the size of the whole file in its header.
fn close(bytes: &mut [u8]) {
    let size = u32::try_from(bytes.len() - 8).expect("small");
    bytes[4..8].copy_from_slice(&size.to_le_bytes());
}

#[test]
fn a_clip_without_an_index_is_read_as_one_with_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let bare = changed(folder.path(), |bytes| {
        bytes.truncate(find(bytes, b"idx1"));
        close(bytes);
    });
    let whole = open(&path("avi-mjpeg", "ball_1.avi")).expect("opens");
    let all = [0, 1, 2, 3, 4, 5, 6, 7];
    let bare = open(&bare).expect("opens");
    assert_eq!(
        digests(&bare, &all, Colours::Luma),
        digests(&whole, &all, Colours::Luma)
    );
}

#[test]
fn an_index_that_contradicts_the_frames_is_refused_with_its_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut at = 0;
    let wrong = changed(folder.path(), |bytes| {
        at = find(bytes, b"idx1") + 8 + 16;
        bytes[at + 8] ^= 4;
    });
    match open(&wrong).expect_err("refused") {
        VideoError::Index { offset, .. } => assert_eq!(offset, at as u64),
        other => panic!("{other}"),
    }
    let short = changed(folder.path(), |bytes| {
        let index = find(bytes, b"idx1");
        bytes.truncate(bytes.len() - 16);
        bytes[index + 4] -= 16;
        close(bytes);
    });
    let error = open(&short).expect_err("refused").to_string();
    assert!(
        error.contains("the index lists 7 frames, but the file has 8"),
        "{error}"
    );
}

#[test]
fn a_frame_of_another_size_is_refused_by_its_number() {
    let folder = tempfile::tempdir().expect("a folder");
    let wrong = changed(folder.path(), |bytes| {
        // Width in the frame header of the last picture.
        let last = bytes
            .windows(2)
            .rposition(|two| two == [0xff, 0xc0])
            .expect("there");
        bytes[last + 8] = 32;
    });
    let clip = open(&wrong).expect("opens");
    let error = clip.visit(&[6, 7], Colours::Luma, &mut |_, _| Ok::<(), String>(()));
    let error = error.expect_err("refused").to_string();
    assert!(
        error.contains("frame 7 is 32×48, expected 64×48"),
        "{error}"
    );
}

#[test]
fn a_picture_without_huffman_tables_is_given_with_the_standard_ones() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut bare_jpeg = Vec::new();
    let bare = changed(folder.path(), |bytes| {
        // First picture without its tables. A padding chunk has the removed size.
        let packet = find(bytes, b"00dc");
        let packet = packet
            + bytes[packet + 4..]
                .windows(4)
                .position(|four| four == b"00dc")
                .expect("there")
            + 4;
        let size = usize::from(u16::from_le_bytes([bytes[packet + 4], bytes[packet + 5]]));
        let jpeg = bytes[packet + 8..packet + 8 + size].to_vec();
        let mut at = 2;
        bare_jpeg.extend_from_slice(&jpeg[..2]);
        while jpeg[at + 1] != 0xda {
            let next = at + 2 + usize::from(u16::from_be_bytes([jpeg[at + 2], jpeg[at + 3]]));
            if jpeg[at + 1] != 0xc4 {
                bare_jpeg.extend_from_slice(&jpeg[at..next]);
            }
            at = next;
        }
        bare_jpeg.extend_from_slice(&jpeg[at..]);
        let lost = size - bare_jpeg.len();
        assert!(lost > 8, "the picture had tables");
        let mut chunks = b"00dc".to_vec();
        chunks.extend(u32::try_from(bare_jpeg.len()).expect("small").to_le_bytes());
        chunks.extend_from_slice(&bare_jpeg);
        chunks.extend(vec![0; bare_jpeg.len() % 2]);
        let junk = packet + 8 + size + size % 2 - packet - chunks.len() - 8;
        chunks.extend(b"JUNK");
        chunks.extend(u32::try_from(junk).expect("small").to_le_bytes());
        chunks.extend(vec![0; junk]);
        bytes[packet..packet + chunks.len()].copy_from_slice(&chunks);
        bytes.truncate(find(bytes, b"idx1"));
        close(bytes);
    });
    let clip = open(&bare).expect("opens");
    let mut given = None;
    clip.visit(&[0], Colours::Luma, &mut |_, picture| {
        given = Some(picture);
        Ok::<(), String>(())
    })
    .expect("visited");
    let Some(Picture::Jpeg(given)) = given else {
        panic!("no JPEG");
    };
    assert_eq!(given.len(), bare_jpeg.len() + 420);
    // Digest of the four standard tables, as libjpeg writes them: one segment each, counts and values in a row.
    let at = given
        .windows(4)
        .position(|four| four == [0xff, 0xc4, 0x01, 0xa2])
        .expect("there");
    assert_eq!(sha256(&given[at + 4..at + 420]), STANDARD_TABLES_SHA256);
}

/// SHA-256 of the tables in a picture that Pillow 13.0 wrote with `optimize=False`.
const STANDARD_TABLES_SHA256: &str =
    "f361ab42f71ff019275c522494accedf9fadd13f16af71632ca28255a7554a15";

#[test]
fn a_frame_that_was_lost_is_left_out_and_the_times_say_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = changed(folder.path(), |bytes| {
        // The third picture becomes empty, with padding of its size.
        let index = find(bytes, b"idx1");
        let entry = index + 8 + 2 * 16;
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four"));
        let offset = usize::try_from(word(entry + 8)).expect("small");
        let at = find(bytes, b"movi") + offset;
        let size = word(at + 4) + word(at + 4) % 2;
        bytes[at + 4..at + 8].fill(0);
        bytes[at + 8..at + 12].copy_from_slice(b"JUNK");
        bytes[at + 12..at + 16].copy_from_slice(&(size - 8).to_le_bytes());
        bytes[entry + 12..entry + 16].fill(0);
    });
    let clip = open(&file).expect("opens");
    assert_eq!(clip.info().frames, 7);
    let times = clip.info().times_s.as_ref().expect("a rate");
    assert!((times[1] - 1.0 / 30.0).abs() < 1e-12 && (times[2] - 3.0 / 30.0).abs() < 1e-12);
    let whole = open(&path("avi-mjpeg", "ball_1.avi")).expect("opens");
    let (left, all) = (
        digests(&clip, &[1, 2], Colours::Luma),
        digests(&whole, &[1, 3], Colours::Luma),
    );
    assert_eq!((&left[0].1, &left[1].1), (&all[0].1, &all[1].1));
}

/// Chunk, padded to an even number of bytes.
fn chunk(id: &[u8; 4], content: &[u8]) -> Vec<u8> {
    let mut chunk = id.to_vec();
    chunk.extend(u32::try_from(content.len()).expect("small").to_le_bytes());
    chunk.extend_from_slice(content);
    chunk.extend(vec![0; content.len() % 2]);
    chunk
}

/// File in two parts, each with an OpenDML index after its frames, and the offset of the entries of the second index.
fn in_two_parts(frames: &[Vec<u8>]) -> (Vec<u8>, usize) {
    let mut header = [
        b"vids".as_slice(),
        b"MJPG",
        &[0; 12],
        &[1, 0, 0, 0, 30, 0, 0, 0],
    ]
    .concat();
    header.resize(56, 0);
    let mut format = [40_u32, 64, 48].map(u32::to_le_bytes).concat();
    format.extend([1, 0, 24, 0]);
    format.extend_from_slice(b"MJPG");
    format.resize(40, 0);
    let stream = [
        b"strl".to_vec(),
        chunk(b"strh", &header),
        chunk(b"strf", &format),
    ]
    .concat();
    let headers = chunk(
        b"LIST",
        &[b"hdrl".to_vec(), chunk(b"LIST", &stream)].concat(),
    );
    let mut file: Vec<u8> = Vec::new();
    let mut entries_at = 0;
    for (kind, frames, before) in [
        (b"AVI ", &frames[..3], headers),
        (b"AVIX", &frames[3..], Vec::new()),
    ] {
        // After the headers of the part and of the list.
        let mut at = file.len() + 12 + before.len() + 12;
        let (mut movie, mut entries) = (b"movi".to_vec(), Vec::new());
        for frame in frames {
            entries.extend(u32::try_from(at + 8).expect("small").to_le_bytes());
            entries.extend(u32::try_from(frame.len()).expect("small").to_le_bytes());
            let packet = chunk(b"00dc", frame);
            at += packet.len();
            movie.extend(packet);
        }
        let count = u32::try_from(frames.len()).expect("small").to_le_bytes();
        let index = [&[2, 0, 0, 1], count.as_slice(), b"00dc", &[0; 12], &entries].concat();
        entries_at = at + 8 + 24;
        movie.extend(chunk(b"ix00", &index));
        let part = [kind.to_vec(), before, chunk(b"LIST", &movie)].concat();
        file.extend(chunk(b"RIFF", &part));
    }
    (file, entries_at)
}

#[test]
fn a_file_in_several_parts_is_one_clip_and_its_indices_are_checked() {
    let whole = open(&path("avi-mjpeg", "ball_1.avi")).expect("opens");
    let all = [0, 1, 2, 3, 4, 5, 6, 7];
    let mut frames = Vec::new();
    whole
        .visit(&all, Colours::Luma, &mut |_, picture| {
            frames.push(bytes(picture));
            Ok::<(), String>(())
        })
        .expect("visited");
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("parts.avi");
    let (mut parts, entries_at) = in_two_parts(&frames);
    std::fs::write(&file, &parts).expect("written");
    let clip = open(&file).expect("opens");
    assert_eq!(
        digests(&clip, &all, Colours::Luma),
        digests(&whole, &all, Colours::Luma)
    );
    parts[entries_at + 8] ^= 2;
    std::fs::write(&file, &parts).expect("written");
    match open(&file).expect_err("refused") {
        VideoError::Index { offset, .. } => assert_eq!(offset, entries_at as u64 + 8),
        other => panic!("{other}"),
    }
}

#[test]
fn damaged_clips_give_frames_or_a_typed_error() {
    for name in CLIPS {
        let damage = damage(&path("avi-mjpeg", name), &Decoders::default());
        assert!(damage.refused >= 6, "cuts are seen: {damage:?}");
    }
}
