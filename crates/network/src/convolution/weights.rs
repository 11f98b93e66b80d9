//! Weights of a convolution, in packed and in plain (PyTorch's) order.

use rayon::prelude::*;

use super::Convolution;
use crate::machine::Machine;
use crate::panel::{Aligned, PANEL};
use crate::simd::{Job, Vector};

/// The weights of a convolution.
///
/// # Shapes
/// `[outputs / PANEL, kernel row, kernel column, inputs, PANEL]`. The weight gradient has the same shape.
#[derive(Clone, Debug)]
pub(crate) struct ConvolutionWeights {
    convolution: Convolution,
    values: Aligned,
}

impl ConvolutionWeights {
    /// Weights that are all zero.
    pub(crate) fn zeros(convolution: Convolution) -> ConvolutionWeights {
        let length = convolution.outputs * convolution.inputs * convolution.taps();
        let values = Aligned::zeros(length);
        ConvolutionWeights {
            convolution,
            values,
        }
    }

    pub(crate) fn convolution(&self) -> Convolution {
        self.convolution
    }

    pub(crate) fn values(&self) -> &[f32] {
        &self.values
    }

    pub(crate) fn values_mut(&mut self) -> &mut [f32] {
        &mut self.values
    }

    /// Copies the weights to the order `[outputs, inputs, kernel row, kernel column]`.
    pub(crate) fn to_plain(&self) -> Vec<f32> {
        plain(self.convolution, &self.values)
    }

    /// Sets the weights from values in the order `[outputs, inputs, kernel row, kernel column]`.
    pub(crate) fn set_plain(&mut self, plain: &[f32]) {
        for (place, at) in places(self.convolution).enumerate() {
            self.values[at] = plain[place];
        }
    }

    /// Writes the weights with inputs and outputs exchanged, for the input gradient, in the shape `[inputs / PANEL, taps, outputs, PANEL]`.
    pub(crate) fn exchange(&self, machine: Machine, into: &mut [f32]) {
        let Convolution {
            inputs, outputs, ..
        } = self.convolution;
        let taps = self.convolution.taps();
        let panels = into.par_chunks_mut(PANELS_AT_ONCE * taps * outputs * PANEL);
        panels.enumerate().for_each(|(group, into)| {
            machine.run(Exchange {
                weights: &self.values,
                taps,
                inputs,
                outputs,
                first_input: group * PANELS_AT_ONCE * PANEL,
                into,
            });
        });
    }
}

/// Converts a gradient or weights of `convolution` to the order `[outputs, inputs, kernel row, kernel column]`.
pub(crate) fn plain(convolution: Convolution, values: &[f32]) -> Vec<f32> {
    places(convolution).map(|at| values[at]).collect()
}

/// Offsets of the packed weights, in the order `[outputs, inputs, kernel row, kernel column]`.
fn places(convolution: Convolution) -> impl Iterator<Item = usize> {
    let (inputs, taps) = (convolution.inputs, convolution.taps());
    (0..convolution.outputs).flat_map(move |output| {
        (0..inputs).flat_map(move |input| {
            (0..taps).map(move |tap| {
                (((output / PANEL) * taps + tap) * inputs + input) * PANEL + output % PANEL
            })
        })
    })
}

/// Number of input panels written at once, whose source values are adjacent in memory.
const PANELS_AT_ONCE: usize = 2;

/// Task that exchanges inputs and outputs of the weights, for some panels of input channels.
struct Exchange<'a> {
    weights: &'a [f32],
    taps: usize,
    inputs: usize,
    outputs: usize,
    first_input: usize,
    /// Exchanged weights, shape `[panel of inputs, taps, outputs, PANEL]`.
    into: &'a mut [f32],
}

impl Job for Exchange<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self, _proof: V::Proof) {
        let panels = self.outputs / PANEL;
        let blocks = self.taps * panels;
        // Square blocks of constant size, which the compiler transposes with vector instructions.
        let (into, _) = self
            .into
            .as_chunks_mut::<PANEL>()
            .0
            .as_chunks_mut::<PANEL>();
        let at_once = into.len() / blocks;
        for block in 0..blocks {
            let (tap, panel) = (block / panels, block % panels);
            let from = ((panel * self.taps + tap) * self.inputs + self.first_input) * PANEL;
            let from = &self.weights[from..][..at_once * PANEL * PANEL];
            let (from, _) = from.as_chunks::<PANEL>().0.as_chunks::<PANEL>();
            for (input, from) in from.iter().enumerate() {
                let into = &mut into[input * blocks + block];
                for (place, from) in from.iter().enumerate() {
                    for lane in 0..PANEL {
                        into[lane][place] = from[lane];
                    }
                }
            }
        }
    }
}
