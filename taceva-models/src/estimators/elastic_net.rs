//! Elastic net: least squares with a penalty that makes most weights 0.

mod descent;
mod predictors;

use faer::Mat;
use rayon::prelude::*;
use taceva_core::{Features, ModelError, Progress, TrainingSet};

use self::descent::{Penalty, path};
use self::predictors::{Predictors, Target};
use crate::estimators::linear::{LinearEstimator, LinearFit, LinearRegressor};
use crate::features::FeatureSpec;
use crate::linalg::progress::interrupted;
use crate::linalg::{Design, FeatureScale};
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};
use crate::training::fit::estimator;
use crate::training::info::ModelInfo;
use crate::training::problem::{Problem, centred};
use crate::training::trials::{Trials, rows_of};

/// Elastic net: minimises ½n⁻¹ Σ (y − b − wᵀx)² + λ (α‖w‖₁ + ½(1 − α)‖w‖²) for each channel. The sum is over n samples with features x and label y. w
/// are the weights, and α is the setting `mix`. The intercept b is not penalised.
///
/// λ is the strength times the least λ at which every weight is 0. The strength of each channel is one of the 25 values 1, 10⁻¹ᐟ⁶ … 10⁻⁴. The chosen
/// strength has the least squared error on the validation part, or on folds of the training part if there is no validation part.
///
/// # Reference
/// H. Zou, T. Hastie, J. R. Stat. Soc. B 67 (2005) 301; J. Friedman, T. Hastie, R. Tibshirani, J. Stat. Softw. 33 (2010) 1, sec. 2.2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticNet {
    scale: FeatureScale,
    strength: Option<f64>,
    mix: f64,
    refit: bool,
}

const STRENGTH: SettingInfo = SettingInfo {
    key: "strength",
    accepts: "a number from 1e-6 to 1",
    default: "chosen for each channel",
    about: "the penalty on weights, relative to the least penalty that sets every weight to 0",
};
const MIX: SettingInfo = SettingInfo {
    key: "mix",
    accepts: "a number from 0.01 to 1",
    default: "0.5",
    about: "the share of the penalty on absolute values instead of squares: 1 is the lasso",
};

/// Weights of one channel, `[strengths][features]`.
type Path = Vec<Vec<f64>>;

impl ElasticNet {
    /// Registry entry of the elastic net.
    pub const INFO: ModelInfo = ModelInfo {
        name: "elastic-net",
        about: "least squares that leaves most weights at 0: shows which pixels matter",
        settings: &[FeatureScale::SETTING, STRENGTH, MIX, SettingInfo::REFIT],
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(ElasticNet::from_settings(settings)?)),
        load: LinearRegressor::load,
    };

    /// Builds the estimator from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<ElasticNet, SettingError> {
        settings.check_keys(ElasticNet::INFO.settings)?;
        Ok(ElasticNet {
            scale: FeatureScale::from_settings(settings)?,
            strength: settings.value(&STRENGTH, None, |text| number(text, 1e-6..=1.0).map(Some))?,
            mix: settings.value(&MIX, 0.5, |text| number(text, 0.01..=1.0))?,
            refit: settings.refit()?,
        })
    }

    /// Candidate strengths of the penalty, ascending. Of strengths with equal errors, the greatest is chosen.
    fn strengths(&self) -> Vec<f64> {
        let grid = || {
            (0..=24)
                .map(|step| 10_f64.powf(f64::from(step - 24) / 6.0))
                .collect()
        };
        self.strength.map_or_else(grid, |strength| vec![strength])
    }

    /// Returns the mean label of each channel, and the weights of each channel at each strength of the penalty.
    fn solve(
        &self,
        design: &Design<'_>,
        labels: Mat<f64>,
        progress: &dyn Progress,
    ) -> Result<(Vec<f64>, Vec<Path>), ModelError> {
        let (shift, labels) = centred(labels);
        let predictors = Predictors::of(design, progress)?;
        let products = design.transpose_times(labels.as_ref());
        let strengths = self.strengths();
        // Reports the error of the first failing channel, in any order of threads.
        let channels: Vec<Result<Path, ModelError>> = (0..labels.ncols())
            .into_par_iter()
            .map(|channel| {
                interrupted(progress)?;
                let penalty = Penalty {
                    strengths: &strengths,
                    mix: self.mix,
                };
                let target = Target {
                    labels: labels.col_as_slice(channel),
                    products: products.col_as_slice(channel),
                };
                path(&predictors, target, penalty, progress)
            })
            .collect();
        let channels = channels.into_iter().collect::<Result<_, _>>()?;
        Ok((shift, channels))
    }
}

impl LinearEstimator for ElasticNet {
    fn fit_linear(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<LinearFit, ModelError> {
        let width = training.features.shape().len();
        let problem = Problem::new(*training)?;
        let held = problem.validation(validation)?;
        let trials = Trials::new(&problem, held.as_ref(), self.strength.is_none());
        let strengths = self.strengths();
        let errors = trials.errors(progress, |round| {
            let features = trials.features.select(&round.learnt);
            let design = Design::new(&features, self.scale);
            let labels = rows_of(&trials.labels, &round.learnt);
            let (shift, paths) = self.solve(&design, labels, progress)?;
            let held = trials.features.select(&round.held);
            let truth = rows_of(&trials.labels, &round.held);
            let mut squares = vec![vec![0.0; paths.len()]; strengths.len()];
            for (channel, path) in paths.iter().enumerate() {
                let weights = Mat::from_fn(width, path.len(), |row, column| path[column][row]);
                let found = design.of(&held).times(weights.as_ref());
                for (column, squares) in squares.iter_mut().enumerate() {
                    let pairs = found
                        .col_as_slice(column)
                        .iter()
                        .zip(truth.col_as_slice(channel));
                    squares[channel] = pairs
                        .map(|(found, label)| (found + shift[channel] - label).powi(2))
                        .sum();
                }
            }
            Ok(squares)
        })?;
        let (chosen, choice) = trials.choose(&problem, STRENGTH.key, &strengths, errors.as_ref());
        let refitted = self.refit && trials.has_validation();
        let rows = trials.learnt(self.refit);
        let features: Features = trials.features.select(&rows);
        let design = Design::new(training.features, self.scale).recentred(&features);
        let (shift, paths) = self.solve(&design, rows_of(&trials.labels, &rows), progress)?;
        let weights = Mat::from_fn(width, paths.len(), |row, channel| {
            paths[channel][chosen[channel]][row]
        });
        let mean: Vec<f64> = problem
            .mean
            .iter()
            .zip(&shift)
            .map(|(a, b)| a + b)
            .collect();
        Ok(LinearFit {
            regressor: LinearRegressor::from_scaled(&problem, &design, &weights, &mean)?,
            choice,
            refitted,
            scaling: problem.scaling.clone(),
        })
    }
}

estimator!(ElasticNet, |_| ElasticNet::INFO.name);
