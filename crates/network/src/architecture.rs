//! Layers of a network, described as data.

mod pooling;
mod stage_plan;

pub use self::pooling::Pooling;
pub use self::stage_plan::StagePlan;

use serde::{Deserialize, Serialize};

use crate::convolution::Convolution;
use crate::error::NetworkError;
use crate::panel::PANEL;
use crate::picture::Picture;

/// Layers of a network, and the shapes of its input and output.
///
/// ```
/// use taceva_network::{Architecture, Depth, Picture};
/// let input = Picture { height: 64, width: 64, channels: 3 };
/// let architecture = Architecture::residual(Depth::Eighteen, input, 6);
/// // The same number as torchvision's resnet18 with six outputs.
/// assert_eq!(architecture.parameters()?, 11_179_590);
/// # Ok::<(), taceva_network::NetworkError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Architecture {
    /// Shape of an input picture.
    pub input: Picture,
    /// Layers that convert a picture to features.
    pub body: Body,
    /// Number of outputs predicted for each picture.
    pub outputs: usize,
}

/// Layers that convert a picture to features.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Body {
    /// A stem of 7 × 7 with pooling, four stages of residual blocks, then the mean over pixels.
    ///
    /// # Reference
    /// K. He, X. Zhang, S. Ren, J. Sun, "Deep residual learning for image recognition", CVPR 2016. Layers and names follow torchvision's `resnet`.
    Residual(Depth),
    /// A sequence of convolutions, each followed by batch normalisation and ReLU.
    Plain {
        /// Convolutions in order. The first convolution reads the picture.
        layers: Vec<PlainLayer>,
        /// Reduction of the last convolution's pictures to features.
        pooling: Pooling,
    },
}

/// Number of layers of a residual network.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Depth {
    /// One block per stage.
    Ten,
    /// Two blocks per stage.
    Eighteen,
    /// Three, four, six and three blocks in the four stages.
    ThirtyFour,
}

/// One convolution of a plain network.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlainLayer {
    /// Number of output channels, a multiple of 16.
    pub channels: usize,
    /// Side of the square kernel, in pixels; an odd number.
    pub kernel: usize,
    /// Stride, in pixels.
    pub stride: usize,
}

impl Depth {
    const fn blocks(self) -> [usize; 4] {
        match self {
            Depth::Ten => [1, 1, 1, 1],
            Depth::Eighteen => [2, 2, 2, 2],
            Depth::ThirtyFour => [3, 4, 6, 3],
        }
    }
}

/// Maximum number of values of any picture in a network, which ensures that offsets fit into 32 bits.
const PICTURE_MAX: usize = 1 << 28;

impl Architecture {
    /// Creates a residual network.
    pub const fn residual(depth: Depth, input: Picture, outputs: usize) -> Architecture {
        let body = Body::Residual(depth);
        Architecture {
            input,
            body,
            outputs,
        }
    }

    /// Creates the small network of five convolutions of stride 2. Every value of every pixel of the last picture is a feature, so outputs can depend on
    /// positions in the picture.
    pub fn five_layers(input: Picture, outputs: usize) -> Architecture {
        let layer = |channels, kernel| PlainLayer {
            channels,
            kernel,
            stride: 2,
        };
        let layers = vec![
            layer(16, 5),
            layer(32, 3),
            layer(48, 3),
            layer(64, 3),
            layer(96, 3),
        ];
        let pooling = Pooling::Flatten;
        Architecture {
            input,
            body: Body::Plain { layers, pooling },
            outputs,
        }
    }

    /// Number of trainable parameters: weights, gains and biases.
    ///
    /// # Errors
    /// [`NetworkError::Architecture`] if the architecture is invalid.
    pub fn parameters(&self) -> Result<usize, NetworkError> {
        self.check()?;
        let mut picture = self.input;
        let mut count = 0;
        for stage in self.stages() {
            count += stage.parameters(picture.channels);
            picture = stage.output(picture);
        }
        let features = self.pooling().features(picture) as u128;
        count += (features + 1) * self.outputs as u128;
        usize::try_from(count).map_err(|_| NetworkError::Architecture {
            reason: format!("{count} parameters, which exceed the address space"),
        })
    }

