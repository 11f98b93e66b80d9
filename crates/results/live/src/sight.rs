//! Saturation and sharpness of a frame.

use taceva_core::Frame;

/// Saturation and sharpness of one frame, for adjusting the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sight {
    /// Share of pixel values at full scale, 0 to 1, as in `taceva check`.
    pub(crate) saturated: f64,
    /// Mean square of the Laplacian (4 times a pixel minus its four neighbours) of the first colour channel over sampled pixels, in squared 8-bit
    /// levels. Sharpness is greatest in focus. Values of different scenes are not comparable.
    pub(crate) sharpness: f64,
}

/// Maximum number of sampled rows and columns; a 640×480 frame is sampled at every second pixel.
const SIDE: usize = 320;

impl Sight {
    /// Computes saturation from every pixel, and sharpness from a grid of pixels.
    pub(crate) fn of(frame: &Frame) -> Sight {
        let info = frame.info();
        let (depth, top) = (info.format.samples(), info.format.full_scale());
        let full = match info.format.bytes_per_sample() {
            1 => frame
                .bytes()
                .iter()
                .filter(|byte| u16::from(**byte) == top)
                .count(),
            _ => frame.samples().filter(|number| *number == top).count(),
        };
        let [width, height] = [info.width, info.height].map(|side| side as usize);
        let bytes = info.format.bytes_per_sample();
        // The high byte of the value: 8 bits are enough for focus.
        let at = |x: usize, y: usize| {
            let number = (y * width + x) * depth * bytes + (bytes - 1);
            frame.bytes().get(number).copied().map_or(0, i64::from)
        };
        let step = |side: usize| side.div_ceil(SIDE).max(1);
        let (mut sum, mut count) = (0_i64, 0_i64);
        for y in (1..height.saturating_sub(1)).step_by(step(height)) {
            for x in (1..width.saturating_sub(1)).step_by(step(width)) {
                let about = at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1);
                let bent = 4 * at(x, y) - about;
                sum += bent * bent;
                count += 1;
            }
        }
        Sight {
            saturated: full as f64 / (width * height * depth).max(1) as f64,
            sharpness: sum as f64 / count.max(1) as f64,
        }
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::{FrameInfo, PixelFormat};

    use super::*;

    fn frame(format: PixelFormat, pixel: impl Fn(usize, usize) -> u8) -> Frame {
        let info = FrameInfo {
            width: 8,
            height: 8,
            format,
        };
        let pixels = (0..64).flat_map(|at| {
            let value = pixel(at % 8, at / 8);
            match format.bytes_per_sample() {
                1 => vec![value; format.samples()],
                _ => [value, value].repeat(format.samples()),
            }
        });
        Frame::new(info, pixels.collect()).expect("whole")
    }

    #[test]
    fn an_edge_is_sharper_than_a_slope_and_an_even_picture_is_not_sharp() {
        let even = Sight::of(&frame(PixelFormat::Gray8, |_, _| 90));
        let slope = Sight::of(&frame(PixelFormat::Gray8, |x, _| {
            u8::try_from(x * 20).expect("small")
        }));
        let edge = Sight::of(&frame(
            PixelFormat::Gray8,
            |x, _| if x < 4 { 0 } else { 140 },
        ));
        assert!(even.sharpness.abs() <= 0.0 && slope.sharpness.abs() <= 0.0);
        // Two of six columns have a Laplacian of 140.
        assert!((edge.sharpness - 2.0 / 6.0 * 140.0_f64.powi(2)).abs() < 1e-9);
    }

    #[test]
    fn full_numbers_are_counted_in_every_format() {
        for format in [PixelFormat::Gray8, PixelFormat::Rgb8, PixelFormat::Rgb16] {
            let half = Sight::of(&frame(format, |x, _| if x < 4 { 255 } else { 10 }));
            assert!((half.saturated - 0.5).abs() < 1e-12, "{half:?}");
        }
    }
}
