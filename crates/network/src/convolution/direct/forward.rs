//! Forward pass of the direct algorithm.

use std::ops::Range;

use rayon::prelude::*;

use super::border::{Reach, is_left_out, reaches};
use super::correlation::{Correlation, OutputLayout, Tap, are_weights_many};
use super::single_picture::Divided;
use crate::convolution::division::{Division, Outputs};
use crate::convolution::source::Source;
use crate::convolution::target::Target;
use crate::convolution::{Convolution, TileRooms, offset};
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::Layout;
use crate::simd::Pixels;
use crate::team;

/// Number of pixels per task of a thread, large enough to amortise reading the weights.
const PIXELS_AT_ONCE: usize = 384;

/// Minimum number of pictures for which the border is skipped, equal to the number of rows in a tile of sums.
const IMAGES_WORTH_CLASSES: usize = 6;

/// Maximum number of pixels of a tile of sums: the sums that the inner loop keeps in registers.
pub(super) const ROWS: usize = 6;

/// Forward pass, prepared for pictures of one memory layout.
#[derive(Clone, Debug)]
pub(crate) struct Forward {
    /// Class that contains all pixels.
    whole: Class,
    /// Classes of pixels with only the kernel positions inside the picture; empty if the border is not skipped.
    apart: Vec<Class>,
    rows: usize,
}

/// Output pixels that read the same kernel positions.
#[derive(Clone, Debug)]
pub(super) struct Class {
    pub(super) pixels: Pixels,
    pub(super) taps: Vec<Tap>,
    pub(super) run: usize,
}

impl Forward {
    /// Prepares the pass of `convolution` from pictures of layout `input` to pictures of layout `output`.
    pub(crate) fn new(convolution: Convolution, input: Layout, output: Layout) -> Forward {
        let (height, width) = (output.picture.height, output.picture.width);
        let [down, across] = [height, width].map(|side| Reach::all(convolution, side));
        let mut apart = Vec::new();
        if is_left_out(output.picture) {
            let columns = reaches(convolution, width, input.picture.width);
            for rows in reaches(convolution, height, input.picture.height) {
                let classes = columns.iter();
                apart.extend(
                    classes.map(|columns| Class::new(convolution, input, output, &rows, columns)),
                );
            }
        }
        Forward {
            whole: Class::new(convolution, input, output, &down, &across),
            apart,
            rows: convolution.taps() * convolution.inputs,
        }
    }

    /// Classes to compute for `images` pictures: one class of all pixels, or one class per pixel for many tiny pictures. Each class reads the weights
    /// again, so it needs many pixels. Only zeros are skipped, so outputs do not depend on this choice.
    fn classes(&self, images: usize) -> &[Class] {
        if self.apart.is_empty() || images < IMAGES_WORTH_CLASSES {
            std::slice::from_ref(&self.whole)
        } else {
            &self.apart
        }
    }

    /// Size of the work for one picture with `panels` output panels, for its division among threads.
    pub(in crate::convolution) fn outputs(&self, panels: usize) -> Outputs {
        Outputs {
            pixels: self.whole.pixels.len(),
            together: ROWS,
            panels,
            products: self.rows,
            points: 1,
        }
    }

    /// Runs the pass and writes to the first pictures of `output`. `see` is called for each picture while its output is in cache. `see` receives the item of
    /// `each` for this picture, and the output.
    pub(crate) fn run<E: Send>(
        &self,
        machine: Machine,
        source: Source<'_>,
        target: Target<'_>,
        each: &mut [E],
        see: impl Fn(&mut E, &[f32]) + Sync,
        rooms: &TileRooms,
    ) {
        let Target {
            pictures: output,
            epilogue,
        } = target;
        let count = source.count;
        let layout = output.layout();
        let (input_image, output_image) = (source.input.layout().len(), layout.len());
        let panels = layout.picture.channels / PANEL;
        let division = self.outputs(panels).divided(team::parts(count));
        if division != Division::Whole {
            let images = output.first_mut(count).par_chunks_mut(output_image);
            let images = images.zip(source.pictures().par_chunks(input_image));
            let images = images.zip(&mut each[..count]).enumerate();
            images.for_each(|(index, ((output, input), each))| {
                let divided = Divided {
                    class: &self.whole,
                    rows: self.rows,
                    input,
                    weights: source.weights,
                    layout,
                };
                let first = index * output_image;
                let ending =
                    |part: Range<usize>| epilogue.within(first + part.start..first + part.end);
                divided.run(machine, division, &mut *output, ending, rooms);
                see(each, output);
            });
            return;
        }
        let are_many = are_weights_many(self.rows, panels);
        let group = images_at_once(self.whole.pixels.len(), count, are_many);
        let inputs = source.pictures().par_chunks(group * input_image);
        let outputs = output.first_mut(count).par_chunks_mut(group * output_image);
        let groups = outputs.zip(inputs).zip(each.par_chunks_mut(group));
        groups
            .enumerate()
            .for_each(|(index, ((output, input), each))| {
                let first = index * group * output_image;
                let rule = epilogue.within(first..first + output.len());
                let images = output.len() / output_image;
                for class in self.classes(images) {
                    machine.run(Correlation {
                        pixels: &class.pixels,
                        range: 0..images * class.pixels.len(),
                        input,
                        input_image,
                        taps: &class.taps,
                        run: class.run,
                        weights: source.weights,
                        rows: self.rows,
                        output: &mut *output,
                        layout: OutputLayout::Pictures {
                            image: output_image,
                            skipped: 0,
                        },
                        rule,
                    });
                }
                for (each, output) in each.iter_mut().zip(output.chunks_exact(output_image)) {
                    see(each, output);
                }
            });
    }
}

impl Class {
    fn new(
        convolution: Convolution,
        input: Layout,
        output: Layout,
        rows: &Reach,
        columns: &Reach,
    ) -> Class {
        let inputs = convolution.inputs;
        let first = columns.places.start;
        let taps = rows.places.clone().map(|row| Tap {
            offset: row * input.row() + first * inputs,
            row: (row * convolution.kernel + first) * inputs,
        });
        let mut offsets = Vec::new();
        for y in rows.positions.clone() {
            for x in columns.positions.clone() {
                let to = output.start_of_row(y) + x * output.picture.channels;
                offsets.push((offset(convolution.corner(input, y, x)), offset(to)));
            }
        }
        Class {
            pixels: Pixels::new(offsets),
            taps: taps.collect(),
            run: columns.places.len() * inputs,
        }
    }
}

/// Number of pictures of `pixels` pixels per task of a thread. Affects only the run time, not the result.
pub(super) fn images_at_once(pixels: usize, count: usize, are_weights_many: bool) -> usize {
    let share = count.div_ceil(rayon::current_num_threads()).max(1);
    if are_weights_many {
        // Each group reads the weights from memory once, so groups are as large as possible.
        share
    } else {
        PIXELS_AT_ONCE.div_ceil(pixels).min(share)
    }
}
