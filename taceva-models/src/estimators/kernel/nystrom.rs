//! Nyström features. The scalar product of the features of two samples approximates their kernel.

use rayon::prelude::*;
use taceva_core::{FeatureShape, Features, single};

use super::landmarks::{EXPLAINED, Landmarks, kernel, rate};
use crate::linalg::distance::squared_distance;
use crate::linalg::dot;
use crate::linalg::standard::Standard;

/// Feature map φ(x) = L⁻¹ k(x). L Lᵀ is the kernel matrix of the landmarks, and k(x) contains the kernel of x with each landmark. The kernel of two
/// samples x and x' is approximately φ(x)ᵀφ(x').
///
/// # Reference
/// C. K. I. Williams, M. Seeger, NIPS 13 (2001) 682.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Nystrom {
    pub(super) standard: Standard,
    /// Kernel length ℓ, for the model card.
    pub(super) length: f64,
    /// Factor 1 / 2ℓ²D by which the kernel multiplies squared distances. D is the variance of the features, summed over features.
    pub(super) rate: f64,
    /// Features of the landmarks, standardised by `standard`, shape `[landmarks, features]`.
    pub(super) rows: Vec<f32>,
    /// Lower triangle of the Cholesky factor L of the kernel matrix of the landmarks, row by row.
    pub(super) factor: Vec<f64>,
    /// Indices into `Landmarks::chosen` of the landmarks in use.
    kept: Vec<usize>,
}

/// Number of samples per task of a thread.
const CHUNK: usize = 16;

impl Nystrom {
    /// Builds the map from landmarks whose kernels of length `length` are linearly independent.
    pub(super) fn new(landmarks: &Landmarks, length: f64) -> Nystrom {
        let rate = rate(length, landmarks.variance);
        let width = landmarks.standard.centre().len();
        let (mut kept, mut rows, mut factor) = (Vec::new(), Vec::new(), Vec::new());
        for (position, &sample) in landmarks.chosen.iter().enumerate() {
            let distances = landmarks.of(sample);
            let mut row: Vec<f64> = kept
                .iter()
                .map(|&other: &usize| kernel(distances[other], rate))
                .collect();
            substitute(&factor, &mut row);
            let left = 1.0 - dot(&row, &row);
            if left > EXPLAINED {
                kept.push(position);
                factor.extend(row);
                factor.push(left.sqrt());
                rows.extend_from_slice(&landmarks.rows[position * width..(position + 1) * width]);
            }
        }
        Nystrom {
            standard: landmarks.standard.clone(),
            length,
            rate,
            rows,
            factor,
            kept,
        }
    }

    /// Builds the map from parameters of a model file, whose lengths are already checked.
    pub(super) fn ready(
        standard: Standard,
        length: f64,
        rate: f64,
        rows: Vec<f32>,
        factor: Vec<f64>,
    ) -> Nystrom {
        let count = rows.len() / standard.centre().len().max(1);
        Nystrom {
            standard,
            length,
            rate,
            rows,
            factor,
            kept: (0..count).collect(),
        }
    }

    /// Number of Nyström features, which is the number of landmarks.
    pub(super) fn len(&self) -> usize {
        self.kept.len()
    }

    /// Nyström features of the training samples, computed from the distances in `landmarks`.
    pub(super) fn of_training(&self, landmarks: &Landmarks) -> Features {
        let count = landmarks.chosen.len();
        let samples = landmarks.distances.par_chunks_exact(count);
        let values: Vec<Vec<f32>> = samples
            .map(|distances| {
                let kernels = self
                    .kept
                    .iter()
                    .map(|&kept| kernel(distances[kept], self.rate));
                self.finish(kernels.collect())
            })
            .collect();
        self.features(values)
    }

    /// Nyström features of any samples.
    pub(super) fn of(&self, features: &Features) -> Features {
        let width = self.standard.centre().len();
        let samples = features.values().par_chunks(CHUNK * width);
        let values: Vec<Vec<f32>> = samples
            .map(|samples| {
                let samples = samples.chunks_exact(width);
                samples.flat_map(|sample| self.of_one(sample)).collect()
            })
            .collect();
        self.features(values)
    }

    /// Nyström features of a single sample.
    pub(super) fn of_one(&self, sample: &[f32]) -> Vec<f32> {
        let mut own = vec![0.0; sample.len()];
        self.standard.write(sample, &mut own);
        let landmarks = self.rows.chunks_exact(sample.len());
        let kernels = landmarks.map(|row| kernel(squared_distance(&own, row), self.rate));
        self.finish(kernels.collect())
    }

    fn finish(&self, mut kernels: Vec<f64>) -> Vec<f32> {
        substitute(&self.factor, &mut kernels);
        kernels.into_iter().map(single).collect()
    }

    fn features(&self, values: Vec<Vec<f32>>) -> Features {
        Features::new(FeatureShape::flat(self.len()), values.concat())
            .expect("one value per landmark for every sample")
    }
}

/// Solves L x = `values` for x in place, with the lower triangle L in `factor`.
fn substitute(factor: &[f64], values: &mut [f64]) {
    let mut start = 0;
    for position in 0..values.len() {
        let row = &factor[start..start + position];
        let known = dot(row, &values[..position]);
        values[position] = (values[position] - known) / factor[start + position];
        start += position + 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::FeatureScale;
    use taceva_core::SilentProgress;

    #[test]
    fn where_every_sample_is_a_landmark_products_are_the_kernel() {
        let mut random = taceva_core::random::SplitMix64::new(6);
        let values = (0..40).map(|_| f32::from(random.next_u64().to_le_bytes()[0]));
        let values: Vec<f32> = values.collect();
        let features = Features::new(FeatureShape::flat(4), values).expect("ten samples");
        let landmarks = Landmarks::choose(&features, FeatureScale::Unit, 10, &SilentProgress)
            .expect("not cancelled");
        let map = Nystrom::new(&landmarks, 0.5);
        assert_eq!(map.len(), 10, "every sample is one");
        let mapped = map.of_training(&landmarks);
        assert_eq!(mapped, map.of(&features));
        for a in 0..10 {
            for b in 0..10 {
                let products = mapped.sample(a).iter().zip(mapped.sample(b));
                let found: f64 = products.map(|(a, b)| f64::from(a * b)).sum();
                let rows = landmarks.standard.rows(&features);
                let distance = squared_distance(&rows[4 * a..4 * a + 4], &rows[4 * b..4 * b + 4]);
                let expected = kernel(distance, map.rate);
                // Ten products of features in single precision.
                assert!((found - expected).abs() < 2e-6, "{found} for {expected}");
            }
        }
    }
}
