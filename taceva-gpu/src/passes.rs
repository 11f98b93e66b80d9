//! The parts of a network and how pictures pass them, however normalisation is done.

use burn_tensor::activation::relu;
use burn_tensor::backend::Backend;
use burn_tensor::module::{conv2d, max_pool2d};
use burn_tensor::ops::ConvOptions;
use burn_tensor::{Slice, Tensor};
use taceva_network::{Architecture, PlainLayer, Pooling, StagePlan};

use crate::weights::Layout;

/// The parts of a network.
#[derive(Clone, Debug)]
pub(crate) struct Passes {
    parts: Vec<Layer>,
    pooling: Pooling,
    head: Head,
}

/// A layer, or a residual block, that is computed as a whole.
#[derive(Clone, Debug)]
enum Layer {
    Stem(Normed),
    Plain(Normed),
    Block {
        first: Normed,
        second: Normed,
        past: Option<Normed>,
    },
}

/// A convolution and its normalisation, by the positions of their tensors among those that are learnt and those that run.
#[derive(Clone, Debug)]
pub(crate) struct Normed {
    pub(crate) weight: usize,
    pub(crate) gain: usize,
    pub(crate) bias: usize,
    pub(crate) mean: usize,
    pub(crate) variance: usize,
    /// `[outputs, inputs, kernel rows, kernel columns]`.
    pub(crate) shape: [usize; 4],
    stride: usize,
}

/// Outputs that are linear in features.
#[derive(Clone, Copy, Debug)]
struct Head {
    weight: usize,
    bias: usize,
    /// `[outputs, features]`.
    shape: [usize; 2],
}

impl Passes {
    /// Those of `architecture`, whose tensors lie as `layout` says.
    pub(crate) fn new(architecture: &Architecture, layout: &Layout) -> Passes {
        let positions = layout.positions();
        let position = |name: &str| {
            let found = positions.get(name);
            *found.expect("a network has the tensors of its parts")
        };
        let normed = |prefix: &str, [convolution, norm]: [&str; 2], stride| {
            let weight = position(&format!("{prefix}{convolution}.weight"));
            let of_norm = |name: &str| position(&format!("{prefix}{norm}.{name}"));
            let shape = &layout.learnt[weight].shape;
            Normed {
                weight,
                gain: of_norm("weight"),
                bias: of_norm("bias"),
                mean: of_norm("running_mean"),
                variance: of_norm("running_var"),
                shape: (**shape).try_into().expect("a kernel has four sizes"),
                stride,
            }
        };
        let names = architecture.stage_names();
        let parts = architecture.stages().into_iter().zip(&names);
        let parts = parts.map(|(plan, prefix)| match plan {
            StagePlan::Stem { .. } => Layer::Stem(normed(prefix, ["conv1", "bn1"], 2)),
            StagePlan::Plain(PlainLayer { stride, .. }) => {
                Layer::Plain(normed(prefix, ["0", "1"], stride))
            }
            StagePlan::Block { stride, .. } => {
                let is_past = positions.contains_key(&*format!("{prefix}downsample.0.weight"));
                Layer::Block {
                    first: normed(prefix, ["conv1", "bn1"], stride),
                    second: normed(prefix, ["conv2", "bn2"], 1),
                    past: is_past.then(|| normed(prefix, ["downsample.0", "downsample.1"], stride)),
                }
            }
        });
        let parts = parts.collect();
        let weight = position("fc.weight");
        let shape = &layout.learnt[weight].shape;
        Passes {
            parts,
            pooling: architecture.pooling(),
            head: Head {
                weight,
                bias: position("fc.bias"),
                shape: (**shape).try_into().expect("a matrix has two sizes"),
            },
        }
    }

    /// Every convolution with its normalisation, in the order of the passes.
    pub(crate) fn normed(&self) -> impl Iterator<Item = &Normed> {
        self.parts.iter().flat_map(|part| match part {
            Layer::Stem(normed) | Layer::Plain(normed) => vec![normed],
            Layer::Block {
                first,
                second,
                past,
            } => [first, second].into_iter().chain(past).collect(),
        })
    }

    /// The stride of a kernel that is narrower than it and wider than a pixel, which burn does not differentiate (see [`thinned`]).
    pub(crate) fn gap(&self) -> Option<usize> {
        let mut normed = self.normed();
        let gap = normed.find(|normed| (2..normed.stride).contains(&normed.shape[2]));
        gap.map(|normed| normed.stride)
    }

    /// The outputs for `pictures`, with `norm` for each convolution and its normalisation.
    ///
    /// # Shapes
    /// `pictures`: `[samples, channels, height, width]`; `learnt`: the tensors that are learnt; the outputs: `[samples, outputs]`.
    pub(crate) fn run<B: Backend>(
        &self,
        pictures: Tensor<B, 4>,
        learnt: &[Tensor<B, 1>],
        mut norm: impl FnMut(&Normed, Tensor<B, 4>) -> Tensor<B, 4>,
    ) -> Tensor<B, 2> {
        let mut seen = pictures;
        for part in &self.parts {
            seen = match part {
                Layer::Stem(normed) => {
                    let cut = relu(norm(normed, seen));
                    max_pool2d(cut, [3, 3], [2, 2], [1, 1], [1, 1], false)
                }
                Layer::Plain(normed) => relu(norm(normed, seen)),
                Layer::Block {
                    first,
                    second,
                    past,
                } => {
                    let middle = relu(norm(first, seen.clone()));
                    let added = norm(second, middle);
                    let past = match past {
                        Some(past) => norm(past, seen),
                        None => seen,
                    };
                    relu(added + past)
                }
            };
        }
        let [samples, channels, height, width] = seen.dims();
        let last = seen.permute([0, 2, 3, 1]);
        let features = match self.pooling {
            Pooling::Average => {
                let pixels = last.reshape([samples, height * width, channels]);
                pixels.mean_dim(1).reshape([samples, channels])
            }
            Pooling::Flatten => last.reshape([samples, height * width * channels]),
        };
        let Head {
            weight,
            bias,
            shape: [outputs, inputs],
        } = self.head;
        let weights = learnt[weight].clone().reshape([outputs, inputs]);
        features.matmul(weights.transpose()) + learnt[bias].clone().reshape([1, outputs])
    }
}

impl Normed {
    /// Pictures convolved with `weights`, which have its shape.
    pub(crate) fn convolve<B: Backend>(
        &self,
        pictures: Tensor<B, 4>,
        weights: Tensor<B, 1>,
        bias: Option<Tensor<B, 1>>,
    ) -> Tensor<B, 4> {
        let [_, _, rows, columns] = self.shape;
        let (pictures, stride) = if rows == 1 {
            (thinned(pictures, self.stride), 1)
        } else {
            (pictures, self.stride)
        };
        let options = ConvOptions::new([stride; 2], [rows / 2, columns / 2], [1, 1], 1);
        conv2d(pictures, weights.reshape(self.shape), bias, options)
    }
}

/// Each `stride`-th pixel of each `stride`-th row.
///
/// Convolutions whose kernels are narrower than their strides get no gradient for some pixels from burn 0.21's transposed convolution
/// (`conv_transpose2d_direct`: its range of rows is empty where it should have one); so pixels that are passed over are left out
/// before.
fn thinned<B: Backend>(pictures: Tensor<B, 4>, stride: usize) -> Tensor<B, 4> {
    let every = Slice::new(
        0,
        None,
        isize::try_from(stride).expect("a stride of a few pixels"),
    );
    pictures.slice([Slice::full(), Slice::full(), every, every])
}
