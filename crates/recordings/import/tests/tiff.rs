//! Tests of TIFF frames written by other programs (`tests/fixtures/tiff/make.py`). They are stored unchanged and decoded to the generated numbers, or rejected
//! with the name of the unsupported feature.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::{PixelFormat, SilentProgress};
use taceva_dataset::Dataset;
use taceva_import::{ImportError, ImportMap, ImportPlan};

const MAP: &str = r#"
map_version = 2
table = { files = "*.tif" }
[frame]
column = "file"
channel_order = "ORDER"
reference = "unknown"
[time]
clock = "unknown"
[sensor]
model = "drawn gel"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#;

fn fixture(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/tiff");
    folder.join(format!("{name}.tif"))
}

/// Imports a folder with `bytes` as its only picture.
fn import(bytes: &[u8], order: &str) -> Result<(tempfile::TempDir, Dataset), ImportError> {
    let lab = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(lab.path().join("lab")).expect("made");
    std::fs::write(lab.path().join("lab/a.tif"), bytes).expect("written");
    let map = ImportMap::parse("map.toml".as_ref(), &MAP.replace("ORDER", order)).expect("a map");
    let target = lab.path().join("set");
    let outcome = ImportPlan::new(&lab.path().join("lab"), &map)
        .and_then(|plan| plan.run(&target, NonZeroUsize::MIN, &SilentProgress));
    if let Err(error) = outcome {
        assert!(!target.exists(), "{error}");
        return Err(error);
    }
    let dataset = Dataset::open(&target)?;
    Ok((lab, dataset))
}

/// Pixel values that `make.py` generates for a picture of the format `format`.
fn drawn(format: PixelFormat) -> Vec<u16> {
    let colours = u16::try_from(format.samples()).expect("few");
    let scale = if format.bytes_per_sample() == 2 {
        200
    } else {
        1
    };
    let mut numbers = Vec::new();
    for y in 0..7 {
        for x in 0..9 {
            numbers.extend((0..colours).map(|c| (7 * x + 13 * y + 29 * c) % 251 * scale));
        }
    }
    numbers
}

#[test]
fn every_packing_comes_back_number_for_number_in_the_bytes_it_came_in() {
    for (name, format, order) in [
        ("gray8", PixelFormat::Gray8, "gray"),
        ("gray8-strips", PixelFormat::Gray8, "gray"),
        ("gray8-big", PixelFormat::Gray8, "gray"),
        ("gray16-lzw", PixelFormat::Gray16, "gray"),
        ("rgb8-deflate", PixelFormat::Rgb8, "rgb"),
        ("rgb8-packbits", PixelFormat::Rgb8, "rgb"),
        ("rgb8-tiles", PixelFormat::Rgb8, "rgb"),
        ("rgb16-big-endian", PixelFormat::Rgb16, "rgb"),
        ("rgba8-opaque", PixelFormat::Rgb8, "rgb"),
    ] {
        let bytes = std::fs::read(fixture(name)).expect("there");
        let (_lab, dataset) =
            import(&bytes, order).unwrap_or_else(|error| panic!("{name}: {error}"));
        let frame = dataset.frame(0).expect("decodes").expect("there");
        assert_eq!(frame.info().format, format, "{name}");
        assert_eq!(
            frame.samples().collect::<Vec<u16>>(),
            drawn(format),
            "{name}"
        );
        let entry = dataset.table().frames()[0].as_ref().expect("a frame");
        assert!(entry.path.ends_with(".tif"), "{}", entry.path);
        assert_eq!(dataset.frame_bytes(entry).expect("there"), bytes, "{name}");
        assert_eq!(
            dataset.table().as_text("source_frame").expect("kept")[0].as_deref(),
            Some("a.tif")
        );
    }
}

#[test]
fn what_is_not_read_is_refused_by_its_name() {
    for (name, expected) in [
        ("refused-float", "Gray(32)"),
        (
            "refused-signed",
            "expected unsigned numbers of 8 or 16 bits",
        ),
        ("refused-32", "Gray(32)"),
        ("refused-planes", "planes of colours"),
        ("refused-pages", "several pictures"),
        ("refused-cmyk", "CMYK(8)"),
        ("refused-palette", "RGBPalette"),
        ("refused-bits", "Gray(1)"),
        ("refused-transparent", "transparent pixels"),
    ] {
        let bytes = std::fs::read(fixture(name)).expect("there");
        let error = import(&bytes, "rgb").expect_err(name);
        assert!(error.to_string().contains(expected), "{name}: {error}");
    }
}

#[test]
fn a_packing_that_is_not_read_is_refused_with_those_that_are() {
    let mut bytes = std::fs::read(fixture("gray8")).expect("there");
    // Compression tag: 259, a short with one value, 1 for none. 50,000 is Zstandard.
    let plain = [3, 1, 3, 0, 1, 0, 0, 0, 1, 0];
    let at = bytes.windows(plain.len()).position(|part| part == plain);
    let at = at.expect("it is plain") + 8;
    bytes[at..at + 2].copy_from_slice(&50_000_u16.to_le_bytes());
    let error = import(&bytes, "gray").expect_err("packed by Zstandard");
    let said = error.to_string();
    assert!(
        said.contains("LZW, Deflate or PackBits, or as PNG"),
        "{said}"
    );
}

#[test]
fn a_tiff_cut_anywhere_is_refused() {
    for name in [
        "gray8",
        "gray16-lzw",
        "rgb8-deflate",
        "rgb8-tiles",
        "gray8-big",
    ] {
        let order = if name.starts_with("gray") {
            "gray"
        } else {
            "rgb"
        };
        let bytes = std::fs::read(fixture(name)).expect("there");
        for end in (0..bytes.len()).step_by(11).chain([bytes.len() - 1]) {
            assert!(
                import(&bytes[..end], order).is_err(),
                "{name} cut at {end} of {}",
                bytes.len()
            );
        }
    }
}

#[test]
fn flipped_bits_are_refused_in_words_or_read_and_never_panic() {
    for name in [
        "gray8",
        "gray16-lzw",
        "rgb8-deflate",
        "rgb8-tiles",
        "rgb16-big-endian",
    ] {
        let order = if name.starts_with("gray") {
            "gray"
        } else {
            "rgb"
        };
        let bytes = std::fs::read(fixture(name)).expect("there");
        let mut refused = 0;
        for at in (0..bytes.len()).step_by(3) {
            let mut flipped = bytes.clone();
            flipped[at] ^= 1 << (at % 8);
            if let Err(error) = import(&flipped, order) {
                refused += 1;
                assert!(!error.to_string().contains("panicked at taceva"), "{error}");
            }
        }
        assert!(refused > 8, "{name}: {refused}");
    }
}

#[test]
fn a_size_that_is_not_there_is_refused_before_it_is_allocated() {
    let mut bytes = std::fs::read(fixture("gray8")).expect("there");
    // Entries of 12 bytes behind the directory's count: width is tag 256, its value the last four.
    let directory =
        usize::try_from(u32::from_le_bytes(bytes[4..8].try_into().expect("four"))).expect("small");
    for entry in 0..usize::from(bytes[directory]) {
        let at = directory + 2 + 12 * entry;
        if matches!(u16::from_le_bytes([bytes[at], bytes[at + 1]]), 256 | 257) {
            bytes[at + 2..at + 4].copy_from_slice(&4_u16.to_le_bytes());
            bytes[at + 8..at + 12].copy_from_slice(&16_000_u32.to_le_bytes());
        }
    }
    let error = import(&bytes, "gray").expect_err("too large");
    assert!(error.to_string().contains("a.tif"), "{error}");
}
