//! The forward pass.

use rayon::prelude::*;

use super::border::{Reach, reaches};
use super::correlation::{Correlation, Tap, are_weights_many};
use crate::convolution::ending::Epilogue;
use crate::convolution::source::Source;
use crate::convolution::{Convolution, offset};
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::{Layout, Planes};
use crate::simd::Pixels;

/// Pixels of pictures that one thread takes at a time: enough to outweigh the weights that they meet.
const PIXELS_AT_ONCE: usize = 384;

/// A forward pass over pictures of one layout, ready to be run.
#[derive(Clone, Debug)]
pub(crate) struct Forward {
    classes: Vec<Class>,
    /// Pixels of all classes.
    pixels: usize,
    rows: usize,
}

/// Output pixels that read the same places of the kernel.
#[derive(Clone, Debug)]
struct Class {
    pixels: Pixels,
    taps: Vec<Tap>,
    run: usize,
}

impl Forward {
    /// The pass of `convolution` from pictures of layout `input` to those of layout `output`.
    pub(crate) fn new(convolution: Convolution, input: Layout, output: Layout) -> Forward {
        let picture = output.picture;
        let side = |positions, length| reaches(convolution, (positions, length), picture);
        let columns = side(picture.width, input.picture.width);
        let mut classes = Vec::new();
        for rows in side(picture.height, input.picture.height) {
            for columns in &columns {
                classes.push(Class::new(convolution, (input, output), (&rows, columns)));
            }
        }
        Forward {
            classes,
            pixels: picture.pixels(),
            rows: convolution.taps() * convolution.inputs,
        }
    }

    /// Runs it, into the first pictures of `output`; `each` of a picture sees its output while that is still in a cache.
    pub(crate) fn run<E: Send>(
        &self,
        machine: Machine,
        source: Source<'_>,
        (output, epilogue): (&mut Planes, Epilogue<'_>),
        (each, see): (&mut [E], impl Fn(&mut E, &[f32]) + Sync),
    ) {
        let count = source.count;
        let layout = output.layout();
        let (input_image, output_image) = (source.input.layout().len(), layout.len());
        let panels = layout.picture.channels / PANEL;
        let are_many = are_weights_many(self.rows, panels);
        let group = images_at_once(self.pixels, count, are_many);
        let inputs = source.pictures().par_chunks(group * input_image);
        let outputs = output.first_mut(count).par_chunks_mut(group * output_image);
        let groups = outputs.zip(inputs).zip(each.par_chunks_mut(group));
        groups
            .enumerate()
            .for_each(|(index, ((output, input), each))| {
                let first = index * group * output_image;
                let (start, finish) = epilogue.within(first..first + output.len());
                for class in &self.classes {
                    machine.run(Correlation {
                        pixels: &class.pixels,
                        images: output.len() / output_image,
                        input,
                        input_image,
                        taps: &class.taps,
                        run: class.run,
                        weights: source.weights,
                        rows: self.rows,
                        output: &mut *output,
                        output_image,
                        start,
                        finish,
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
        (input, output): (Layout, Layout),
        (rows, columns): (&Reach, &Reach),
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
