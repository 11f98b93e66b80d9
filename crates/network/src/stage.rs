//! Stages of a network that is being trained.

mod block;
mod plain;
mod stem;

pub(crate) use block::{Block, BlockSpace};
pub(crate) use plain::PlainSpace;
pub(crate) use stem::StemSpace;

use crate::architecture::StagePlan;
use crate::convolution::ConvolutionForm;
use crate::machine::Machine;
use crate::normalised_convolution::{Back, Normed};
use crate::planes::{Layout, Pictures, Planes};
use crate::scratch::Scratch;

/// Weights of a stage.
#[derive(Clone, Debug)]
pub(crate) enum Stage {
    Stem(Normed),
    Plain(Normed),
    Block(Box<Block>),
}

/// Activations and prepared passes of a stage in training.
#[derive(Debug)]
pub(crate) enum StageSpace {
    Stem(StemSpace),
    Plain(PlainSpace),
    Block(Box<BlockSpace>),
}

/// Position of a stage in its network.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Standing {
    /// Layout of the input pictures.
    pub(crate) input: Layout,
    /// Border of the output pictures, in pixels.
    pub(crate) border: usize,
    pub(crate) batch: usize,
    /// True if no earlier stage needs a gradient.
    pub(crate) is_first: bool,
    /// Algorithm of the convolutions.
    pub(crate) form: ConvolutionForm,
}

impl Stage {
    /// Stage for `plan` with `inputs` input channels. The slots (indices) of its parameter tensors begin at `slot`.
    pub(crate) fn new(plan: StagePlan, inputs: usize, slot: usize) -> Stage {
        let first = plan.first(inputs);
        match plan {
            StagePlan::Stem { .. } => Stage::Stem(Normed::new(first, slot)),
            StagePlan::Plain(_) => Stage::Plain(Normed::new(first, slot)),
            StagePlan::Block { .. } => Stage::Block(Box::new(Block::new(first, slot))),
        }
    }

    /// Convolutions in slot order, each with the suffixes of its tensor names: for convolution and normalisation.
    pub(crate) fn normed(&self) -> Vec<(&Normed, [&'static str; 2])> {
        match self {
            Stage::Stem(normed) => vec![(normed, ["conv1", "bn1"])],
            Stage::Plain(normed) => vec![(normed, ["0", "1"])],
            Stage::Block(block) => block.normed(),
        }
    }

    /// Mutable convolutions, in the order of [`normed`](Stage::normed).
    pub(crate) fn normed_mut(&mut self) -> Vec<&mut Normed> {
        match self {
            Stage::Stem(normed) | Stage::Plain(normed) => vec![normed],
            Stage::Block(block) => block.normed_mut(),
        }
    }

    /// Allocates training buffers.
    pub(crate) fn space(&self, standing: Standing) -> StageSpace {
        match self {
            Stage::Stem(normed) => StageSpace::Stem(StemSpace::new(normed, standing)),
            Stage::Plain(normed) => StageSpace::Plain(PlainSpace::new(normed, standing)),
            Stage::Block(block) => StageSpace::Block(Box::new(BlockSpace::new(block, standing))),
        }
    }

    /// Runs the stage on the first `count` pictures. Temporary buffers are taken from `scratch`.
    pub(crate) fn forward(
        &mut self,
        machine: Machine,
        space: &mut StageSpace,
        input: Pictures<'_>,
        scratch: &mut Scratch,
    ) {
        match (self, space) {
            (Stage::Stem(normed), StageSpace::Stem(space)) => {
                space.forward(normed, machine, input, scratch)
            }
            (Stage::Plain(normed), StageSpace::Plain(space)) => {
                space.forward(normed, machine, input, scratch)
            }
            (Stage::Block(block), StageSpace::Block(space)) => {
                space.forward(block, machine, input, scratch)
            }
            _ => unreachable!("a space is made by its stage"),
        }
    }

    /// Runs the backward pass. Returns the input gradient; `None` for a first stage that is a stem or plain.
    pub(crate) fn backward(
        &mut self,
        space: &mut StageSpace,
        input: &Planes,
        gradient: Planes,
        back: &mut Back<'_>,
    ) -> Option<Planes> {
        match (self, space) {
            (Stage::Stem(normed), StageSpace::Stem(space)) => {
                space.backward(normed, input, gradient, back);
                None
            }
            (Stage::Plain(normed), StageSpace::Plain(space)) => {
                space.backward(normed, input, gradient, back)
            }
            (Stage::Block(block), StageSpace::Block(space)) => {
                Some(space.backward(block, input, gradient, back))
            }
            _ => unreachable!("a space is made by its stage"),
        }
    }
}

impl StageSpace {
    /// Output pictures.
    pub(crate) fn output(&self) -> &Planes {
        match self {
            StageSpace::Stem(space) => &space.output,
            StageSpace::Plain(space) => &space.output,
            StageSpace::Block(space) => &space.output,
        }
    }

    /// Length of the longest transformed weights of any convolution.
    pub(crate) fn transformed_len(&self) -> usize {
        match self {
            StageSpace::Stem(space) => space.normed.transformed_len(),
            StageSpace::Plain(space) => space.normed.transformed_len(),
            StageSpace::Block(space) => space.transformed_len(),
        }
    }
}
