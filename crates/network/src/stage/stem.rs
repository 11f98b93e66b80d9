//! First stage of a residual network: convolution, normalisation, ReLU and pooling.

use super::Standing;
use crate::machine::Machine;
use crate::max_pool::{self, Pooled};
use crate::normalised_convolution::{Back, Normed, NormedSpace};
use crate::planes::{Pictures, Planes};
use crate::scratch::Scratch;

/// Activations and prepared passes of a stem in training.
#[derive(Debug)]
pub(crate) struct StemSpace {
    pub(super) normed: NormedSpace,
    pub(crate) output: Planes,
    /// Position of each output's source pixel in the pooling window of that output.
    choices: Vec<u8>,
}

impl StemSpace {
    pub(super) fn new(normed: &Normed, standing: Standing) -> StemSpace {
        let Standing {
            input,
            border,
            batch,
            form,
            ..
        } = standing;
        let normed = NormedSpace::new(normed.convolution(), form, input, batch, false);
        let picture = max_pool::output(normed.raw.layout().picture);
        StemSpace {
            normed,
            output: Planes::zeros(picture, border, batch),
            choices: vec![0; picture.len() * batch],
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
        max_pool::pool_normalised(
            machine,
            &space.raw,
            input.count,
            &space.moments,
            &mut self.output,
            &mut self.choices,
        );
    }

    pub(super) fn backward(
        &mut self,
        normed: &mut Normed,
        input: &Planes,
        mut gradient: Planes,
        back: &mut Back<'_>,
    ) {
        let space = &mut self.normed;
        let pooled = Pooled {
            output: &self.output,
            choices: &self.choices,
            count: back.count,
        };
        let machine = back.machine;
        let (moments, room) = (&space.moments, &mut space.sums);
        let raw = &mut space.raw;
        let sums = max_pool::gradient_sums(machine, raw, pooled, moments, &mut gradient, room);
        max_pool::input_gradient(machine, raw, pooled, moments, &sums, &gradient);
        back.scratch.put(gradient);
        normed.update_norm(&sums, back.update);
        normed.backward(space, input, &space.raw, None, back);
    }
}
