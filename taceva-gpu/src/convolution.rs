//! Convolutions as products of matrices: windows of pixels are gathered, and multiplied by the kernels.
//!
//! burn's own convolutions are not used: without tensor cores they are formed pixel by pixel, ten times as slow, and with them in TF32;
//! and burn 0.21 drops the gradient of pixels where a kernel is narrower than its stride (`conv_transpose2d_direct`).

use burn_tensor::Tensor;
use burn_tensor::backend::Backend;

use crate::products::Products;
use crate::windows::{Way, Windows, given};

/// A convolution of pictures of one size, which lie `[samples, height, width, channels]`; its weights lie as in PyTorch,
/// `[outputs, inputs, kernel rows, kernel columns]`, in one vector.
#[derive(Clone, Debug)]
pub(crate) struct Convolution<B: Backend> {
    windows: Windows<B>,
    inputs: usize,
    outputs: usize,
    kernel: usize,
}

/// Numbers that windows take at most: what a storage buffer of WebGPU holds at least, 128 MiB.
const MOST: usize = 1 << 25;

/// Tiles of 64 × 64 that a GPU is busy with: products of fewer are formed in parts, which are added up.
const BUSY: usize = 512;

impl<B: Backend> Convolution<B> {
    /// One whose weights have `shape`, of pictures of `seen` height and width.
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
        }
    }

    /// Height and width of what it gives.
    pub(crate) fn given(&self) -> [usize; 2] {
        self.windows.given
    }

    /// Height and width after pooling over 3 × 3 with stride 2.
    pub(crate) fn pooled(&self) -> [usize; 2] {
        self.windows.given.map(|length| given(length, 3, 2))
    }

    /// The weights of each place of the kernel behind each other.
    fn kernels(&self, weights: Tensor<B, 1>) -> Tensor<B, 4> {
        let kernel = self.kernel;
        weights.reshape([self.outputs, self.inputs, kernel, kernel])
    }
}

impl<B: Products> Convolution<B> {
    /// `pictures` convolved with `weights`.
    pub(crate) fn forward(&self, pictures: Tensor<B, 4>, weights: Tensor<B, 1>) -> Tensor<B, 4> {
        let inner = self.windows.taps * self.inputs;
        let kernels = self.kernels(weights).permute([2, 3, 1, 0]);
        let kernels = kernels.reshape([1, inner, self.outputs]);
        self.gathered(pictures, Way::Onward, &kernels)
    }

    /// The gradient of the pictures, from `gradient`, that of what the convolution gave.
    pub(crate) fn backward(&self, gradient: Tensor<B, 4>, weights: Tensor<B, 1>) -> Tensor<B, 4> {
        let inner = self.windows.taps * self.outputs;
        let kernels = self.kernels(weights).permute([2, 3, 0, 1]);
        let kernels = kernels.reshape([1, inner, self.inputs]);
        self.gathered(gradient, Way::Back, &kernels)
    }

    /// The gradient of the weights.
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

    /// The windows of `pictures` multiplied by `kernels`, which are `[1, taps · channels, channels given]`.
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

    /// The windows of `pictures`, of as many at once as memory allows.
    fn parts(&self, pictures: Tensor<B, 4>, way: Way) -> impl Iterator<Item = Tensor<B, 3>> {
        split(pictures, self.at_once(way)).map(move |pictures| {
            let [samples, height, width, channels] = pictures.dims();
            let pixels = pictures.reshape([samples, height * width, channels]);
            self.windows.of(pixels, way)
        })
    }

    /// Pictures whose windows are gathered at once.
    fn at_once(&self, way: Way) -> usize {
        let Windows {
            seen, given, taps, ..
        } = &self.windows;
        let (pixels, channels) = match way {
            Way::Onward => (given, self.inputs),
            Way::Back => (seen, self.outputs),
        };
        (MOST / (pixels[0] * pixels[1] * taps * channels)).max(1)
    }
}

/// `pictures`, at most `most` at once.
fn split<B: Backend>(pictures: Tensor<B, 4>, most: usize) -> impl Iterator<Item = Tensor<B, 4>> {
    let [samples, ..] = pictures.dims();
    (0..samples).step_by(most).map(move |start| {
        if samples <= most {
            pictures.clone()
        } else {
            let end = samples.min(start + most);
            pictures.clone().slice([start..end])
        }
    })
}

/// `parts` one behind the other.
fn together<B: Backend>(mut parts: Vec<Tensor<B, 3>>, along: usize) -> Tensor<B, 3> {
    match parts.len() {
        1 => parts.remove(0),
        _ => Tensor::cat(parts, along),
    }
}

/// The sum of a stack.
fn added<B: Backend>(stack: Tensor<B, 3>) -> Tensor<B, 3> {
    match stack.dims() {
        [1, ..] => stack,
        _ => stack.sum_dim(0),
    }
}

/// Numbers of a window that stay together.
const LINE: usize = 32;

/// Products that a part of a sum has at least.
const LEAST: usize = 128;

/// In how many equal parts sums of `length` products are formed for a matrix of `size`, so that the GPU is busy; each of whole lines.
fn stack(length: usize, line: usize, [rows, columns]: [usize; 2]) -> usize {
    let tiles = rows.div_ceil(64) * columns.div_ceil(64);
    let wanted = (BUSY / tiles).min(length / LEAST).max(1);
    let mut fitting = (1..=wanted).rev();
    fitting
        .find(|parts| length % (parts * line) == 0)
        .unwrap_or(1)
}
