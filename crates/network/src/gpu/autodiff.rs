//! A convolution in burn's automatic differentiation. Gradients are computed by [`Convolution`].

use burn_autodiff::Autodiff;
use burn_autodiff::checkpoint::base::Checkpointer;
use burn_autodiff::checkpoint::strategy::NoCheckpointing;
use burn_autodiff::grads::Gradients;
use burn_autodiff::ops::{Backward, Ops, OpsKind};
use burn_tensor::backend::Backend;
use burn_tensor::{Tensor, TensorPrimitive};

use crate::gpu::convolution::Convolution;
use crate::gpu::products::Products;

/// State that the backward pass needs.
#[derive(Clone, Debug)]
struct Kept<B: Backend> {
    convolution: Convolution<B>,
    pictures: Tensor<B, 4>,
    weights: Tensor<B, 1>,
}

/// Backward pass of a convolution.
#[derive(Debug)]
struct Convolved;

impl<B: Products> Backward<B, 2> for Convolved {
    type State = Kept<B>;

    fn backward(self, ops: Ops<Kept<B>, 2>, gradients: &mut Gradients, _: &mut Checkpointer) {
        let gradient = gradients.consume::<B>(&ops.node);
        let gradient = Tensor::<B, 4>::from_primitive(TensorPrimitive::Float(gradient));
        let Kept {
            convolution,
            pictures,
            weights,
        } = ops.state;
        let [of_pictures, of_weights] = ops.parents;
        if let Some(node) = of_weights {
            let found = convolution.of_weights(pictures, gradient.clone());
            gradients.register::<B>(node.id, found.into_primitive().tensor());
        }
        if let Some(node) = of_pictures {
            let found = convolution.backward(gradient, weights);
            gradients.register::<B>(node.id, found.into_primitive().tensor());
        }
    }
}

/// Convolves `pictures` with `weights`, with gradients for both.
pub(crate) fn convolved<B: Products>(
    convolution: &Convolution<B>,
    pictures: Tensor<Autodiff<B>, 4>,
    weights: Tensor<Autodiff<B>, 1>,
) -> Tensor<Autodiff<B>, 4> {
    let kept = Kept {
        convolution: convolution.clone(),
        pictures: pictures.clone().inner(),
        weights: weights.clone().inner(),
    };
    let given = convolution.forward(kept.pictures.clone(), kept.weights.clone());
    let given = given.into_primitive().tensor();
    let nodes = [
        pictures.into_primitive().tensor().node,
        weights.into_primitive().tensor().node,
    ];
    let prepared = <Convolved as Backward<B, 2>>::prepare::<NoCheckpointing>(Convolved, nodes);
    let given = match prepared.compute_bound().stateful() {
        OpsKind::Tracked(prepared) => prepared.finish(kept, given),
        OpsKind::UnTracked(prepared) => prepared.finish(given),
    };
    Tensor::from_primitive(TensorPrimitive::Float(given))
}
