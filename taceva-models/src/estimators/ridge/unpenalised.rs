//! Ridge regression of strength 0: least squares, solved without a spectrum.

use faer::Mat;
use taceva_core::{ModelError, Progress, TrainingSet};

use super::{Ridge, STRENGTH};
use crate::estimators::linear::{LinearFit, LinearRegressor};
use crate::linalg::progress::interrupted;
use crate::linalg::{Design, Wide, least_squares};
use crate::training::problem::{Problem, Validation, centred};
use crate::training::trials::{Trials, rows_of};

impl Ridge {
    /// Fits by least squares without a penalty. No Gram matrix is formed, because its eigenvalues lose half of the digits.
    pub(super) fn fit_unpenalised(
        &self,
        training: &TrainingSet<'_>,
        problem: &Problem<'_>,
        validation: Option<&Validation<'_>>,
        progress: &dyn Progress,
    ) -> Result<LinearFit, ModelError> {
        let trials = Trials::new(problem, validation, false);
        let errors = trials.errors(progress, |round| {
            let features = trials.features.select(&round.learnt);
            let design = Design::new(&features, self.scale);
            let (shift, labels) = centred(rows_of(&trials.labels, &round.learnt));
            let weights = weights(&design, &labels)?;
            let held = trials.features.select(&round.held);
            let found = design.of(&held).times(weights.as_ref());
            let square = |channel: usize| {
                let found = found.col_as_slice(channel).iter().zip(&round.held);
                let errors = found.map(|(found, &row)| {
                    (found + shift[channel] - trials.labels[(row, channel)]).powi(2)
                });
                errors.sum()
            };
            Ok(vec![(0..problem.channels()).map(square).collect()])
        })?;
        interrupted(progress)?;
        let (_, choice) = trials.choose(problem, STRENGTH.key, &[0.0], errors.as_ref());
        let rows = trials.learnt(self.refit);
        let features = trials.features.select(&rows);
        let design = Design::new(training.features, self.scale).recentred(&features);
        let (shift, labels) = centred(rows_of(&trials.labels, &rows));
        let weights = weights(&design, &labels)?;
        let mean: Vec<f64> = problem
            .mean
            .iter()
            .zip(&shift)
            .map(|(a, b)| a + b)
            .collect();
        Ok(LinearFit {
            regressor: LinearRegressor::from_scaled(problem, &design, &weights, &mean)?,
            choice,
            refitted: self.refit && trials.has_validation(),
            scaling: problem.scaling.clone(),
        })
    }
}

fn weights(design: &Design<'_>, labels: &Mat<f64>) -> Result<Mat<f64>, ModelError> {
    let block = design.block(0..design.samples(), 0..design.width());
    let matrix = block.transpose().to_owned();
    let wide = Wide {
        high: &matrix,
        low: None,
    };
    let solutions = least_squares(wide, labels)?;
    Ok(Mat::from_fn(
        design.width(),
        labels.ncols(),
        |row, channel| solutions[channel].refined[row],
    ))
}
