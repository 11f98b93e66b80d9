//! Leave-one-out errors of ridge regression: each sample is left out alone. Blocks of samples are processed in parallel.

use faer::Mat;
use rayon::prelude::*;
use taceva_core::{ModelError, Progress};

use super::{LeaveOut, rows};
use crate::linalg::multiply;
use crate::linalg::progress::{ReportedStage, interrupted};
use crate::training::choice::Errors;

/// Number of samples per block.
const BLOCK: usize = 256;

/// Factors λ / (σ² + λ) for every eigenvalue σ² and penalty λ, and their products with the rotated targets.
struct Shrunk {
    shrinkage: Mat<f64>,
    /// Products of the factors with the rotated targets. One column per penalty and channel; channels of one penalty are adjacent.
    coefficients: Mat<f64>,
}

impl LeaveOut<'_> {
    /// Squared error, averaged over samples: one row per penalty, one column per target. Each sample is predicted by a fit to the other samples.
    pub(in crate::estimators::ridge) fn singles(
        &self,
        penalties: &[f64],
        progress: &dyn Progress,
    ) -> Result<Errors, ModelError> {
        let (samples, channels) = (self.targets.nrows(), self.targets.ncols());
        let columns = penalties.len() * channels;
        let shrinkage = self.shrinkage(penalties);
        let coefficients = Mat::from_fn(shrinkage.nrows(), columns, |row, column| {
            shrinkage[(row, column / channels)] * self.rotated[(row, column % channels)]
        });
        let shrunk = Shrunk {
            shrinkage,
            coefficients,
        };
        let rows: Vec<usize> = (0..samples).collect();
        let stage = ReportedStage::begin(progress, "leaving samples out", samples.div_ceil(BLOCK));
        let blocks: Result<Vec<Vec<f64>>, ModelError> = rows
            .par_chunks(BLOCK)
            .map(|block| {
                interrupted(progress)?;
                let squares = self.squares(block, &shrunk);
                stage.advance();
                Ok(squares)
            })
            .collect();
        let blocks = blocks?;
        let errors: Vec<f64> = (0..columns)
            .map(|column| blocks.iter().map(|block| block[column]).sum::<f64>() / samples as f64)
            .collect();
        Ok(errors.chunks_exact(channels).map(<[f64]>::to_vec).collect())
    }

    /// Squared leave-out errors, summed over the samples of `block`: one value per penalty and channel.
    fn squares(&self, block: &[usize], shrunk: &Shrunk) -> Vec<f64> {
        let channels = self.targets.ncols();
        let vectors = rows(&self.vectors, block);
        let squared = Mat::from_fn(vectors.nrows(), vectors.ncols(), |row, column| {
            vectors[(row, column)].powi(2)
        });
        let complement = multiply(squared.as_ref(), shrunk.shrinkage.as_ref());
        let residuals = multiply(vectors.as_ref(), shrunk.coefficients.as_ref());
        let unspanned_residuals = self.unspanned_residuals(block, &vectors);
        let unspanned: Vec<f64> = if self.complete {
            vec![0.0; block.len()]
        } else {
            let centring = 1.0 - 1.0 / self.targets.nrows() as f64;
            let spanned = (0..block.len()).map(|row| squared.row(row).iter().sum::<f64>());
            spanned.map(|spanned| centring - spanned).collect()
        };
        let left_out = |row: usize, column: usize| {
            let share = complement[(row, column / channels)] + unspanned[row];
            if share > 0.0 {
                (residuals[(row, column)] + unspanned_residuals[(row, column % channels)]) / share
            } else {
                // Only rounding errors remain: the penalty is too weak to judge.
                f64::INFINITY
            }
        };
        (0..residuals.ncols())
            .map(|column| {
                (0..block.len())
                    .map(|row| left_out(row, column).powi(2))
                    .sum()
            })
            .collect()
    }
}
