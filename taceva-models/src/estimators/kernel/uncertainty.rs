//! Predictive standard deviations of a Gaussian process.

use crate::linalg::dot;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::{Raw, Tensors};

/// Posterior distribution of the weights of each channel.
///
/// The variance of a prediction is s² ((1 − φᵀφ) + λ φᵀ(ΦᵀΦ + λ)⁻¹φ + λ (1 + 1/n)). s² is the signal variance, and λ the noise variance divided by
/// s². φ are the Nyström features of the sample. Φ has the centred Nyström features of the n training samples as rows, and φ in the second term is
/// centred like them. The first term is the variance not explained by landmarks, the second the uncertainty of the weights. The third is the noise
/// λs² of a label and of the mean.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Uncertainty {
    /// Mean Nyström features of the training samples.
    pub(super) centre: Vec<f64>,
    /// Eigenvectors of the scatter matrix of the centred Nyström features of the training samples, one after another.
    pub(super) vectors: Vec<f64>,
    /// Eigenvalues in the order of `vectors`.
    pub(super) eigenvalues: Vec<f64>,
    /// Ratio λ of each channel: noise variance divided by signal variance.
    pub(super) ratio: Vec<f64>,
    /// Signal variance s² of each channel, in the squared unit of the channel.
    pub(super) signal: Vec<f64>,
    /// Noise term λ (1 + 1/n) of each channel. λ is the value in `ratio`, and n the number of training samples.
    pub(super) noise: Vec<f64>,
}

const CENTRE: &str = "posterior.centre";
const VECTORS: &str = "posterior.vectors";
const EIGENVALUES: &str = "posterior.eigenvalues";
const RATIO: &str = "posterior.ratio";
const SIGNAL: &str = "posterior.signal";
const NOISE: &str = "posterior.noise";

impl Uncertainty {
    /// Writes the standard deviation of each channel's prediction for a sample with Nyström features `mapped`.
    pub(super) fn write(&self, mapped: &[f32], into: &mut [f64]) {
        let own: f64 = mapped.iter().map(|&value| f64::from(value).powi(2)).sum();
        let centred: Vec<f64> = mapped
            .iter()
            .zip(&self.centre)
            .map(|(&value, centre)| f64::from(value) - centre)
            .collect();
        let along: Vec<f64> = self
            .vectors
            .chunks_exact(centred.len())
            .map(|vector| dot(vector, &centred).powi(2))
            .collect();
        let unseen = (dot(&centred, &centred) - along.iter().sum::<f64>()).max(0.0);
        let unexplained = (1.0 - own).max(0.0);
        for (channel, place) in into.iter_mut().enumerate() {
            let ratio = self.ratio[channel];
            let seen = along.iter().zip(&self.eigenvalues);
            let open: f64 = seen
                .map(|(along, value)| along * ratio / (value + ratio))
                .sum();
            let share = unexplained + open + unseen + self.noise[channel];
            *place = (self.signal[channel] * share).sqrt();
        }
    }

    /// Multiplies the predictive standard deviations of each channel by its factor in `reaches`.
    pub(super) fn reaching(mut self, reaches: &[f64]) -> Uncertainty {
        let signals = self.signal.iter_mut().zip(reaches);
        signals.for_each(|(signal, reach)| *signal *= reach * reach);
        self
    }

    pub(super) fn tensors(&self) -> Vec<Raw> {
        let list = |name, values: &[f64]| Raw::doubles(name, vec![values.len()], values);
        let shape = vec![self.eigenvalues.len(), self.centre.len()];
        vec![
            list(CENTRE, &self.centre),
            list(EIGENVALUES, &self.eigenvalues),
            list(NOISE, &self.noise),
            list(RATIO, &self.ratio),
            list(SIGNAL, &self.signal),
            Raw::doubles(VECTORS, shape, &self.vectors),
        ]
    }

    /// Reads the posterior of a model with `count` landmarks from its file; `None` if the file contains no posterior.
    pub(super) fn from_tensors(
        tensors: &Tensors<'_>,
        count: usize,
        channels: usize,
    ) -> Result<Option<Uncertainty>, FormatError> {
        if !tensors.has(VECTORS) {
            return Ok(None);
        }
        let known = tensors.rows(VECTORS)?;
        let found = Uncertainty {
            centre: tensors.doubles(CENTRE, &[count])?,
            vectors: tensors.doubles(VECTORS, &[known, count])?,
            eigenvalues: tensors.doubles(EIGENVALUES, &[known])?,
            ratio: tensors.doubles(RATIO, &[channels])?,
            signal: tensors.doubles(SIGNAL, &[channels])?,
            noise: tensors.doubles(NOISE, &[channels])?,
        };
        let finite = [&found.centre, &found.vectors, &found.eigenvalues];
        let positive = [&found.ratio, &found.noise];
        let valid = finite.into_iter().flatten().all(|value| value.is_finite())
            && found
                .eigenvalues
                .iter()
                .chain(&found.signal)
                .all(|value| *value >= 0.0)
            && positive.into_iter().flatten().all(|value| *value > 0.0);
        if valid {
            Ok(Some(found))
        } else {
            Err(FormatError::Card)
        }
    }
}
