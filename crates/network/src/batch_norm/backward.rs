//! Gradients of batch normalisation followed by ReLU.

use rayon::prelude::*;
use taceva_core::single;

use super::Moments;
use super::sums::{ChannelSums, PIXELS_AT_ONCE};
use crate::machine::Machine;
use crate::panel::{Aligned, PANEL};
use crate::planes::{Layout, Pictures, Planes};
use crate::simd::{Job, Vector};

/// Mask that ReLU applies to a gradient. The gradient is zero where the output was not positive.
#[derive(Clone, Copy)]
pub(crate) enum Gate<'a> {
    /// No mask, because the gradient is already masked.
    Open,
    /// Zeroes the gradient where the normalised picture is not positive.
    Normalised,
    /// Overwrites the gradient with zero where these output pictures are not positive.
    Output(&'a Planes),
}

/// Sums over a batch that the gradients need, one value per channel. g is the masked output gradient, x the input of the normalisation and n the
/// number of values per channel; mean and inverse are fields of [`Moments`].
#[derive(Clone, Debug)]
pub(crate) struct GradientSums {
    /// Gradient of the bias: sum of the masked output gradient over the batch.
    pub(crate) bias: Aligned,
    /// Gradient of the gain: sum over the batch of masked output gradient times normalised input.
    pub(crate) gain: Aligned,
    /// Mean of the masked output gradient over the batch.
    pub(crate) mean: Aligned,
    /// Slope of the masked output gradient over the input, with the symbols of [`GradientSums`]: inverse² · Σ g · (x − mean) / n.
    pub(crate) slope: Aligned,
}

/// Computes the sums over the gradients of the first `count` pictures. `sums` is a buffer for the sums of each picture.
pub(crate) fn gradient_sums(
    machine: Machine,
    raw: &Planes,
    count: usize,
    moments: &Moments,
    gate: Gate<'_>,
    gradient: &mut Planes,
    sums: &mut [ChannelSums],
) -> GradientSums {
    let length = raw.layout().len();
    let raws = raw.first(count).par_chunks_exact(length);
    let gradients = gradient.first_mut(count).par_chunks_exact_mut(length);
    let images = raws.zip(gradients).zip(&mut sums[..count]).enumerate();
    images.for_each(|(image, ((raw, gradient), sums))| {
        let gate = match gate {
            Gate::Open => PictureGate::Open,
            Gate::Normalised => PictureGate::Normalised,
            Gate::Output(output) => {
                let length = output.layout().len();
                let picture = &output.first(count)[image * length..][..length];
                PictureGate::Output(picture, output.layout())
            }
        };
        machine.run(Sums {
            raw,
            moments,
            gate,
            gradient,
            sums,
        });
    });
    let samples = count * raw.layout().picture.pixels();
    GradientSums::over(&sums[..count], moments, samples)
}

impl GradientSums {
    /// Sums over a batch of `samples` values per channel, computed from the two sums of each picture in `images`.
    pub(crate) fn over(images: &[ChannelSums], moments: &Moments, samples: usize) -> GradientSums {
        let channels = moments.mean.len();
        let mut into = GradientSums {
            bias: Aligned::zeros(channels),
            gain: Aligned::zeros(channels),
            mean: Aligned::zeros(channels),
            slope: Aligned::zeros(channels),
        };
        let samples = samples as f64;
        for channel in 0..channels {
            let (mut sum, mut product) = (0.0, 0.0);
            for image in images {
                sum += image.sum(channel);
                product += image.squares(channel);
            }
            let inverse = f64::from(moments.inverse[channel]);
            into.bias[channel] = single(sum);
            into.gain[channel] = single(product * inverse);
            into.mean[channel] = single(sum / samples);
            into.slope[channel] = single(product * inverse * inverse / samples);
        }
        into
    }
}

/// Writes the gradient of the normalisation's input for the first `count` pictures: scale · (g − Σg/n − (x − mean) · inverse² · Σ(g · (x − mean))/n),
/// with g, x and n of [`GradientSums`].
pub(crate) fn input_gradient(
    machine: Machine,
    raw: Pictures<'_>,
    moments: &Moments,
    sums: &GradientSums,
    gate: Gate<'_>,
    gradient: &Planes,
    into: &mut Planes,
) {
    let Pictures { planes: raw, count } = raw;
    let length = raw.layout().len();
    let raws = raw.first(count).par_chunks_exact(length);
    let gradients = gradient.first(count).par_chunks_exact(length);
    let layout = into.layout();
    let images = into.first_mut(count).par_chunks_exact_mut(layout.len());
    // `Gate::Output` has zeroed the masked values already.
    let is_gated = matches!(gate, Gate::Normalised);
    images
        .zip(raws)
        .zip(gradients)
        .for_each(|((into, raw), gradient)| {
            machine.run(Apply {
                raw,
                moments,
                sums,
                is_gated,
                gradient,
                into,
                layout,
            });
        });
}

