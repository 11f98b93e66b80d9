//! Tests with clips from ffmpeg: depths, changing sizes, removed parts, variable rates, lists of other files.

use super::*;

#[test]
fn ten_bits_stay_ten_bits() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("deep.mkv");
    // From column 64 on luma rises by one step a column.
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
    // Equal numbers of bytes per frame: lengths alone do not show the difference.
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
    // Starts in the middle of a group of pictures. The edit list hides the part before.
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
    // Without ffmpeg the first part is shown, and then the reason.
    let mut shown = 0;
    let alone = open(&file, &Decoders::default());
    let ended = alone.visit(&all, Colours::Luma, &mut |_, _| {
        shown += 1;
        Ok::<(), String>(())
    });
    let error = ended.expect_err("refused").to_string();
    assert!(
        error.contains("no available decoder supports H.264 High with fields"),
        "{error}"
    );
    assert_eq!(shown, 10);
}

#[test]
fn frames_of_a_varying_rate_are_each_shown_once() {
    let Some(decoders) = ffmpeg() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("varying.mkv");
    // These ten of thirty frames a second, at their own times.
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
    // The source counts in its pictures, so that no two are equal.
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
