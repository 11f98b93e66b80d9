//! Loss functions and their gradients.

use serde::{Deserialize, Serialize};

use crate::labels::Labels;

/// Loss function, averaged over samples and outputs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Loss {
    /// Squared error: (output − label)².
    SquaredError,
    /// Huber's loss of the difference d = output − label: d² / 2 for |d| up to `delta`, otherwise delta · (|d| − delta / 2).
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
    /// `outputs`, `gradient`: `[samples, width]`, with `width` outputs per sample.
    /// # Panics
    /// If cross entropy is applied to numbers, or another loss to classes. [`Trainer`](crate::Trainer) rejects both cases.
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
                cross_entropy(outputs, width, classes, &[], gradient)
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

/// Mean cross entropy of the softmax of `outputs`, and its gradient. Each sample has the weight of its class, or weight 1 if `weights` is empty.
///
/// # Shapes
/// `outputs`, `gradient`: `[samples, width]`, with `width` outputs per sample; `weights`: `[width]`, or empty.
pub(crate) fn cross_entropy(
    outputs: &[f64],
    width: usize,
    classes: &[u32],
    weights: &[f64],
    gradient: &mut Vec<f64>,
) -> f64 {
    gradient.clear();
    let weight = |class: u32| weights.get(class as usize).copied().unwrap_or(1.0);
    let total: f64 = classes.iter().map(|class| weight(*class)).sum();
    let mut loss = 0.0;
    for (outputs, class) in outputs.chunks_exact(width).zip(classes) {
        let weight = weight(*class);
        let most = outputs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = outputs.iter().map(|output| (output - most).exp()).sum();
        loss += weight * (sum.ln() + most - outputs[*class as usize]);
        gradient.extend(outputs.iter().enumerate().map(|(place, output)| {
            let is_class = f64::from(u8::from(place == *class as usize));
            weight * ((output - most).exp() / sum - is_class) / total
        }));
    }
    loss / total
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Outputs of three samples of three classes.
    const OUTPUTS: [f64; 9] = [0.5, -1.0, 0.25, 1.5, 0.0, -0.5, 0.1, 0.2, 0.3];
    const CLASSES: [u32; 3] = [0, 2, 2];

    #[test]
    fn a_class_of_weight_two_counts_as_if_its_samples_were_there_twice() {
        let (mut weighted, mut twice) = (Vec::new(), Vec::new());
        let loss = cross_entropy(&OUTPUTS, 3, &CLASSES, &[1.0, 1.0, 2.0], &mut weighted);
        let repeated = [&OUTPUTS[..], &OUTPUTS[3..]].concat();
        let expected = cross_entropy(&repeated, 3, &[0, 2, 2, 2, 2], &[], &mut twice);
        assert!((loss - expected).abs() < 1e-12, "{loss} for {expected}");
        for (place, found) in weighted.iter().enumerate() {
            let times = if place < 3 { 1.0 } else { 2.0 };
            assert!((found - times * twice[place]).abs() < 1e-12, "{place}");
        }
    }

    #[test]
    fn the_gradient_of_weighted_cross_entropy_is_that_of_finite_differences() {
        let weights = [0.5, 3.0, 1.5];
        let mut gradient = Vec::new();
        cross_entropy(&OUTPUTS, 3, &CLASSES, &weights, &mut gradient);
        for place in 0..OUTPUTS.len() {
            let at = |step: f64| {
                let mut moved = OUTPUTS;
                moved[place] += step;
                cross_entropy(&moved, 3, &CLASSES, &weights, &mut Vec::new())
            };
            let expected = (at(1e-5) - at(-1e-5)) / 2e-5;
            assert!((gradient[place] - expected).abs() < 1e-8, "{place}");
        }
    }
}
