//! Time of extracting features from a frame.

use divan::Bencher;
use taceva_core::{Frame, FrameInfo, PixelFormat};
use taceva_models::{Color, Extractor, FeatureKind, FeatureSpec};

fn main() {
    divan::main();
}

const KINDS: [(PixelFormat, Color, u32); 6] = [
    (PixelFormat::Gray8, Color::Gray, 32),
    (PixelFormat::Rgb8, Color::Gray, 32),
    (PixelFormat::Rgb8, Color::Rgb, 32),
    (PixelFormat::Gray16, Color::Gray, 32),
    // Not a whole ratio: partial pixels on every side.
    (PixelFormat::Gray8, Color::Gray, 37),
    (PixelFormat::Rgb8, Color::Gray, 37),
];

#[divan::bench(args = 0..KINDS.len())]
fn extract_640x480(bencher: Bencher, kind: usize) {
    let (format, color, side) = KINDS[kind];
    let frame = noise(format);
    let spec = FeatureSpec {
        width: side,
        height: side,
        color,
        ..FeatureSpec::default()
    };
    let extractor = Extractor::new(spec, frame.info(), None).expect("fits");
    let mut into = vec![0.0; extractor.shape().len()];
    bencher.bench_local(|| extractor.extract(divan::black_box(&frame), &mut into));
}

#[divan::bench(args = ["gradients", "statistics"])]
fn extract_colours_640x480(bencher: Bencher, kind: &str) {
    let frame = noise(PixelFormat::Rgb8);
    let kind = FeatureKind::ALL
        .into_iter()
        .find(|known| known.name() == kind);
    let spec = FeatureSpec {
        kinds: kind.expect("a kind").into(),
        ..FeatureSpec::default()
    };
    let extractor = Extractor::new(spec, frame.info(), Some((&frame).into())).expect("fits");
    let mut into = vec![0.0; extractor.shape().len()];
    bencher.bench_local(|| extractor.extract(divan::black_box(&frame), &mut into));
}

/// White squares of 13 pixels, 40 pixels apart.
#[divan::bench]
fn extract_markers_640x480(bencher: Bencher) {
    let info = info(PixelFormat::Gray8);
    let is_lit = |at: usize| at % 40 < 13;
    let pixel = |at: usize| 255 * u8::from(is_lit(at % 640) && is_lit(at / 640));
    let frame = Frame::new(info, (0..640 * 480).map(pixel).collect()).expect("whole");
    let spec = FeatureSpec {
        kinds: FeatureKind::Markers.into(),
        width: 16,
        height: 16,
        ..FeatureSpec::default()
    };
    let extractor = Extractor::new(spec, info, Some((&frame).into())).expect("markers");
    let mut into = vec![0.0; extractor.shape().len()];
    bencher.bench_local(|| extractor.extract(divan::black_box(&frame), &mut into));
}

fn info(format: PixelFormat) -> FrameInfo {
    FrameInfo {
        width: 640,
        height: 480,
        format,
    }
}

fn noise(format: PixelFormat) -> Frame {
    let info = info(format);
    let mut state = 1_u64;
    let bytes = (0..info.byte_len().expect("small")).map(|_| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        state.to_be_bytes()[0]
    });
    Frame::new(info, bytes.collect()).expect("whole")
}
