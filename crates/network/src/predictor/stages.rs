//! Stages of a predictor: convolutions with bias. The running moments are folded into weights and bias.

use super::layer::{Ending, Layer, Pass};
use crate::convolution::ConvolutionForm;
use crate::max_pool;
use crate::planes::{Layout, Planes};
use crate::scratch::Scratch;
use crate::stage::Stage;

/// One stage of a predictor.
#[derive(Debug)]
pub(super) enum Folded {
    /// A convolution, and the layout of its pooled output.
    Stem(Layer, Layout),
    Plain(Layer),
    Block(Box<FoldedBlock>),
}

/// Two convolutions, and the convolution of the shortcut if the picture shape changes.
#[derive(Debug)]
pub(super) struct FoldedBlock {
    first: Layer,
    second: Layer,
    shortcut: Option<Layer>,
}

impl Folded {
    pub(super) fn new(
        stage: &Stage,
        input: Layout,
        border: usize,
        form: ConvolutionForm,
    ) -> Folded {
        let layer = |normed, input, border| Layer::new(normed, input, border, form);
        match stage {
            Stage::Stem(normed) => {
                let layer = layer(normed, input, 0);
                let picture = max_pool::output(layer.output().picture);
                Folded::Stem(layer, Layout { picture, border })
            }
            Stage::Plain(normed) => Folded::Plain(layer(normed, input, border)),
            Stage::Block(block) => {
                let first = layer(&block.first, input, 1);
                // The shortcut has the layout of the output, so both can be added.
                let past = block.shortcut.as_ref();
                Folded::Block(Box::new(FoldedBlock {
                    second: layer(&block.second, first.output(), border),
                    shortcut: past.map(|past| layer(past, input, border)),
                    first,
                }))
            }
        }
    }

    /// Memory layout of the output.
    pub(super) fn output(&self) -> Layout {
        match self {
            Folded::Stem(_, pooled) => *pooled,
            Folded::Plain(layer) => layer.output(),
            Folded::Block(block) => block.second.output(),
        }
    }

    /// True if the stage has few weights and large pictures.
    pub(super) fn is_light(&self) -> bool {
        match self {
            Folded::Stem(layer, _) | Folded::Plain(layer) => layer.is_light(),
            Folded::Block(block) => block.first.is_light() && block.second.is_light(),
        }
    }

    /// Number of multiplications per picture in the direct algorithm.
    pub(super) fn products(&self) -> usize {
        match self {
            Folded::Stem(layer, _) | Folded::Plain(layer) => layer.products(),
            Folded::Block(block) => {
                let past = block.shortcut.as_ref().map_or(0, Layer::products);
                block.first.products() + block.second.products() + past
            }
        }
    }

    /// All convolutions of the stage.
    pub(super) fn layers_mut(&mut self) -> Vec<&mut Layer> {
        match self {
            Folded::Stem(layer, _) | Folded::Plain(layer) => vec![layer],
            Folded::Block(block) => {
                let FoldedBlock {
                    first,
                    second,
                    shortcut,
                } = &mut **block;
                let both = [first, second];
                both.into_iter().chain(shortcut.as_mut()).collect()
            }
        }
    }

    /// Runs the stage into a buffer of `scratch`.
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
