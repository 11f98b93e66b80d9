//! Plain stages: a convolution, its normalisation and ReLU.

use super::Standing;
use crate::batch_norm::{Gate, Shortcut, apply};
use crate::convolution::{GradientTarget, Onto};
use crate::machine::Machine;
use crate::normalised_convolution::{Back, Normed, NormedSpace};
use crate::planes::{Layout, Pictures, Planes};
use crate::scratch::Scratch;

/// Activations and prepared passes of a plain stage in training.
#[derive(Debug)]
pub(crate) struct PlainSpace {
    pub(super) normed: NormedSpace,
    pub(crate) output: Planes,
    /// Layout of the input gradient; `None` if no earlier stage needs a gradient.
    input: Option<Layout>,
}

impl PlainSpace {
    pub(super) fn new(normed: &Normed, standing: Standing) -> PlainSpace {
        let Standing {
            input,
            border,
            batch,
            is_first,
            form,
        } = standing;
        let convolution = normed.convolution();
        PlainSpace {
            normed: NormedSpace::new(convolution, form, input, batch, !is_first),
            output: Planes::zeros(convolution.output(input.picture), border, batch),
            input: (!is_first).then_some(input.bare()),
        }
    }

    pub(super) fn forward(
        &mut self,
        normed: &mut Normed,
        machine: Machine,
        input: Pictures<'_>,
        scratch: &mut Scratch,
    ) {
        let space = &mut self.normed;
        normed.forward(machine, space, input, scratch);
        apply(
            machine,
            &space.raw,
            input.count,
            &space.moments,
            Shortcut::Nothing,
            &mut self.output,
        );
    }

    pub(super) fn backward(
        &mut self,
        normed: &mut Normed,
        input: &Planes,
        mut gradient: Planes,
        back: &mut Back<'_>,
    ) -> Option<Planes> {
        let space = &mut self.normed;
        let raw_gradient = normed.norm_backward(space, Gate::Normalised, &mut gradient, back);
        back.scratch.put(gradient);
        let mut passed = self.input.map(|input| back.scratch.take(input, back.count));
        let into = passed
            .as_mut()
            .map(|passed| GradientTarget::new(passed, Onto::Nothing));
        normed.backward(space, input, &raw_gradient, into, back);
        back.scratch.put(raw_gradient);
        passed
    }
}
