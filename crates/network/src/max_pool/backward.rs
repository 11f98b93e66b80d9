//! Backward pass: the gradient of each output is added to its source pixel.

use rayon::prelude::*;

use super::{CoveringWindow, PLACES, place, window, windows};
use crate::batch_norm::{ChannelSums, GradientSums, Moments};
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::{Layout, Planes};
use crate::simd::{Job, Vector};

/// Results of the forward pass that the backward pass reads.
#[derive(Clone, Copy)]
pub(crate) struct Pooled<'a> {
    pub(crate) output: &'a Planes,
    pub(crate) choices: &'a [u8],
    pub(crate) count: usize,
}

/// Computes the sums for the gradients of the normalisation. Sets the output gradient `gradient` to zero where ReLU made the output zero.
pub(crate) fn gradient_sums(
    machine: Machine,
    raw: &Planes,
    pooled: Pooled<'_>,
    moments: &Moments,
    gradient: &mut Planes,
    sums: &mut [ChannelSums],
) -> GradientSums {
    let Pooled {
        output,
        choices,
        count,
    } = pooled;
    let (from, layout) = (raw.layout(), output.layout());
    let length = layout.picture.len();
    let raws = raw.first(count).par_chunks_exact(from.len());
    let outputs = output.first(count).par_chunks_exact(layout.len());
    let gradients = gradient.first_mut(count).par_chunks_exact_mut(length);
    let images = raws.zip(outputs).zip(choices.par_chunks_exact(length));
    let images = images.zip(gradients).zip(&mut sums[..count]);
    images.for_each(|((((raw, output), choices), gradient), sums)| {
        machine.run(Sums {
            raw,
            from,
            moments,
            output,
            layout,
            choices,
            gradient,
            sums,
        });
    });
    GradientSums::over(&sums[..count], moments, count * from.picture.pixels())
}

/// Replaces the raw pictures by their gradient. The same buffer is used, because these are the largest pictures of a network, and are not read again.
/// `gradient` is the output gradient, masked by [`gradient_sums`].
pub(crate) fn input_gradient(
    machine: Machine,
    raw: &mut Planes,
    pooled: Pooled<'_>,
    moments: &Moments,
    sums: &GradientSums,
    gradient: &Planes,
) {
    let Pooled {
        output,
        choices,
        count,
    } = pooled;
    let (from, layout) = (raw.layout(), output.layout());
    let length = layout.picture.len();
    let raws = raw.first_mut(count).par_chunks_exact_mut(from.len());
    let gradients = gradient.first(count).par_chunks_exact(length);
    let images = raws.zip(gradients).zip(choices.par_chunks_exact(length));
    images.for_each(|((raw, gradient), choices)| {
        machine.run(Apply {
            raw,
            from,
            moments,
            sums,
            layout,
            choices,
            gradient,
        });
    });
}

/// Task of [`gradient_sums`] for one picture.
struct Sums<'a> {
    raw: &'a [f32],
    from: Layout,
    moments: &'a Moments,
    output: &'a [f32],
    layout: Layout,
    choices: &'a [u8],
    gradient: &'a mut [f32],
    sums: &'a mut ChannelSums,
}

impl Job for Sums<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, _proof: V::Proof) {
        let (mean, _) = self.moments.mean.as_chunks::<PANEL>();
        let panels = mean.len();
        let (sums, products) = self.sums.split();
        let (sums, _) = sums.as_chunks_mut::<PANEL>();
        let (products, _) = products.as_chunks_mut::<PANEL>();
        sums.iter_mut()
            .chain(products.iter_mut())
            .for_each(|sum| *sum = [0.0; PANEL]);
        let row = self.layout.picture.width * panels;
        let choices = self.choices.as_chunks::<PANEL>().0.chunks_exact(row);
        let gradients = self
            .gradient
            .as_chunks_mut::<PANEL>()
            .0
            .chunks_exact_mut(row);
        for (y, (choices, gradients)) in choices.zip(gradients).enumerate() {
            let output = self.output[self.layout.row_range(y)].as_chunks::<PANEL>().0;
            let lines = window(y, self.from.picture.height)
                .map(|y| self.raw[self.from.row_range(y)].as_chunks::<PANEL>().0);
            for panel in 0..panels {
                let (mut sum, mut product) = ([0.0_f32; PANEL], [0.0_f32; PANEL]);
                for x in 0..self.layout.picture.width {
                    let at = x * panels + panel;
                    let gradient = &mut gradients[at];
                    for lane in 0..PANEL {
                        let passes = output[at][lane] > 0.0;
                        gradient[lane] = if passes { gradient[lane] } else { 0.0 };
                    }
                    let chosen = choices[at].map(u32::from);
                    let mut value = [0.0_f32; PANEL];
                    let columns = window(x, self.from.picture.width);
                    for (row, line) in PLACES.into_iter().zip(lines) {
                        for (column, from_x) in PLACES.into_iter().zip(columns) {
                            let raw = &line[from_x * panels + panel];
                            let place = place(row, column);
                            for lane in 0..PANEL {
                                let is_it = chosen[lane] == place;
                                value[lane] = if is_it { raw[lane] } else { value[lane] };
                            }
                        }
                    }
                    for lane in 0..PANEL {
                        sum[lane] += gradient[lane];
                        product[lane] += gradient[lane] * (value[lane] - mean[panel][lane]);
                    }
                }
                for lane in 0..PANEL {
                    sums[panel][lane] += f64::from(sum[lane]);
                    products[panel][lane] += f64::from(product[lane]);
                }
            }
        }
    }
}

/// Task of [`input_gradient`] for one picture.
struct Apply<'a> {
    raw: &'a mut [f32],
    from: Layout,
    moments: &'a Moments,
    sums: &'a GradientSums,
    layout: Layout,
    choices: &'a [u8],
    gradient: &'a [f32],
}

impl Job for Apply<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, _proof: V::Proof) {
        let values = [
            &self.moments.mean,
            &self.moments.scale,
            &self.sums.mean,
            &self.sums.slope,
        ];
        let [mean, scale, offset, slope] = values.map(|values| values.as_chunks::<PANEL>().0);
        let panels = mean.len();
        let (choices, _) = self.choices.as_chunks::<PANEL>();
        let (gradient, _) = self.gradient.as_chunks::<PANEL>();
        let (input, output) = (self.from.picture, self.layout.picture);
        for y in 0..input.height {
            let rows = windows(y, output.height);
            let range = self.from.row_range(y);
            let (row_of_raw, _) = self.raw[range].as_chunks_mut::<PANEL>();
            for x in 0..input.width {
                let columns = windows(x, output.width);
                for panel in 0..panels {
                    let mut passed = [0.0_f32; PANEL];
                    // Even rows and columns belong to one window only.
                    for row in rows.into_iter().filter(CoveringWindow::is_there) {
                        for column in columns.into_iter().filter(CoveringWindow::is_there) {
                            let at = (row.window * output.width + column.window) * panels + panel;
                            let chosen = choices[at].map(u32::from);
                            let place = place(row.place, column.place);
                            for lane in 0..PANEL {
                                let is_it = chosen[lane] == place;
                                passed[lane] += if is_it { gradient[at][lane] } else { 0.0 };
                            }
                        }
                    }
                    let raw = &mut row_of_raw[x * panels + panel];
                    for lane in 0..PANEL {
                        let distance = raw[lane] - mean[panel][lane];
                        raw[lane] = scale[panel][lane]
                            * (passed[lane] - offset[panel][lane] - distance * slope[panel][lane]);
                    }
                }
            }
        }
    }
}
