//! ResNet-18 in burn, on its backend for processors in Rust alone.

use burn::backend::{Autodiff, Flex};
use burn::module::{AutodiffModule, Module};
use burn::nn::conv::{Conv2d, Conv2dConfig};
use burn::nn::loss::{MseLoss, Reduction};
use burn::nn::pool::{AdaptiveAvgPool2d, AdaptiveAvgPool2dConfig, MaxPool2d, MaxPool2dConfig};
use burn::nn::{BatchNorm, BatchNormConfig, Linear, LinearConfig, PaddingConfig2d};
use burn::optim::adaptor::OptimizerAdaptor;
use burn::optim::decay::WeightDecayConfig;
use burn::optim::momentum::MomentumConfig;
use burn::optim::{GradientsParams, Optimizer, Sgd, SgdConfig};
use burn::tensor::activation::relu;
use burn::tensor::backend::Backend;
use burn::tensor::{Tensor, TensorData};

use crate::{BATCH, DECAY, Framework, MOMENTUM, OUTPUTS, RATE, Samples};

type Trained = Autodiff<Flex>;

pub struct Burn {
    network: ResNet<Trained>,
    optimizer: OptimizerAdaptor<Sgd<Flex>, ResNet<Trained>, Trained>,
    pictures: Tensor<Flex, 4>,
    labels: Tensor<Trained, 2>,
}

#[derive(Module, Debug)]
struct ResNet<B: Backend> {
    stem: Normed<B>,
    pool: MaxPool2d,
    blocks: Vec<Block<B>>,
    average: AdaptiveAvgPool2d,
    head: Linear<B>,
}

#[derive(Module, Debug)]
struct Block<B: Backend> {
    first: Normed<B>,
    second: Normed<B>,
    past: Option<Normed<B>>,
}

#[derive(Module, Debug)]
struct Normed<B: Backend> {
    convolution: Conv2d<B>,
    norm: BatchNorm<B>,
}

impl Burn {
    pub fn new(samples: &Samples) -> Burn {
        let (device, side) = (Default::default(), samples.side);
        let momentum = MomentumConfig::new()
            .with_momentum(MOMENTUM)
            .with_dampening(0.0);
        let optimizer = SgdConfig::new()
            .with_momentum(Some(momentum))
            .with_weight_decay(Some(WeightDecayConfig::new(DECAY as f32)));
        let pictures = TensorData::new(samples.pictures.clone(), [BATCH, 3, side, side]);
        let labels = TensorData::new(samples.labels.clone(), [BATCH, OUTPUTS]);
        Burn {
            network: ResNet::new(),
            optimizer: optimizer.init(),
            pictures: Tensor::from_data(pictures, &device),
            labels: Tensor::from_data(labels, &device),
        }
    }
}

impl Framework for Burn {
    fn step(&mut self) -> f32 {
        let outputs = self
            .network
            .forward(Tensor::from_inner(self.pictures.clone()));
        let loss = MseLoss::new().forward(outputs, self.labels.clone(), Reduction::Mean);
        let gradients = GradientsParams::from_grads(loss.backward(), &self.network);
        self.network = self.optimizer.step(RATE, self.network.clone(), gradients);
        loss.into_scalar()
    }

    fn predictor(&self) -> impl Fn(usize) -> Vec<f32> {
        let network = self.network.valid();
        move |count| {
            let outputs = network.forward(self.pictures.clone().narrow(0, 0, count));
            outputs.into_data().to_vec().expect("single precision")
        }
    }
}

impl<B: Backend> ResNet<B> {
    fn new() -> ResNet<B> {
        let mut blocks = Vec::new();
        let mut inputs = 64;
        for (outputs, stride) in [(64, 1), (128, 2), (256, 2), (512, 2)] {
            blocks.push(Block::new(inputs, outputs, stride));
            blocks.push(Block::new(outputs, outputs, 1));
            inputs = outputs;
        }
        let pool = MaxPool2dConfig::new([3, 3]).with_strides([2, 2]);
        ResNet {
            stem: Normed::new(3, 64, 7, 2),
            pool: pool
                .with_padding(PaddingConfig2d::Explicit(1, 1, 1, 1))
                .init(),
            blocks,
            average: AdaptiveAvgPool2dConfig::new([1, 1]).init(),
            head: LinearConfig::new(512, OUTPUTS).init(&Default::default()),
        }
    }

    fn forward(&self, pictures: Tensor<B, 4>) -> Tensor<B, 2> {
        let seen = self.pool.forward(relu(self.stem.forward(pictures)));
        let seen = self
            .blocks
            .iter()
            .fold(seen, |seen, block| block.forward(seen));
        self.head.forward(self.average.forward(seen).flatten(1, 3))
    }
}

impl<B: Backend> Block<B> {
    fn new(inputs: usize, outputs: usize, stride: usize) -> Block<B> {
        Block {
            first: Normed::new(inputs, outputs, 3, stride),
            second: Normed::new(outputs, outputs, 3, 1),
            past: (stride != 1).then(|| Normed::new(inputs, outputs, 1, stride)),
        }
    }

    fn forward(&self, seen: Tensor<B, 4>) -> Tensor<B, 4> {
        let added = self.second.forward(relu(self.first.forward(seen.clone())));
        let past = match &self.past {
            Some(past) => past.forward(seen),
            None => seen,
        };
        relu(added + past)
    }
}

impl<B: Backend> Normed<B> {
    fn new(inputs: usize, outputs: usize, kernel: usize, stride: usize) -> Normed<B> {
        let half = kernel / 2;
        let convolution = Conv2dConfig::new([inputs, outputs], [kernel; 2])
            .with_stride([stride; 2])
            .with_padding(PaddingConfig2d::Explicit(half, half, half, half))
            .with_bias(false);
        Normed {
            convolution: convolution.init(&Default::default()),
            norm: BatchNormConfig::new(outputs).init(&Default::default()),
        }
    }

    fn forward(&self, seen: Tensor<B, 4>) -> Tensor<B, 4> {
        self.norm.forward(self.convolution.forward(seen))
    }
}
