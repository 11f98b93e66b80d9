//! Gathers outputs of channel panels that were computed separately into one picture.

use super::ending::Finish;
use crate::panel::PANEL;
use crate::planes::Layout;
use crate::simd::{Job, Tile, Vector};

/// One picture whose channel panels are stored separately.
pub(super) struct Gathering<'a> {
    /// Outputs, shape `[part, pixel, channel of the part]`. The last part may have fewer channels.
    pub(super) parts: &'a [f32],
    /// Number of channels per part.
    pub(super) channels: usize,
    pub(super) output: (&'a mut [f32], Layout),
    /// Operation on finished sums.
    pub(super) finish: Finish<'a>,
}

impl Job for Gathering<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, proof: V::Proof) {
        let (output, layout) = self.output;
        let (picture, row) = (layout.picture, layout.picture.width);
        let parts = self.parts.chunks(picture.pixels() * self.channels);
        for (part, values) in parts.enumerate() {
            let channels = values.len() / picture.pixels();
            for pixel in 0..picture.pixels() {
                let to = layout.start_of_row(pixel / row)
                    + pixel % row * picture.channels
                    + part * self.channels;
                for channel in (0..channels).step_by(V::LANES) {
                    let load = |values: &[f32], start: usize| -> Tile<V, 1, 1> {
                        Tile::load(proof, values, [start], PANEL)
                    };
                    let sums = load(values, pixel * channels + channel);
                    let sums = match self.finish {
                        Finish::Keep => sums,
                        Finish::Relu => sums.positive_part(),
                        Finish::AddThenRelu(other) => {
                            sums.plus(load(other, to + channel)).positive_part()
                        }
                    };
                    sums.store(output, [to + channel], PANEL);
                }
            }
        }
    }
}
