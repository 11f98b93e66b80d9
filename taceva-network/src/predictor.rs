//! A network ready to predict: running moments are worked into the weights, so that nothing but convolutions is left.

use crate::architecture::StagePlan;
use crate::convolution::{ConvolutionWeights, Epilogue, Forward, Source};
use crate::error::NetworkError;
use crate::head::Head;
use crate::machine::Machine;
use crate::max_pool;
use crate::network::Network;
use crate::normed::Normed;
use crate::planes::{Layout, Picture, Planes};
use crate::scratch::Scratch;
use crate::stage::Stage;

/// A network ready to predict, and the room that it needs.
#[derive(Debug)]
pub struct Predictor {
    machine: Machine,
    input: Planes,
    stages: Vec<Folded>,
    scratch: Scratch,
    head: Head,
    features: Vec<f32>,
    outputs: Vec<f64>,
    batch: usize,
}

/// Pictures that are passed at once.
const BATCH: usize = 32;

/// One convolution with a bias.
#[derive(Debug)]
struct Layer {
    weights: ConvolutionWeights,
    bias: crate::panel::Aligned,
    forward: Forward,
    output: Layout,
}

/// A part of the network.
#[derive(Debug)]
enum Folded {
    /// A convolution, and how what is pooled of it lies.
    Stem(Layer, Layout),
    Plain(Layer),
    Block(Box<FoldedBlock>),
}

/// Two convolutions, and the one that leads past them where pictures change their shape.
#[derive(Debug)]
struct FoldedBlock {
    first: Layer,
    second: Layer,
    shortcut: Option<Layer>,
}

impl Network {
    /// The network ready to predict.
    pub fn predictor(&self) -> Predictor {
        self.predictor_of(BATCH)
    }

    /// The network ready to predict `batch` pictures at once; predictions do not depend on it.
    pub(crate) fn predictor_of(&self, batch: usize) -> Predictor {
        let mut layout = self.architecture.stages()[0].input_layout(self.architecture.input);
        let input = Planes::zeros(layout.picture, layout.border, batch);
        let plans: Vec<StagePlan> = self.architecture.stages();
        let mut stages = Vec::new();
        for (position, (plan, stage)) in self.planned().enumerate() {
            let output = plan.output(layout.picture);
            // At least one even behind the last, so that a block's output lies as its input does.
            let next = plans.get(position + 1);
            let border = next.map_or(1, |next| next.input_layout(output).border);
            stages.push(Folded::new(stage, layout, border));
            layout = Layout {
                picture: output,
                border,
            };
        }
        Predictor {
            machine: self.machine,
            input,
            stages,
            scratch: Scratch::new(0),
            head: self.head.clone(),
            features: Vec::new(),
            outputs: Vec::new(),
            batch,
        }
    }
}

impl Predictor {
    /// Pictures it takes.
    pub fn input(&self) -> Picture {
        self.input.layout().picture
    }

    /// Numbers it gives for each picture.
    pub fn outputs(&self) -> usize {
        self.head.outputs()
    }

    /// The outputs of each picture.
    ///
    /// # Shapes
    /// `pictures`: `[samples, height, width, channels]`; `into`: `[samples, outputs]`, the caller's.
    /// # Errors
    /// [`NetworkError`] if a length differs or a number is not finite.
    pub fn predict(&mut self, pictures: &[f32], into: &mut [f64]) -> Result<(), NetworkError> {
        let (picture, outputs) = (self.input(), self.outputs());
        picture.check_prediction(pictures, outputs, into)?;
        let batches = pictures.chunks(self.batch * picture.len());
        for (pictures, into) in batches.zip(into.chunks_mut(self.batch * outputs)) {
            for (position, values) in pictures.chunks_exact(picture.len()).enumerate() {
                self.input.set(position, values);
            }
            into.copy_from_slice(self.pass(pictures.len() / picture.len()));
        }
        Ok(())
    }

    /// The outputs of the first `count` pictures of the input.
    fn pass(&mut self, count: usize) -> &[f64] {
        let mut seen: Option<Planes> = None;
        for stage in &self.stages {
            let pass = Pass {
                machine: self.machine,
                input: seen.as_ref().unwrap_or(&self.input),
                count,
            };
            let output = stage.pass(pass, &mut self.scratch);
            if let Some(passed) = seen.replace(output) {
                self.scratch.put(passed);
            }
        }
        let last = seen.expect("an architecture has stages");
        self.head.see((&last, count), &mut self.features);
        self.scratch.put(last);
        self.head.forward(&self.features, &mut self.outputs);
        &self.outputs
    }
}

/// What a part passes on.
#[derive(Clone, Copy)]
struct Pass<'a> {
    machine: Machine,
    input: &'a Planes,
    /// How many pictures.
    count: usize,
}

impl Folded {
    fn new(stage: &Stage, input: Layout, border: usize) -> Folded {
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

    /// Passes pictures on, into room of `scratch`.
    fn pass(&self, pass: Pass<'_>, scratch: &mut Scratch) -> Planes {
        match self {
            Folded::Stem(layer, pooled) => layer.pass_pooled(pass, *pooled, scratch),
            Folded::Plain(layer) => layer.pass(pass, Ending::Relu, scratch),
            Folded::Block(block) => {
                let middle = block.first.pass(pass, Ending::Relu, scratch);
                let layer = block.shortcut.as_ref();
                let past = layer.map(|layer| layer.pass(pass, Ending::Keep, scratch));
                let ending = Ending::AddThenRelu(past.as_ref().unwrap_or(pass.input));
                let second = Pass {
                    input: &middle,
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
    AddThenRelu(&'a Planes),
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
        let source = self.source(pass, 0, pass.count);
        let epilogue = match ending {
            Ending::Keep => Epilogue::Bias(&self.bias),
            Ending::Relu => Epilogue::BiasRelu(&self.bias),
            Ending::AddThenRelu(other) => Epilogue::BiasAddRelu(&self.bias, other),
        };
        // Nobody looks at the outputs on the way.
        let each = (&mut vec![(); pass.count][..], |(): &mut (), _: &[f32]| {});
        self.forward
            .run(pass.machine, source, &mut output, epilogue, each);
        output
    }

    /// Passes a few pictures at a time and pools each while it is in a cache: what lies between is the largest of a network, and
    /// never needed whole.
    fn pass_pooled(&self, pass: Pass<'_>, layout: Layout, scratch: &mut Scratch) -> Planes {
        let machine = pass.machine;
        let at_once = rayon::current_num_threads().min(pass.count);
        let mut pooled = scratch.take(layout, pass.count);
        let mut raw = scratch.take(self.output, at_once);
        let mut images: Vec<&mut [f32]> = pooled
            .first_mut(pass.count)
            .chunks_exact_mut(layout.len())
            .collect();
        for (group, images) in images.chunks_mut(at_once).enumerate() {
            let source = self.source(pass, group * at_once, images.len());
            let pool = |into: &mut &mut [f32], raw: &[f32]| {
                max_pool::pool(machine, (raw, self.output), (into, layout));
            };
            let epilogue = Epilogue::BiasRelu(&self.bias);
            self.forward
                .run(machine, source, &mut raw, epilogue, (images, pool));
        }
        scratch.put(raw);
        pooled
    }

    fn source<'a>(&'a self, pass: Pass<'a>, first: usize, count: usize) -> Source<'a> {
        Source {
            weights: &self.weights,
            input: pass.input,
            first,
            count,
        }
    }
}
