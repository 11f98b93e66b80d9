//! Tests of MP4 files with H.264: luma as libavcodec decodes it, in presentation order.

use std::convert::Infallible;

use crate::support::{bytes, damage, digests, expected, path};
use taceva_video::{Colours, Decoders, Video, VideoError};

const CLIPS: [&str; 3] = ["mp4-h264-high-b", "mp4-h264-baseline", "lerobot-v3-h264"];

fn open(clip: &str) -> Video {
    Video::open(&path(clip, "clip.mp4"), &Decoders::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn luma_is_that_of_the_peer_to_the_bit() {
    for name in CLIPS {
        let expected = expected(name, "luma_sha256");
        assert_eq!(expected.len(), 5);
        let wanted: Vec<u64> = expected.keys().copied().collect();
        let shown = digests(&open(name), &wanted, Colours::Luma);
        assert_eq!(shown, expected.into_iter().collect::<Vec<_>>(), "{name}");
    }
}

#[test]
fn a_frame_is_the_same_whether_all_are_read_or_it_alone() {
    for name in CLIPS {
        let clip = open(name);
        let all: Vec<u64> = (0..clip.info().frames).collect();
        let together = digests(&clip, &all, Colours::Rgb);
        assert_eq!(together.len(), 24);
        for frame in all {
            let alone = digests(&clip, &[frame], Colours::Rgb);
            assert_eq!(
                alone,
                together[usize::try_from(frame).expect("small")..][..1],
                "{name}"
            );
        }
    }
}

#[test]
fn the_container_says_what_and_when() {
    let clip = open("mp4-h264-high-b");
    let info = clip.info();
    assert_eq!(
        (info.codec.as_str(), info.pixel_format.as_str()),
        ("H.264 High", "yuv420p")
    );
    assert_eq!((info.width, info.height, info.frames), (64, 48, 24));
    for (frame, time_s) in info.times_s.as_ref().expect("times").iter().enumerate() {
        assert!(
            (time_s - frame as f64 / 30.0).abs() < 1e-9,
            "{frame}: {time_s}"
        );
    }
    assert_eq!(open("mp4-h264-baseline").info().codec, "H.264 Baseline");
}

#[test]
fn what_is_not_decoded_names_its_codec_and_what_would_mend_it() {
    for (name, expected) in [
        ("mp4-h264-444", "H.264 High 4:4:4 Predictive"),
        ("mp4-mpeg4", "MPEG-4 part 2"),
        ("mp4-av1", "AV1"),
    ] {
        let refused = Video::open(&path(name, "clip.mp4"), &Decoders::default());
        match refused.expect_err("refused") {
            VideoError::NoDecoder { codec, remedy, .. } => {
                assert!(codec.starts_with(expected), "{codec}");
                for named in [
                    "pip install imageio-ffmpeg",
                    "--ffmpeg PROGRAM",
                    "TACEVA_FFMPEG",
                ] {
                    assert!(remedy.contains(named), "{remedy}");
                }
            }
            other => panic!("{other}"),
        }
    }
}

#[test]
fn a_cut_clip_says_where_it_ends() {
    let folder = tempfile::tempdir().expect("a folder");
    let whole = std::fs::read(path(CLIPS[0], "clip.mp4")).expect("readable");
    let copy = folder.path().join("cut.mp4");
    std::fs::write(&copy, &whole[..whole.len() - 1]).expect("written");
    let error = Video::open(&copy, &Decoders::default()).expect_err("refused");
    assert!(matches!(error, VideoError::Damaged { .. }), "{error}");
    assert!(
        error.to_string().contains("the box `moov` states"),
        "{error}"
    );
}

#[test]
fn a_clip_in_fragments_is_the_same_as_one_with_one_table() {
    // Written by `ffmpeg -i mp4-h264-high-b/clip.mp4 -c copy -movflags frag_keyframe+empty_moov+default_base_moof`.
    let (parts, whole) = (open("mp4-fragments"), open("mp4-h264-high-b"));
    let all: Vec<u64> = (0..24).collect();
    assert_eq!(
        digests(&parts, &all, Colours::Luma),
        digests(&whole, &all, Colours::Luma)
    );
    let steps = |clip: &Video| -> Vec<f64> {
        let times = clip.info().times_s.as_ref().expect("times");
        times.windows(2).map(|two| two[1] - two[0]).collect()
    };
    for (ours, expected) in steps(&parts).into_iter().zip(steps(&whole)) {
        assert!((ours - expected).abs() < 1e-9);
    }
}

#[test]
fn damaged_clips_give_frames_or_a_typed_error() {
    for name in CLIPS.into_iter().chain(["mp4-fragments"]) {
        let damage = damage(&path(name, "clip.mp4"), &Decoders::default());
        assert!(damage.refused >= 5, "cuts are seen: {damage:?}");
    }
}

#[test]
fn colours_are_within_three_steps_of_swscale() {
    // Twelve pixels on a diagonal in each of three frames, as PyAV 18.1.0 converts them (`to_ndarray(format="rgb24")`).
    let text = std::fs::read_to_string(path(".", "rgb.json")).expect("readable");
    let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let (mut most, mut compared) = (0, 0);
    for name in CLIPS {
        open(name)
            .visit(&[0, 13, 23], Colours::Rgb, &mut |frame, picture| {
                let rgb = bytes(picture);
                let expected = json[name][frame.to_string()].as_array().expect("pixels");
                for (pixel, place) in expected.iter().zip(0..) {
                    let at = (4 * place * 64 + 5 * place) * 3;
                    for (colour, ours) in rgb[at..at + 3].iter().enumerate() {
                        let theirs = pixel[colour].as_u64().expect("a number");
                        most = most.max(theirs.abs_diff(u64::from(*ours)));
                        compared += 1;
                    }
                }
                Ok::<(), Infallible>(())
            })
            .expect("visited");
    }
    assert_eq!(compared, 3 * 3 * 12 * 3);
    assert!(most <= 3, "{most} steps");
}
