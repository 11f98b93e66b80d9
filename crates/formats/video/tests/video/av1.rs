//! Tests of AV1 in a confined child. Luma must equal that of libdav1d. A child that exits early gives an error with the name of the clip.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use crate::support::{bytes, damage, digests, expected, path};
use taceva_needs::{Need, skip};
use taceva_video::{Colours, Decoders, Video, VideoError};

const CLIPS: [&str; 2] = ["mp4-av1", "lerobot-v3-av1"];

/// Decoders with the example program as child. The program is beside the tests if the whole package is tested; `None` otherwise.
fn child() -> Option<Decoders> {
    let test = std::env::current_exe().expect("this test is a program");
    let built = test
        .parent()
        .and_then(Path::parent)
        .expect("in a folder of its own");
    let program = built.join("examples").join("av1_child");
    if !program.is_file() {
        skip(Need::Example, "`av1_child` is not built");
        return None;
    }
    Some(by(vec![program.into()]))
}

fn by(program: Vec<OsString>) -> Decoders {
    Decoders {
        av1: Some(program),
        ..Decoders::default()
    }
}

fn clip(name: &str) -> PathBuf {
    path(name, "clip.mp4")
}

#[test]
fn luma_is_that_of_the_peer_to_the_bit() {
    let Some(decoders) = child() else {
        return;
    };
    for name in CLIPS {
        let clip = Video::open(&clip(name), &decoders).expect("opens");
        let info = clip.info();
        assert_eq!(
            (info.codec.as_str(), info.pixel_format.as_str(), info.frames),
            ("AV1", "yuv420p", 24)
        );
        let expected = expected(name, "luma_sha256");
        assert_eq!(expected.len(), 5);
        let wanted: Vec<u64> = expected.keys().copied().collect();
        let shown = digests(&clip, &wanted, Colours::Luma);
        assert_eq!(shown, expected.into_iter().collect::<Vec<_>>(), "{name}");
    }
}

#[test]
fn a_frame_is_the_same_whether_all_are_read_or_it_alone() {
    let Some(decoders) = child() else {
        return;
    };
    let clip = Video::open(&clip("lerobot-v3-av1"), &decoders).expect("opens");
    let all: Vec<u64> = (0..24).collect();
    let together = digests(&clip, &all, Colours::Rgb);
    assert_eq!(together.len(), 24);
    for frame in [0, 1, 2, 13, 23] {
        let alone = digests(&clip, &[frame], Colours::Rgb);
        assert_eq!(
            alone,
            together[usize::try_from(frame).expect("small")..][..1]
        );
    }
}

/// Result of reading the first frame if a shell runs `script` in place of the child.
#[cfg(unix)]
fn first_by(script: &str) -> String {
    let decoders = by(vec!["sh".into(), "-c".into(), script.into()]);
    let clip = Video::open(&clip("mp4-av1"), &decoders).expect("opens");
    let visited = clip.visit(&[0], Colours::Luma, &mut |_, picture| {
        panic!("{} bytes", bytes(picture).len());
        #[expect(unreachable_code, reason = "says of which type an error would be")]
        Ok::<(), String>(())
    });
    visited.expect_err("refused").to_string()
}

#[cfg(unix)]
#[test]
fn a_child_that_dies_or_speaks_otherwise_is_an_error_that_names_the_clip() {
    for (script, expected) in [
        ("echo boom >&2; kill -ABRT $$", "signal: 6"),
        ("exit 4", "exit status: 4"),
        ("printf nonsense; sleep 1", "ended with"),
        (
            "printf 'R\\002\\000no'; sleep 1",
            "does not decode frame 0: no",
        ),
        ("printf 'D\\000'; sleep 1", "no picture for frame 0"),
        (
            "printf 'P\\001\\000\\000\\000\\001\\000\\000\\000\\002\\000\\000\\000'; sleep 1",
            "frame 0 is 1×1, expected 64×48",
        ),
    ] {
        let error = first_by(script);
        assert!(
            error.contains(expected) && error.contains("clip.mp4"),
            "{script}: {error}"
        );
    }
    assert!(first_by("echo boom >&2; kill -ABRT $$").contains("boom"));
    let absent = by(vec!["/nonexistent/child".into()]);
    let clip = Video::open(&clip("mp4-av1"), &absent).expect("opens");
    let error = clip.visit(&[0], Colours::Luma, &mut |_, _| Ok::<(), String>(()));
    assert!(
        error
            .expect_err("refused")
            .to_string()
            .contains("does not start")
    );
}

#[test]
fn damaged_clips_give_frames_or_a_typed_error() {
    let Some(decoders) = child() else {
        return;
    };
    for name in CLIPS {
        let damage = damage(&clip(name), &decoders);
        assert!(damage.refused >= 6, "cuts are seen: {damage:?}");
    }
}

#[test]
fn the_codec_is_named_where_there_is_no_child() {
    let refused = Video::open(&clip("mp4-av1"), &Decoders::default());
    assert!(matches!(refused, Err(VideoError::NoDecoder { codec, .. }) if codec == "AV1"));
}
