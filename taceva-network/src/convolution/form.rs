//! The forms in which convolutions can be computed.

use serde::{Deserialize, Serialize};

/// How convolutions with a kernel of 3 × 3 and a stride of 1 are computed. The forms round differently, so that results differ in last digits.
///
/// Other convolutions are direct in either form, and so are those of pictures where Winograd's would not multiply less: of 2 × 2 pixels, and
/// of one row or one column. That depends on shapes alone, never on a machine, a clock or the number of threads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ConvolutionForm {
    /// Each output is a sum of products of pixels with weights. The faster form for single pictures, as its weights are a quarter in size.
    Direct,
    /// Winograd's F(4 × 4, 3 × 3): tiles of 4 × 4 outputs with a quarter of the products. The faster form for batches, and that of training.
    ///
    /// # Reference
    /// A. Lavin, S. Gray, "Fast algorithms for convolutional neural networks", CVPR 2016; here with the points 0, ±√½, ±√2 and ∞, whose
    /// errors are smaller than those of the points of that paper, 0, ±1, ±2 and ∞.
    #[serde(rename = "winograd-4x4")]
    Winograd,
}

impl ConvolutionForm {
    /// The word in files.
    pub const fn name(self) -> &'static str {
        match self {
            ConvolutionForm::Direct => "direct",
            ConvolutionForm::Winograd => "winograd-4x4",
        }
    }

    /// The form of whatever does not say one: it is of a time when there was one only.
    pub const fn unstated() -> ConvolutionForm {
        ConvolutionForm::Direct
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
    fn files_have_the_name_that_is_shown() {
        for form in [ConvolutionForm::Direct, ConvolutionForm::Winograd] {
            let text = serde_json::to_string(&form).expect("text");
            assert_eq!(text, format!("\"{form}\""));
        }
    }
}
