//! Layers of a network and their order. Implementations of convolution and normalisation are supplied by a [`Pass`].

use burn_tensor::Tensor;
use burn_tensor::activation::relu;
use burn_tensor::backend::Backend;
use burn_tensor::module::max_pool2d;

use crate::gpu::convolution::Convolution;
use crate::gpu::weights::Layout;
use crate::{Architecture, PlainLayer, Pooling, StagePlan};

/// Layers of a network on a device of the backend `B`.
#[derive(Clone, Debug)]
pub(crate) struct Passes<B: Backend> {
    parts: Vec<Layer<B>>,
    pooling: Pooling,
    head: Head<B>,
}

/// A layer, or a residual block.
#[derive(Clone, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "a network has a few dozen, nearly all of the largest kind"
)]
enum Layer<B: Backend> {
    Stem(Normed<B>),
    Plain(Normed<B>),
    Block {
        first: Normed<B>,
        second: Normed<B>,
        past: Option<Normed<B>>,
    },
}

/// A convolution and its normalisation. Fields are indices of their tensors among the trained tensors and the running moments.
#[derive(Clone, Debug)]
pub(crate) struct Normed<B: Backend> {
    pub(crate) convolution: Convolution<B>,
    pub(crate) weight: usize,
    pub(crate) gain: usize,
    pub(crate) bias: usize,
    pub(crate) mean: usize,
    pub(crate) variance: usize,
    /// Shape of the weights, `[outputs, inputs, kernel rows, kernel columns]`.
    pub(crate) shape: [usize; 4],
}

/// Linear output layer, computed as a convolution of pictures of one pixel.
#[derive(Clone, Debug)]
pub(crate) struct Head<B: Backend> {
    pub(crate) convolution: Convolution<B>,
    pub(crate) weight: usize,
    bias: usize,
    outputs: usize,
}

/// Implementation of layers on tensors of the backend `T`. `B` is the backend of the device.
pub(crate) trait Pass<B: Backend, T: Backend> {
    /// Convolves and normalises pictures.
    fn normed(&mut self, normed: &Normed<B>, pictures: Tensor<T, 4>) -> Tensor<T, 4>;

    /// Multiplies features by the weights, without the bias.
    fn weighted(&self, head: &Head<B>, features: Tensor<T, 4>) -> Tensor<T, 4>;

    /// Trained tensor with index `position`.
    fn learnt(&self, position: usize) -> Tensor<T, 1>;
}

impl<B: Backend> Passes<B> {
    /// Layers of `architecture` with the tensors of `layout`.
    pub(crate) fn new(architecture: &Architecture, layout: &Layout, device: &B::Device) -> Self {
        let positions = layout.positions();
        let position = |name: &str| {
            let found = positions.get(name);
            *found.expect("a network has the tensors of its parts")
        };
        let normed = |prefix: &str, [convolution, norm]: [&str; 2], stride, seen| {
            let weight = position(&format!("{prefix}{convolution}.weight"));
            let of_norm = |name: &str| position(&format!("{prefix}{norm}.{name}"));
            let shape = &layout.learnt[weight].shape;
            let shape = (**shape).try_into().expect("a kernel has four sizes");
            Normed {
                convolution: Convolution::new(shape, stride, seen, device),
                weight,
                gain: of_norm("weight"),
                bias: of_norm("bias"),
                mean: of_norm("running_mean"),
                variance: of_norm("running_var"),
                shape,
            }
        };
        let mut seen = [architecture.input.height, architecture.input.width];
        let names = architecture.stage_names();
        let parts = architecture.stages().into_iter().zip(&names);
        let parts = parts.map(|(plan, prefix)| match plan {
            StagePlan::Stem { .. } => {
                let stem = normed(prefix, ["conv1", "bn1"], 2, seen);
                seen = stem.convolution.pooled();
                Layer::Stem(stem)
            }
            StagePlan::Plain(PlainLayer { stride, .. }) => {
                let plain = normed(prefix, ["0", "1"], stride, seen);
                seen = plain.convolution.given();
                Layer::Plain(plain)
            }
            StagePlan::Block { stride, .. } => {
                let first = normed(prefix, ["conv1", "bn1"], stride, seen);
                let shortcut = ["downsample.0", "downsample.1"];
                let is_past = positions.contains_key(&*format!("{prefix}downsample.0.weight"));
                let past = is_past.then(|| normed(prefix, shortcut, stride, seen));
                seen = first.convolution.given();
                let second = normed(prefix, ["conv2", "bn2"], 1, seen);
                Layer::Block {
                    first,
                    second,
                    past,
                }
            }
        });
        let parts = parts.collect();
        let weight = position("fc.weight");
        let shape = &layout.learnt[weight].shape;
        let [outputs, features] = (**shape).try_into().expect("a matrix has two sizes");
        Passes {
            parts,
            pooling: architecture.pooling(),
            head: Head {
                convolution: Convolution::new([outputs, features, 1, 1], 1, [1, 1], device),
                weight,
                bias: position("fc.bias"),
                outputs,
            },
        }
    }

    /// All convolutions with their normalisations, in the order of the forward pass.
    pub(crate) fn normed(&self) -> impl Iterator<Item = &Normed<B>> {
        self.parts.iter().flat_map(|part| match part {
            Layer::Stem(normed) | Layer::Plain(normed) => vec![normed],
            Layer::Block {
                first,
                second,
                past,
            } => [first, second].into_iter().chain(past).collect(),
        })
    }

    /// Computes the outputs for `pictures`. Convolutions are computed by `pass`.
    ///
    /// # Shapes
    /// `pictures`: `[samples, height, width, channels]`. Returns `[samples, outputs]`.
    pub(crate) fn run<T: Backend>(
        &self,
        pictures: Tensor<T, 4>,
        pass: &mut impl Pass<B, T>,
    ) -> Tensor<T, 2> {
        let mut seen = pictures;
        for part in &self.parts {
            seen = match part {
                Layer::Stem(normed) => pooled(relu(pass.normed(normed, seen))),
                Layer::Plain(normed) => relu(pass.normed(normed, seen)),
                Layer::Block {
                    first,
                    second,
                    past,
                } => {
                    let middle = relu(pass.normed(first, seen.clone()));
                    let added = pass.normed(second, middle);
                    let past = match past {
                        Some(past) => pass.normed(past, seen),
                        None => seen,
                    };
                    relu(added + past)
                }
            };
        }
        let [samples, height, width, channels] = seen.dims();
        let features = match self.pooling {
            Pooling::Average => {
                let pixels = seen.reshape([samples, height * width, channels]);
                pixels.mean_dim(1).reshape([samples, 1, 1, channels])
            }
            Pooling::Flatten => seen.reshape([samples, 1, 1, height * width * channels]),
        };
        let Head { bias, outputs, .. } = self.head;
        let weighted = pass.weighted(&self.head, features);
        weighted.reshape([samples, outputs]) + pass.learnt(bias).reshape([1, outputs])
    }
}

/// Max pooling over 3 × 3 pixels with stride 2.
fn pooled<T: Backend>(pictures: Tensor<T, 4>) -> Tensor<T, 4> {
    // Channels before rows, as burn expects. Only strides change; no data is copied.
    let seen = pictures.permute([0, 3, 1, 2]);
    max_pool2d(seen, [3, 3], [2, 2], [1, 1], [1, 1], false).permute([0, 2, 3, 1])
}
