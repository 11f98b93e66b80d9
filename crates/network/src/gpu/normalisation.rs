//! Batch normalisation and its gradient, with few GPU kernels.

use crate::Network;
use burn_autodiff::Autodiff;
use burn_autodiff::checkpoint::base::Checkpointer;
use burn_autodiff::checkpoint::strategy::NoCheckpointing;
use burn_autodiff::grads::Gradients;
use burn_autodiff::ops::{Backward, Ops, OpsKind};
use burn_tensor::backend::Backend;
use burn_tensor::{Tensor, TensorPrimitive};

/// State that the backward pass needs.
#[derive(Clone, Debug)]
struct Kept<B: Backend> {
    /// Normalised pictures: mean 0 and variance 1 in each channel.
    normalised: Tensor<B, 4>,
    /// Derivative of the output by the input at constant moments: gain / √(variance + ε), shape `[1, 1, 1, channels]`.
    scale: Tensor<B, 4>,
}

/// Backward pass of a normalisation.
#[derive(Debug)]
struct Normalised;

impl<B: Backend> Backward<B, 3> for Normalised {
    type State = Kept<B>;

    fn backward(self, ops: Ops<Kept<B>, 3>, gradients: &mut Gradients, _: &mut Checkpointer) {
        let gradient = gradients.consume::<B>(&ops.node);
        let gradient = Tensor::<B, 4>::from_primitive(TensorPrimitive::Float(gradient));
        let Kept { normalised, scale } = ops.state;
        let [samples, height, width, channels] = gradient.dims();
        let pixels = (samples * height * width) as f64;
        let of_bias = sums(gradient.clone());
        let of_gain = sums(gradient.clone() * normalised.clone());
        let [raw, gain, bias] = ops.parents;
        let mut register = |node: burn_autodiff::NodeId, found: Tensor<B, 1>| {
            gradients.register::<B>(node, found.into_primitive().tensor());
        };
        if let Some(node) = gain {
            register(node.id, of_gain.clone().reshape([channels]));
        }
        if let Some(node) = bias {
            register(node.id, of_bias.clone().reshape([channels]));
        }
        if let Some(node) = raw {
            // The batch mean and variance depend on the pictures too: subtracts their share of the gradient.
            let shared = normalised * (of_gain / pixels) + of_bias / pixels;
            let found = (gradient - shared) * scale;
            gradients.register::<B>(node.id, found.into_primitive().tensor());
        }
    }
}

/// Pictures that were normalised by their own moments.
pub(crate) struct Batch<B: Backend> {
    pub(crate) given: Tensor<Autodiff<B>, 4>,
    /// Mean of each channel.
    pub(crate) mean: Tensor<B, 1>,
    /// Unbiased variance of each channel.
    pub(crate) variance: Tensor<B, 1>,
}

/// Normalises `raw` by the moments of its channels, then applies `gain` and `bias`.
pub(crate) fn normalised<B: Backend>(
    raw: Tensor<Autodiff<B>, 4>,
    gain: Tensor<Autodiff<B>, 1>,
    bias: Tensor<Autodiff<B>, 1>,
) -> Batch<B> {
    let [samples, height, width, channels] = raw.dims();
    let pixels = (samples * height * width) as f64;
    let row = |tensor: &Tensor<Autodiff<B>, 1>| tensor.clone().inner().reshape([1, 1, 1, channels]);
    let inner = raw.clone().inner();
    let mean = sums(inner.clone()) / pixels;
    let centred = inner - mean.clone();
    let variance = sums(centred.clone() * centred.clone()) / pixels;
    let root = (variance.clone() + Network::NORM_EPSILON).sqrt();
    let normalised = centred / root.clone();
    let given = normalised.clone() * row(&gain) + row(&bias);
    let kept = Kept {
        normalised,
        scale: row(&gain) / root,
    };
    let nodes = [
        raw.into_primitive().tensor().node,
        gain.into_primitive().tensor().node,
        bias.into_primitive().tensor().node,
    ];
    let prepared = <Normalised as Backward<B, 3>>::prepare::<NoCheckpointing>(Normalised, nodes);
    let given = given.into_primitive().tensor();
    let given = match prepared.compute_bound().stateful() {
        OpsKind::Tracked(prepared) => prepared.finish(kept, given),
        OpsKind::UnTracked(prepared) => prepared.finish(given),
    };
    Batch {
        given: Tensor::from_primitive(TensorPrimitive::Float(given)),
        mean: mean.reshape([channels]),
        variance: (variance * (pixels / (pixels - 1.0))).reshape([channels]),
    }
}

/// Maximum number of pixels that one GPU thread sums.
const ALONE: usize = 128;

/// Sums of each channel: along rows, then columns, then pictures. This order occupies many GPU threads and limits rounding errors.
///
/// # Shapes
/// `pictures`: `[samples, height, width, channels]`. Returns `[1, 1, 1, channels]`.
fn sums<B: Backend>(pictures: Tensor<B, 4>) -> Tensor<B, 4> {
    let [samples, height, width, channels] = pictures.dims();
    let lines = if height * width <= ALONE {
        pictures.reshape([samples, height * width, channels])
    } else {
        let lines = pictures.reshape([samples * height, width, channels]);
        lines.sum_dim(1).reshape([samples, height, channels])
    };
    let each = lines.sum_dim(1).reshape([samples, channels]);
    each.sum_dim(0).reshape([1, 1, 1, channels])
}
