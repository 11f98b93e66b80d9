//! Centred features in the form in which a step along one weight costs least.

use faer::Mat;
use taceva_core::{ModelError, Progress};

use crate::linalg::{Design, feature_gram};
use crate::problem::invalid;

/// Features X of all samples, a column a feature.
#[derive(Debug)]
pub(super) struct Form {
    kept: Kept,
    /// The squared length of each column.
    pub(super) squares: Vec<f64>,
}

#[derive(Debug)]
enum Kept {
    /// XᵀX: a step reads as many numbers as there are features.
    Gram(Mat<f64>),
    /// X: a step reads as many numbers as there are samples, twice.
    Columns(Mat<f64>),
}

/// Features that a Gram matrix is kept of: 134 MB.
const FEATURES_MAX: usize = 4096;

impl Form {
    /// Columns where there are fewer than half as many samples as features, else products of features.
    ///
    /// # Errors
    /// [`ModelError`] where products are too many to keep, or if `progress` was cancelled.
    pub(super) fn of(design: &Design<'_>, progress: &dyn Progress) -> Result<Form, ModelError> {
        let (samples, width) = (design.samples(), design.width());
        if 2 * samples < width {
            return Ok(Form::of_columns(design));
        }
        if width > FEATURES_MAX {
            return Err(invalid(format!(
                "{width} features, the elastic net takes at most {FEATURES_MAX} of {samples} samples: a smaller `size` or `pca` would be accepted"
            )));
        }
        Form::of_products(design, progress)
    }

    pub(super) fn of_columns(design: &Design<'_>) -> Form {
        let (samples, width) = (design.samples(), design.width());
        let columns = design.block(0..samples, 0..width).transpose().to_owned();
        let own = |feature| columns.col_as_slice(feature);
        Form {
            squares: (0..width)
                .map(|feature| dot(own(feature), own(feature)))
                .collect(),
            kept: Kept::Columns(columns),
        }
    }

    pub(super) fn of_products(
        design: &Design<'_>,
        progress: &dyn Progress,
    ) -> Result<Form, ModelError> {
        let gram = feature_gram(design, progress)?;
        Ok(Form {
            squares: (0..design.width())
                .map(|feature| gram[(feature, feature)])
                .collect(),
            kept: Kept::Gram(gram),
        })
    }
}

/// What is left of the labels y once Xw is taken from them, seen through the form: Xᵀ(y − Xw), or y − Xw itself.
#[derive(Debug)]
pub(super) struct Rest<'a> {
    form: &'a Form,
    values: Vec<f64>,
}

impl<'a> Rest<'a> {
    /// Formed anew: roundings of the steps before do not add up. `labels` are y, `products` Xᵀy.
    pub(super) fn new(
        form: &'a Form,
        (labels, products): (&[f64], &[f64]),
        weights: &[f64],
    ) -> Rest<'a> {
        let values = match &form.kept {
            Kept::Gram(_) => products.to_vec(),
            Kept::Columns(_) => labels.to_vec(),
        };
        let mut rest = Rest { form, values };
        let moved = weights.iter().enumerate();
        for (feature, weight) in moved.filter(|(_, weight)| weight.abs() > 0.0) {
            rest.follow(feature, *weight);
        }
        rest
    }

    /// Its product with a feature.
    pub(super) fn along(&self, feature: usize) -> f64 {
        match &self.form.kept {
            Kept::Gram(_) => self.values[feature],
            Kept::Columns(columns) => dot(columns.col_as_slice(feature), &self.values),
        }
    }

    /// Takes in that the weight of `feature` grew by `step`.
    pub(super) fn follow(&mut self, feature: usize, step: f64) {
        let (Kept::Gram(columns) | Kept::Columns(columns)) = &self.form.kept;
        let places = self.values.iter_mut().zip(columns.col_as_slice(feature));
        places.for_each(|(place, value)| *place -= step * value);
    }
}

/// Eight partial sums, so that the additions do not wait for each other; always in the same order.
fn dot(left: &[f64], right: &[f64]) -> f64 {
    let (left, last_left) = left.as_chunks::<8>();
    let (right, last_right) = right.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (left, right) in left.iter().zip(right) {
        for ((sum, left), right) in sums.iter_mut().zip(left).zip(right) {
            *sum += left * right;
        }
    }
    let last = last_left.iter().zip(last_right);
    sums.iter().sum::<f64>() + last.map(|(left, right)| left * right).sum::<f64>()
}
