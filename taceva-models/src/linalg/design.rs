//! Centred, optionally scaled features of a training part, as a matrix that is computed in blocks.

use std::ops::Range;

use faer::{Mat, MatRef};
use rayon::prelude::*;
use taceva_core::Features;

use crate::settings::{ModelSettings, SettingError, SettingInfo};

use super::gram::{add_product, slabs};

/// Number of samples or features per block: large enough for full speed, small enough for many threads and the cache.
const BLOCK: usize = 256;

/// Divisor of each centred feature.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum FeatureScale {
    /// No scaling: divisor 1.
    None,
    /// Standard deviation over the training part; 1 if the deviation is 0.
    #[default]
    Unit,
}

impl FeatureScale {
    /// Setting `scale`, which selects the divisor of features.
    pub(crate) const SETTING: SettingInfo = SettingInfo {
        key: "scale",
        accepts: "none or unit",
        default: "unit",
        about: "whether each feature is divided by its standard deviation over the training part",
    };

    /// Reads the scale from `settings`.
    pub(crate) fn from_settings(settings: &ModelSettings) -> Result<FeatureScale, SettingError> {
        settings.value(
            &FeatureScale::SETTING,
            FeatureScale::default(),
            |name| match name {
                "none" => Some(FeatureScale::None),
                "unit" => Some(FeatureScale::Unit),
                _ => None,
            },
        )
    }
}

/// Design matrix X with one row per sample. Its entries are (feature − centre) · factor.
#[derive(Clone, Debug)]
pub(crate) struct Design<'a> {
    features: &'a Features,
    centre: Vec<f64>,
    /// Factor that multiplies each centred feature; `None` if all factors are 1.
    factor: Option<Vec<f64>>,
}

impl<'a> Design<'a> {
    /// Design centred by the mean of `features`, which must not be empty.
    pub(crate) fn new(features: &'a Features, scale: FeatureScale) -> Design<'a> {
        let centre = mean_of(features, |value, _| value);
        let factor = (scale == FeatureScale::Unit).then(|| {
            let variance = mean_of(features, |value, position| {
                (value - centre[position]).powi(2)
            });
            variance
                .into_iter()
                .map(|variance| {
                    if variance > 0.0 {
                        1.0 / variance.sqrt()
                    } else {
                        1.0
                    }
                })
                .collect()
        });
        Design {
            features,
            centre,
            factor,
        }
    }

    /// Design of other `features`, centred by their own mean, with the factors of `self`.
    pub(crate) fn recentred<'b>(&self, features: &'b Features) -> Design<'b> {
        Design {
            features,
            centre: mean_of(features, |value, _| value),
            factor: self.factor.clone(),
        }
    }

    /// Design of other samples, with the centre and factors of `self`.
    pub(crate) fn of<'b>(&self, features: &'b Features) -> Design<'b> {
        Design {
            features,
            centre: self.centre.clone(),
            factor: self.factor.clone(),
        }
    }

    /// Unscaled design centred at `centre`.
    pub(crate) fn centred_at(features: &'a Features, centre: Vec<f64>) -> Design<'a> {
        Design {
            features,
            centre,
            factor: None,
        }
    }

    pub(crate) fn samples(&self) -> usize {
        self.features.samples()
    }

    pub(crate) fn width(&self) -> usize {
        self.centre.len()
    }

    pub(crate) fn centre(&self) -> &[f64] {
        &self.centre
    }

    /// Factor of each centred feature; `None` if all factors are 1.
    pub(crate) fn factor(&self) -> Option<&[f64]> {
        self.factor.as_deref()
    }

    /// Transposed block of the design matrix, with one row per feature and one column per sample.
    pub(crate) fn block(&self, samples: Range<usize>, features: Range<usize>) -> Mat<f64> {
        let mut block = Mat::zeros(features.len(), samples.len());
        let centre = &self.centre[features.clone()];
        for (position, sample) in samples.enumerate() {
            let values = &self.features.sample(sample)[features.clone()];
            let column = block.col_as_slice_mut(position);
            for ((place, &value), centre) in column.iter_mut().zip(values).zip(centre) {
                *place = f64::from(value) - centre;
            }
            if let Some(factor) = &self.factor {
                for (place, factor) in column.iter_mut().zip(&factor[features.clone()]) {
                    *place *= factor;
                }
            }
        }
        block
    }

    /// Product of the design matrix and `right`.
    pub(crate) fn times(&self, right: MatRef<'_, f64>) -> Mat<f64> {
        stacked(self.samples(), right.ncols(), |samples, product| {
            for slab in slabs(self.width()) {
                let block = self.block(samples.clone(), slab.clone());
                let right = right.subrows(slab.start, slab.len());
                add_product(product, block.transpose(), right);
            }
        })
    }

    /// Product of the transposed design matrix and `right`.
    pub(crate) fn transpose_times(&self, right: MatRef<'_, f64>) -> Mat<f64> {
        stacked(self.width(), right.ncols(), |features, product| {
            for slab in slabs(self.samples()) {
                let block = self.block(slab.clone(), features.clone());
                let right = right.subrows(slab.start, slab.len());
                add_product(product, block.as_ref(), right);
            }
        })
    }
}

/// Mean over samples of `of(value, index)`, for the feature at each index.
fn mean_of(features: &Features, of: impl Fn(f64, usize) -> f64) -> Vec<f64> {
    let mut sums = vec![0.0; features.shape().len()];
    for sample in 0..features.samples() {
        for (position, (sum, &value)) in sums.iter_mut().zip(features.sample(sample)).enumerate() {
            *sum += of(f64::from(value), position);
        }
    }
    let count = features.samples() as f64;
    sums.iter_mut().for_each(|sum| *sum /= count);
    sums
}

/// Builds a matrix of `rows` × `columns` from blocks of rows that `fill` computes in parallel.
fn stacked(
    rows: usize,
    columns: usize,
    fill: impl Fn(Range<usize>, &mut Mat<f64>) + Sync,
) -> Mat<f64> {
    let starts: Vec<usize> = (0..rows).step_by(BLOCK).collect();
    let blocks: Vec<Mat<f64>> = starts
        .par_iter()
        .map(|&start| {
            let rows = start..rows.min(start + BLOCK);
            let mut block = Mat::zeros(rows.len(), columns);
            fill(rows, &mut block);
            block
        })
        .collect();
    let mut whole = Mat::zeros(rows, columns);
    for (&start, block) in starts.iter().zip(&blocks) {
        whole.subrows_mut(start, block.nrows()).copy_from(block);
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::FeatureShape;

    #[test]
    fn products_are_those_of_the_centred_scaled_matrix() {
        let features =
            Features::new(FeatureShape::flat(2), vec![1.0, 5.0, 3.0, 5.0]).expect("two samples");
        let design = Design::new(&features, FeatureScale::Unit);
        let right = Mat::from_fn(2, 1, |row, _| [2.0, 7.0][row]);
        // Centred: [[-1, 0], [1, 0]]; deviations 1 and 0, the latter taken as 1.
        assert_eq!(
            design.times(right.as_ref()),
            Mat::from_fn(2, 1, |row, _| [-2.0, 2.0][row])
        );
        assert_eq!(
            design.transpose_times(right.as_ref()),
            Mat::from_fn(2, 1, |row, _| [5.0, 0.0][row])
        );
    }
}
