//! The forward pass.

use rayon::prelude::*;

use super::{KERNEL, window};
use crate::batch_norm::{Moments, relu};
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::{Layout, Planes};
use crate::simd::{Job, Vector};

/// Pools the first `count` pictures once normalised and cut at zero; `choices` of each output says which place of the window
/// it came from.
///
/// # Shapes
/// `choices`: `[pictures, output pixels, channels]`.
pub(crate) fn pool_normalised(
    machine: Machine,
    (raw, count): (&Planes, usize),
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

/// One picture.
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
        let (width, output) = (self.from.picture.width, self.layout.picture);
        let rows = self
            .choices
            .as_chunks_mut::<PANEL>()
            .0
            .chunks_exact_mut(output.width * panels);
        for (y, choices) in rows.enumerate() {
            let into = self.into[self.layout.row_range(y)]
                .as_chunks_mut::<PANEL>()
                .0;
            let pixels = into
                .chunks_exact_mut(panels)
                .zip(choices.chunks_exact_mut(panels));
            for (x, (into, choices)) in pixels.enumerate() {
                for panel in 0..panels {
                    // The first candidate always wins, so that a NaN is kept; none is greater than it.
                    let (mut best, mut choice) = ([0.0_f32; PANEL], [0_u32; PANEL]);
                    let mut is_first = true;
                    for (row, from_y) in window(y, self.from.picture.height) {
                        let start = self.from.start_of_row(from_y);
                        let (line, _) = self.raw[start..].as_chunks::<PANEL>();
                        for (column, from_x) in window(x, width) {
                            let raw = &line[from_x * panels + panel];
                            #[expect(
                                clippy::cast_possible_truncation,
                                reason = "one of nine places"
                            )]
                            let place = (row * KERNEL + column) as u32;
                            for lane in 0..PANEL {
                                let value = raw[lane] * scale[panel][lane] + shift[panel][lane];
                                let wins = is_first | (value > best[lane]);
                                best[lane] = if wins { value } else { best[lane] };
                                choice[lane] = if wins { place } else { choice[lane] };
                            }
                            is_first = false;
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
