//! Residual blocks: two convolutions and a shortcut.

use super::Standing;
use crate::batch_norm::{Gate, Shortcut, apply};
use crate::convolution::{Convolution, GradientTarget, Onto};
use crate::machine::Machine;
use crate::normalised_convolution::{Back, Normed, NormedSpace};
use crate::planes::{Layout, Pictures, Planes};
use crate::scratch::Scratch;

/// Weights of a block.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub(crate) first: Normed,
    pub(crate) second: Normed,
    /// Convolution of the shortcut; `None` if the pictures do not change their shape.
    pub(crate) shortcut: Option<Normed>,
}

/// Activations and prepared passes of a block in training.
#[derive(Debug)]
pub(crate) struct BlockSpace {
    first: NormedSpace,
    second: NormedSpace,
    shortcut: Option<NormedSpace>,
    pub(crate) output: Planes,
    /// Layout of the input of the second convolution.
    middle: Layout,
    /// Layout of the input gradient.
    input: Layout,
}

impl Block {
    /// Block whose first convolution is `first`. The slots (indices) of its parameter tensors begin at `slot`.
    pub(super) fn new(first: Convolution, slot: usize) -> Block {
        let Convolution {
            inputs,
            outputs,
            stride,
            ..
        } = first;
        let second = Convolution {
            inputs: outputs,
            outputs,
            kernel: 3,
            stride: 1,
        };
        let past = Convolution {
            inputs,
            outputs,
            kernel: 1,
            stride,
        };
        let changes = stride != 1 || inputs != outputs;
        Block {
            first: Normed::new(first, slot),
            second: Normed::new(second, slot + Normed::SLOTS),
            shortcut: changes.then(|| Normed::new(past, slot + 2 * Normed::SLOTS)),
        }
    }

    pub(super) fn normed(&self) -> Vec<(&Normed, [&'static str; 2])> {
        let mut normed = vec![
            (&self.first, ["conv1", "bn1"]),
            (&self.second, ["conv2", "bn2"]),
        ];
        let past = self.shortcut.as_ref();
        normed.extend(past.map(|past| (past, ["downsample.0", "downsample.1"])));
        normed
    }

    pub(super) fn normed_mut(&mut self) -> Vec<&mut Normed> {
        let both = [&mut self.first, &mut self.second];
        both.into_iter().chain(self.shortcut.as_mut()).collect()
    }
}

impl BlockSpace {
    pub(super) fn new(block: &Block, standing: Standing) -> BlockSpace {
        let Standing {
            input,
            border,
            batch,
            form,
            ..
        } = standing;
        let picture = block.first.convolution().output(input.picture);
        let middle = Layout { picture, border: 1 };
        let past = block.shortcut.as_ref().map(Normed::convolution);
        let space = |convolution, input| NormedSpace::new(convolution, form, input, batch, true);
        BlockSpace {
            first: space(block.first.convolution(), input),
            second: space(block.second.convolution(), middle),
            shortcut: past.map(|past| space(past, input)),
            output: Planes::zeros(picture, border, batch),
            middle,
            input: input.bare(),
        }
    }

    /// Length of the longest transformed weights of any convolution.
    pub(super) fn transformed_len(&self) -> usize {
        let past = self.shortcut.as_ref();
        let past = past.map_or(0, NormedSpace::transformed_len);
        let both = self.first.transformed_len();
        both.max(self.second.transformed_len()).max(past)
    }

    /// Normalised output of the first convolution after ReLU. The output is not stored, because computing it in both passes takes
    /// only a hundredth of the convolution's time.
    fn middle(&self, machine: Machine, count: usize, scratch: &mut Scratch) -> Planes {
        let raw = &self.first.raw;
        let mut middle = scratch.take(self.middle, count);
        let nothing = Shortcut::Nothing;
        apply(
            machine,
            raw,
            count,
            &self.first.moments,
            nothing,
            &mut middle,
        );
        middle
    }

    pub(super) fn forward(
        &mut self,
        block: &mut Block,
        machine: Machine,
        input: Pictures<'_>,
        scratch: &mut Scratch,
    ) {
        let count = input.count;
        let first = &mut self.first;
        block.first.forward(machine, first, input, scratch);
        let middle = self.middle(machine, count, scratch);
        let BlockSpace {
            second,
            shortcut,
            output,
            ..
        } = self;
        let normed = &mut block.second;
        let planes = &middle;
        let pictures = Pictures { planes, count };
        normed.forward(machine, second, pictures, scratch);
        scratch.put(middle);
        let past = match (&mut block.shortcut, shortcut) {
            (Some(normed), Some(space)) => {
                normed.forward(machine, space, input, scratch);
                Shortcut::Normalised(&space.raw, &space.moments)
            }
            _ => Shortcut::Identity(input.planes),
        };
        apply(machine, &second.raw, count, &second.moments, past, output);
    }

    /// Runs the backward pass. Masks `gradient` in place. If the shortcut is the input itself, `gradient` contains the input gradient afterwards.
    pub(super) fn backward(
        &mut self,
        block: &mut Block,
        input: &Planes,
        mut gradient: Planes,
        back: &mut Back<'_>,
    ) -> Planes {
        let cut = Gate::Output(&self.output);
        let raw_gradient = block
            .second
            .norm_backward(&mut self.second, cut, &mut gradient, back);
        let middle = self.middle(back.machine, back.count, back.scratch);
        let mut inner = back.scratch.take(self.middle.bare(), back.count);
        let into = Some(GradientTarget::new(&mut inner, Onto::Nothing));
        block
            .second
            .backward(&self.second, &middle, &raw_gradient, into, back);
        back.scratch.put(middle);
        back.scratch.put(raw_gradient);

        let cut = Gate::Normalised;
        let raw_gradient = block
            .first
            .norm_backward(&mut self.first, cut, &mut inner, back);
        back.scratch.put(inner);
        match (&mut block.shortcut, &mut self.shortcut) {
            (Some(past), Some(space)) => {
                let mut passed = back.scratch.take(self.input, back.count);
                let into = Some(GradientTarget::new(&mut passed, Onto::Nothing));
                block
                    .first
                    .backward(&self.first, input, &raw_gradient, into, back);
                back.scratch.put(raw_gradient);
                let past_gradient = past.norm_backward(space, Gate::Open, &mut gradient, back);
                let into = Some(GradientTarget::new(&mut passed, Onto::Sum));
                past.backward(space, input, &past_gradient, into, back);
                back.scratch.put(past_gradient);
                back.scratch.put(gradient);
                passed
            }
            _ => {
                let into = Some(GradientTarget::new(&mut gradient, Onto::Sum));
                block
                    .first
                    .backward(&self.first, input, &raw_gradient, into, back);
                back.scratch.put(raw_gradient);
                gradient
            }
        }
    }
}
