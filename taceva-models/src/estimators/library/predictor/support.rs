//! Support vector predictors: sums of Gaussian kernels around stored training samples.

use taceva_core::{ModelError, single};

use super::damaged;
use crate::estimators::library::guard::finite;
use crate::estimators::library::{LibraryPredictor, LibrarySizes, LibraryTensors};
use crate::training::file::tensors::Raw;

/// Predicts Σ coefficient · exp(−rate ‖x − v‖²) + bias for each target. x are the features of a sample. The sum is over training samples v with a
/// nonzero coefficient for any target.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Support {
    rate: f64,
    /// Stored training samples, shape `[vectors, features]`.
    vectors: Vec<f32>,
    /// Coefficients, shape `[vectors, targets]`.
    coefficients: Vec<f64>,
    /// Biases, shape `[targets]`.
    bias: Vec<f64>,
}

/// Support vector machine that the library fitted for one target.
pub(crate) struct Machine {
    /// Coefficient of each training sample; 0 for a sample that is not a support vector of the target.
    pub(crate) coefficients: Vec<f64>,
    pub(crate) bias: f64,
}

const BIAS: &str = "bias";
const COEFFICIENTS: &str = "coefficients";
const RATE: &str = "rate";
const VECTORS: &str = "vectors";

impl Support {
    /// Builds the predictor from training samples `rows` and one machine per target. `rows` has shape `[samples, features]` and values that are exact
    /// in single precision.
    ///
    /// # Errors
    /// [`ModelError`] of kind `OutOfRange` if a coefficient or bias is not finite.
    pub(crate) fn new(
        name: &str,
        rows: &[f64],
        features: usize,
        rate: f64,
        machines: &[Machine],
    ) -> Result<Support, ModelError> {
        let (mut vectors, mut coefficients) = (Vec::new(), Vec::new());
        for (sample, row) in rows.chunks_exact(features).enumerate() {
            let own = machines.iter().map(|machine| machine.coefficients[sample]);
            let own: Vec<f64> = own.collect();
            if own
                .iter()
                .any(|coefficient| coefficient.abs() > 0.0 || coefficient.is_nan())
            {
                vectors.extend(row.iter().copied().map(single));
                coefficients.extend(own);
            }
        }
        let bias: Vec<f64> = machines.iter().map(|machine| machine.bias).collect();
        finite(name, coefficients.iter().chain(&bias))?;
        Ok(Support {
            rate,
            vectors,
            coefficients,
            bias,
        })
    }

    /// Loads the predictor from a file.
    pub(crate) fn load(
        tensors: &LibraryTensors<'_>,
        sizes: LibrarySizes,
    ) -> Result<Box<dyn LibraryPredictor>, ModelError> {
        let vectors = tensors.rows(VECTORS)?;
        let rate = tensors.doubles(RATE, &[1])?[0];
        if rate < 0.0 {
            return Err(damaged("the rate of a kernel is negative"));
        }
        Ok(Box::new(Support {
            rate,
            vectors: tensors.singles(VECTORS, &[vectors, sizes.features])?,
            coefficients: tensors.doubles(COEFFICIENTS, &[vectors, sizes.targets])?,
            bias: tensors.doubles(BIAS, &[sizes.targets])?,
        }))
    }
}

impl LibraryPredictor for Support {
    fn tensors(&self) -> Vec<Raw> {
        let targets = self.bias.len();
        let vectors = self.coefficients.len() / targets.max(1);
        let features = self.vectors.len() / vectors.max(1);
        vec![
            Raw::doubles(BIAS, vec![targets], &self.bias),
            Raw::doubles(COEFFICIENTS, vec![vectors, targets], &self.coefficients),
            Raw::doubles(RATE, vec![1], &[self.rate]),
            Raw::singles(VECTORS, vec![vectors, features], &self.vectors),
        ]
    }

    fn predict(&self, sample: &[f32], into: &mut [f64]) -> Result<(), ModelError> {
        into.copy_from_slice(&self.bias);
        let vectors = self.vectors.chunks_exact(sample.len().max(1));
        for (vector, coefficients) in vectors.zip(self.coefficients.chunks_exact(into.len())) {
            let kernel = (-self.rate * squared_distance(vector, sample)).exp();
            for (place, coefficient) in into.iter_mut().zip(coefficients) {
                *place += coefficient * kernel;
            }
        }
        Ok(())
    }
}

/// Squared distance between `left` and `right`, summed in a fixed order as eight partial sums.
fn squared_distance(left: &[f32], right: &[f32]) -> f64 {
    let (left, last_left) = left.as_chunks::<8>();
    let (right, last_right) = right.as_chunks::<8>();
    let mut sums = [0.0; 8];
    let square = |left: f32, right: f32| (f64::from(left) - f64::from(right)).powi(2);
    for (left, right) in left.iter().zip(right) {
        for ((sum, &left), &right) in sums.iter_mut().zip(left).zip(right) {
            *sum += square(left, right);
        }
    }
    let rest = last_left.iter().zip(last_right);
    sums.iter().sum::<f64>() + rest.map(|(&left, &right)| square(left, right)).sum::<f64>()
}
