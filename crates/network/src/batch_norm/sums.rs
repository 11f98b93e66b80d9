//! Sums over the pixels of one picture, by channel.

use crate::machine::Machine;
use crate::panel::PANEL;
use crate::simd::{Job, Vector};

/// Number of pixels summed in single precision before the sum is added in double precision.
pub(super) const PIXELS_AT_ONCE: usize = 64;

/// Two sums for each channel of one picture: of values and squares, or of gradients and their products with centred values.
#[derive(Clone, Debug)]
pub(crate) struct ChannelSums {
    /// Both sums, shape `[2, channels]`.
    values: Vec<f64>,
}

impl ChannelSums {
    /// Zeroed sums of `channels` channels.
    pub(crate) fn zeros(channels: usize) -> ChannelSums {
        let values = vec![0.0; 2 * channels];
        ChannelSums { values }
    }

    pub(crate) fn sum(&self, channel: usize) -> f64 {
        self.values[channel]
    }

    pub(crate) fn squares(&self, channel: usize) -> f64 {
        self.values[self.values.len() / 2 + channel]
    }

    /// Overwrites the sums with the sums of `pixels`.
    ///
    /// # Shapes
    /// `pixels`: `[pixels, channels]`.
    pub(crate) fn measure(&mut self, machine: Machine, pixels: &[f32]) {
        let (sums, squares) = self.split();
        machine.run(Measure {
            pixels,
            sums,
            squares,
        });
    }

    /// Mutable views of both sums.
    pub(crate) fn split(&mut self) -> (&mut [f64], &mut [f64]) {
        let channels = self.values.len() / 2;
        self.values.split_at_mut(channels)
    }
}

struct Measure<'a> {
    pixels: &'a [f32],
    sums: &'a mut [f64],
    squares: &'a mut [f64],
}

impl Job for Measure<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, _proof: V::Proof) {
        let channels = self.sums.len();
        let (pixels, _) = self.pixels.as_chunks::<PANEL>();
        let (sums, _) = self.sums.as_chunks_mut::<PANEL>();
        let (squares, _) = self.squares.as_chunks_mut::<PANEL>();
        let panels = channels / PANEL;
        // Sums distances from the first pixel, so that a mean far from zero costs the variance no precision.
        let pivot = &pixels[..panels];
        sums.iter_mut()
            .chain(squares.iter_mut())
            .for_each(|sum| *sum = [0.0; PANEL]);
        for block in pixels.chunks(PIXELS_AT_ONCE * panels) {
            for panel in 0..panels {
                let (mut sum, mut square) = ([0.0_f32; PANEL], [0.0_f32; PANEL]);
                for pixel in block[panel..].iter().step_by(panels) {
                    for lane in 0..PANEL {
                        let distance = pixel[lane] - pivot[panel][lane];
                        sum[lane] += distance;
                        square[lane] += distance * distance;
                    }
                }
                for lane in 0..PANEL {
                    sums[panel][lane] += f64::from(sum[lane]);
                    squares[panel][lane] += f64::from(square[lane]);
                }
            }
        }
        let count = (pixels.len() / panels) as f64;
        for panel in 0..panels {
            for lane in 0..PANEL {
                let pivot = f64::from(pivot[panel][lane]);
                let distances = sums[panel][lane];
                squares[panel][lane] += pivot * (2.0 * distances + count * pivot);
                sums[panel][lane] += count * pivot;
            }
        }
    }
}
