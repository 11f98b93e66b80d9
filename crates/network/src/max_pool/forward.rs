//! Forward pass of fused max pooling.

use rayon::prelude::*;

use super::{PLACES, place, window};
use crate::batch_norm::{Moments, relu};
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::{Layout, Planes};
use crate::simd::{Job, Vector};

/// Normalises the first `count` pictures, applies ReLU and pools them. Writes to `choices` the window position of each output's source pixel.
///
/// # Shapes
/// `choices`: `[pictures, output pixels, channels]`.
pub(crate) fn pool_normalised(
    machine: Machine,
    raw: &Planes,
    count: usize,
    moments: &Moments,
    into: &mut Planes,
    choices: &mut [u8],
) {
    let (from, layout) = (raw.layout(), into.layout());
    let raws = raw.first(count).par_chunks_exact(from.len());
    let images = into.first_mut(count).par_chunks_exact_mut(layout.len());
    let choices = choices.par_chunks_exact_mut(layout.picture.len());
    images
        .zip(raws)
        .zip(choices)
        .for_each(|((into, raw), choices)| {
            machine.run(Pool {
                raw,
                from,
                moments,
                into,
                layout,
                choices,
            });
        });
}

/// Task of [`pool_normalised`] for one picture.
struct Pool<'a> {
    raw: &'a [f32],
    from: Layout,
    moments: &'a Moments,
    into: &'a mut [f32],
    layout: Layout,
    choices: &'a mut [u8],
}

impl Job for Pool<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, _proof: V::Proof) {
        let (scale, _) = self.moments.scale.as_chunks::<PANEL>();
        let (shift, _) = self.moments.shift.as_chunks::<PANEL>();
        let panels = scale.len();
        let (input, output) = (self.from.picture, self.layout.picture);
        let rows = self
            .choices
            .as_chunks_mut::<PANEL>()
            .0
            .chunks_exact_mut(output.width * panels);
        for (y, choices) in rows.enumerate() {
            let lines = window(y, input.height)
                .map(|y| self.raw[self.from.row_range(y)].as_chunks::<PANEL>().0);
            let first_row = u32::from(y == 0);
            let into = self.into[self.layout.row_range(y)]
                .as_chunks_mut::<PANEL>()
                .0;
            let pixels = into
                .chunks_exact_mut(panels)
                .zip(choices.chunks_exact_mut(panels));
            for (x, (into, choices)) in pixels.enumerate() {
                let columns = window(x, input.width).map(|x| x * panels);
                let first_column = u32::from(x == 0);
                for panel in 0..panels {
                    // The first position always wins and no value is greater than NaN, so a NaN is kept. Positions outside the picture never win.
                    // Above and to the left, `is_in` excludes them. Below and to the right, they repeat a value that was already compared.
                    let (mut best, mut choice) = ([0.0_f32; PANEL], [0_u32; PANEL]);
                    for (row, line) in PLACES.into_iter().zip(lines) {
                        for (column, start) in PLACES.into_iter().zip(columns) {
                            let is_in = (row >= first_row) & (column >= first_column);
                            let is_first = (row == first_row) & (column == first_column);
                            let raw = &line[start + panel];
                            let place = place(row, column);
                            for lane in 0..PANEL {
                                let value = raw[lane] * scale[panel][lane] + shift[panel][lane];
                                let wins = is_first | (is_in & (value > best[lane]));
                                best[lane] = if wins { value } else { best[lane] };
                                choice[lane] = if wins { place } else { choice[lane] };
                            }
                        }
                    }
                    into[panel] = best.map(relu);
                    #[expect(clippy::cast_possible_truncation, reason = "one of nine places")]
                    let narrow = choice.map(|place| place as u8);
                    choices[panel] = narrow;
                }
            }
        }
    }
}
