//! The stages of a predictor: convolutions with a bias, into which the running moments are folded.

use crate::convolution::{ConvolutionWeights, Epilogue, Forward, Source};
use crate::machine::Machine;
use crate::max_pool;
use crate::normed::Normed;
use crate::planes::{Layout, Planes};
use crate::scratch::Scratch;
use crate::stage::Stage;

/// Bytes of weights that stay there too.
const WEIGHTS_IN_CACHE: usize = 256 << 10;

/// Pixels of a picture that are enough to be worth reading the weights for.
const PIXELS_WORTH_WEIGHTS: usize = 128;

/// One convolution with a bias.
#[derive(Debug)]
pub(super) struct Layer {
    weights: ConvolutionWeights,
    bias: crate::panel::Aligned,
    forward: Forward,
    output: Layout,
}

/// A part of the network.
#[derive(Debug)]
pub(super) enum Folded {
    /// A convolution, and how what is pooled of it lies.
    Stem(Layer, Layout),
    Plain(Layer),
    Block(Box<FoldedBlock>),
}

/// Two convolutions, and the one that leads past them where pictures change their shape.
#[derive(Debug)]
pub(super) struct FoldedBlock {
    first: Layer,
    second: Layer,
    shortcut: Option<Layer>,
}

/// What a part passes on.
#[derive(Clone, Copy)]
pub(super) struct Pass<'a> {
    pub(super) machine: Machine,
    pub(super) input: &'a Planes,
    /// The first picture of the input.
    pub(super) first: usize,
    /// How many pictures.
    pub(super) count: usize,
}

impl Folded {
    pub(super) fn new(stage: &Stage, input: Layout, border: usize) -> Folded {
        match stage {
            Stage::Stem(normed) => {
                let layer = Layer::new(normed, input, 0);
                let picture = max_pool::output(layer.output.picture);
                Folded::Stem(layer, Layout { picture, border })
            }
            Stage::Plain(normed) => Folded::Plain(Layer::new(normed, input, border)),
            Stage::Block(block) => {
                let first = Layer::new(&block.first, input, 1);
                // What leads past lies as the output does, so that the two can be added.
                let past = block.shortcut.as_ref();
                Folded::Block(Box::new(FoldedBlock {
                    second: Layer::new(&block.second, first.output, border),
                    shortcut: past.map(|past| Layer::new(past, input, border)),
                    first,
                }))
            }
        }
    }

    /// How what it gives lies.
    pub(super) fn output(&self) -> Layout {
        match self {
            Folded::Stem(_, pooled) => *pooled,
            Folded::Plain(layer) => layer.output,
            Folded::Block(block) => block.second.output,
        }
    }

    /// Whether its weights are few and its pictures large.
    pub(super) fn is_light(&self) -> bool {
        match self {
            Folded::Stem(layer, _) | Folded::Plain(layer) => layer.is_light(),
            Folded::Block(block) => block.first.is_light() && block.second.is_light(),
        }
    }

    /// Passes pictures on, into room of `scratch`.
    pub(super) fn pass(&self, pass: Pass<'_>, scratch: &mut Scratch) -> Planes {
        match self {
            Folded::Stem(layer, pooled) => layer.pass_pooled(pass, *pooled, scratch),
            Folded::Plain(layer) => layer.pass(pass, Ending::Relu, scratch),
            Folded::Block(block) => {
                let middle = block.first.pass(pass, Ending::Relu, scratch);
                let layer = block.shortcut.as_ref();
                let past = layer.map(|layer| layer.pass(pass, Ending::Keep, scratch));
                let past_pictures = match &past {
                    Some(past) => past.first(pass.count),
                    None => pass.input.from(pass.first, pass.count),
                };
                let ending = Ending::AddThenRelu(past_pictures);
                let second = Pass {
                    input: &middle,
                    first: 0,
                    ..pass
                };
                let output = block.second.pass(second, ending, scratch);
                for passed in past.into_iter().chain([middle]) {
                    scratch.put(passed);
                }
                output
            }
        }
    }
}

/// What follows the bias.
#[derive(Clone, Copy)]
enum Ending<'a> {
    Keep,
    Relu,
    /// These pictures lie as the output does.
    AddThenRelu(&'a [f32]),
}

impl Layer {
    fn new(normed: &Normed, input: Layout, border: usize) -> Layer {
        let convolution = normed.convolution();
        let output = Layout {
            picture: convolution.output(input.picture),
            border,
        };
        let (weights, bias) = normed.fold();
        Layer {
            weights,
            bias,
            forward: Forward::new(convolution, input, output),
            output,
        }
    }

    fn pass(&self, pass: Pass<'_>, ending: Ending<'_>, scratch: &mut Scratch) -> Planes {
        let mut output = scratch.take(self.output, pass.count);
        let source = self.source(pass);
        let epilogue = match ending {
            Ending::Keep => Epilogue::Bias(&self.bias),
            Ending::Relu => Epilogue::BiasRelu(&self.bias),
            Ending::AddThenRelu(other) => Epilogue::BiasAddRelu(&self.bias, other),
        };
        // The outputs on the way are not needed.
        let each = (&mut vec![(); pass.count][..], |(): &mut (), _: &[f32]| {});
        self.forward
            .run(pass.machine, source, &mut output, epilogue, each);
        output
    }

    /// Pools each picture while it is in a cache.
    fn pass_pooled(&self, pass: Pass<'_>, layout: Layout, scratch: &mut Scratch) -> Planes {
        let (machine, count) = (pass.machine, pass.count);
        let mut raw = scratch.take(self.output, count);
        let mut pooled = scratch.take(layout, count);
        let images = pooled.first_mut(count).chunks_exact_mut(layout.len());
        let mut images: Vec<&mut [f32]> = images.collect();
        let pool = |into: &mut &mut [f32], raw: &[f32]| {
            max_pool::pool(machine, (raw, self.output), (into, layout));
        };
        let (source, epilogue) = (self.source(pass), Epilogue::BiasRelu(&self.bias));
        self.forward
            .run(machine, source, &mut raw, epilogue, (&mut images, pool));
        scratch.put(raw);
        pooled
    }

    fn source<'a>(&'a self, pass: Pass<'a>) -> Source<'a> {
        Source {
            weights: &self.weights,
            input: pass.input,
            first: pass.first,
            count: pass.count,
        }
    }

    /// Whether its weights are few and its pictures large.
    fn is_light(&self) -> bool {
        size_of_val(self.weights.values()) <= WEIGHTS_IN_CACHE
            && self.output.picture.pixels() >= PIXELS_WORTH_WEIGHTS
    }
}
