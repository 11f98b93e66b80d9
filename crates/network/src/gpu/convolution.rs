//! Convolutions as matrix products. Windows (the pixels that one output reads) are gathered and multiplied by the kernels.
//!
//! burn's own convolutions are not used. With tensor cores they compute in TF32; without tensor cores they process pixel by pixel. In burn 0.21 they also lose
//! the gradient of pixels where a kernel is narrower than its stride (`conv_transpose2d_direct`).

use burn_tensor::Tensor;
use burn_tensor::backend::Backend;

use crate::gpu::parts::{LINE, added, split, stack, together};
use crate::gpu::products::Products;
use crate::gpu::windows::{Way, Windows, given};

/// A convolution of pictures of one size, shape `[samples, height, width, channels]`. The weights are one vector in PyTorch's order, `[outputs, inputs, kernel
/// rows, kernel columns]`.
#[derive(Clone, Debug)]
pub(crate) struct Convolution<B: Backend> {
    windows: Windows<B>,
    inputs: usize,
    outputs: usize,
    kernel: usize,
    /// Maximum number of values of a tensor of gathered pixels.
    most: usize,
}

/// Maximum number of values of a tensor of gathered pixels. These values take 128 MiB, the storage buffer size that WebGPU guarantees.
const MOST: usize = 1 << 25;

impl<B: Backend> Convolution<B> {
    /// Convolution with weights of `shape`. `seen` is the height and width of the input pictures.
    pub(crate) fn new(
        shape: [usize; 4],
        stride: usize,
        seen: [usize; 2],
        device: &B::Device,
    ) -> Self {
        let [outputs, inputs, kernel, _] = shape;
        Convolution {
            windows: Windows::new(seen, kernel, stride, device),
            inputs,
            outputs,
            kernel,
            most: MOST,
        }
    }

    /// Height and width of the output.
    pub(crate) fn given(&self) -> [usize; 2] {
        self.windows.given
    }

    /// Height and width after 3 × 3 max pooling with stride 2.
    pub(crate) fn pooled(&self) -> [usize; 2] {
        self.windows.given.map(|length| given(length, 3, 2))
    }

    /// Weights reshaped to `[outputs, inputs, kernel rows, kernel columns]`.
    fn kernels(&self, weights: Tensor<B, 1>) -> Tensor<B, 4> {
        let kernel = self.kernel;
        weights.reshape([self.outputs, self.inputs, kernel, kernel])
    }
}

impl<B: Products> Convolution<B> {
    /// Convolves `pictures` with `weights`.
    pub(crate) fn forward(&self, pictures: Tensor<B, 4>, weights: Tensor<B, 1>) -> Tensor<B, 4> {
        let inner = self.windows.taps * self.inputs;
        let kernels = self.kernels(weights).permute([2, 3, 1, 0]);
        let kernels = kernels.reshape([1, inner, self.outputs]);
        self.gathered(pictures, Way::Onward, &kernels)
    }

    /// Gradient of the pictures, from the output gradient `gradient`.
    pub(crate) fn backward(&self, gradient: Tensor<B, 4>, weights: Tensor<B, 1>) -> Tensor<B, 4> {
        let inner = self.windows.taps * self.outputs;
        let kernels = self.kernels(weights).permute([2, 3, 0, 1]);
        let kernels = kernels.reshape([1, inner, self.inputs]);
        self.gathered(gradient, Way::Back, &kernels)
    }

    /// Gradient of the weights, from the output gradient `gradient`.
    pub(crate) fn of_weights(
        &self,
        pictures: Tensor<B, 4>,
        gradient: Tensor<B, 4>,
    ) -> Tensor<B, 1> {
        let [height, width] = self.windows.given;
        let inner = self.windows.taps * self.inputs;
        let parts = self
            .parts(pictures, Way::Onward)
            .zip(split(gradient, self.at_once(Way::Onward)));
        let sums = parts.map(|(windows, gradient)| {
            let [samples, ..] = windows.dims();
            let pixels = samples * height * width;
            let stack = stack(pixels, 1, [inner, self.outputs]);
            let windows = windows.reshape([stack, pixels / stack, inner]);
            let gradient = gradient.reshape([stack, pixels / stack, self.outputs]);
            added(B::product(windows.swap_dims(1, 2), gradient))
        });
        let sum = sums
            .reduce(|sum, next| sum + next)
            .expect("a batch has pictures");
        let kernel = self.kernel;
        let sum = sum.reshape([kernel, kernel, self.inputs, self.outputs]);
        let count = inner * self.outputs;
        sum.permute([3, 2, 0, 1]).reshape([count])
    }

