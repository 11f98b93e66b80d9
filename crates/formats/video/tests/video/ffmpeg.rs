//! Tests of an external ffmpeg. Luma from raw frames must equal the luma that another decoder gives. Damage must be an error.

mod odd_clips;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::support::{bytes, damage, digests, expected, path};
use taceva_needs::{Need, skip};
use taceva_video::{Colours, Decoders, Picture, Video, VideoError};

/// ffmpeg 5.1 or later, from `TACEVA_FFMPEG` or from the path.
fn ffmpeg() -> Option<Decoders> {
    let program = std::env::var_os("TACEVA_FFMPEG").map_or_else(|| "ffmpeg".into(), PathBuf::from);
    let mut help = Command::new(&program);
    let help = help
        .args(["-hide_banner", "-h", "long"])
        .stdin(Stdio::null())
        .output();
    match help {
        Ok(output) if String::from_utf8_lossy(&output.stdout).contains("-fps_mode") => {
            Some(Decoders {
                ffmpeg: Some(program),
                ..Decoders::default()
            })
        }
        Ok(_) => {
            skip(Need::Ffmpeg, "older than 5.1");
            None
        }
        Err(error) => {
            skip(Need::Ffmpeg, error);
            None
        }
    }
}

fn open(file: &Path, decoders: &Decoders) -> Video {
    Video::open(file, decoders).unwrap_or_else(|error| panic!("{error}"))
}

/// Creates a clip for a test with ffmpeg.
fn make(decoders: &Decoders, arguments: &[&str], to: &Path) {
    let program = decoders.ffmpeg.as_ref().expect("there");
    let mut command = Command::new(program);
    command
        .args(["-nostdin", "-loglevel", "error", "-y"])
        .args(arguments)
        .arg(to);
    assert!(command.status().expect("starts").success(), "{arguments:?}");
}

#[test]
fn luma_is_that_of_the_peer_to_the_bit() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    for (name, codec, format) in [
        ("mp4-h264-444", "H.264 High 4:4:4 Predictive", "yuv444p"),
        ("mp4-mpeg4", "MPEG-4 part 2", "yuv420p"),
        ("mp4-av1", "AV1", "yuv420p"),
        ("lerobot-v3-av1", "AV1", "yuv420p"),
    ] {
        let clip = open(&path(name, "clip.mp4"), &decoders);
        let info = clip.info();
        assert_eq!(
            (info.codec.as_str(), info.pixel_format.as_str()),
            (codec, format)
        );
        assert_eq!((info.width, info.height, info.frames), (64, 48, 24));
        assert!(
            info.decoder
                .as_ref()
                .is_some_and(|decoder| decoder.starts_with("ffmpeg "))
        );
        let expected = expected(name, "luma_sha256");
        let wanted: Vec<u64> = expected.keys().copied().collect();
        let shown = digests(&clip, &wanted, Colours::Luma);
        assert_eq!(shown, expected.into_iter().collect::<Vec<_>>(), "{name}");
    }
}

#[test]
fn pixels_of_a_lossless_clip_are_the_original_ones() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    let clip = open(&path("mkv-ffv1", "clip.mkv"), &decoders);
    assert_eq!(
        (clip.info().container.as_str(), clip.info().codec.as_str()),
        ("Matroska", "FFV1")
    );
    assert_eq!((clip.info().frames, clip.info().lossy), (24, Some(false)));
    let times = clip.info().times_s.as_ref().expect("times");
    // Matroska times are whole milliseconds.
    assert!(
        times
            .iter()
            .enumerate()
            .all(|(frame, time_s)| (time_s - frame as f64 / 30.0).abs() < 1e-3)
    );
    // Digests are by row of a table that names every second frame, backwards.
    let expected = expected("mkv-ffv1", "frames_sha256");
    assert_eq!(expected.len(), 3);
    for (row, digest) in expected {
        let frame = 22 - 2 * row;
        assert_eq!(digests(&clip, &[frame], Colours::Rgb), [(frame, digest)]);
    }
    let luma = clip.visit(&[0], Colours::Luma, &mut |_, _| Ok::<(), String>(()));
    assert!(
        luma.expect_err("refused")
            .to_string()
            .contains("pixel format bgr0 has no luma plane")
    );
}

#[test]
fn without_ffmpeg_the_codec_is_named() {
    let absent = Decoders {
        ffmpeg: Some("/nonexistent/ffmpeg".into()),
        ..Decoders::default()
    };
    for decoders in [Decoders::default(), absent] {
        let refused = Video::open(&path("mkv-ffv1", "clip.mkv"), &decoders);
        match refused.expect_err("refused") {
            VideoError::NoDecoder { codec, remedy, .. } => {
                assert_eq!(codec, "FFV1");
                assert!(remedy.contains("pip install imageio-ffmpeg"));
            }
            other => panic!("{other}"),
        }
    }
}

#[test]
fn a_wrong_checksum_within_the_stream_is_an_error() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    let mut whole = std::fs::read(path("mkv-ffv1", "clip.mkv")).expect("readable");
    whole[20_000] ^= 0x55;
    let folder = tempfile::tempdir().expect("a folder");
    let copy = folder.path().join("copy.mkv");
    std::fs::write(&copy, whole).expect("written");
    let error = Video::open(&copy, &decoders)
        .expect_err("refused")
        .to_string();
    assert!(error.contains("CRC mismatch"), "{error}");
}

#[test]
fn motion_jpeg_of_quicktime_is_given_as_it_came() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let avi = path("avi-mjpeg", "ball_1.avi");
    for name in ["clip.mov", "clip.mp4"] {
        let file = folder.path().join(name);
        make(
            &decoders,
            &["-i", avi.to_str().expect("text"), "-c", "copy"],
            &file,
        );
        let all: Vec<u64> = (0..8).collect();
        let there = digests(&open(&file, &Decoders::default()), &all, Colours::Luma);
        assert_eq!(
            there,
            digests(&open(&avi, &Decoders::default()), &all, Colours::Luma),
            "{name}"
        );
    }
}

#[test]
fn damaged_clips_give_frames_or_a_typed_error() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    for (name, file) in [
        ("mp4-mpeg4", "clip.mp4"),
        ("mkv-ffv1", "clip.mkv"),
        ("mp4-h264-444", "clip.mp4"),
    ] {
        let damage = damage(&path(name, file), &decoders);
        assert!(damage.refused >= 5, "most cuts are seen: {damage:?}");
    }
}

#[test]
fn colours_are_within_three_steps_of_those_of_the_peer() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let whole = path("mp4-h264-high-b", "clip.mp4");
    let other = folder.path().join("colours.mkv");
    let exact = "scale=flags=neighbor+accurate_rnd+full_chroma_int,format=bgr0";
    make(
        &decoders,
        &[
            "-i",
            whole.to_str().expect("text"),
            "-vf",
            exact,
            "-c:v",
            "ffv1",
        ],
        &other,
    );
    let rgb = |clip: &Video| {
        let mut found = Vec::new();
        clip.visit(&[0, 11, 23], Colours::Rgb, &mut |_, picture| {
            found.extend(bytes(picture));
            Ok::<(), String>(())
        })
        .expect("visited");
        found
    };
    let (ours, theirs) = (
        rgb(&open(&whole, &Decoders::default())),
        rgb(&open(&other, &decoders)),
    );
    assert_eq!((ours.len(), ours.len()), (3 * 64 * 48 * 3, theirs.len()));
    let most = ours.iter().zip(&theirs).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(most <= Some(3), "{most:?} steps");
}
