//! Convolution with batch normalisation, the building block of every stage.

use crate::batch_norm::{
    BatchNorm, ChannelSums, Gate, GradientSums, Moments, gradient_sums, input_gradient,
};
use crate::convolution::{
    Convolution, ConvolutionForm, ConvolutionWeights, Epilogue, Forward, GradientTarget,
    InputGradient, Rooms, Source, Target, WeightGradient,
};
use crate::machine::Machine;
use crate::panel::{Aligned, PANEL};
use crate::planes::{Layout, Pictures, Planes};
use crate::scratch::Scratch;
use crate::update::Update;
use taceva_core::single;

/// A convolution and its normalisation.
#[derive(Clone, Debug)]
pub(crate) struct Normed {
    pub(crate) weights: ConvolutionWeights,
    pub(crate) norm: BatchNorm,
    /// Index (slot) of the weights among the parameter tensors of a network. Gain and bias have the following two slots.
    pub(crate) slot: usize,
}

/// Context of a backward pass.
pub(crate) struct Back<'a> {
    pub(crate) machine: Machine,
    /// Number of pictures.
    pub(crate) count: usize,
    pub(crate) scratch: &'a mut Scratch,
    pub(crate) update: &'a mut dyn Update,
}

/// Activations and prepared passes of a convolution in training.
#[derive(Debug)]
pub(crate) struct NormedSpace {
    /// Output of the convolution, before normalisation.
    pub(crate) raw: Planes,
    pub(crate) moments: Moments,
    pub(crate) sums: Vec<ChannelSums>,
    /// Memory layout of the output gradient, with a border if the input-gradient pass reads the gradient.
    gradient: Layout,
    forward: Forward,
    weight_gradient: WeightGradient,
    /// Input-gradient pass; `None` if the input gradient is not needed.
    input_gradient: Option<InputGradient>,
}

impl Normed {
    /// Number of parameter tensors (slots): weights, gain and bias.
    pub(crate) const SLOTS: usize = 3;

    pub(crate) fn new(convolution: Convolution, slot: usize) -> Normed {
        Normed {
            weights: ConvolutionWeights::zeros(convolution),
            norm: BatchNorm::new(convolution.outputs),
            slot,
        }
    }

    pub(crate) fn convolution(&self) -> Convolution {
        self.weights.convolution()
    }

    /// Convolves the first `count` pictures, and computes the moments of the result.
    pub(crate) fn forward(
        &mut self,
        machine: Machine,
        space: &mut NormedSpace,
        input: Pictures<'_>,
        scratch: &mut Scratch,
    ) {
        let count = input.count;
        let room = &mut scratch.transformed;
        let source = Source {
            weights: space.forward.weights(machine, &self.weights, room),
            input: input.planes,
            first: 0,
            count,
        };
        let measure = |sums: &mut ChannelSums, raw: &[f32]| sums.measure(machine, raw);
        let each = &mut space.sums[..count];
        let target = Target {
            pictures: &mut space.raw,
            epilogue: Epilogue::Raw,
        };
        space
            .forward
            .run(machine, source, target, each, measure, &scratch.tiles);
        let samples = count * space.raw.layout().picture.pixels();
        self.norm
            .update(&space.sums[..count], samples, &mut space.moments);
    }

    /// Calls `update` with the gradients of gain and bias.
    pub(crate) fn update_norm(&mut self, sums: &GradientSums, update: &mut dyn Update) {
        update.update(self.slot + 1, &mut self.norm.gain, &sums.gain);
        update.update(self.slot + 2, &mut self.norm.bias, &sums.bias);
    }

    /// Computes the gradient of the convolution's output from the gradient of the normalisation's output. With `Gate::Output`, sets masked values of the
    /// normalisation's gradient to zero. Calls `back.update` with the gradients of gain and bias.
    pub(crate) fn norm_backward(
        &mut self,
        space: &mut NormedSpace,
        gate: Gate<'_>,
        gradient: &mut Planes,
        back: &mut Back<'_>,
    ) -> Planes {
        let machine = back.machine;
        let sums = gradient_sums(
            machine,
            &space.raw,
            back.count,
            &space.moments,
            gate,
            gradient,
            &mut space.sums,
        );
        let mut into = back.scratch.take(space.gradient, back.count);
        input_gradient(
            machine,
            Pictures {
                planes: &space.raw,
                count: back.count,
            },
            &space.moments,
            &sums,
            gate,
            gradient,
            &mut into,
        );
        self.update_norm(&sums, back.update);
        into
    }

    /// Writes the input gradient if `into` is given. Calls `back.update` with the weight gradient.
    pub(crate) fn backward(
        &mut self,
        space: &NormedSpace,
        input: &Planes,
        gradient: &Planes,
        into: Option<GradientTarget<'_>>,
        back: &mut Back<'_>,
    ) {
        let Back {
            machine,
            count,
            scratch,
            update,
        } = back;
        let Scratch {
            weights,
            transformed,
            tiles,
            ..
        } = &mut **scratch;
        let room = &mut weights[..self.weights.values().len()];
        if let (Some(pass), Some(into)) = (&space.input_gradient, into) {
            let pictures = Pictures {
                planes: gradient,
                count: *count,
            };
            let rooms = Rooms { transformed, tiles };
            pass.run(*machine, &self.weights, room, pictures, into, rooms);
        }
        let rooms = Rooms { transformed, tiles };
        let pass = &space.weight_gradient;
        pass.run(*machine, input, gradient, *count, room, rooms);
        update.update(self.slot, self.weights.values_mut(), room);
    }

    /// Folds the running moments into the convolution. Returns the scaled weights and the bias.
    pub(crate) fn fold(&self) -> (ConvolutionWeights, Aligned) {
        let mut weights = self.weights.clone();
        let channels = self.convolution().outputs;
        let rows = weights.values().len() / channels;
        let mut bias = Aligned::zeros(channels);
        for channel in 0..channels {
            let (scale, shift) = self.norm.frozen(channel);
            bias[channel] = single(shift);
            let panel = &mut weights.values_mut()[channel / PANEL * rows * PANEL..][..rows * PANEL];
            for weight in panel[channel % PANEL..].iter_mut().step_by(PANEL) {
                *weight = single(f64::from(*weight) * scale);
            }
        }
        (weights, bias)
    }
}

impl NormedSpace {
    /// Allocates buffers for `batch` pictures of layout `input`.
    pub(crate) fn new(
        convolution: Convolution,
        form: ConvolutionForm,
        input: Layout,
        batch: usize,
        asks_for_input_gradient: bool,
    ) -> NormedSpace {
        let picture = convolution.output(input.picture);
        let raw = Planes::zeros(picture, 0, batch);
        let border = if asks_for_input_gradient {
            convolution.padding().max(1)
        } else {
            0
        };
        let gradient = Layout { picture, border };
        NormedSpace {
            forward: Forward::new(convolution, input, raw.layout(), form),
            weight_gradient: WeightGradient::new(convolution, input, gradient, form),
            input_gradient: asks_for_input_gradient
                .then(|| InputGradient::new(convolution, gradient, input.bare(), form)),
            gradient,
            moments: Moments::zeros(picture.channels),
            sums: vec![ChannelSums::zeros(picture.channels); batch],
            raw,
        }
    }

    /// Length of the longest transformed weights of any pass.
    pub(crate) fn transformed_len(&self) -> usize {
        let back = self.input_gradient.as_ref();
        self.forward
            .transformed_len()
            .max(self.weight_gradient.transformed_len())
            .max(back.map_or(0, InputGradient::transformed_len))
    }
}
