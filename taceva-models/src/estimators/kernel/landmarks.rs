//! Selection of landmarks: training samples with which every sample is compared.

use rayon::prelude::*;
use taceva_core::{Features, ModelError, Progress};

use crate::linalg::distance::from_all;
use crate::linalg::progress::{ReportedStage, interrupted};
use crate::linalg::standard::Standard;
use crate::linalg::{FeatureScale, dot};

/// Kernel length used to choose landmarks.
const LENGTH: f64 = 1.0;

/// Least share of a sample's kernel that earlier landmarks must leave unexplained before it can become a landmark. Smaller shares are rounding errors
/// of single precision.
pub(super) const EXPLAINED: f64 = 1e-5;

/// Number of samples per task of a thread.
const CHUNK: usize = 64;

/// Landmarks, and the distances of all training samples from them.
///
/// Landmarks are chosen by pivoted Cholesky decomposition: first the sample nearest to the mean, then repeatedly the sample whose kernel the chosen
/// landmarks explain least. The choice is deterministic. The order of samples matters only between equally good samples.
///
/// # Reference
/// S. Fine, K. Scheinberg, J. Mach. Learn. Res. 2 (2001) 243.
#[derive(Debug)]
pub(super) struct Landmarks {
    pub(super) standard: Standard,
    /// Variance D of the training samples, summed over the features.
    pub(super) variance: f64,
    /// Indices of the landmarks among the training samples.
    pub(super) chosen: Vec<usize>,
    /// Standardised features of the landmarks, shape `[landmarks, features]`.
    pub(super) rows: Vec<f32>,
    /// Squared distances of training samples from landmarks, shape `[samples, landmarks]`.
    pub(super) distances: Vec<f32>,
}

impl Landmarks {
    pub(super) fn choose(
        training: &Features,
        scale: FeatureScale,
        most: usize,
        progress: &dyn Progress,
    ) -> Result<Landmarks, ModelError> {
        let standard = Standard::of(training, scale);
        let rows = standard.rows(training);
        let (samples, width) = (training.samples(), training.shape().len());
        let row = |sample: usize| &rows[sample * width..(sample + 1) * width];
        let squares: Vec<f64> = rows
            .par_chunks_exact(width)
            .map(|row| row.iter().map(|&value| f64::from(value).powi(2)).sum())
            .collect();
        let variance = match squares.iter().sum::<f64>() / samples as f64 {
            variance if variance > 0.0 => variance,
            // No feature varies: every sample equals the first landmark.
            _ => 1.0,
        };
        let most = most.min(samples);
        let mut left = vec![1.0; samples];
        let mut factor = vec![0.0; samples * most];
        let mut distances = vec![0.0; samples * most];
        let mut column = vec![0.0; samples];
        let mut chosen: Vec<usize> = Vec::new();
        let stage = ReportedStage::begin(progress, "landmarks", most);
        let mut next = extreme(&squares, |value, best| value < best);
        while chosen.len() < most && left[next] > EXPLAINED {
            interrupted(progress)?;
            from_all(row(next), &rows, &mut column);
            let position = chosen.len();
            let pivot = factor[next * most..next * most + position].to_vec();
            let root = left[next].sqrt();
            let rate = rate(LENGTH, variance);
            factor
                .par_chunks_mut(CHUNK * most)
                .zip(distances.par_chunks_mut(CHUNK * most))
                .zip(left.par_chunks_mut(CHUNK))
                .zip(column.par_chunks(CHUNK))
                .for_each(|(((factor, distances), left), column)| {
                    let factors = factor.chunks_exact_mut(most);
                    let places = factors.zip(distances.chunks_exact_mut(most)).zip(left);
                    for (((factor, distances), left), &distance) in places.zip(column) {
                        let along = dot(&factor[..position], &pivot);
                        let value = (kernel(distance, rate) - along) / root;
                        factor[position] = value;
                        distances[position] = distance;
                        *left -= value * value;
                    }
                });
            left[next] = 0.0;
            chosen.push(next);
            next = extreme(&left, |value, best| value > best);
            stage.advance();
        }
        let count = chosen.len();
        let distances = distances.chunks_exact(most);
        let kept = distances.flat_map(|row| row[..count].iter().copied());
        Ok(Landmarks {
            variance,
            rows: chosen
                .iter()
                .flat_map(|&sample| row(sample))
                .copied()
                .collect(),
            distances: kept.collect(),
            chosen,
            standard,
        })
    }

    /// Squared distances of a training sample from the landmarks.
    pub(super) fn of(&self, sample: usize) -> &[f32] {
        let count = self.chosen.len();
        &self.distances[sample * count..(sample + 1) * count]
    }
}

/// Factor 1 / 2ℓ²D by which the kernel multiplies squared distances, with the kernel length ℓ = `length` and the variance D = `variance`.
pub(super) fn rate(length: f64, variance: f64) -> f64 {
    0.5 / (length * length * variance)
}

pub(super) fn kernel(squared_distance: f32, rate: f64) -> f64 {
    (-f64::from(squared_distance) * rate).exp()
}

/// Index of the best of `values` by the comparison `better`. Of equal values, the first.
fn extreme(values: &[f64], better: impl Fn(f64, f64) -> bool) -> usize {
    let mut best = 0;
    for (position, &value) in values.iter().enumerate() {
        if better(value, values[best]) {
            best = position;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::{FeatureShape, SilentProgress};

    #[test]
    fn samples_that_repeat_others_are_no_landmarks() {
        let values = vec![0.0, 1.0, 0.0, 2.0, 1.0, 2.0, 0.0];
        let features = Features::new(FeatureShape::flat(1), values).expect("whole");
        let landmarks = Landmarks::choose(&features, FeatureScale::Unit, 7, &SilentProgress)
            .expect("not cancelled");
        // 0.857 is the mean: 1 is nearest to it, then the two ends follow.
        assert_eq!(landmarks.chosen, [1, 3, 0]);
        assert_eq!(
            landmarks.of(4),
            [0.0, landmarks.of(3)[0], landmarks.of(0)[0]]
        );
    }
}
