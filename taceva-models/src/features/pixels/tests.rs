//! Tests of area averages against their definition.

use taceva_core::{Frame, PixelFormat};

use crate::features::test_pictures::noise;
use crate::features::{Color, Extractor, FeatureSpec};

fn spec(width: u32, height: u32, color: Color) -> FeatureSpec {
    FeatureSpec {
        width,
        height,
        color,
        ..FeatureSpec::default()
    }
}

fn features(frame: &Frame, spec: FeatureSpec) -> Vec<f32> {
    let extractor = Extractor::new(spec, frame.info(), None).expect("fits");
    let mut values = vec![0.0; extractor.shape().len()];
    extractor.extract(frame, &mut values).expect("same kind");
    values
}

/// Area averages by their definition: areas of overlap in f64.
fn by_definition(frame: &Frame, spec: FeatureSpec) -> Vec<f64> {
    let info = frame.info();
    let samples: Vec<f64> = frame.samples().map(f64::from).collect();
    let depth = info.format.samples();
    let overlap = |index: u32, cells: u32, pixels: u32, pixel: u32| {
        let cell = f64::from(pixels) / f64::from(cells);
        let (start, end) = (f64::from(index) * cell, f64::from(index + 1) * cell);
        (end.min(f64::from(pixel + 1)) - start.max(f64::from(pixel))).max(0.0) / cell
    };
    let mut values = Vec::new();
    for row in 0..spec.height {
        for column in 0..spec.width {
            let mut cell = vec![0.0; depth];
            for y in 0..info.height {
                for x in 0..info.width {
                    let weight = overlap(row, spec.height, info.height, y)
                        * overlap(column, spec.width, info.width, x);
                    for (sample, total) in cell.iter_mut().enumerate() {
                        *total +=
                            weight * samples[((y * info.width + x) as usize) * depth + sample];
                    }
                }
            }
            let full = f64::from(info.format.full_scale());
            if spec.color == Color::Gray && depth == 3 {
                values.push((0.299 * cell[0] + 0.587 * cell[1] + 0.114 * cell[2]) / full);
            } else {
                values.extend(cell.iter().map(|total| total / full));
            }
        }
    }
    values
}

#[test]
fn features_are_area_averages_for_every_format_and_ratio() {
    let formats = [
        (PixelFormat::Gray8, Color::Gray),
        (PixelFormat::Gray16, Color::Gray),
        (PixelFormat::Rgb8, Color::Gray),
        (PixelFormat::Rgb16, Color::Gray),
        (PixelFormat::Rgb8, Color::Rgb),
        (PixelFormat::Rgb16, Color::Rgb),
    ];
    for (format, color) in formats {
        for (width, height) in [(8, 6), (7, 5), (24, 18), (1, 1), (23, 17)] {
            let frame = noise(24, 18, format, 7);
            let spec = spec(width, height, color);
            for (found, expected) in features(&frame, spec)
                .iter()
                .zip(by_definition(&frame, spec))
            {
                // The definition above rounds in f64; a feature is rounded to f32, by half an ulp of 1.
                assert!(
                    (f64::from(*found) - expected).abs() < 6.1e-8,
                    "{format:?} to {spec}: {found} for {expected}"
                );
            }
        }
    }
}

#[test]
fn a_difference_from_itself_is_zero_and_from_black_is_the_frame() {
    let bright = noise(20, 20, PixelFormat::Rgb8, 1);
    let black = Frame::new(bright.info(), vec![0; bright.bytes().len()]).expect("whole");
    let plain = spec(7, 7, Color::Gray);
    let difference = FeatureSpec {
        difference: true,
        ..plain
    };
    let of = |reference: &Frame| {
        Extractor::new(difference, bright.info(), Some(reference.into()))
            .expect("fits")
            .extract_all([&bright])
            .expect("same kind")
    };
    assert!(
        of(&bright)
            .values()
            .iter()
            .all(|value| value.to_bits() == 0)
    );
    assert_eq!(of(&black).values(), features(&bright, plain));
}

#[test]
fn white_is_one_whatever_the_format() {
    for format in [
        PixelFormat::Gray8,
        PixelFormat::Gray16,
        PixelFormat::Rgb8,
        PixelFormat::Rgb16,
    ] {
        let info = noise(33, 21, format, 1).info();
        let white = Frame::new(info, vec![0xff; info.byte_len().expect("small")]).expect("whole");
        let values = features(&white, spec(10, 10, Color::Gray));
        assert!(
            values
                .iter()
                .all(|value| value.to_bits() == 1.0_f32.to_bits())
        );
    }
}
