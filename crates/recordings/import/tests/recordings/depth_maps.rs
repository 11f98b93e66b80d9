//! Tests of depth maps of LeRobot. They must be stored in millimetres or rejected, but never stored as brightness.

use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{Decoders, ImportMap, ImportPlan, MapDraft};
use taceva_needs::{Need, skip};

use super::{copy, ffmpeg, folder, own_map};

const NAME: &str = "lerobot-v3-depth";

/// Copy of the recording in which `from` in `meta/info.json` is replaced by `to`.
fn changed(from: &str, to: &str) -> tempfile::TempDir {
    let target = tempfile::tempdir().expect("a folder");
    copy(&folder(NAME), target.path());
    let path = target.path().join("meta/info.json");
    let text = fs::read_to_string(&path).expect("readable");
    assert!(text.contains(from), "{from}");
    fs::write(&path, text.replace(from, to)).expect("written");
    target
}

/// Least and greatest pixel of the first picture, and bits of a pixel, after an import of `source` by the map `text`.
fn ends(source: &Path, text: &str, ffmpeg: Option<&str>) -> Result<([u32; 2], u8), String> {
    let map = ImportMap::parse("map.toml".as_ref(), text).map_err(|error| error.to_string())?;
    let decoders = Decoders {
        ffmpeg: ffmpeg.map(Into::into),
        ..Decoders::default()
    };
    let plan = ImportPlan::with_decoders(source, &map, &decoders);
    let plan = plan.map_err(|error| error.to_string())?;
    let target = tempfile::tempdir().expect("a folder");
    let path = target.path().join("dataset");
    let run = plan.run(&path, NonZeroUsize::MIN, &SilentProgress);
    run.map_err(|error| error.to_string())?;
    let dataset = Dataset::open(&path).expect("a dataset");
    let frame = dataset.table().frames()[0].as_ref().expect("a frame");
    let picture = image::open(path.join(&frame.path)).expect("a picture");
    let (pixels, bits): (Vec<u32>, u8) = match picture {
        image::DynamicImage::ImageLuma8(pixels) => {
            (pixels.iter().map(|pixel| u32::from(*pixel)).collect(), 8)
        }
        image::DynamicImage::ImageLuma16(pixels) => {
            (pixels.iter().map(|pixel| u32::from(*pixel)).collect(), 16)
        }
        other => panic!("{:?}", other.color()),
    };
    let least = pixels.iter().min().expect("pixels");
    let greatest = pixels.iter().max().expect("pixels");
    Ok(([*least, *greatest], bits))
}

fn with_ffmpeg(test: impl FnOnce()) {
    match ffmpeg() {
        Ok(_) => test(),
        Err(error) => skip(Need::Ffmpeg, error),
    }
}

#[test]
fn a_depth_map_without_ffmpeg_is_refused_with_the_program_that_decodes_it() {
    let refused = ends(&folder(NAME), &own_map(NAME), None).expect_err("no decoder");
    for words in ["HEVC", "ffmpeg"] {
        let is_there = refused.to_lowercase().contains(&words.to_lowercase());
        assert!(is_there, "{refused}");
    }
}

#[test]
fn a_depth_map_without_one_of_its_parameters_is_refused_by_its_name_and_is_no_draft() {
    for key in [
        "video.depth_min",
        "video.depth_max",
        "video.shift",
        "video.use_log",
    ] {
        let source = changed(&format!("\"{key}\""), "\"video.other\"");
        let refused = ends(source.path(), &own_map(NAME), Some("ffmpeg")).expect_err(key);
        assert!(
            refused.contains(&format!("`{key}`")) && refused.contains("meta/info.json"),
            "{refused}"
        );
        let draft = MapDraft::of(source.path()).expect("a draft");
        assert!(!draft.text().contains("video = \""), "{}", draft.text());
        assert!(draft.text().contains(key), "{}", draft.text());
    }
    let source = changed("\"video.depth_min\": 0.01", "\"video.depth_min\": 20.0");
    let refused = ends(source.path(), &own_map(NAME), Some("ffmpeg")).expect_err("no range");
    assert!(refused.contains("not a valid range"), "{refused}");
}

#[test]
fn distances_are_whole_millimetres_or_shares_of_the_range_that_the_map_says() {
    with_ffmpeg(|| {
        let map = own_map(NAME);
        let of_range = |range: &str| {
            map.replace(
                "channel_order = \"gray\"",
                &format!("channel_order = \"gray\"\n{range}"),
            )
        };
        let read = |text: &str| ends(&folder(NAME), text, Some("ffmpeg"));
        let ([near, far], bits) = read(&map).expect("imported");
        // 300 and 1000 mm were recorded; codes are up to 1.5 mm apart there.
        assert!(
            near.abs_diff(300) <= 1 && far.abs_diff(1000) <= 1,
            "{near} {far}"
        );
        assert_eq!(bits, 16);
        let (pixels, bits) = read(&of_range("range = [200, 1220]\nbits = 8")).expect("imported");
        assert_eq!((pixels, bits), ([25, 200], 8));
        let refused = read(&of_range("range = [10, 500]\nbits = 8")).expect_err("beyond");
        assert!(
            refused.contains("outside of `range = [10, 500]`"),
            "{refused}"
        );
    });
}

#[test]
fn codes_that_are_finer_than_millimetres_or_go_further_than_16_bits_want_a_range() {
    with_ffmpeg(|| {
        for (from, to, range) in [
            (
                "\"video.shift\": 3.5",
                "\"video.shift\": 0.0",
                "range = [10, 10000]",
            ),
            (
                "\"video.depth_max\": 10.0",
                "\"video.depth_max\": 80.0",
                "range = [10, 80000]",
            ),
        ] {
            let source = changed(from, to);
            let refused = ends(source.path(), &own_map(NAME), Some("ffmpeg")).expect_err(to);
            assert!(
                refused.contains(range) && refused.contains("bits = 16"),
                "{refused}"
            );
            let draft = MapDraft::of(source.path()).expect("a draft");
            assert!(draft.text().contains(range), "{}", draft.text());
        }
    });
}

#[test]
fn colours_of_a_depth_map_and_a_range_of_ordinary_clips_are_refused() {
    with_ffmpeg(|| {
        let map = own_map(NAME).replace("\"gray\"", "\"rgb\"");
        let refused = ends(&folder(NAME), &map, Some("ffmpeg")).expect_err("no colours");
        assert!(refused.contains("channel_order = \"gray\""), "{refused}");
    });
    let map = own_map("lerobot-v3-h264").replace(
        "channel_order = \"gray\"",
        "channel_order = \"gray\"\nrange = [0, 10]\nbits = 8",
    );
    let refused = ends(&folder("lerobot-v3-h264"), &map, None).expect_err("no depth map");
    assert!(refused.contains("or a depth map of LeRobot"), "{refused}");
}
