//! The parts that a network passes one after the other, in training.

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
use crate::planes::{Layout, Planes};
use crate::scratch::Scratch;

/// The weights of a part.
#[derive(Clone, Debug)]
pub(crate) enum Stage {
    Stem(Normed),
    Plain(Normed),
    Block(Box<Block>),
}

/// What training keeps of a part between the passes.
#[derive(Debug)]
pub(crate) enum StageSpace {
    Stem(StemSpace),
    Plain(PlainSpace),
    Block(Box<BlockSpace>),
}

/// How a part stands in its network.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Standing {
    /// Pictures that it reads.
    pub(crate) input: Layout,
    /// Zeros around the pictures that it gives.
    pub(crate) border: usize,
    pub(crate) batch: usize,
    /// Whether no part before it needs a gradient.
    pub(crate) is_first: bool,
    /// The form of its convolutions.
    pub(crate) form: ConvolutionForm,
}

impl Stage {
    /// The part of `plan` that reads `inputs` channels; its slots begin at `slot`.
    pub(crate) fn new(plan: StagePlan, inputs: usize, slot: usize) -> Stage {
        let first = plan.first(inputs);
        match plan {
            StagePlan::Stem { .. } => Stage::Stem(Normed::new(first, slot)),
            StagePlan::Plain(_) => Stage::Plain(Normed::new(first, slot)),
            StagePlan::Block { .. } => Stage::Block(Box::new(Block::new(first, slot))),
        }
    }

    /// Its convolutions, with what their names and those of their normalisation end in, in the order of their slots.
    pub(crate) fn normed(&self) -> Vec<(&Normed, [&'static str; 2])> {
        match self {
            Stage::Stem(normed) => vec![(normed, ["conv1", "bn1"])],
            Stage::Plain(normed) => vec![(normed, ["0", "1"])],
            Stage::Block(block) => block.normed(),
        }
    }

    /// As [`normed`](Stage::normed), to be changed.
    pub(crate) fn normed_mut(&mut self) -> Vec<&mut Normed> {
        match self {
            Stage::Stem(normed) | Stage::Plain(normed) => vec![normed],
            Stage::Block(block) => block.normed_mut(),
        }
    }

    /// Room to train it in.
    pub(crate) fn space(&self, standing: Standing) -> StageSpace {
        match self {
            Stage::Stem(normed) => StageSpace::Stem(StemSpace::new(normed, standing)),
            Stage::Plain(normed) => StageSpace::Plain(PlainSpace::new(normed, standing)),
            Stage::Block(block) => StageSpace::Block(Box::new(BlockSpace::new(block, standing))),
        }
    }

    /// Passes the first `count` pictures; `scratch` lends room on the way.
    pub(crate) fn forward(
        &mut self,
        machine: Machine,
        space: &mut StageSpace,
        input: (&Planes, usize),
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

    /// Passes the gradient of the output on; gives that of the input, where something stands before it.
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
    /// What the part gave.
    pub(crate) fn output(&self) -> &Planes {
        match self {
            StageSpace::Stem(space) => &space.output,
            StageSpace::Plain(space) => &space.output,
            StageSpace::Block(space) => &space.output,
        }
    }

    /// Numbers that the weights of one convolution take at most when a pass transforms them.
    pub(crate) fn transformed_len(&self) -> usize {
        match self {
            StageSpace::Stem(space) => space.normed.transformed_len(),
            StageSpace::Plain(space) => space.normed.transformed_len(),
            StageSpace::Block(space) => space.transformed_len(),
        }
    }
}
