//! Pictures for tests.

use taceva_core::{Frame, FrameInfo, PixelFormat};

use super::markers::Polarity;
use taceva_core::random::SplitMix64;

/// A frame of random bytes.
pub(super) fn noise(width: u32, height: u32, format: PixelFormat, seed: u64) -> Frame {
    let info = FrameInfo {
        width,
        height,
        format,
    };
    let mut state = SplitMix64::new(seed);
    let bytes = (0..info.byte_len().expect("small"))
        .map(|_| state.next_u64().to_le_bytes()[0])
        .collect();
    Frame::new(info, bytes).expect("whole")
}

/// Test gel of 160×120 pixels with soft round markers of a radius of 2.5 pixels.
#[derive(Clone, Copy)]
pub(super) struct Gel {
    pub(super) polarity: Polarity,
    /// Standard deviation of the camera noise, in 8-bit levels.
    pub(super) noise: f64,
    pub(super) seed: u64,
}

impl Gel {
    pub(super) const WIDTH: u32 = 160;
    pub(super) const HEIGHT: u32 = 120;
    /// Contrast of markers at the left edge, in 8-bit levels. The contrast increases to the right.
    pub(super) const CONTRAST: f64 = 100.0;
    /// Spacing of markers, in pixels.
    pub(super) const SPACING: f64 = 12.0;

    /// Draws the gel with markers at `places`. Brightness increases to the right.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "levels of gray"
    )]
    pub(super) fn frame(self, places: &[[f64; 2]]) -> Frame {
        let mut random = SplitMix64::new(self.seed);
        let info = FrameInfo {
            width: Gel::WIDTH,
            height: Gel::HEIGHT,
            format: PixelFormat::Gray8,
        };
        let mut bytes = Vec::new();
        for y in 0..Gel::HEIGHT {
            for x in 0..Gel::WIDTH {
                let (x, y) = (f64::from(x), f64::from(y));
                let dots = places.iter().map(|place| {
                    let distance = (x - place[0]).hypot(y - place[1]);
                    1.0 / (1.0 + (3.0 * (distance - 2.5)).exp())
                });
                let dot = dots.sum::<f64>().min(1.0);
                let (gel, marker) = match self.polarity {
                    Polarity::Dark => (40.0 + Gel::CONTRAST + 0.4 * x, 40.0),
                    Polarity::Bright => (40.0 + 0.2 * x, 40.0 + Gel::CONTRAST + 0.4 * x),
                };
                let noise = self.noise * normal(&mut random);
                bytes.push((gel + dot * (marker - gel) + noise).round() as u8);
            }
        }
        Frame::new(info, bytes).expect("whole")
    }
}

/// Sum of twelve uniform random numbers minus its mean. The distribution is nearly normal, with standard deviation 1.
fn normal(random: &mut SplitMix64) -> f64 {
    let draws = (0..12).map(|_| (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64);
    draws.sum::<f64>() - 6.0
}

/// Marker positions of a [`Gel`], away from its rim.
pub(super) fn grid(is_hexagonal: bool) -> Vec<[f64; 2]> {
    let rise = if is_hexagonal {
        Gel::SPACING * 0.75_f64.sqrt()
    } else {
        Gel::SPACING
    };
    let mut places = Vec::new();
    for row in 0..10_u8 {
        for column in 0..11_u8 {
            let is_between = is_hexagonal && row % 2 == 1;
            let shift = if is_between { 0.5 * Gel::SPACING } else { 0.0 };
            let y = 10.3 + rise * f64::from(row);
            if y < f64::from(Gel::HEIGHT) - 9.0 {
                places.push([14.7 + Gel::SPACING * f64::from(column) + shift, y]);
            }
        }
    }
    places
}
