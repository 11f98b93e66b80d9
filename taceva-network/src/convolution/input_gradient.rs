//! The gradient of the input: a correlation of the output's gradient with exchanged weights, one for each class of pixels
//! that the same places of the kernel reach.

use rayon::prelude::*;

use super::correlation::{Correlation, Finish, Start, Tap, are_weights_many};
use super::forward::images_at_once;
use super::weights::ConvolutionWeights;
use super::{Convolution, offset};
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::{Layout, Planes};
use crate::simd::Pixels;

/// What the gradient is written onto.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Onto {
    /// In place of what was there.
    Nothing,
    /// Added to what is there.
    Sum,
}

/// The pass that gives the gradient of the input, ready to be run.
#[derive(Clone, Debug)]
pub(crate) struct InputGradient {
    classes: Vec<Class>,
    convolution: Convolution,
}

/// Input pixels that the same places of the kernel reach; with stride 2, four classes by parity.
#[derive(Clone, Debug)]
struct Class {
    pixels: Pixels,
    taps: Vec<Tap>,
}

impl InputGradient {
    /// The pass from gradients of the output, of layout `output`, to those of the input, of layout `input`.
    ///
    /// The border of `output` is at least the padding.
    pub(crate) fn new(convolution: Convolution, output: Layout, input: Layout) -> InputGradient {
        let stride = convolution.stride;
        let classes = (0..stride).flat_map(|y| (0..stride).map(move |x| (y, x)));
        InputGradient {
            classes: classes
                .map(|first| Class::new(convolution, output, input, first))
                .filter(|class| class.pixels.len() > 0)
                .collect(),
            convolution,
        }
    }

    /// Runs it on the first `count` pictures; `exchanged` is room for as many numbers as there are weights.
    pub(crate) fn run(
        &self,
        machine: Machine,
        weights: &ConvolutionWeights,
        gradient: (&Planes, usize),
        exchanged: &mut [f32],
        into: (&mut Planes, Onto),
    ) {
        let Convolution {
            inputs, outputs, ..
        } = self.convolution;
        let rows = self.convolution.taps() * outputs;
        weights.exchange(machine, exchanged);
        let exchanged = &*exchanged;

        let ((gradient, count), (into, onto)) = (gradient, into);
        let (from_image, to_image) = (gradient.layout().len(), into.layout().len());
        let are_many = are_weights_many(rows, inputs / PANEL);
        let group = images_at_once(into.layout().picture.pixels(), count, are_many);
        let groups = into.first_mut(count).par_chunks_mut(group * to_image);
        let gradients = gradient.first(count).par_chunks(group * from_image);
        groups.zip(gradients).for_each(|(into, gradient)| {
            for class in &self.classes {
                if class.taps.is_empty() && onto == Onto::Sum {
                    continue;
                }
                machine.run(Correlation {
                    pixels: &class.pixels,
                    images: into.len() / to_image,
                    input: gradient,
                    input_image: from_image,
                    taps: &class.taps,
                    run: outputs,
                    weights: exchanged,
                    rows,
                    output: &mut *into,
                    output_image: to_image,
                    start: match onto {
                        Onto::Nothing => Start::Zero,
                        Onto::Sum => Start::Output,
                    },
                    finish: Finish::Keep,
                });
            }
        });
    }
}

impl Class {
    fn new(
        convolution: Convolution,
        output: Layout,
        input: Layout,
        (first_y, first_x): (usize, usize),
    ) -> Class {
        let (stride, padding) = (convolution.stride, convolution.padding());
        // Input pixel `first + stride·i` meets kernel place `tap` in output pixel `i + shift`, where it meets it at all.
        let shift = |first: usize, tap: usize| -> Option<usize> {
            let distance = (first + padding + stride * padding).checked_sub(tap)?;
            // Shifts are kept non-negative by `padding` pixels of border.
            distance.is_multiple_of(stride).then_some(distance / stride)
        };
        let places = (0..convolution.kernel)
            .flat_map(|row| (0..convolution.kernel).map(move |column| (row, column)));
        let taps = places.filter_map(|(row, column)| {
            let (y, x) = (shift(first_y, row)?, shift(first_x, column)?);
            Some(Tap {
                offset: y * output.row() + x * convolution.outputs,
                row: (row * convolution.kernel + column) * convolution.outputs,
            })
        });
        let corner = output.border - padding;
        let mut offsets = Vec::new();
        for (i, y) in (first_y..input.picture.height).step_by(stride).enumerate() {
            for (j, x) in (first_x..input.picture.width).step_by(stride).enumerate() {
                let from = (i + corner) * output.row() + (j + corner) * convolution.outputs;
                let to = input.start_of_row(y) + x * input.picture.channels;
                offsets.push((offset(from), offset(to)));
            }
        }
        Class {
            pixels: Pixels::new(offsets),
            taps: taps.collect(),
        }
    }
}
