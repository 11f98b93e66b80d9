//! The forward pass, in the form that goes with its shape.

use super::ending::Epilogue;
use super::form::ConvolutionForm;
use super::source::Source;
use super::weights::ConvolutionWeights;
use super::winograd;
use super::workspace::TileRooms;
use super::{Convolution, direct};
use crate::machine::Machine;
use crate::planes::{Layout, Planes};

/// A forward pass over pictures of one layout, ready to be run.
#[derive(Clone, Debug)]
pub(crate) enum Forward {
    Direct(direct::Forward),
    Winograd(winograd::Forward),
}

impl Forward {
    /// The pass of `convolution` from pictures of layout `input` to those of layout `output`; Winograd's where `form` says so and it
    /// multiplies less.
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

    /// Numbers that transformed weights take; none where they are read as they are.
    pub(crate) fn transformed_len(&self) -> usize {
        match self {
            Forward::Direct(_) => 0,
            Forward::Winograd(pass) => pass.transformed_len(),
        }
    }

    /// The weights as this pass reads them: as they are, or transformed into the first numbers of `room`.
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

    /// Runs it, into the first pictures of `output`; `each` of a picture sees its output while that is still in a cache.
    pub(crate) fn run<E: Send>(
        &self,
        machine: Machine,
        source: Source<'_>,
        (output, epilogue): (&mut Planes, Epilogue<'_>),
        each: (&mut [E], impl Fn(&mut E, &[f32]) + Sync),
        rooms: &TileRooms,
    ) {
        match self {
            Forward::Direct(pass) => {
                pass.run(machine, source, (output, epilogue), each, rooms);
            }
            Forward::Winograd(pass) => {
                pass.run(machine, source, (output, epilogue), each, rooms);
            }
        }
    }
}
