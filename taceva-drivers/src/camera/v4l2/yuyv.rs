//! Conversion of YUYV pixels to RGB. Each pixel has one luminance, and each pair of pixels shares two colour values.

use super::kernel::Coding;

/// Conversion from YUYV to RGB, in units of 1/65,536. The rounding error is less than 0.01 of an 8-bit step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Matrix {
    /// Luminance of black, from 0 to 255.
    black: i32,
    brightness: i32,
    red_of_v: i32,
    green_of_u: i32,
    green_of_v: i32,
    blue_of_u: i32,
}

const ONE: f64 = 65_536.0;
/// Luminance steps from black to white in the limited range. The next constants: colour steps of the limited range, and steps of the full range.
const STEPS_BRIGHTNESS: f64 = 219.0;
const STEPS_COLOUR: f64 = 224.0;
const STEPS: f64 = 255.0;

impl Matrix {
    /// Matrix for the conversion standard `coding`, from the shares of red and blue in luminance (ITU-R BT.601 and BT.709).
    pub(super) fn of(coding: Coding) -> Matrix {
        let (red, blue) = match coding {
            Coding::Limited601 | Coding::Full601 => (0.299, 0.114),
            Coding::Limited709 | Coding::Full709 => (0.2126, 0.0722),
        };
        let (black, brightness, colour) = match coding {
            Coding::Limited601 | Coding::Limited709 => {
                (16, STEPS / STEPS_BRIGHTNESS, STEPS / STEPS_COLOUR)
            }
            Coding::Full601 | Coding::Full709 => (0, 1.0, 1.0),
        };
        let green = 1.0 - red - blue;
        #[expect(
            clippy::cast_possible_truncation,
            reason = "numbers of a few units, in 65,536ths"
        )]
        let whole = |number: f64| (number * ONE).round() as i32;
        Matrix {
            black,
            brightness: whole(brightness),
            red_of_v: whole(2.0 * (1.0 - red) * colour),
            green_of_u: whole(2.0 * (1.0 - blue) * blue / green * colour),
            green_of_v: whole(2.0 * (1.0 - red) * red / green * colour),
            blue_of_u: whole(2.0 * (1.0 - blue) * colour),
        }
    }

    /// Converts a row of YUYV pixels to RGB bytes in `into`. Bytes after the last complete pair of pixels are ignored.
    pub(super) fn row(self, row: &[u8], into: &mut [u8]) {
        for (pair, pixels) in row.chunks_exact(4).zip(into.chunks_mut(6)) {
            let &[y0, u, y1, v] = pair else { continue };
            let (u, v) = (i32::from(u) - 128, i32::from(v) - 128);
            for (y, pixel) in [y0, y1].into_iter().zip(pixels.chunks_exact_mut(3)) {
                let brightness = (i32::from(y) - self.black) * self.brightness;
                pixel.copy_from_slice(&[
                    step(brightness + v * self.red_of_v),
                    step(brightness - u * self.green_of_u - v * self.green_of_v),
                    step(brightness + u * self.blue_of_u),
                ]);
            }
        }
    }
}

/// Rounds `value`, in units of 1/65,536, to a whole number and limits it to 0 to 255.
fn step(value: i32) -> u8 {
    let rounded = (value + (1 << 15)) >> 16;
    u8::try_from(rounded.clamp(0, 255)).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn colours(coding: Coding, pair: [u8; 4]) -> [u8; 6] {
        let mut into = [0; 6];
        Matrix::of(coding).row(&pair, &mut into);
        into
    }

    #[test]
    fn black_white_and_pure_colours_are_what_the_standard_says() {
        let limited = Coding::Limited601;
        assert_eq!(
            colours(limited, [16, 128, 235, 128]),
            [0, 0, 0, 255, 255, 255]
        );
        // Red of BT.601: brightness 81.481, colours 90.203 and 240.
        let red = colours(limited, [81, 90, 81, 240]);
        assert!(red[0] >= 253 && red[1] <= 1 && red[2] <= 1, "{red:?}");
        // Blue of BT.709: brightness 31.812, colours 240 and 117.7.
        let blue = colours(Coding::Limited709, [32, 240, 32, 118]);
        assert!(blue[0] <= 1 && blue[1] <= 1 && blue[2] >= 254, "{blue:?}");
        assert_eq!(
            colours(Coding::Full601, [0, 128, 255, 128]),
            [0, 0, 0, 255, 255, 255]
        );
        assert_eq!(
            colours(Coding::Full709, [77, 128, 78, 128]),
            [77, 77, 77, 78, 78, 78]
        );
    }

    #[test]
    fn every_byte_gives_the_nearest_step_of_the_exact_formula() {
        let exact = |y: f64, u: f64, v: f64| {
            let (y, u, v) = ((y - 16.0) / 219.0, (u - 128.0) / 224.0, (v - 128.0) / 224.0);
            let (red, blue) = (y + 1.402 * v, y + 1.772 * u);
            let green = (y - 0.299 * red - 0.114 * blue) / 0.587;
            [red, green, blue].map(|colour| (colour * 255.0).clamp(0.0, 255.0))
        };
        for y in (0..=255).step_by(5) {
            for u in (0..=255).step_by(15) {
                for v in (0..=255).step_by(15) {
                    let found = colours(Coding::Limited601, [y, u, y, v]);
                    let expected = exact(f64::from(y), f64::from(u), f64::from(v));
                    for (found, expected) in found.into_iter().zip(expected) {
                        assert!((f64::from(found) - expected).abs() < 0.52, "{y} {u} {v}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_row_of_odd_length_loses_its_last_byte_and_no_more() {
        let mut into = [7; 3];
        Matrix::of(Coding::Full601).row(&[9, 128, 9, 128, 1, 2], &mut into);
        assert_eq!(into, [9, 9, 9]);
    }
}
