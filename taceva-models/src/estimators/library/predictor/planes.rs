//! Classification by linear functions: predicts, for each target, the label whose function has the greatest value for the features.

use taceva_core::ModelError;

use super::damaged;
use crate::estimators::library::guard::finite;
use crate::estimators::library::{LibraryPredictor, LibrarySizes, LibraryTensors};
use crate::linalg::dot;
use crate::training::file::tensors::Raw;

/// Linear functions of all targets, one per class.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Planes(Vec<Classes>);

/// Classes of one target with their linear functions: offset + Σ weight · feature.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Classes {
    /// Label of each class.
    pub(crate) labels: Vec<f64>,
    /// Offset of each class's linear function.
    pub(crate) offsets: Vec<f64>,
    /// Weights, shape `[classes, features]`.
    pub(crate) weights: Vec<f64>,
}

const COUNTS: &str = "counts";
const LABELS: &str = "labels";
const OFFSETS: &str = "offsets";
const WEIGHTS: &str = "weights";

impl Planes {
    /// Builds the predictor from labels, offsets and weights of each target.
    ///
    /// # Errors
    /// [`ModelError`] of kind `OutOfRange` if an offset or weight is not finite.
    pub(crate) fn new(name: &str, targets: Vec<Classes>) -> Result<Planes, ModelError> {
        for target in &targets {
            finite(name, target.offsets.iter().chain(&target.weights))?;
        }
        Ok(Planes(targets))
    }

    /// Loads the predictor from a file.
    pub(crate) fn load(
        tensors: &LibraryTensors<'_>,
        sizes: LibrarySizes,
    ) -> Result<Box<dyn LibraryPredictor>, ModelError> {
        let counts = tensors.integers(COUNTS, &[sizes.targets])?;
        let total = tensors.rows(OFFSETS)?;
        let sum: u64 = counts.iter().map(|&count| u64::from(count)).sum();
        if sum != total as u64 || counts.contains(&0) {
            return Err(damaged(
                "the classes of a target differ from those of its planes",
            ));
        }
        let labels = tensors.doubles(LABELS, &[total])?;
        let offsets = tensors.doubles(OFFSETS, &[total])?;
        let weights = tensors.doubles(WEIGHTS, &[total, sizes.features])?;
        let mut start = 0;
        let targets = counts.into_iter().map(|count| {
            let own = start..start + count as usize;
            start = own.end;
            Classes {
                labels: labels[own.clone()].to_vec(),
                offsets: offsets[own.clone()].to_vec(),
                weights: weights[own.start * sizes.features..own.end * sizes.features].to_vec(),
            }
        });
        Ok(Box::new(Planes(targets.collect())))
    }
}

impl LibraryPredictor for Planes {
    fn tensors(&self) -> Vec<Raw> {
        let joined = |of: fn(&Classes) -> &Vec<f64>| -> Vec<f64> {
            self.0.iter().flat_map(of).copied().collect()
        };
        let counts = self.0.iter().map(|target| target.labels.len());
        let counts: Vec<u32> = counts
            .map(|count| u32::try_from(count).expect("a few hundred classes"))
            .collect();
        let offsets = joined(|target| &target.offsets);
        let (classes, weights) = (offsets.len(), joined(|target| &target.weights));
        vec![
            Raw::integers(COUNTS, vec![counts.len()], &counts),
            Raw::doubles(LABELS, vec![classes], &joined(|target| &target.labels)),
            Raw::doubles(OFFSETS, vec![classes], &offsets),
            Raw::doubles(
                WEIGHTS,
                vec![classes, weights.len() / classes.max(1)],
                &weights,
            ),
        ]
    }

    fn predict(&self, sample: &[f32], into: &mut [f64]) -> Result<(), ModelError> {
        for (place, target) in into.iter_mut().zip(&self.0) {
            let rows = target.weights.chunks_exact(sample.len().max(1));
            let mut best = (f64::NEG_INFINITY, target.labels[0]);
            for ((row, offset), &label) in rows.zip(&target.offsets).zip(&target.labels) {
                let height = offset + dot(row, sample);
                if height > best.0 {
                    best = (height, label);
                }
            }
            *place = best.1;
        }
        Ok(())
    }
}
