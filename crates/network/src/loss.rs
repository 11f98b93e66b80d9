//! Loss functions and their gradients.

use serde::{Deserialize, Serialize};

use crate::labels::Labels;

/// Loss function, averaged over samples and outputs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Loss {
    /// Squared error: (output − label)².
    SquaredError,
    /// Huber's loss: half the squared distance up to `delta`; beyond `delta`, delta · (|distance| − delta / 2).
    ///
    /// # Reference
    /// P. J. Huber, "Robust estimation of a location parameter", Ann. Math. Statist. 35, 1964.
    Huber {
        /// Upper limit of the quadratic part, in the unit of the scaled labels.
        delta: f64,
    },
    /// Cross entropy: −ln of the softmax of the outputs at the class, averaged over samples.
    CrossEntropy,
}

impl Loss {
    /// Computes the loss of some samples, and writes the gradient of the loss.
    ///
    /// # Shapes
    /// `outputs`, `gradient`: `[samples, width]`.
    /// # Panics
    /// If a distance loss is applied to classes, or cross entropy is applied to numbers. [`Trainer`](crate::Trainer) rejects both cases.
    pub fn measure(
        self,
        outputs: &[f64],
        width: usize,
        truth: Labels<'_>,
        gradient: &mut Vec<f64>,
    ) -> f64 {
        gradient.clear();
        let count = outputs.len() as f64;
        match (self, truth) {
            (Loss::CrossEntropy, Labels::Classes(classes)) => {
                let samples = classes.len() as f64;
                let mut loss = 0.0;
                for (outputs, class) in outputs.chunks_exact(width).zip(classes) {
                    let most = outputs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                    let sum: f64 = outputs.iter().map(|output| (output - most).exp()).sum();
                    loss += sum.ln() + most - outputs[*class as usize];
                    gradient.extend(outputs.iter().enumerate().map(|(place, output)| {
                        let is_class = f64::from(u8::from(place == *class as usize));
                        ((output - most).exp() / sum - is_class) / samples
                    }));
                }
                loss / samples
            }
            (Loss::SquaredError, Labels::Values(labels)) => {
                let mut loss = 0.0;
                for (output, label) in outputs.iter().zip(labels) {
                    let distance = output - label;
                    loss += distance * distance;
                    gradient.push(2.0 * distance / count);
                }
                loss / count
            }
            (Loss::Huber { delta }, Labels::Values(labels)) => {
                let mut loss = 0.0;
                for (output, label) in outputs.iter().zip(labels) {
                    let distance = output - label;
                    loss += if distance.abs() <= delta {
                        0.5 * distance * distance
                    } else {
                        delta * (distance.abs() - 0.5 * delta)
                    };
                    gradient.push(distance.clamp(-delta, delta) / count);
                }
                loss / count
            }
            (Loss::CrossEntropy, Labels::Values(_)) | (_, Labels::Classes(_)) => {
                unreachable!("a recipe is checked against the labels")
            }
        }
    }
}
