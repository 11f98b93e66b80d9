//! Covariance of samples within classes. Shrinkage makes the matrix invertible even for few samples.

use std::ops::Range;

use faer::Mat;
use taceva_core::{ModelError, Progress};

use crate::linalg::progress::interrupted;
use crate::linalg::{multiply, symmetric_eigen};

/// Function that reads a range of samples as a matrix of shape `[features, samples]`.
pub(super) type Blocks<'a> = dyn Fn(Range<usize>) -> Mat<f64> + Sync + 'a;

/// Number of samples per block.
const BLOCK: usize = 1024;

/// Divides `samples` samples into ranges of at most `BLOCK` samples.
pub(super) fn ranges(samples: usize) -> impl Iterator<Item = Range<usize>> {
    (0..samples)
        .step_by(BLOCK)
        .map(move |start| start..samples.min(start + BLOCK))
}

/// Mean features of each class; `None` for a class without samples.
pub(super) fn means(blocks: &Blocks<'_>, classes: &[usize]) -> Vec<Option<Vec<f64>>> {
    let count = classes.iter().max().map_or(0, |greatest| greatest + 1);
    let mut sums: Vec<(f64, Vec<f64>)> = vec![(0.0, Vec::new()); count];
    for range in ranges(classes.len()) {
        let block = blocks(range.clone());
        for (column, &class) in classes[range].iter().enumerate() {
            let (count, sum) = &mut sums[class];
            *count += 1.0;
            sum.resize(block.nrows(), 0.0);
            let sample = block.col_as_slice(column);
            sum.iter_mut()
                .zip(sample)
                .for_each(|(sum, value)| *sum += value);
        }
    }
    sums.into_iter()
        .map(|(count, sum)| {
            let mean = || sum.iter().map(|sum| sum / count).collect();
            (count > 0.0).then(mean)
        })
        .collect()
}

/// Covariance of samples about their class means, with the sums that its shrinkage needs.
pub(super) struct Scatter {
    covariance: Mat<f64>,
    samples: f64,
    /// Sum over samples of the fourth power of the distance between a sample's features and its class mean.
    fourth_powers: f64,
}

impl Scatter {
    pub(super) fn of(
        blocks: &Blocks<'_>,
        classes: &[usize],
        means: &[Option<Vec<f64>>],
        progress: &dyn Progress,
    ) -> Result<Scatter, ModelError> {
        let samples = classes.len() as f64;
        let mut fourth_powers = 0.0;
        let mut covariance = Mat::zeros(0, 0);
        for range in ranges(classes.len()) {
            interrupted(progress)?;
            let mut block = blocks(range.clone());
            for (column, &class) in classes[range].iter().enumerate() {
                let mean = means[class]
                    .as_ref()
                    .expect("the class of a sample has a mean");
                let sample = block.col_as_slice_mut(column);
                let mut square = 0.0;
                for (value, mean) in sample.iter_mut().zip(mean) {
                    *value -= mean;
                    square += *value * *value;
                }
                fourth_powers += square * square;
            }
            let products = multiply(block.as_ref(), block.transpose());
            covariance = if covariance.nrows() == 0 {
                products
            } else {
                covariance + products
            };
        }
        Ok(Scatter {
            covariance: covariance * faer::Scale(samples.recip()),
            samples,
            fourth_powers,
        })
    }

    /// Shrunk covariance: the weighted mean of the covariance and a multiple of the identity matrix.
    pub(super) fn shrunk(self) -> Mat<f64> {
        let mut covariance = self.covariance;
        let length = covariance.nrows();
        let p = length as f64;
        let mean = (0..length).map(|at| covariance[(at, at)]).sum::<f64>() / p;
        let columns = (0..length).map(|column| covariance.col_as_slice(column));
        let whole: f64 = columns.flatten().map(|value| value * value).sum();
        // ‖S − mI‖² = ‖S‖² − p m²; and Σ‖xxᵀ − S‖² = Σ (xᵀx)² − 2 xᵀSx + ‖S‖², of which Σ xᵀSx = n ‖S‖².
        let spread = (whole - p * mean * mean).max(0.0);
        let n = self.samples;
        let error = ((self.fourth_powers - n * whole) / (n * n)).clamp(0.0, spread);
        let share = if spread > 0.0 { error / spread } else { 1.0 };
        for column in 0..length {
            for value in covariance.col_as_slice_mut(column) {
                *value *= 1.0 - share;
            }
            covariance[(column, column)] += share * mean;
        }
        covariance
    }
}

/// Inverse square root of the covariance `scatter`, up to a rotation. The identity matrix if `scatter` is zero.
pub(super) fn whitening(scatter: &Mat<f64>) -> Result<Mat<f64>, ModelError> {
    let length = scatter.nrows();
    let (values, vectors) = symmetric_eigen(scatter.as_ref())?;
    let greatest = values.last().copied().unwrap_or(0.0);
    // Directions without scatter, to within rounding, get no weight.
    let least = greatest * f64::EPSILON;
    let mut whitening = Mat::zeros(length, length);
    for (position, value) in values.iter().enumerate() {
        let scale = if *value > least {
            value.sqrt().recip()
        } else {
            0.0
        };
        for place in 0..length {
            whitening[(position, place)] = scale * vectors[(place, position)];
        }
    }
    if greatest <= 0.0 {
        return Ok(Mat::identity(length, length));
    }
    Ok(whitening)
}