    /// Checks the settings of the layers, and the sizes of their pictures.
    ///
    /// # Errors
    /// [`NetworkError::Architecture`] with the first fault found.
    pub fn check(&self) -> Result<(), NetworkError> {
        let refuse = |reason: String| Err(NetworkError::Architecture { reason });
        if self.input.is_empty() || self.outputs == 0 {
            return refuse(format!(
                "input pictures of {} and {} outputs; expected sizes and outputs above 0",
                self.input, self.outputs
            ));
        }
        if let Body::Plain { layers, .. } = &self.body {
            if layers.is_empty() {
                return refuse("a plain network has no layers, expected at least one".into());
            }
            for (position, layer) in layers.iter().enumerate() {
                let is_odd = layer.kernel % 2 == 1 && layer.kernel <= 15;
                if layer.channels == 0
                    || !layer.channels.is_multiple_of(PANEL)
                    || !is_odd
                    || layer.stride == 0
                {
                    return refuse(format!(
                        "layer {position}: {} channels, kernel {}, stride {}; expected a multiple of {PANEL} channels, an odd kernel of \
                            at most 15, a stride of at least 1",
                        layer.channels, layer.kernel, layer.stride
                    ));
                }
            }
        }
        let sizes = [self.input.height, self.input.width, self.input.channels];
        if sizes.into_iter().any(|size| size > PICTURE_MAX) {
            return refuse(format!(
                "pictures of {}: expected sides and channels of at most {PICTURE_MAX}",
                self.input
            ));
        }
        let mut picture = self.input;
        for stage in self.stages() {
            // The largest picture of a stage is the input or the output of its first convolution.
            let Convolution {
                outputs, stride, ..
            } = stage.first(picture.channels);
            let convolved = Picture {
                height: (picture.height - 1) / stride + 1,
                width: (picture.width - 1) / stride + 1,
                channels: outputs,
            };
            for picture in [picture, convolved] {
                let numbers = (picture.height + 16)
                    .checked_mul(picture.width + 16)
                    .and_then(|pixels| pixels.checked_mul(picture.channels));
                if numbers.is_none_or(|numbers| numbers > PICTURE_MAX) {
                    return refuse(format!(
                        "pictures of {picture} within the network: expected at most {PICTURE_MAX} numbers with borders"
                    ));
                }
            }
            picture = stage.output(picture);
        }
        Ok(())
    }

    /// Plans of the network's stages, in order.
    pub fn stages(&self) -> Vec<StagePlan> {
        match &self.body {
            Body::Plain { layers, .. } => layers.iter().copied().map(StagePlan::Plain).collect(),
            Body::Residual(depth) => {
                let mut stages = vec![StagePlan::Stem { channels: 64 }];
                for (stage, blocks) in depth.blocks().into_iter().enumerate() {
                    stages.extend((0..blocks).map(|block| StagePlan::Block {
                        channels: 64 << stage,
                        stride: if stage > 0 && block == 0 { 2 } else { 1 },
                    }));
                }
                stages
            }
        }
    }

    /// Prefixes of the tensor names for each stage.
    pub fn stage_names(&self) -> Vec<String> {
        match &self.body {
            Body::Plain { layers, .. } => (0..layers.len())
                .map(|layer| format!("features.{layer}."))
                .collect(),
            Body::Residual(depth) => {
                let blocks = depth
                    .blocks()
                    .into_iter()
                    .enumerate()
                    .flat_map(|(stage, blocks)| {
                        (0..blocks).map(move |block| format!("layer{}.{block}.", stage + 1))
                    });
                std::iter::once(String::new()).chain(blocks).collect()
            }
        }
    }

    /// Reduction of the last convolution's pictures to features.
    pub fn pooling(&self) -> Pooling {
        match self.body {
            Body::Residual(_) => Pooling::Average,
            Body::Plain { pooling, .. } => pooling,
        }
    }
}
