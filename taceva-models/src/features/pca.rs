//! Principal components of the training part.

use faer::Mat;
use taceva_core::{FeatureShape, Features, ModelError, Progress, by_count, counted, single};

use crate::linalg::invalid;
use crate::linalg::{Design, FeatureScale, Spectrum};

/// Orthonormal directions of greatest variance of the training part, in order of decreasing variance.
#[derive(Clone, Debug, PartialEq)]
pub struct Pca {
    shape: FeatureShape,
    mean: Vec<f64>,
    components: Vec<f64>,
    variance_ratio: Vec<f64>,
}

impl Pca {
    /// Computes the first `count` components of `training`. The entry of greatest magnitude in each component is positive.
    ///
    /// # Errors
    /// [`ModelError`] if a feature is not finite, if `training` varies in fewer than `count` directions, or if `progress` was cancelled.
    pub fn fit(
        training: &Features,
        count: usize,
        progress: &dyn Progress,
    ) -> Result<Pca, ModelError> {
        let known = Pca::up_to(count, training, progress)?;
        match known.variance_ratio.len() {
            found if found == count => Ok(known),
            found => Err(invalid(format!(
                "`pca={count}`: {} {} in {}",
                counted(training.samples(), "training sample"),
                by_count(training.samples(), "varies", "vary"),
                counted(found, "direction")
            ))),
        }
    }

    /// Computes the first `most` components of `training`, or all if there are fewer.
    ///
    /// # Errors
    /// Errors of [`fit`](Pca::fit), but fewer directions than `most` are no error.
    pub(crate) fn up_to(
        most: usize,
        training: &Features,
        progress: &dyn Progress,
    ) -> Result<Pca, ModelError> {
        if !training.values().iter().all(|value| value.is_finite()) {
            return Err(invalid(
                "cannot compute principal components: a feature is not finite",
            ));
        }
        if training.samples() == 0 {
            return Err(invalid(
                "cannot compute principal components without a sample",
            ));
        }
        let design = Design::new(training, FeatureScale::None);
        let spectrum = Spectrum::new(&design, progress)?;
        let eigenvalues = spectrum.eigenvalues();
        let known = eigenvalues
            .iter()
            .filter(|&&eigenvalue| eigenvalue > spectrum.noise())
            .count();
        let count = most.min(known);
        let mut vectors = spectrum.leading_feature_vectors(count);
        orthonormalise(&mut vectors);
        let total: f64 = eigenvalues.iter().sum();
        Ok(Pca {
            shape: training.shape(),
            mean: design.centre().to_vec(),
            components: (0..count)
                .flat_map(|column| with_fixed_sign(vectors.col_as_slice(column)))
                .collect(),
            variance_ratio: eigenvalues
                .iter()
                .rev()
                .take(count)
                .map(|value| value / total)
                .collect(),
        })
    }

    /// Builds principal components from stored means, components and variance ratios.
    ///
    /// # Errors
    /// [`ModelError`] if a length is wrong or a number is not finite.
    pub(crate) fn ready(
        shape: FeatureShape,
        mean: Vec<f64>,
        components: Vec<f64>,
        variance_ratio: Vec<f64>,
    ) -> Result<Pca, ModelError> {
        let places = shape.len().checked_mul(variance_ratio.len());
        let mut numbers = mean.iter().chain(&components).chain(&variance_ratio);
        let whole = mean.len() == shape.len() && Some(components.len()) == places;
        if !whole || !numbers.all(|value| value.is_finite()) {
            return Err(invalid(
                "the principal components have a number that is not finite, or do not fit the features",
            ));
        }
        Ok(Pca {
            shape,
            mean,
            components,
            variance_ratio,
        })
    }

    /// Shape of the features.
    pub fn shape(&self) -> FeatureShape {
        self.shape
    }

    /// Mean of each feature over the training part.
    pub fn mean(&self) -> &[f64] {
        &self.mean
    }

    /// Components, each as long as a sample.
    pub fn components(&self) -> std::slice::ChunksExact<'_, f64> {
        self.components.chunks_exact(self.mean.len())
    }

    /// Share of the total variance of the training part along each component.
    pub fn variance_ratio(&self) -> &[f64] {
        &self.variance_ratio
    }

    /// Projects `features` onto the components.
    ///
    /// # Shapes
    /// Input: samples of [`shape`](Pca::shape). Output: flat samples with one value per component.
    /// # Errors
    /// [`ModelError`] if the shape differs.
    pub fn transform(&self, features: &Features) -> Result<Features, ModelError> {
        if features.shape() != self.shape {
            return Err(invalid(format!(
                "features of shape {}, expected {} for these principal components",
                features.shape(),
                self.shape
            )));
        }
        let count = self.variance_ratio.len();
        let width = self.mean.len();
        let directions = Mat::from_fn(width, count, |row, column| {
            self.components[column * width + row]
        });
        let coordinates =
            Design::centred_at(features, self.mean.clone()).times(directions.as_ref());
        let values = (0..features.samples())
            .flat_map(|sample| (0..count).map(move |component| (sample, component)))
            .map(|place| single(coordinates[place]))
            .collect();
        Features::new(FeatureShape::flat(count), values)
    }
}

/// Orthonormalises the columns of `vectors` by the Gram–Schmidt method, applied twice. The columns of smallest variance need this, because a Gram
/// matrix keeps only half of their digits.
fn orthonormalise(vectors: &mut Mat<f64>) {
    for column in 0..vectors.ncols() {
        let mut own = vectors.col_as_slice(column).to_vec();
        for _ in 0..2 {
            for earlier in 0..column {
                let earlier = vectors.col_as_slice(earlier);
                let along: f64 = own.iter().zip(earlier).map(|(a, b)| a * b).sum();
                own.iter_mut()
                    .zip(earlier)
                    .for_each(|(value, earlier)| *value -= along * earlier);
            }
            let norm = own.iter().map(|value| value * value).sum::<f64>().sqrt();
            own.iter_mut().for_each(|value| *value /= norm);
        }
        vectors.col_as_slice_mut(column).copy_from_slice(&own);
    }
}

fn with_fixed_sign(vector: &[f64]) -> Vec<f64> {
    let mut largest = 0.0_f64;
    for &value in vector {
        if value.abs() > largest.abs() {
            largest = value;
        }
    }
    vector
        .iter()
        .map(|value| value * largest.signum())
        .collect()
}
