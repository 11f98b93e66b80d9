//! Transforms of kernels, and of the gradients of kernels.

use rayon::prelude::*;

use super::transform;
use super::{POINTS, SIDE, slab};
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::simd::{Job, Spaced, Vector};

/// Side of a kernel, and its number of positions.
const KERNEL: usize = 3;
const TAPS: usize = KERNEL * KERNEL;

/// Transforms weights for `inputs` input channels. If `turned` is true, each kernel is rotated by 180°.
///
/// # Shapes
/// `weights`: `[panel, tap, input, PANEL]`. `into`: `[panel, point, input, PANEL]`, with one unused panel after the inputs of each point.
pub(super) fn to_points(
    machine: Machine,
    weights: &[f32],
    inputs: usize,
    turned: bool,
    into: &mut [f32],
) {
    let panels = into.par_chunks_mut(POINTS * slab(inputs, PANEL));
    let weights = weights.par_chunks(TAPS * inputs * PANEL);
    panels.zip(weights).for_each(|(into, weights)| {
        machine.run(Kernels {
            weights,
            width: inputs * PANEL,
            turned,
            into,
        });
    });
}

/// Computes the gradient of weights for `inputs` input channels, from the gradient of transformed weights.
///
/// # Shapes
/// `transformed`: `[point, panel, input, PANEL]`, with one unused panel after the inputs of each panel. `into`: `[panel, tap, input, PANEL]`.
pub(super) fn from_points(machine: Machine, transformed: &[f32], inputs: usize, into: &mut [f32]) {
    let panels = into.len() / (TAPS * inputs * PANEL);
    let gradients = into.par_chunks_mut(TAPS * inputs * PANEL);
    gradients.enumerate().for_each(|(panel, into)| {
        machine.run(KernelGradients {
            transformed: &transformed[panel * slab(inputs, PANEL)..],
            stride: panels * slab(inputs, PANEL),
            width: inputs * PANEL,
            into,
        });
    });
}

/// Task that transforms one panel of kernels.
struct Kernels<'a> {
    weights: &'a [f32],
    /// Number of values per kernel position.
    width: usize,
    turned: bool,
    into: &'a mut [f32],
}

impl Job for Kernels<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, proof: V::Proof) {
        let (width, slab) = (self.width, self.width + PANEL);
        for at in (0..width).step_by(V::LANES) {
            let mut half = [[V::zero(proof); KERNEL]; SIDE];
            for column in 0..KERNEL {
                let tap = if self.turned {
                    KERNEL - 1 - column
                } else {
                    column
                };
                let places = Spaced {
                    start: tap * width + at,
                    stride: KERNEL * width,
                    count: KERNEL,
                };
                let [first, middle, last] = places.load(proof, self.weights);
                let kernel = if self.turned {
                    [last, middle, first]
                } else {
                    [first, middle, last]
                };
                for (half, value) in half.iter_mut().zip(transform::kernel(proof, kernel)) {
                    half[column] = value;
                }
            }
            for (row, half) in half.into_iter().enumerate() {
                let points = Spaced {
                    start: row * SIDE * slab + at,
                    stride: slab,
                    count: SIDE,
                };
                points.store(transform::kernel(proof, half), self.into);
            }
        }
    }
}

/// Task that computes the gradient of one panel of kernels.
struct KernelGradients<'a> {
    /// Gradient of transformed weights, beginning with this panel at the first point.
    transformed: &'a [f32],
    /// Stride between points, in values.
    stride: usize,
    width: usize,
    into: &'a mut [f32],
}

impl Job for KernelGradients<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, proof: V::Proof) {
        for at in (0..self.width).step_by(V::LANES) {
            let mut half = [[V::zero(proof); SIDE]; KERNEL];
            for column in 0..SIDE {
                let points = Spaced {
                    start: column * self.stride + at,
                    stride: SIDE * self.stride,
                    count: SIDE,
                };
                let values = points.load(proof, self.transformed);
                let values = transform::kernel_gradient(proof, values);
                for (half, value) in half.iter_mut().zip(values) {
                    half[column] = value;
                }
            }
            for (row, half) in half.into_iter().enumerate() {
                let places = Spaced {
                    start: row * KERNEL * self.width + at,
                    stride: self.width,
                    count: KERNEL,
                };
                places.store(transform::kernel_gradient(proof, half), self.into);
            }
        }
    }
}
