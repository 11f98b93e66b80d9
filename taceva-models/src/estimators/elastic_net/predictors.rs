//! Centred features, stored in the layout that makes coordinate descent cheapest.

use faer::Mat;
use taceva_core::{ModelError, Progress};

use crate::linalg::invalid;
use crate::linalg::{Design, dot, feature_gram};

/// Centred features X of all samples, one column per feature.
#[derive(Debug)]
pub(super) struct Predictors {
    layout: Layout,
    /// Sum of squares of each column.
    pub(super) squares: Vec<f64>,
}

#[derive(Debug)]
enum Layout {
    /// Gram matrix XᵀX. Updating one weight reads one number per feature.
    Gram(Mat<f64>),
    /// Matrix X. Updating one weight reads one number per sample, twice.
    Columns(Mat<f64>),
}

/// Maximum number of features of a Gram matrix, which then takes 134 MB.
const FEATURES_MAX: usize = 4096;

impl Predictors {
    /// Chooses [`Columns`](Self::Columns) for fewer than half as many samples as features, or if the Gram matrix is too large. Otherwise chooses the
    /// Gram matrix.
    ///
    /// # Errors
    /// [`ModelError`] if there are too many samples and features for either layout, or `progress` was cancelled.
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
                "{width} features, the elastic net accepts at most {FEATURES_MAX} for {samples} samples: set a smaller `size` or `pca`"
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

/// Labels of one channel, which the weights are fitted to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target<'a> {
    /// Centred labels y of the samples.
    pub(super) labels: &'a [f64],
    /// Products Xᵀy of the centred features X with the labels y, one per feature.
    pub(super) products: &'a [f64],
}

/// Residual for features X, labels y and weights w: Xᵀ(y − Xw) with a Gram matrix, otherwise y − Xw.
#[derive(Debug)]
pub(super) struct Residual<'a> {
    predictors: &'a Predictors,
    values: Vec<f64>,
}

impl<'a> Residual<'a> {
    /// Computes the residual from scratch, so that rounding errors of earlier steps do not accumulate.
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

    /// Scalar product of the residual y − Xw with the column of `feature`.
    pub(super) fn along(&self, feature: usize) -> f64 {
        match &self.predictors.layout {
            Layout::Gram(_) => self.values[feature],
            Layout::Columns(columns) => dot(columns.col_as_slice(feature), &self.values),
        }
    }

    /// Updates the residual after the weight of `feature` was increased by `step`.
    pub(super) fn follow(&mut self, feature: usize, step: f64) {
        let (Layout::Gram(columns) | Layout::Columns(columns)) = &self.predictors.layout;
        let places = self.values.iter_mut().zip(columns.col_as_slice(feature));
        places.for_each(|(place, value)| *place -= step * value);
    }
}
