//! Linear predictors.

use taceva_core::ModelError;

use crate::estimators::library::guard::finite;
use crate::estimators::library::{LibraryPredictor, LibrarySizes, LibraryTensors};
use crate::linalg::dot;
use crate::training::file::tensors::Raw;

/// Linear predictor: weights and bias of each target.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Linear {
    /// Weights, shape `[targets, features]`.
    weights: Vec<f64>,
    /// Biases, shape `[targets]`.
    bias: Vec<f64>,
}

/// Weights and bias of one target.
pub(crate) type Weighted = (Vec<f64>, f64);

const BIAS: &str = "bias";
const WEIGHTS: &str = "weights";

impl Linear {
    /// Builds the predictor from weights and bias of each target.
    ///
    /// # Errors
    /// [`ModelError`] of kind `OutOfRange` if a value is not finite.
    pub(crate) fn new(name: &str, targets: Vec<Weighted>) -> Result<Linear, ModelError> {
        let (weights, bias): (Vec<Vec<f64>>, Vec<f64>) = targets.into_iter().unzip();
        let weights = weights.concat();
        finite(name, weights.iter().chain(&bias))?;
        Ok(Linear { weights, bias })
    }

    /// Loads the predictor from a file.
    pub(crate) fn load(
        tensors: &LibraryTensors<'_>,
        sizes: LibrarySizes,
    ) -> Result<Box<dyn LibraryPredictor>, ModelError> {
        Ok(Box::new(Linear {
            weights: tensors.doubles(WEIGHTS, &[sizes.targets, sizes.features])?,
            bias: tensors.doubles(BIAS, &[sizes.targets])?,
        }))
    }
}

impl LibraryPredictor for Linear {
    fn tensors(&self) -> Vec<Raw> {
        let targets = self.bias.len();
        let shape = vec![targets, self.weights.len() / targets.max(1)];
        vec![
            Raw::doubles(BIAS, vec![targets], &self.bias),
            Raw::doubles(WEIGHTS, shape, &self.weights),
        ]
    }

    fn predict(&self, sample: &[f32], into: &mut [f64]) -> Result<(), ModelError> {
        let rows = self.weights.chunks_exact(sample.len().max(1));
        for ((place, row), bias) in into.iter_mut().zip(rows).zip(&self.bias) {
            *place = bias + dot(row, sample);
        }
        Ok(())
    }
}