    /// Multiplies the windows of `pictures` by `kernels` of shape `[1, taps · channels, output channels]`.
    fn gathered(&self, pictures: Tensor<B, 4>, way: Way, kernels: &Tensor<B, 3>) -> Tensor<B, 4> {
        let [samples, ..] = pictures.dims();
        let [_, inner, channels] = kernels.dims();
        let [height, width] = match way {
            Way::Onward => self.windows.given,
            Way::Back => self.windows.seen,
        };
        let parts = self.parts(pictures, way).map(|windows| {
            let [samples, ..] = windows.dims();
            let rows = samples * height * width;
            let stack = stack(inner, LINE, [rows, channels]);
            let windows = windows
                .reshape([rows, stack, inner / stack])
                .swap_dims(0, 1);
            let kernels = kernels.clone().reshape([stack, inner / stack, channels]);
            added(B::product(windows, kernels))
        });
        let parts: Vec<_> = parts.collect();
        together(parts, 1).reshape([samples, height, width, channels])
    }

    /// Windows of `pictures`, in tensors of at most `most` values, or of one picture.
    fn parts(&self, pictures: Tensor<B, 4>, way: Way) -> impl Iterator<Item = Tensor<B, 3>> {
        split(pictures, self.at_once(way)).map(move |pictures| {
            let [samples, height, width, channels] = pictures.dims();
            let pixels = pictures.reshape([samples, height * width, channels]);
            self.windows.of(pixels, way)
        })
    }

    /// Number of pictures whose windows are gathered in one tensor.
    fn at_once(&self, way: Way) -> usize {
        let Windows {
            seen, given, taps, ..
        } = &self.windows;
        let (pixels, channels) = match way {
            Way::Onward => (given, self.inputs),
            Way::Back => (seen, self.outputs),
        };
        (self.most / (pixels[0] * pixels[1] * taps * channels)).max(1)
    }
}

#[cfg(test)]
mod tests {
    use super::Convolution;
    use crate::gpu::devices::on_each;
    use crate::gpu::products::Products;
    use burn_tensor::{Tensor, TensorData};

    fn numbers<B: Products, const D: usize>(shape: [usize; D], seed: usize) -> Tensor<B, D> {
        let count = shape.iter().product::<usize>();
        let values = (0..count).map(|at| ((at * 37 + seed) % 101) as f32 / 50.0 - 1.0);
        let data = TensorData::new(values.collect::<Vec<f32>>(), shape);
        Tensor::from_data(data, &B::Device::default())
    }

    /// Outputs and gradients of a test convolution of five pictures, with windows of at most `most` values.
    fn all<B: Products>(most: usize) -> [Vec<f32>; 3] {
        let device = B::Device::default();
        let mut convolution = Convolution::<B>::new([8, 4, 3, 3], 2, [9, 7], &device);
        convolution.most = most;
        let (pictures, weights) = (numbers([5, 9, 7, 4], 3), numbers([8 * 4 * 9], 5));
        let gradient = numbers([5, 5, 4, 8], 7);
        let given = convolution.forward(pictures.clone(), weights.clone());
        let of_pictures = convolution.backward(gradient.clone(), weights);
        let of_weights = convolution.of_weights(pictures, gradient);
        [
            given.into_data().iter::<f32>().collect(),
            of_pictures.into_data().iter::<f32>().collect(),
            of_weights.into_data().iter::<f32>().collect(),
        ]
    }

    fn check<B: Products>() {
        let whole = all::<B>(super::MOST);
        // The limit allows windows of two pictures at once forward (5 × 4 × 9 × 4 values each), and of one backward.
        for (found, expected) in all::<B>(1500).iter().zip(&whole) {
            assert_eq!(found.len(), expected.len());
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-4, "{found}, {expected}");
            }
        }
    }

    #[test]
    fn pictures_in_parts_give_what_they_give_at_once() {
        on_each!(check);
    }
}
