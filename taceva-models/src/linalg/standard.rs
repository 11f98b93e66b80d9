//! Standardisation of features by the training part, for models that compare samples with each other.

use taceva_core::{Features, ModelError, single};

use crate::linalg::invalid;
use crate::linalg::{Design, FeatureScale};

/// Standardises features to (feature − centre) · factor, rounded to single precision.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Standard {
    centre: Vec<f64>,
    factor: Vec<f64>,
}

impl Standard {
    /// Standardisation by the mean and the scale of `training`, which must not be empty.
    pub(crate) fn of(training: &Features, scale: FeatureScale) -> Standard {
        let design = Design::new(training, scale);
        let width = design.width();
        Standard {
            centre: design.centre().to_vec(),
            factor: design
                .factor()
                .map_or_else(|| vec![1.0; width], <[f64]>::to_vec),
        }
    }

    /// Builds the standardisation from a stored centre and factor of each feature.
    ///
    /// # Errors
    /// [`ModelError`] if a number is not finite, or the lengths differ.
    pub(crate) fn new(centre: Vec<f64>, factor: Vec<f64>) -> Result<Standard, ModelError> {
        let mut numbers = centre.iter().chain(&factor);
        if centre.len() != factor.len() || !numbers.all(|value| value.is_finite()) {
            return Err(invalid("the scale of features has a number out of range"));
        }
        Ok(Standard { centre, factor })
    }

    pub(crate) fn centre(&self) -> &[f64] {
        &self.centre
    }

    pub(crate) fn factor(&self) -> &[f64] {
        &self.factor
    }

    /// Writes the standardised features of one sample.
    pub(crate) fn write(&self, sample: &[f32], into: &mut [f32]) {
        let own = self.centre.iter().zip(&self.factor);
        for ((place, &value), (centre, factor)) in into.iter_mut().zip(sample).zip(own) {
            *place = single((f64::from(value) - centre) * factor);
        }
    }

    /// Standardised features of all samples, concatenated.
    pub(crate) fn rows(&self, features: &Features) -> Vec<f32> {
        let mut rows = vec![0.0; features.values().len()];
        let width = self.centre.len();
        for (place, sample) in rows
            .chunks_exact_mut(width)
            .zip(features.values().chunks_exact(width))
        {
            self.write(sample, place);
        }
        rows
    }
}
