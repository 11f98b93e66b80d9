//! ResNet-18 in candle.
//!
//! Its gradients know pooling only where windows do not overlap, so the pooling of the first stage is 2 × 2 here where it is 3 × 3
//! elsewhere: less work, and pictures of the same size behind it.

use candle_core::backprop::GradStore;
use candle_core::{DType, Device, Result, Tensor, Var};
use candle_nn::{
    BatchNorm, Conv2d, Conv2dConfig, Linear, Module, VarBuilder, VarMap, batch_norm,
    conv2d_no_bias, linear,
};

use crate::{BATCH, DECAY, Framework, MOMENTUM, OUTPUTS, RATE, Samples};

pub struct Candle {
    network: ResNet<Normed>,
    weights: Vec<Var>,
    velocities: Vec<Tensor>,
    pictures: Tensor,
    labels: Tensor,
}

/// A network of convolutions `C`.
struct ResNet<C> {
    stem: C,
    blocks: Vec<Block<C>>,
    head: Linear,
}

struct Block<C> {
    first: C,
    second: C,
    past: Option<C>,
}

struct Normed {
    convolution: Conv2d,
    norm: BatchNorm,
}

impl Candle {
    pub fn new(samples: &Samples) -> Result<Candle> {
        let (device, side) = (Device::Cpu, samples.side);
        let variables = VarMap::new();
        let place = VarBuilder::from_varmap(&variables, DType::F32, &device);
        let network = ResNet::new(&place)?;
        // All but running moments, which have no gradient.
        let named = variables.data().lock().expect("one thread").clone();
        let learnt = named
            .into_iter()
            .filter(|(name, _)| !name.contains("running"));
        let weights: Vec<Var> = learnt.map(|(_, variable)| variable).collect();
        Ok(Candle {
            network,
            velocities: weights
                .iter()
                .map(|weight| weight.zeros_like())
                .collect::<Result<_>>()?,
            weights,
            pictures: Tensor::from_slice(&samples.pictures, (BATCH, 3, side, side), &device)?,
            labels: Tensor::from_slice(&samples.labels, (BATCH, OUTPUTS), &device)?,
        })
    }

    fn try_step(&mut self) -> Result<f32> {
        let outputs = self.network.forward(&self.pictures)?;
        let loss = candle_nn::loss::mse(&outputs, &self.labels)?;
        self.descend(&loss.backward()?)?;
        loss.to_scalar()
    }

    /// SGD of candle has no momentum.
    fn descend(&mut self, gradients: &GradStore) -> Result<()> {
        for (weight, velocity) in self.weights.iter().zip(&mut self.velocities) {
            let gradient = gradients
                .get(weight)
                .expect("the loss depends on every weight");
            let pull = (gradient + (weight.as_tensor() * DECAY)?)?;
            *velocity = ((&*velocity * MOMENTUM)? + pull)?.detach();
            weight.set(&(weight.as_tensor() - (&*velocity * RATE)?)?)?;
        }
        Ok(())
    }
}

impl Framework for Candle {
    fn step(&mut self) -> f32 {
        self.try_step().expect("a step")
    }

    fn predictor(&self) -> impl Fn(usize) -> Vec<f32> {
        let network = self.network.folded().expect("a network");
        let predict = move |count| -> Result<Vec<f32>> {
            let outputs = network.forward(&self.pictures.narrow(0, 0, count)?)?;
            outputs.flatten_all()?.to_vec1()
        };
        move |count| predict(count).expect("a prediction")
    }
}

impl ResNet<Normed> {
    fn new(place: &VarBuilder) -> Result<ResNet<Normed>> {
        let mut blocks = Vec::new();
        let mut inputs = 64;
        for (outputs, stride) in [(64, 1), (128, 2), (256, 2), (512, 2)] {
            for (inputs, stride) in [(inputs, stride), (outputs, 1)] {
                let place = place.pp(blocks.len());
                let past = (stride != 1)
                    .then(|| Normed::new(&place.pp("past"), inputs, outputs, 1, stride));
                blocks.push(Block {
                    first: Normed::new(&place.pp("first"), inputs, outputs, 3, stride)?,
                    second: Normed::new(&place.pp("second"), outputs, outputs, 3, 1)?,
                    past: past.transpose()?,
                });
            }
            inputs = outputs;
        }
        Ok(ResNet {
            stem: Normed::new(&place.pp("stem"), 3, 64, 7, 2)?,
            blocks,
            head: linear(512, OUTPUTS, place.pp("head"))?,
        })
    }

    /// The same with running moments folded into the convolutions.
    fn folded(&self) -> Result<ResNet<Conv2d>> {
        let blocks = self.blocks.iter().map(|block| {
            Ok(Block {
                first: block.first.folded()?,
                second: block.second.folded()?,
                past: block.past.as_ref().map(Normed::folded).transpose()?,
            })
        });
        Ok(ResNet {
            stem: self.stem.folded()?,
            blocks: blocks.collect::<Result<_>>()?,
            head: self.head.clone(),
        })
    }
}

impl<C: Module> Module for ResNet<C> {
    fn forward(&self, pictures: &Tensor) -> Result<Tensor> {
        let seen = self.stem.forward(pictures)?.relu()?.max_pool2d(2)?;
        let seen = self
            .blocks
            .iter()
            .try_fold(seen, |seen, block| block.forward(&seen))?;
        self.head.forward(&seen.mean((2, 3))?)
    }
}

impl<C: Module> Module for Block<C> {
    fn forward(&self, seen: &Tensor) -> Result<Tensor> {
        let added = self.second.forward(&self.first.forward(seen)?.relu()?)?;
        let past = match &self.past {
            Some(past) => past.forward(seen)?,
            None => seen.clone(),
        };
        (added + past)?.relu()
    }
}

impl Normed {
    fn new(
        place: &VarBuilder,
        inputs: usize,
        outputs: usize,
        kernel: usize,
        stride: usize,
    ) -> Result<Normed> {
        let config = Conv2dConfig {
            stride,
            padding: kernel / 2,
            ..Conv2dConfig::default()
        };
        Ok(Normed {
            convolution: conv2d_no_bias(inputs, outputs, kernel, config, place.pp("convolution"))?,
            norm: batch_norm(outputs, 1e-5, place.pp("norm"))?,
        })
    }

    fn folded(&self) -> Result<Conv2d> {
        self.convolution.absorb_bn(&self.norm)
    }
}

/// Normalised by the moments of the batch.
impl Module for Normed {
    fn forward(&self, seen: &Tensor) -> Result<Tensor> {
        self.norm.forward_train(&self.convolution.forward(seen)?)
    }
}
