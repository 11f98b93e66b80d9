//! Scaling of labels to one range, for any unit.

use serde::{Deserialize, Serialize};

use crate::error::NetworkError;

/// Method of scaling labels. Scales are computed only from the training part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LabelScaling {
    /// Scales by the range, to 0..1.
    MinMax,
    /// Standardises to a mean of 0 and a standard deviation of 1.
    Standard,
    /// No scaling.
    None,
}

/// One offset and one span for each output: scaled = (label − offset) / span.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LabelScale {
    /// Offset of each output, in the unit of the label.
    pub offset: Vec<f64>,
    /// Span of each output, in the unit of the label.
    pub span: Vec<f64>,
}

impl LabelScale {
    /// Scale that leaves labels unchanged.
    pub fn identity(outputs: usize) -> LabelScale {
        LabelScale {
            offset: vec![0.0; outputs],
            span: vec![1.0; outputs],
        }
    }

    /// Computes the scale of `labels` by the method `scaling`.
    ///
    /// # Shapes
    /// `labels`: `[samples, outputs]`.
    /// # Errors
    /// [`NetworkError::ConstantLabels`] if all labels of an output are equal, for any method.
    pub fn of(
        scaling: LabelScaling,
        labels: &[f64],
        outputs: usize,
    ) -> Result<LabelScale, NetworkError> {
        let mut scale = LabelScale::identity(outputs);
        for output in 0..outputs {
            let own = || labels.iter().skip(output).step_by(outputs).copied();
            let least = own().fold(f64::INFINITY, f64::min);
            let most = own().fold(f64::NEG_INFINITY, f64::max);
            if least >= most {
                return Err(NetworkError::ConstantLabels {
                    output,
                    value: least,
                });
            }
            let count = own().count() as f64;
            let mean = own().sum::<f64>() / count;
            let square = own()
                .map(|label| (label - mean) * (label - mean))
                .sum::<f64>();
            let (offset, span) = match scaling {
                LabelScaling::MinMax => (least, most - least),
                LabelScaling::Standard => (mean, (square / count).sqrt()),
                LabelScaling::None => continue,
            };
            (scale.offset[output], scale.span[output]) = (offset, span);
        }
        Ok(scale)
    }

    /// Scales a label of `output`.
    pub fn scaled(&self, output: usize, label: f64) -> f64 {
        (label - self.offset[output]) / self.span[output]
    }

    /// Converts a scaled value of `output` back to the unit of the label.
    pub fn unscaled(&self, output: usize, value: f64) -> f64 {
        value * self.span[output] + self.offset[output]
    }

    /// Scales all `labels`.
    pub(super) fn all_scaled(&self, labels: &[f64]) -> Vec<f64> {
        let outputs = self.span.len();
        let places = labels.iter().enumerate();
        places
            .map(|(at, label)| self.scaled(at % outputs, *label))
            .collect()
    }
}
