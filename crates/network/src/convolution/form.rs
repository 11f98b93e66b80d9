//! Algorithms for convolutions.

use serde::{Deserialize, Serialize};

use super::{Convolution, winograd};
use crate::picture::Picture;

/// Maximum number of transformed weights per tile of a picture for Winograd's algorithm in [`ConvolutionForm::Mixed`]. Layers of 128 channels need at
/// least 4 tiles, layers of 256 channels at least 13.
const WEIGHTS_A_TILE: usize = 3 << 16;

/// Algorithm for convolutions with a 3 × 3 kernel and stride 1. The algorithms round differently, so results differ in the last digits.
///
/// Every variant computes other convolutions directly. Direct computation is also used for pictures where Winograd's algorithm saves no products: 2 × 2 pixels,
/// one row or one column. The choice depends only on shapes, never on machine, clock or number of threads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ConvolutionForm {
    /// Sums of products of pixels and weights.
    Direct,
    /// Winograd's algorithm if the weights are few compared to the tiles of a picture, otherwise direct. Transformed weights are four times as many, and
    /// reading them would take most of the time. Fastest for single pictures.
    Mixed,
    /// Winograd's F(4 × 4, 3 × 3): tiles of 4 × 4 outputs with a quarter of the products. Fastest for batches, and used in training.
    ///
    /// # Reference
    /// A. Lavin, S. Gray, "Fast algorithms for convolutional neural networks", CVPR 2016. The points used here, 0, ±√½, ±√2 and ∞, have smaller
    /// errors than the paper's points 0, ±1, ±2 and ∞.
    #[serde(rename = "winograd-4x4")]
    Winograd,
}

impl ConvolutionForm {
    /// All algorithms.
    pub const ALL: [ConvolutionForm; 3] = [
        ConvolutionForm::Direct,
        ConvolutionForm::Mixed,
        ConvolutionForm::Winograd,
    ];

    /// True if `convolution` into pictures of shape `output` uses Winograd's algorithm.
    pub(super) fn is_winograd(self, convolution: Convolution, output: Picture) -> bool {
        winograd::is_for(convolution, output)
            && match self {
                ConvolutionForm::Direct => false,
                ConvolutionForm::Mixed => {
                    let Convolution {
                        inputs, outputs, ..
                    } = convolution;
                    let weights = winograd::transformed_len(inputs, outputs);
                    weights <= WEIGHTS_A_TILE * winograd::tiles(output)
                }
                ConvolutionForm::Winograd => true,
            }
    }

    /// Name of the algorithm in files.
    pub const fn name(self) -> &'static str {
        match self {
            ConvolutionForm::Direct => "direct",
            ConvolutionForm::Mixed => "mixed",
            ConvolutionForm::Winograd => "winograd-4x4",
        }
    }
}

impl std::fmt::Display for ConvolutionForm {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_pictures_are_direct_where_they_have_few_tiles_for_many_weights() {
        let is_winograd = |channels, side| {
            let convolution = Convolution {
                inputs: channels,
                outputs: channels,
                kernel: 3,
                stride: 1,
            };
            let output = Picture {
                height: side,
                width: side,
                channels,
            };
            let forms = ConvolutionForm::ALL;
            forms.map(|form| form.is_winograd(convolution, output))
        };
        // ResNet-18 at 64² and at 112², by layer. At 2 × 2 pixels no form selects Winograd's.
        assert_eq!(is_winograd(64, 16), [false, true, true]);
        assert_eq!(is_winograd(128, 8), [false, true, true]);
        assert_eq!(is_winograd(256, 4), [false, false, true]);
        assert_eq!(is_winograd(512, 2), [false, false, false]);
        assert_eq!(is_winograd(128, 14), [false, true, true]);
        assert_eq!(is_winograd(256, 7), [false, false, true]);
        // Larger pictures allow more weights.
        assert_eq!(is_winograd(256, 28), [false, true, true]);
        assert_eq!(is_winograd(512, 4), [false, false, true]);
    }

    #[test]
    fn files_have_the_name_that_is_shown() {
        for form in ConvolutionForm::ALL {
            let text = serde_json::to_string(&form).expect("text");
            assert_eq!(text, format!("\"{form}\""));
        }
    }
}
