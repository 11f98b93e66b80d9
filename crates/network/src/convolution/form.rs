//! The forms in which convolutions can be computed.

use serde::{Deserialize, Serialize};

use super::{Convolution, winograd};
use crate::picture::Picture;

/// Numbers of transformed weights that a tile of a picture is worth reading: of 128 channels where a picture has four tiles, of 256 where it has thirteen.
const WEIGHTS_A_TILE: usize = 3 << 16;

/// How convolutions with a kernel of 3 × 3 and a stride of 1 are computed. The forms round differently, so that results differ in last digits.
///
/// Other convolutions are direct in either form, and so are those of pictures where Winograd's would not multiply less: of 2 × 2 pixels, and
/// of one row or one column. That depends on shapes alone, never on a machine, a clock or the number of threads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ConvolutionForm {
    /// Each output is a sum of products of pixels with weights.
    Direct,
    /// Winograd's where weights are few for what a picture has of tiles, direct where most of the time would go into reading transformed weights,
    /// which are four times as many. The fastest form for single pictures.
    Mixed,
    /// Winograd's F(4 × 4, 3 × 3): tiles of 4 × 4 outputs with a quarter of the products. The faster form for batches, and that of training.
    ///
    /// # Reference
    /// A. Lavin, S. Gray, "Fast algorithms for convolutional neural networks", CVPR 2016; here with the points 0, ±√½, ±√2 and ∞, whose
    /// errors are smaller than those of the points of that paper, 0, ±1, ±2 and ∞.
    #[serde(rename = "winograd-4x4")]
    Winograd,
}

impl ConvolutionForm {
    /// Every form.
    pub const ALL: [ConvolutionForm; 3] = [
        ConvolutionForm::Direct,
        ConvolutionForm::Mixed,
        ConvolutionForm::Winograd,
    ];

    /// Whether `convolution` into pictures of `output` is Winograd's.
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

    /// The word in files.
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
        // ResNet-18 at 64² and at 112²: which of its layers, and at 2 × 2 pixels none in any form.
        assert_eq!(is_winograd(64, 16), [false, true, true]);
        assert_eq!(is_winograd(128, 8), [false, true, true]);
        assert_eq!(is_winograd(256, 4), [false, false, true]);
        assert_eq!(is_winograd(512, 2), [false, false, false]);
        assert_eq!(is_winograd(128, 14), [false, true, true]);
        assert_eq!(is_winograd(256, 7), [false, false, true]);
        // Larger pictures are worth more weights.
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
