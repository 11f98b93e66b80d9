//! Weight gradient of the direct algorithm. Each row belongs to one input value of the kernel, and is a sum over pixels.

use rayon::prelude::*;

use super::border::{self, Reach};
use crate::constant::with_constant;
use crate::convolution::{Convolution, offset};
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::{Layout, Planes};
use crate::simd::{Job, Pixels, Tile, Vector};

/// Size of the output gradient processed at once, in bytes. This part remains in the second-level cache.
const GRADIENT_AT_ONCE: usize = 400 << 10;

/// Number of rows of weights in one task.
const ROWS_AT_ONCE: usize = 48;

/// Weight-gradient pass, prepared for pictures of one memory layout.
#[derive(Clone, Debug)]
pub(crate) struct WeightGradient {
    /// One table of all pixels for each kernel row. If the border is skipped, one table for each kernel position, with the pixels that read it.
    pixels: Vec<Pixels>,
    blocks: Vec<Block>,
    rows: usize,
}

/// Consecutive rows of weights, for consecutive input values.
#[derive(Clone, Copy, Debug)]
struct Block {
    /// Index into `WeightGradient::pixels`.
    pixels: usize,
    /// Offset of the first row's input value from the first value that the kernel reads.
    offset: usize,
    rows: usize,
}

impl WeightGradient {
    /// Prepares the pass for inputs of layout `input` and output gradients of layout `output`.
    pub(crate) fn new(convolution: Convolution, input: Layout, output: Layout) -> WeightGradient {
        let Convolution { inputs, kernel, .. } = convolution;
        let picture = output.picture;
        // A kernel row is processed as a whole over all pixels, or each kernel position over its own pixels.
        let is_left_out = border::is_left_out(picture);
        let run = if is_left_out { inputs } else { kernel * inputs };
        let side = |positions, length| match is_left_out {
            true => border::reaches(convolution, positions, length),
            false => vec![Reach::all(convolution, positions)],
        };
        let rows = side(picture.height, input.picture.height);
        let columns = side(picture.width, input.picture.width);
        let (mut pixels, mut blocks) = (Vec::new(), Vec::new());
        for kernel_row in 0..kernel {
            for start in (0..kernel * inputs).step_by(run) {
                let mut offsets = Vec::new();
                for y in border::positions(&rows, kernel_row) {
                    for x in border::positions(&columns, start / inputs) {
                        let to = output.start_of_row(y) + x * picture.channels;
                        offsets.push((offset(convolution.corner(input, y, x)), offset(to)));
                    }
                }
                for first in (start..start + run).step_by(ROWS_AT_ONCE) {
                    blocks.push(Block {
                        pixels: pixels.len(),
                        offset: kernel_row * input.row() + first,
                        rows: ROWS_AT_ONCE.min(start + run - first),
                    });
                }
                pixels.push(Pixels::new(offsets));
            }
        }
        WeightGradient {
            pixels,
            blocks,
            rows: kernel * kernel * inputs,
        }
    }

    /// Runs the pass on the first `count` pictures.
    ///
    /// # Shapes
    /// `into`: same shape as the weights.
    pub(crate) fn run(
        &self,
        machine: Machine,
        input: &Planes,
        gradient: &Planes,
        count: usize,
        into: &mut [f32],
    ) {
        let mut tasks = self.tasks(into);
        let share = tasks.len().div_ceil(rayon::current_num_threads()).max(1);
        let (input_image, gradient_image) = (input.layout().len(), gradient.layout().len());
        let images = (GRADIENT_AT_ONCE / (gradient_image * size_of::<f32>())).clamp(1, count);
        tasks.par_chunks_mut(share).for_each(|tasks| {
            let inputs = input.first(count).chunks(images * input_image);
            let gradients = gradient.first(count).chunks(images * gradient_image);
            for (group, (input, gradient)) in inputs.zip(gradients).enumerate() {
                for task in &mut *tasks {
                    machine.run(Sums {
                        pixels: &self.pixels[task.block.pixels],
                        input,
                        input_image,
                        gradient,
                        gradient_image,
                        is_first: group == 0,
                        task,
                    });
                }
            }
        });
    }

    /// Divides the gradient buffer into tasks. A task is a block of rows of up to four panels.
    fn tasks<'a>(&self, into: &'a mut [f32]) -> Vec<Task<'a>> {
        let mut tasks = Vec::new();
        for (group, panels) in into.chunks_mut(4 * self.rows * PANEL).enumerate() {
            let first = tasks.len();
            tasks.extend(self.blocks.iter().map(|&block| Task {
                block,
                channel: group * 4 * PANEL,
                panels: Vec::with_capacity(4),
            }));
            for mut panel in panels.chunks_mut(self.rows * PANEL) {
                for task in &mut tasks[first..] {
                    let (rows, rest) = panel.split_at_mut(task.block.rows * PANEL);
                    task.panels.push(rows);
                    panel = rest;
                }
            }
        }
        tasks
    }
}

/// One block of rows of up to four panels.
struct Task<'a> {
    block: Block,
    /// Index of the first channel of the first panel.
    channel: usize,
    /// Gradient rows of each panel, shape `[block rows, PANEL]`.
    panels: Vec<&'a mut [f32]>,
}

/// Sums of one task over a group of pictures.
struct Sums<'a, 'b> {
    pixels: &'a Pixels,
    input: &'a [f32],
    input_image: usize,
    gradient: &'a [f32],
    gradient_image: usize,
    /// True if sums begin at zero, false if they continue from the values in `task`.
    is_first: bool,
    task: &'a mut Task<'b>,
}

impl Job for Sums<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(mut self, proof: V::Proof) {
        let mut panel = 0;
        while panel < self.task.panels.len() {
            let width = (self.task.panels.len() - panel).min(V::PANELS);
            with_constant!(
                VECTORS = width * PANEL / V::LANES, one of [1, 2, 3, 4] =>
                self.panels::<V, VECTORS>(proof, panel)
            );
            panel += width;
        }
    }
}

impl Sums<'_, '_> {
    #[inline(always)]
    fn panels<V: Vector, const VECTORS: usize>(&mut self, proof: V::Proof, panel: usize) {
        let rows = self.task.block.rows;
        let mut first = 0;
        while first < rows {
            let count = (rows - first).min(V::ROWS);
            with_constant!(
                ROWS = count, one of [1, 2, 3, 4, 5, 6] =>
                self.tile::<V, ROWS, VECTORS>(proof, panel, first)
            );
            first += count;
        }
    }

    #[inline(always)]
    fn tile<V: Vector, const ROWS: usize, const VECTORS: usize>(
        &mut self,
        proof: V::Proof,
        panel: usize,
        first: usize,
    ) {
        let panels = &mut self.task.panels[panel..];
        let mut tile: Tile<V, ROWS, VECTORS> = Tile::zero(proof);
        if !self.is_first {
            for row in 0..ROWS {
                tile.load_row(row, panels, (first + row) * PANEL);
            }
        }
        let start = self.task.block.offset + first;
        let channel = self.task.channel + panel * PANEL;
        let inputs = self.input.chunks_exact(self.input_image);
        let gradients = self.gradient.chunks_exact(self.gradient_image);
        for (input, gradient) in inputs.zip(gradients) {
            tile.add_pixels(self.pixels, &input[start..], &gradient[channel..]);
        }
        for row in 0..ROWS {
            tile.store_row(row, panels, (first + row) * PANEL);
        }
    }
}
