//! How long a frame takes to become features.

use divan::Bencher;
use taceva_core::{Frame, FrameInfo, PixelFormat};
use taceva_models::{Color, Extractor, FeatureSpec};

fn main() {
    divan::main();
}

const KINDS: [(PixelFormat, Color, u32); 6] = [
    (PixelFormat::Gray8, Color::Gray, 32),
    (PixelFormat::Rgb8, Color::Gray, 32),
    (PixelFormat::Rgb8, Color::Rgb, 32),
    (PixelFormat::Gray16, Color::Gray, 32),
    // No whole ratio: partial pixels on every side.
    (PixelFormat::Gray8, Color::Gray, 37),
    (PixelFormat::Rgb8, Color::Gray, 37),
];

#[divan::bench(args = 0..KINDS.len())]
fn extract_640x480(bencher: Bencher, kind: usize) {
    let (format, color, side) = KINDS[kind];
    let info = FrameInfo {
        width: 640,
        height: 480,
        format,
    };
    let mut state = 1_u64;
    let bytes = (0..info.byte_len().expect("small")).map(|_| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        state.to_be_bytes()[0]
    });
    let frame = Frame::new(info, bytes.collect()).expect("whole");
    let spec = FeatureSpec {
        width: side,
        height: side,
        color,
        ..FeatureSpec::default()
    };
    let extractor = Extractor::new(spec, info, None).expect("fits");
    let mut into = vec![0.0; extractor.shape().len()];
    bencher.bench_local(|| extractor.extract(divan::black_box(&frame), &mut into));
}
