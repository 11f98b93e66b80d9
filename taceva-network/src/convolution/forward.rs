//! The forward pass.

use rayon::prelude::*;

use super::correlation::{Correlation, Finish, Start, Tap, are_weights_many};
use super::weights::ConvolutionWeights;
use super::{Convolution, offset};
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::{Layout, Planes};
use crate::simd::Pixels;

/// Pixels of pictures that one thread takes at a time: enough to outweigh the weights that they meet.
const PIXELS_AT_ONCE: usize = 384;

/// A forward pass over pictures of one layout, ready to be run.
#[derive(Clone, Debug)]
pub(crate) struct Forward {
    pixels: Pixels,
    taps: Vec<Tap>,
    run: usize,
    rows: usize,
}

/// What a forward pass reads.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub(crate) weights: &'a ConvolutionWeights,
    pub(crate) input: &'a Planes,
    /// The first picture that is read.
    pub(crate) first: usize,
    /// How many pictures.
    pub(crate) count: usize,
}

/// What is added to sums and done with them, for whole batches.
#[derive(Clone, Copy)]
pub(crate) enum Epilogue<'a> {
    /// Nothing.
    Raw,
    /// A bias, and zero below zero.
    BiasRelu(&'a [f32]),
    /// A bias, as many pictures that lie as the output does, and zero below zero.
    BiasAddRelu(&'a [f32], &'a [f32]),
    /// A bias alone.
    Bias(&'a [f32]),
}

impl Forward {
    /// The pass of `convolution` from pictures of layout `input` to those of layout `output`.
    pub(crate) fn new(convolution: Convolution, input: Layout, output: Layout) -> Forward {
        let run = convolution.kernel * convolution.inputs;
        let taps = (0..convolution.kernel).map(|row| Tap {
            offset: row * input.row(),
            row: row * run,
        });
        let picture = output.picture;
        let mut offsets = Vec::with_capacity(picture.pixels());
        for y in 0..picture.height {
            for x in 0..picture.width {
                let to = output.start_of_row(y) + x * picture.channels;
                offsets.push((offset(convolution.corner(input, y, x)), offset(to)));
            }
        }
        Forward {
            pixels: Pixels::new(offsets),
            taps: taps.collect(),
            run,
            rows: convolution.kernel * run,
        }
    }

    /// Runs it, into the first pictures of `output`; `each` of a picture sees its output while that is still in a cache.
    pub(crate) fn run<E: Send>(
        &self,
        machine: Machine,
        source: Source<'_>,
        output: &mut Planes,
        epilogue: Epilogue<'_>,
        each: (&mut [E], impl Fn(&mut E, &[f32]) + Sync),
    ) {
        let count = source.count;
        let layout = output.layout();
        let (input_image, output_image) = (source.input.layout().len(), layout.len());
        let panels = layout.picture.channels / PANEL;
        let are_many = are_weights_many(self.rows, panels);
        let group = images_at_once(self.pixels.len(), count, are_many);
        let (each, see) = each;
        let inputs = source.input.from(source.first, count);
        let inputs = inputs.par_chunks(group * input_image);
        let outputs = output.first_mut(count).par_chunks_mut(group * output_image);
        let groups = outputs.zip(inputs).zip(each.par_chunks_mut(group));
        groups
            .enumerate()
            .for_each(|(index, ((output, input), each))| {
                let start = index * group * output_image;
                let (start, finish) = match epilogue {
                    Epilogue::Raw => (Start::Zero, Finish::Keep),
                    Epilogue::Bias(bias) => (Start::Bias(bias), Finish::Keep),
                    Epilogue::BiasRelu(bias) => (Start::Bias(bias), Finish::Relu),
                    Epilogue::BiasAddRelu(bias, other) => {
                        let other = &other[start..][..output.len()];
                        (Start::Bias(bias), Finish::AddThenRelu(other))
                    }
                };
                machine.run(Correlation {
                    pixels: &self.pixels,
                    images: output.len() / output_image,
                    input,
                    input_image,
                    taps: &self.taps,
                    run: self.run,
                    weights: source.weights.values(),
                    rows: self.rows,
                    output: &mut *output,
                    output_image,
                    start,
                    finish,
                });
                for (each, output) in each.iter_mut().zip(output.chunks_exact(output_image)) {
                    see(each, output);
                }
            });
    }
}

/// How many pictures of `pixels` pixels a thread takes at a time. It changes the time that a pass takes, and no bit of it.
pub(super) fn images_at_once(pixels: usize, count: usize, are_weights_many: bool) -> usize {
    let share = count.div_ceil(rayon::current_num_threads()).max(1);
    if are_weights_many {
        // Weights are read from memory once for each group.
        share
    } else {
        PIXELS_AT_ONCE.div_ceil(pixels).min(share)
    }
}
