//! Centred features, laid out so that a step along one weight costs least.

use faer::Mat;
use taceva_core::{ModelError, Progress};

use crate::linalg::invalid;
use crate::linalg::{Design, dot, feature_gram};

/// Features X of all samples, a column a feature.
#[derive(Debug)]
pub(super) struct Predictors {
    layout: Layout,
    /// The squared length of each column.
    pub(super) squares: Vec<f64>,
}

#[derive(Debug)]
enum Layout {
    /// XᵀX: a step reads as many numbers as there are features.
    Gram(Mat<f64>),
    /// X: a step reads as many numbers as there are samples, twice.
    Columns(Mat<f64>),
}

/// The most features of which a Gram matrix is kept: 134 MB.
const FEATURES_MAX: usize = 4096;

impl Predictors {
    /// Columns where there are fewer than half as many samples as features, or where products are more than can be kept; else products.
    ///
    /// # Errors
    /// [`ModelError`] where there are too many of both, or if `progress` was cancelled.
    pub(super) fn of(
        design: &Design<'_>,
        progress: &dyn Progress,
    ) -> Result<Predictors, ModelError> {
        let (samples, width) = (design.samples(), design.width());
        let is_wide = samples < width;
        if 2 * samples < width || (is_wide && width > FEATURES_MAX) {
            return Ok(Predictors::of_columns(design));
        }
        if width > FEATURES_MAX {
            return Err(invalid(format!(
                "{width} features, the elastic net takes at most {FEATURES_MAX} of {samples} samples: a smaller `size` or `pca` would be accepted"
            )));
        }
        Predictors::of_products(design, progress)
    }

    pub(super) fn of_columns(design: &Design<'_>) -> Predictors {
        let (samples, width) = (design.samples(), design.width());
        let columns = design.block(0..samples, 0..width).transpose().to_owned();
        let own = |feature| columns.col_as_slice(feature);
        Predictors {
            squares: (0..width)
                .map(|feature| dot(own(feature), own(feature)))
                .collect(),
            layout: Layout::Columns(columns),
        }
    }

    pub(super) fn of_products(
        design: &Design<'_>,
        progress: &dyn Progress,
    ) -> Result<Predictors, ModelError> {
        let gram = feature_gram(design, progress)?;
        Ok(Predictors {
            squares: (0..design.width())
                .map(|feature| gram[(feature, feature)])
                .collect(),
            layout: Layout::Gram(gram),
        })
    }
}

/// What is to be explained.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target<'a> {
    /// The centred labels y of the samples.
    pub(super) labels: &'a [f64],
    /// Xᵀy.
    pub(super) products: &'a [f64],
}

/// What is left of the labels y once Xw is taken from them, seen through the layout: Xᵀ(y − Xw), or y − Xw itself.
#[derive(Debug)]
pub(super) struct Residual<'a> {
    predictors: &'a Predictors,
    values: Vec<f64>,
}

impl<'a> Residual<'a> {
    /// The residual, computed anew, so that rounding errors of earlier steps do not add up.
    pub(super) fn new(
        predictors: &'a Predictors,
        target: Target<'_>,
        weights: &[f64],
    ) -> Residual<'a> {
        let values = match &predictors.layout {
            Layout::Gram(_) => target.products.to_vec(),
            Layout::Columns(_) => target.labels.to_vec(),
        };
        let mut residual = Residual { predictors, values };
        let moved = weights.iter().enumerate();
        for (feature, weight) in moved.filter(|(_, weight)| weight.abs() > 0.0) {
            residual.follow(feature, *weight);
        }
        residual
    }

    /// Its product with a feature.
    pub(super) fn along(&self, feature: usize) -> f64 {
        match &self.predictors.layout {
            Layout::Gram(_) => self.values[feature],
            Layout::Columns(columns) => dot(columns.col_as_slice(feature), &self.values),
        }
    }

    /// Updates the residual after the weight of `feature` grew by `step`.
    pub(super) fn follow(&mut self, feature: usize, step: f64) {
        let (Layout::Gram(columns) | Layout::Columns(columns)) = &self.predictors.layout;
        let places = self.values.iter_mut().zip(columns.col_as_slice(feature));
        places.for_each(|(place, value)| *place -= step * value);
    }
}
