//! One convolution of a predictor.

use crate::convolution::{ConvolutionForm, ConvolutionWeights, Epilogue, Forward, Source, Target};
use crate::error::NetworkError;
use crate::machine::Machine;
use crate::max_pool;
use crate::normalised_convolution::Normed;
use crate::panel::Aligned;
use crate::planes::{Layout, Planes};
use crate::scratch::Scratch;

/// Size of weights that fit into a thread's second-level cache together with pictures, in bytes.
const WEIGHTS_IN_CACHE: usize = 256 << 10;

/// Minimum number of pixels of a picture that amortise reading the weights.
const PIXELS_WORTH_WEIGHTS: usize = 128;

/// One convolution with a bias.
#[derive(Debug)]
pub(super) struct Layer {
    weights: Weights,
    bias: Aligned,
    forward: Forward,
    output: Layout,
    is_light: bool,
    products: usize,
}

/// Weights: untransformed, or in the format that a pass reads.
#[derive(Debug)]
enum Weights {
    Plain(ConvolutionWeights),
    Transformed(Aligned),
}

/// Input of a prepared stage.
#[derive(Clone, Copy)]
pub(super) struct Pass<'a> {
    pub(super) machine: Machine,
    pub(super) input: &'a Planes,
    /// Index of the first picture.
    pub(super) first: usize,
    /// Number of pictures.
    pub(super) count: usize,
}

/// Operation after addition of the bias.
#[derive(Clone, Copy)]
pub(super) enum Ending<'a> {
    Keep,
    Relu,
    /// Adds pictures with the layout of the output, then applies ReLU.
    AddThenRelu(&'a [f32]),
}

impl Layer {
    /// Layer for the convolution `normed`, from pictures of layout `input` to pictures with a border of `border` pixels.
    pub(super) fn new(
        normed: &Normed,
        input: Layout,
        border: usize,
        form: ConvolutionForm,
    ) -> Layer {
        let convolution = normed.convolution();
        let output = Layout {
            picture: convolution.output(input.picture),
            border,
        };
        let (weights, bias) = normed.fold();
        let weights_bytes = size_of_val(weights.values());
        Layer {
            weights: Weights::Plain(weights),
            bias,
            forward: Forward::new(convolution, input, output, form),
            output,
            products: output.picture.len() * convolution.taps() * convolution.inputs,
            // Depends on shapes but not on the form, so all forms process the same number of pictures at a time.
            is_light: weights_bytes <= WEIGHTS_IN_CACHE
                && output.picture.pixels() >= PIXELS_WORTH_WEIGHTS,
        }
    }

    /// Length of the transformed weights that are not allocated yet.
    pub(super) fn missing(&self) -> usize {
        match self.weights {
            Weights::Plain(_) => self.forward.transformed_len(),
            Weights::Transformed(_) => 0,
        }
    }

    /// Transforms the weights if the algorithm requires it, and frees the untransformed weights.
    ///
    /// # Errors
    /// [`NetworkError::Memory`] if the transformed weights do not fit into memory.
    pub(super) fn prepare(&mut self, machine: Machine) -> Result<(), NetworkError> {
        let length = self.missing();
        if let (Weights::Plain(weights), 1..) = (&self.weights, length) {
            let mut transformed = Aligned::try_zeros(length)?;
            self.forward.weights(machine, weights, &mut transformed);
            self.weights = Weights::Transformed(transformed);
        }
        Ok(())
    }

    /// Number of multiplications per picture in the direct algorithm.
    pub(super) fn products(&self) -> usize {
        self.products
    }

    /// Memory layout of the output.
    pub(super) fn output(&self) -> Layout {
        self.output
    }

    /// Convolves pictures into a buffer of `scratch`.
    pub(super) fn pass(&self, pass: Pass<'_>, ending: Ending<'_>, scratch: &mut Scratch) -> Planes {
        let mut output = scratch.take(self.output, pass.count);
        let source = self.source(pass);
        let epilogue = match ending {
            Ending::Keep => Epilogue::Bias(&self.bias),
            Ending::Relu => Epilogue::BiasRelu(&self.bias),
            Ending::AddThenRelu(other) => Epilogue::BiasAddRelu(&self.bias, other),
        };
        // No callback reads the outputs.
        let each = &mut vec![(); pass.count][..];
        let see = |(): &mut (), _: &[f32]| {};
        let pictures = &mut output;
        let target = Target { pictures, epilogue };
        self.forward
            .run(pass.machine, source, target, each, see, &scratch.tiles);
        output
    }

    /// Convolves pictures, and pools each output while it is in cache.
    pub(super) fn pass_pooled(
        &self,
        pass: Pass<'_>,
        layout: Layout,
        scratch: &mut Scratch,
    ) -> Planes {
        let (machine, count) = (pass.machine, pass.count);
        let mut raw = scratch.take(self.output, count);
        let mut pooled = scratch.take(layout, count);
        let images = pooled.first_mut(count).chunks_exact_mut(layout.len());
        let mut images: Vec<&mut [f32]> = images.collect();
        let pool = |into: &mut &mut [f32], raw: &[f32]| {
            max_pool::pool(machine, raw, self.output, into, layout);
        };
        let target = Target {
            pictures: &mut raw,
            epilogue: Epilogue::BiasRelu(&self.bias),
        };
        let (source, images) = (self.source(pass), &mut images[..]);
        self.forward
            .run(machine, source, target, images, pool, &scratch.tiles);
        scratch.put(raw);
        pooled
    }

    fn source<'a>(&'a self, pass: Pass<'a>) -> Source<'a> {
        Source {
            weights: match &self.weights {
                Weights::Plain(weights) => weights.values(),
                Weights::Transformed(weights) => weights,
            },
            input: pass.input,
            first: pass.first,
            count: pass.count,
        }
    }

    /// True if the layer has few weights and large pictures.
    pub(super) fn is_light(&self) -> bool {
        self.is_light
    }
}
