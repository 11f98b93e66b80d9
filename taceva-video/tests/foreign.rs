//! What an external ffmpeg decodes: luma cut out of raw frames is that of the peer, and damage is an error.

mod support;

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use support::{bytes, damage, digests, expected, path};
use taceva_needs::{Need, skip};
use taceva_video::{Colours, Decoders, Picture, Video, VideoError};

/// ffmpeg 5.1 or later: the one that `TACEVA_FFMPEG` names, or that of the path.
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

/// Has ffmpeg make a clip for a test.
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
    // Times of Matroska are whole milliseconds.
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
            .contains("pixels are bgr0, which have no luma plane")
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
fn ten_bits_stay_ten_bits() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("deep.mkv");
    // Luma rises by one step a column from 64 on.
    let source = "color=black:size=512x16:rate=10:duration=0.3,format=yuv420p10le,geq=lum='64+X':cb=512:cr=512";
    make(
        &decoders,
        &["-f", "lavfi", "-i", source, "-c:v", "ffv1"],
        &file,
    );
    let clip = open(&file, &decoders);
    assert_eq!(
        (clip.info().pixel_format.as_str(), clip.info().frames),
        ("yuv420p10le", 3)
    );
    clip.visit(&[1], Colours::Luma, &mut |_, picture| {
        let Picture::Deep {
            width: 512,
            height: 16,
            bits: 10,
            samples,
        } = picture
        else {
            panic!("{picture:?}");
        };
        let expected = (0..16).flat_map(|_| 64..576);
        assert!(samples.into_iter().eq(expected));
        Ok::<(), String>(())
    })
    .expect("visited");
}

#[test]
fn a_clip_that_changes_its_size_is_refused() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let mut whole = Vec::new();
    // As many bytes a frame: lengths alone would not tell them apart.
    for size in ["64x48", "48x64"] {
        let file = folder.path().join("part.mjpeg");
        let source = format!("testsrc=size={size}:rate=25:duration=0.2");
        make(
            &decoders,
            &[
                "-f", "lavfi", "-i", &source, "-c:v", "mjpeg", "-pix_fmt", "yuvj420p",
            ],
            &file,
        );
        whole.extend(std::fs::read(&file).expect("readable"));
    }
    let file = folder.path().join("mixed.mjpeg");
    std::fs::write(&file, whole).expect("written");
    match Video::open(&file, &decoders).expect_err("refused") {
        VideoError::ChangedSize {
            frame,
            found,
            expected,
            ..
        } => {
            assert_eq!(
                (frame, found.as_str(), expected.as_str()),
                (5, "48×64 yuvj420p", "64×48 yuvj420p")
            );
        }
        other => panic!("{other}"),
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
fn lists_that_name_other_files_are_not_followed() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let secret = path("mkv-ffv1", "clip.mkv");
    assert_eq!(
        open(&secret, &decoders).info().frames,
        24,
        "it can be read by itself"
    );
    let secret = secret.display();
    for (name, text) in [
        (
            "list.m3u8",
            format!("#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\n{secret}\n#EXT-X-ENDLIST\n"),
        ),
        (
            "list.ffconcat",
            format!("ffconcat version 1.0\nfile '{secret}'\n"),
        ),
    ] {
        let list = folder.path().join(name);
        std::fs::write(&list, text).expect("written");
        let refused = Video::open(&list, &decoders).expect_err("refused");
        assert!(matches!(refused, VideoError::Process { .. }), "{refused}");
    }
}

#[test]
fn a_part_that_was_cut_out_presents_what_it_says() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("part.mp4");
    let whole = path("mp4-h264-high-b", "clip.mp4");
    // From the middle of a group of pictures on: the edit list hides what stands before.
    let whole = whole.to_str().expect("text");
    make(&decoders, &["-ss", "0.2", "-i", whole, "-c", "copy"], &file);
    let by_us = open(&file, &Decoders::default());
    let other = folder.path().join("part.mkv");
    make(
        &decoders,
        &[
            "-i",
            file.to_str().expect("text"),
            "-fps_mode",
            "passthrough",
            "-c:v",
            "ffv1",
        ],
        &other,
    );
    let by_them = open(&other, &decoders);
    assert!(by_us.info().frames < 24, "something was cut off");
    assert_eq!(by_us.info().frames, by_them.info().frames);
    let all: Vec<u64> = (0..by_us.info().frames).collect();
    assert_eq!(
        digests(&by_us, &all, Colours::Luma),
        digests(&by_them, &all, Colours::Luma)
    );
}

