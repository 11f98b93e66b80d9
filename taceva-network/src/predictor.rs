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
use crate::stage::Stage;

/// A network ready to predict, and the room that it needs.
#[derive(Debug)]
pub struct Predictor {
    machine: Machine,
    input: Planes,
    stages: Vec<Folded>,
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
    output: Planes,
}

/// A part of the network.
#[derive(Debug)]
enum Folded {
    Stem(Layer, Planes),
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
            stages.push(Folded::new(stage, layout, border, batch));
            layout = Layout {
                picture: output,
                border,
            };
        }
        Predictor {
            machine: self.machine,
            input,
            stages,
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
        let machine = self.machine;
        for position in 0..self.stages.len() {
            let (before, rest) = self.stages.split_at_mut(position);
            let input = before.last().map_or(&self.input, Folded::output);
            rest[0].pass(machine, (input, count));
        }
        let last = self.stages.last().expect("an architecture has stages");
        self.head.see((last.output(), count), &mut self.features);
        self.head.forward(&self.features, &mut self.outputs);
        &self.outputs
    }
}

impl Folded {
    fn new(stage: &Stage, input: Layout, border: usize, batch: usize) -> Folded {
        match stage {
            Stage::Stem(normed) => {
                let layer = Layer::new(normed, input, 0, batch);
                let pooled = max_pool::output(layer.output.layout().picture);
                Folded::Stem(layer, Planes::zeros(pooled, border, batch))
            }
            Stage::Plain(normed) => Folded::Plain(Layer::new(normed, input, border, batch)),
            Stage::Block(block) => {
                let first = Layer::new(&block.first, input, 1, batch);
                let middle = first.output.layout();
                // What leads past lies as the output does, so that the two can be added.
                let past = block.shortcut.as_ref();
                Folded::Block(Box::new(FoldedBlock {
                    second: Layer::new(&block.second, middle, border, batch),
                    shortcut: past.map(|past| Layer::new(past, input, border, batch)),
                    first,
                }))
            }
        }
    }

    fn output(&self) -> &Planes {
        match self {
            Folded::Stem(_, output) => output,
            Folded::Plain(layer) => &layer.output,
            Folded::Block(block) => &block.second.output,
        }
    }

    fn pass(&mut self, machine: Machine, input: (&Planes, usize)) {
        match self {
            Folded::Stem(layer, pooled) => {
                layer.pass(machine, input, Ending::Relu);
                max_pool::pool(machine, (&layer.output, input.1), pooled);
            }
            Folded::Plain(layer) => layer.pass(machine, input, Ending::Relu),
            Folded::Block(block) => {
                let FoldedBlock {
                    first,
                    second,
                    shortcut,
                } = &mut **block;
                first.pass(machine, input, Ending::Relu);
                let past = match shortcut {
                    Some(layer) => {
                        layer.pass(machine, input, Ending::Keep);
                        &layer.output
                    }
                    None => input.0,
                };
                second.pass(machine, (&first.output, input.1), Ending::AddThenRelu(past));
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
    fn new(normed: &Normed, input: Layout, border: usize, batch: usize) -> Layer {
        let convolution = normed.convolution();
        let output = Planes::zeros(convolution.output(input.picture), border, batch);
        let (weights, bias) = normed.fold();
        let forward = Forward::new(convolution, input, output.layout());
        Layer {
            weights,
            bias,
            forward,
            output,
        }
    }

    fn pass(&mut self, machine: Machine, (input, count): (&Planes, usize), ending: Ending<'_>) {
        let source = Source {
            weights: &self.weights,
            input,
            count,
        };
        let epilogue = match ending {
            Ending::Keep => Epilogue::Bias(&self.bias),
            Ending::Relu => Epilogue::BiasRelu(&self.bias),
            Ending::AddThenRelu(other) => Epilogue::BiasAddRelu(&self.bias, other),
        };
        // Nobody looks at the outputs on the way.
        let each = (&mut vec![(); count][..], |(): &mut (), _: &[f32]| {});
        self.forward
            .run(machine, source, &mut self.output, epilogue, each);
    }
}
