//! Input gradient: correlation of the output gradient with the weights after inputs and outputs are exchanged. There is one correlation for each
//! class of pixels reached by the same kernel positions.

use rayon::prelude::*;

use super::border;
use super::correlation::{Correlation, OutputLayout, Tap, are_weights_many};
use super::forward::images_at_once;
use crate::convolution::ending::Onto;
use crate::convolution::target::GradientTarget;
use crate::convolution::{Convolution, offset};
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::{Layout, Pictures};
use crate::simd::Pixels;

/// Input-gradient pass, prepared for pictures of one memory layout.
#[derive(Clone, Debug)]
pub(crate) struct InputGradient {
    classes: Vec<Class>,
    convolution: Convolution,
}

/// Input pixels reached by the same kernel positions. With stride 2, there are four classes by parity of row and column.
#[derive(Clone, Debug)]
struct Class {
    pixels: Pixels,
    taps: Vec<Tap>,
}

impl InputGradient {
    /// Prepares the pass from output gradients of layout `output` to input gradients of layout `input`.
    ///
    /// The border of `output` must be at least as wide as the padding.
    pub(crate) fn new(convolution: Convolution, output: Layout, input: Layout) -> InputGradient {
        let stride = convolution.stride;
        let classes = (0..stride).flat_map(|y| (0..stride).map(move |x| (y, x)));
        InputGradient {
            classes: classes
                .flat_map(|(y, x)| Class::all_of(convolution, output, input, y, x))
                .filter(|class| class.pixels.len() > 0)
                .collect(),
            convolution,
        }
    }

    /// Runs the pass on the first `count` pictures. `exchanged` are the weights with inputs and outputs exchanged.
    pub(crate) fn run(
        &self,
        machine: Machine,
        exchanged: &[f32],
        gradient: Pictures<'_>,
        into: GradientTarget<'_>,
    ) {
        let Convolution {
            inputs, outputs, ..
        } = self.convolution;
        let rows = self.convolution.taps() * outputs;

        let Pictures {
            planes: gradient,
            count,
        } = gradient;
        let GradientTarget {
            gradient: into,
            onto,
        } = into;
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
                    range: 0..into.len() / to_image * class.pixels.len(),
                    input: gradient,
                    input_image: from_image,
                    taps: &class.taps,
                    run: outputs,
                    weights: exchanged,
                    rows,
                    output: &mut *into,
                    layout: OutputLayout::Pictures {
                        image: to_image,
                        skipped: 0,
                    },
                    rule: onto.rule(),
                });
            }
        });
    }
}

impl Class {
    /// Classes of the input pixels in every stride-th row from `first_y` and every stride-th column from `first_x`. There is one class, or one for
    /// each pixel if the border is skipped.
    fn all_of(
        convolution: Convolution,
        output: Layout,
        input: Layout,
        first_y: usize,
        first_x: usize,
    ) -> Vec<Class> {
        let (stride, padding) = (convolution.stride, convolution.padding());
        // Output pixel `i + shift` reads input pixel `first + stride·i` at kernel position `tap`. `None`: no output pixel reads it there.
        let shift = |first: usize, tap: usize| -> Option<usize> {
            let distance = (first + padding + stride * padding).checked_sub(tap)?;
            // `padding` pixels of border keep shifts non-negative.
            distance.is_multiple_of(stride).then_some(distance / stride)
        };
        let places = (0..convolution.kernel)
            .flat_map(|row| (0..convolution.kernel).map(move |column| (row, column)));
        let taps = places.filter_map(|(row, column)| {
            let (y, x) = (shift(first_y, row)?, shift(first_x, column)?);
            let tap = Tap {
                offset: y * output.row() + x * convolution.outputs,
                row: (row * convolution.kernel + column) * convolution.outputs,
            };
            Some(((y, x), tap))
        });
        let taps: Vec<((usize, usize), Tap)> = taps.collect();
        let corner = output.border - padding;
        let mut pixels = Vec::new();
        for (i, y) in (first_y..input.picture.height).step_by(stride).enumerate() {
            for (j, x) in (first_x..input.picture.width).step_by(stride).enumerate() {
                let from = (i + corner) * output.row() + (j + corner) * convolution.outputs;
                let to = input.start_of_row(y) + x * input.picture.channels;
                pixels.push(((i, j), (offset(from), offset(to))));
            }
        }
        let class = |pixels: Vec<(u32, u32)>, is_met: &dyn Fn((usize, usize)) -> bool| Class {
            pixels: Pixels::new(pixels),
            taps: taps
                .iter()
                .filter(|(shift, _)| is_met(*shift))
                .map(|(_, tap)| *tap)
                .collect(),
        };
        if !border::is_left_out(input.picture) {
            let pixels = pixels.into_iter().map(|(_, place)| place);
            return vec![class(pixels.collect(), &|_| true)];
        }
        let is_within =
            |at: usize, length: usize| at.checked_sub(padding).is_some_and(|at| at < length);
        let picture = output.picture;
        let alone = pixels.into_iter().map(|((i, j), place)| {
            class(vec![place], &|(y, x)| {
                is_within(i + y, picture.height) && is_within(j + x, picture.width)
            })
        });
        alone.collect()
    }
}
