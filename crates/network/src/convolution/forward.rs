//! Forward pass of a convolution, directly or by Winograd's algorithm.

use super::form::ConvolutionForm;
use super::source::Source;
use super::target::Target;
use super::weights::ConvolutionWeights;
use super::winograd;
use super::workspace::TileRooms;
use super::{Convolution, direct};
use crate::machine::Machine;
use crate::planes::Layout;

/// Forward pass, prepared for pictures of one memory layout.
#[derive(Clone, Debug)]
pub(crate) enum Forward {
    Direct(direct::Forward),
    Winograd(winograd::Forward),
}

impl Forward {
    /// Prepares the pass of `convolution` from pictures of layout `input` to pictures of layout `output`. Uses Winograd's algorithm if `form` selects it for
    /// these shapes.
    pub(crate) fn new(
        convolution: Convolution,
        input: Layout,
        output: Layout,
        form: ConvolutionForm,
    ) -> Forward {
        match form.is_winograd(convolution, output.picture) {
            true => Forward::Winograd(winograd::Forward::new(input, output)),
            false => Forward::Direct(direct::Forward::new(convolution, input, output)),
        }
    }

    /// Length of the transformed weights; 0 if the pass reads untransformed weights.
    pub(crate) fn transformed_len(&self) -> usize {
        match self {
            Forward::Direct(_) => 0,
            Forward::Winograd(pass) => pass.transformed_len(),
        }
    }

    /// Weights in the format that this pass reads: unchanged, or transformed and written to the start of `room`.
    pub(crate) fn weights<'a>(
        &self,
        machine: Machine,
        weights: &'a ConvolutionWeights,
        room: &'a mut [f32],
    ) -> &'a [f32] {
        match self {
            Forward::Direct(_) => weights.values(),
            Forward::Winograd(pass) => pass.transform(machine, weights.values(), room),
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
        match self {
            Forward::Direct(pass) => pass.run(machine, source, target, each, see, rooms),
            Forward::Winograd(pass) => pass.run(machine, source, target, each, see, rooms),
        }
    }
}