#[test]
fn a_stream_that_begins_to_need_more_than_the_decoder_has_goes_on_by_ffmpeg() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    let program = decoders.ffmpeg.as_ref().expect("there");
    let encoders = Command::new(program)
        .args(["-hide_banner", "-encoders"])
        .output();
    let encoders = encoders.expect("starts").stdout;
    if !String::from_utf8_lossy(&encoders).contains(" libx264 ") {
        skip(Need::Ffmpeg, "without libx264");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let mut whole = Vec::new();
    // Frames, then fields.
    for fields in ["bframes=0", "bframes=0:tff=1:interlaced=1"] {
        let part = folder.path().join("part.h264");
        let source = "testsrc=size=64x48:rate=25:duration=0.4";
        let to = [
            "-c:v",
            "libx264",
            "-pix_fmt",
            "yuv420p",
            "-x264-params",
            fields,
        ];
        make(
            &decoders,
            &[["-f", "lavfi", "-i", source].as_slice(), &to].concat(),
            &part,
        );
        whole.extend(std::fs::read(&part).expect("readable"));
    }
    let stream = folder.path().join("whole.h264");
    std::fs::write(&stream, whole).expect("written");
    let (file, other) = (
        folder.path().join("whole.mp4"),
        folder.path().join("whole.mkv"),
    );
    make(
        &decoders,
        &["-i", stream.to_str().expect("text"), "-c", "copy"],
        &file,
    );
    make(
        &decoders,
        &[
            "-i",
            file.to_str().expect("text"),
            "-fps_mode",
            "passthrough",
            "-c:v",
            "ffv1",
        ],
        &other,
    );
    let (clip, peer) = (open(&file, &decoders), open(&other, &decoders));
    assert!(
        clip.info()
            .decoder
            .as_ref()
            .is_some_and(|decoder| decoder.starts_with("rusty_h264"))
    );
    assert_eq!((clip.info().frames, peer.info().frames), (20, 20));
    let all: Vec<u64> = (0..20).collect();
    assert_eq!(
        digests(&clip, &all, Colours::Luma),
        digests(&peer, &all, Colours::Luma)
    );
    // Without ffmpeg the first part is shown, and then the reason is.
    let mut shown = 0;
    let alone = open(&file, &Decoders::default());
    let ended = alone.visit(&all, Colours::Luma, &mut |_, _| {
        shown += 1;
        Ok::<(), String>(())
    });
    let error = ended.expect_err("refused").to_string();
    assert!(
        error.contains("nothing at hand decodes H.264 High with fields"),
        "{error}"
    );
    assert_eq!(shown, 10);
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

#[test]
fn frames_of_a_varying_rate_are_each_shown_once() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("varying.mkv");
    // Of thirty frames a second these ten, at the times that they have.
    let chosen = "select='lt(n,4)+eq(n,9)+eq(n,10)+eq(n,21)+gt(n,40)'";
    make(
        &decoders,
        &[
            "-f",
            "lavfi",
            "-i",
            "testsrc=size=64x48:rate=30",
            "-vf",
            chosen,
            "-fps_mode",
            "vfr",
            "-frames:v",
            "10",
            "-c:v",
            "ffv1",
        ],
        &file,
    );
    let clip = open(&file, &decoders);
    assert_eq!(clip.info().frames, 10);
    let all: Vec<u64> = (0..10).collect();
    let mut seen = Vec::new();
    clip.visit(&all, Colours::Rgb, &mut |_, picture| {
        seen.push(picture);
        Ok::<(), std::convert::Infallible>(())
    })
    .expect("visited");
    // The source counts in its pictures, so that no two are alike.
    assert_eq!(seen.len(), 10);
    assert!(seen.windows(2).all(|pair| pair[0] != pair[1]));
    let mut alone = Vec::new();
    clip.visit(&[6], Colours::Rgb, &mut |_, picture| {
        alone.push(picture);
        Ok::<(), std::convert::Infallible>(())
    })
    .expect("visited");
    assert_eq!(alone, seen[6..7]);
}