/// Part of a [`Gate`] for one picture.
#[derive(Clone, Copy)]
enum PictureGate<'a> {
    Open,
    Normalised,
    Output(&'a [f32], Layout),
}

/// Task of [`gradient_sums`] for one picture.
struct Sums<'a> {
    raw: &'a [f32],
    moments: &'a Moments,
    gate: PictureGate<'a>,
    gradient: &'a mut [f32],
    sums: &'a mut ChannelSums,
}

impl Job for Sums<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, _proof: V::Proof) {
        if let PictureGate::Output(output, layout) = self.gate {
            let row = layout.picture.width * layout.picture.channels;
            for (y, gradient) in self.gradient.chunks_exact_mut(row).enumerate() {
                let output = &output[layout.row_range(y)];
                for (gradient, output) in gradient.iter_mut().zip(output) {
                    *gradient = if *output > 0.0 { *gradient } else { 0.0 };
                }
            }
        }
        let is_gated = matches!(self.gate, PictureGate::Normalised);
        let (mean, _) = self.moments.mean.as_chunks::<PANEL>();
        let (scale, _) = self.moments.scale.as_chunks::<PANEL>();
        let (shift, _) = self.moments.shift.as_chunks::<PANEL>();
        let (raw, _) = self.raw.as_chunks::<PANEL>();
        let (gradient, _) = self.gradient.as_chunks::<PANEL>();
        let panels = mean.len();
        let (sums, products) = self.sums.split();
        let (sums, _) = sums.as_chunks_mut::<PANEL>();
        let (products, _) = products.as_chunks_mut::<PANEL>();
        sums.iter_mut()
            .chain(products.iter_mut())
            .for_each(|sum| *sum = [0.0; PANEL]);
        let blocks = raw.chunks(PIXELS_AT_ONCE * panels);
        for (raw, gradient) in blocks.zip(gradient.chunks(PIXELS_AT_ONCE * panels)) {
            for panel in 0..panels {
                let (mut sum, mut product) = ([0.0_f32; PANEL], [0.0_f32; PANEL]);
                let pixels = raw[panel..].iter().step_by(panels);
                let gradients = gradient[panel..].iter().step_by(panels);
                for (raw, gradient) in pixels.zip(gradients) {
                    for lane in 0..PANEL {
                        let value = raw[lane];
                        let passes =
                            !is_gated || value * scale[panel][lane] + shift[panel][lane] > 0.0;
                        let gradient = if passes { gradient[lane] } else { 0.0 };
                        sum[lane] += gradient;
                        product[lane] += gradient * (value - mean[panel][lane]);
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
    raw: &'a [f32],
    moments: &'a Moments,
    sums: &'a GradientSums,
    is_gated: bool,
    gradient: &'a [f32],
    into: &'a mut [f32],
    layout: Layout,
}

impl Job for Apply<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, _proof: V::Proof) {
        let row = self.layout.picture.width * self.layout.picture.channels;
        let rows = self
            .raw
            .chunks_exact(row)
            .zip(self.gradient.chunks_exact(row));
        let panels = [
            &self.moments.mean,
            &self.moments.scale,
            &self.moments.shift,
            &self.sums.mean,
            &self.sums.slope,
        ];
        let [mean, scale, shift, offset, slope] =
            panels.map(|values| values.as_chunks::<PANEL>().0);
        let count = mean.len();
        for (y, (raw, gradient)) in rows.enumerate() {
            let into = self.into[self.layout.row_range(y)]
                .as_chunks_mut::<PANEL>()
                .0;
            let raw = raw.as_chunks::<PANEL>().0.chunks_exact(count);
            let gradient = gradient.as_chunks::<PANEL>().0.chunks_exact(count);
            for ((into, raw), gradient) in into.chunks_exact_mut(count).zip(raw).zip(gradient) {
                for panel in 0..count {
                    for lane in 0..PANEL {
                        let value = raw[panel][lane];
                        let scale = scale[panel][lane];
                        let passes = !self.is_gated || value * scale + shift[panel][lane] > 0.0;
                        let gradient = if passes { gradient[panel][lane] } else { 0.0 };
                        let distance = value - mean[panel][lane];
                        into[panel][lane] = scale
                            * (gradient - offset[panel][lane] - distance * slope[panel][lane]);
                    }
                }
            }
        }
    }
}
