//! Pixel values of a picture, which a fault changes.

use taceva_core::random::Draws;
use taceva_core::{Frame, FrameInfo, whole_size};

/// Pixel values of a picture, row by row. The colours of a pixel are consecutive.
pub(crate) struct Canvas {
    info: FrameInfo,
    /// Values in digital levels of the camera. A fault may move them out of the range of the camera.
    ///
    /// # Shapes
    /// `[height, width, colours]`.
    pub(crate) values: Vec<f32>,
}

impl Canvas {
    /// Pixel values of `frame`.
    pub(crate) fn of(frame: &Frame) -> Canvas {
        Canvas {
            info: frame.info(),
            values: frame.samples().map(f32::from).collect(),
        }
    }

    /// Converts the values to a picture. Each value is rounded half to even, and clamped to the range of the camera.
    pub(crate) fn into_frame(self) -> Frame {
        let full = self.full();
        let width = self.info.format.bytes_per_sample();
        let mut bytes = Vec::with_capacity(self.values.len() * width);
        for value in &self.values {
            let number = whole(value.clamp(0.0, full)).to_le_bytes();
            bytes.extend_from_slice(&number[..width]);
        }
        Frame::new(self.info, bytes).expect("as many numbers as before")
    }

    /// Number of pixels in a row.
    pub(crate) fn width(&self) -> usize {
        self.info.width as usize
    }

    /// Number of rows.
    pub(crate) fn height(&self) -> usize {
        self.info.height as usize
    }

    /// Number of colours of a pixel.
    pub(crate) fn colours(&self) -> usize {
        self.info.format.samples()
    }

    /// Greatest pixel value of the camera, such as 255.
    pub(crate) fn full(&self) -> f32 {
        f32::from(self.info.format.full_scale())
    }

    /// Values of all pixels, one slice for each pixel.
    pub(crate) fn pixels(&mut self) -> impl Iterator<Item = &mut [f32]> {
        let colours = self.colours();
        self.values.chunks_exact_mut(colours)
    }

    /// Rows of pixel values.
    pub(crate) fn rows(&mut self) -> impl Iterator<Item = &mut [f32]> {
        let length = self.width() * self.colours();
        self.values.chunks_exact_mut(length)
    }

    /// Values of the pixel in column `x` of row `y`.
    pub(crate) fn pixel(&mut self, x: usize, y: usize) -> &mut [f32] {
        let colours = self.colours();
        let first = (y * self.width() + x) * colours;
        &mut self.values[first..first + colours]
    }
}

/// Parameter and random numbers of a fault in one picture.
pub(crate) struct Realisation {
    /// Parameter of the fault, above 0, in the unit that the fault states.
    pub(crate) parameter: f32,
    /// Random numbers. They depend on the seed and the fault, and for [`Scope::Each`](crate::fault::Scope::Each) also on the sample.
    pub(crate) draws: Draws,
}

impl Realisation {
    /// Random number with the index `counter`: a multiple of 2⁻²⁴, at least 0 and below 1.
    pub(crate) fn unit(&self, counter: u64) -> f32 {
        unit(self.draws, counter)
    }

    /// Defects of the fault, as many as its parameter, rounded up. The last has the strength that remains; all others have strength 1.
    pub(crate) fn defects(&self) -> impl Iterator<Item = Defect> + '_ {
        let strength = move |number: u16| (self.parameter - f32::from(number)).min(1.0);
        (0..u16::MAX)
            .map(move |number| Defect {
                strength: strength(number),
                draws: self.draws.of(u64::from(number)),
            })
            .take_while(|defect| defect.strength > 0.0)
    }
}

/// A defect on the gel or the lens, such as a scratch.
pub(crate) struct Defect {
    /// Strength from 0 to 1.
    pub(crate) strength: f32,
    draws: Draws,
}

impl Defect {
    /// Random number with the index `counter`: a multiple of 2⁻²⁴, at least 0 and below 1.
    pub(crate) fn unit(&self, counter: u64) -> f32 {
        unit(self.draws, counter)
    }
}

fn unit(draws: Draws, counter: u64) -> f32 {
    (draws.bits(counter) >> 40) as f32 / 16_777_216.0
}

/// Integer part of a coordinate or length in pixels; 0 if it is negative.
pub(crate) fn index(place: f32) -> usize {
    whole_size(f64::from(place))
}

/// Rounds to the nearest integer, half to even.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the number is clamped to the range of the camera"
)]
fn whole(number: f32) -> u16 {
    number.round_ties_even() as u16
}
