//! Support vector regression.

mod descent;

use faer::Mat;
use rayon::prelude::*;
use taceva_core::{Features, ModelError, Progress, TrainingSet};

use self::descent::{Tube, descend};
use super::regressor::KernelRegressor;
use super::ridge::fit_best;
use super::{Kernel, LANDMARKS, LENGTH};
use crate::estimators::linear::LinearRegressor;
use crate::features::FeatureSpec;
use crate::linalg::{Design, FeatureScale};
use crate::registry::ModelInfo;
use crate::settings::{SettingError, SettingInfo, Settings, number};
use crate::training::fit::{ModelEstimator, ModelFit, ModelRegressor, estimator};
use crate::training::problem::{Problem, centred};
use crate::training::progress::{Stage, interrupted};
use crate::training::trials::{Trials, rows_of};

/// Support vector regression on landmarks: errors within a tube cost nothing, those beyond it their size.
///
/// Minimises ½‖w‖² + C Σ max(0, |y − wᵀφ| − ε) of labels centred and scaled to the range 1, for each channel. The length of the
/// kernel is that of [`KernelRidge`](super::KernelRidge); of the costs C 1000, 100, 10, 1, 0.1 each channel gets the one of least squared
/// error on the validation part or on folds of the training part.
///
/// # Reference
/// C.-H. Ho, C.-J. Lin, J. Mach. Learn. Res. 13 (2012) 3323 (dual coordinate descent).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupportVectors {
    kernel: Kernel,
    cost: Option<f64>,
    tube: f64,
    refit: bool,
}

const COST: SettingInfo = SettingInfo {
    key: "cost",
    accepts: "a number from 1e-6 to 1e6",
    default: "chosen for each channel",
    about: "what an error beyond the tube costs",
};
const TUBE: SettingInfo = SettingInfo {
    key: "tube",
    accepts: "a number from 0 to 1",
    default: "0.01",
    about: "the error that costs nothing, as a share of the range of labels",
};

/// The costs that are tried, the plainest last.
const COSTS: [f64; 5] = [1000.0, 100.0, 10.0, 1.0, 0.1];

impl SupportVectors {
    /// What the registry says of it.
    pub const INFO: ModelInfo = ModelInfo {
        name: "svr",
        about: "support vector regression: a few wrong labels do not bend it",
        settings: &[
            FeatureScale::SETTING,
            LENGTH,
            LANDMARKS,
            COST,
            TUBE,
            SettingInfo::REFIT,
        ],
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(SupportVectors::from_settings(settings)?)),
    };

    /// Support vector regression as `settings` ask for.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &Settings) -> Result<SupportVectors, SettingError> {
        settings.check_keys(SupportVectors::INFO.settings)?;
        Ok(SupportVectors {
            kernel: Kernel::from_settings(settings)?,
            cost: settings.value(&COST, None, |text| number(text, 1e-6..=1e6).map(Some))?,
            tube: settings.value(&TUBE, 0.01, |text| number(text, 0.0..=1.0))?,
            refit: settings.refit()?,
        })
    }

    /// The weights of the centred features of `design`, a column each of `columns`: a channel of `labels` and a cost.
    fn weights(
        &self,
        design: &Design<'_>,
        labels: &Mat<f64>,
        columns: &[(usize, f64)],
        progress: &dyn Progress,
    ) -> Result<Mat<f64>, ModelError> {
        let rows = design.block(0..design.samples(), 0..design.width());
        let stage = Stage::begin(progress, "support vectors", columns.len());
        let weights: Result<Vec<Vec<f64>>, ModelError> = columns
            .par_iter()
            .map(|&(channel, cost)| {
                interrupted(progress)?;
                let tube = Tube {
                    cost,
                    half_width: self.tube,
                };
                let weights = descend(&rows, labels.col_as_slice(channel), tube);
                stage.advance();
                Ok(weights)
            })
            .collect();
        let weights = weights?;
        Ok(Mat::from_fn(
            design.width(),
            columns.len(),
            |row, column| weights[column][row],
        ))
    }
}

impl ModelEstimator for SupportVectors {
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let (mapped, _) = fit_best(&self.kernel, false, training, validation, progress)?;
        let set = mapped.training(training);
        let problem = Problem::new(set)?;
        let held = mapped.validation(validation);
        let held = problem.validation(held.as_ref())?;
        let trials = Trials::new(&problem, held.as_ref(), self.cost.is_none());
        let costs = self.cost.map_or_else(|| COSTS.to_vec(), |cost| vec![cost]);
        let channels = problem.channels();
        let columns: Vec<(usize, f64)> = costs
            .iter()
            .flat_map(|&cost| (0..channels).map(move |channel| (channel, cost)))
            .collect();
        let learn = |features: &Features, rows: &[usize], columns: &[(usize, f64)]| {
            let (shift, labels) = centred(rows_of(&trials.labels, rows));
            let design = Design::new(features, FeatureScale::None);
            let weights = self.weights(&design, &labels, columns, progress)?;
            Ok::<_, ModelError>((shift, weights))
        };
        let errors = trials.errors(progress, |round| {
            let features = trials.features.select(&round.learnt);
            let (shift, weights) = learn(&features, &round.learnt, &columns)?;
            let held = trials.features.select(&round.held);
            let found = Design::new(&features, FeatureScale::None)
                .of(&held)
                .times(weights.as_ref());
            let square = |column: usize, channel: usize| {
                let found = found.col_as_slice(column).iter().enumerate();
                found
                    .map(|(row, found)| {
                        let label = trials.labels[(round.held[row], channel)];
                        (found + shift[channel] - label).powi(2)
                    })
                    .sum()
            };
            let all = columns.iter().enumerate();
            let squares: Vec<f64> = all
                .map(|(column, &(channel, _))| square(column, channel))
                .collect();
            Ok(squares
                .chunks_exact(channels)
                .map(<[f64]>::to_vec)
                .collect())
        })?;
        let (chosen, choice) = trials.choose(&problem, COST.key, &costs, errors.as_ref());
        let columns: Vec<(usize, f64)> = chosen
            .iter()
            .map(|&candidate| costs[candidate])
            .enumerate()
            .collect();
        let rows = trials.learnt(self.refit);
        let features = trials.features.select(&rows);
        let (shift, weights) = learn(&features, &rows, &columns)?;
        let mean: Vec<f64> = problem
            .mean
            .iter()
            .zip(&shift)
            .map(|(a, b)| a + b)
            .collect();
        let design = Design::new(&features, FeatureScale::None);
        let linear = LinearRegressor::from_mapped(&problem, &design, &weights, &mean)?;
        let refitted = self.refit && trials.has_validation();
        drop(trials);
        let shape = training.features.shape();
        let scaling = problem.scaling;
        Ok(ModelFit {
            regressor: ModelRegressor::Kernel(Box::new(KernelRegressor::new(
                shape, mapped.map, linear, None,
            ))),
            choice,
            scaling,
            refitted,
        })
    }
}

estimator!(SupportVectors, |_| SupportVectors::INFO.name);
