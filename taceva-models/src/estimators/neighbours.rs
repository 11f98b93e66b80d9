//! Nearest neighbours: mean of the most similar training samples.

mod regressor;

use faer::Mat;
use rayon::prelude::*;
use taceva_core::{ModelError, Progress, TrainingSet};

pub use self::regressor::NeighbourRegressor;
use self::regressor::{nearest, weighted};
use crate::features::FeatureSpec;
use crate::linalg::FeatureScale;
use crate::linalg::progress::interrupted;
use crate::linalg::standard::Standard;
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};
use crate::training::choice::Errors;
use crate::training::fit::{ModelEstimator, ModelFit, estimator};
use crate::training::info::ModelInfo;
use crate::training::output::OutputScale;
use crate::training::problem::Problem;
use crate::training::regressor::ModelRegressor;
use crate::training::trials::{Trials, rows_of};

/// k nearest neighbours: predicts the mean label of the k nearest training samples, weighted by 1 / distance.
///
/// Training samples at the same distance as the k-th neighbour are included. If training samples have distance 0, only their labels are averaged. The
/// k of each channel is one of 1, 2, 3, 5, 8, 13, 21, 34. The chosen k has the least squared error on the validation part, or on folds of the
/// training part if there is no validation part.
///
/// # Reference
/// T. M. Cover, P. E. Hart, IEEE Trans. Inf. Theory 13 (1967) 21; D. Shepard, ACM Nat. Conf. 23 (1968) 517 (weights).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Neighbours {
    scale: FeatureScale,
    count: Option<usize>,
    refit: bool,
}

const COUNT: SettingInfo = SettingInfo {
    key: "neighbours",
    accepts: "a whole number from 1 to 1000",
    default: "chosen for each channel",
    about: "number of training samples whose mean is the prediction",
};

/// Candidate numbers of neighbours, ascending. A greater number gives a simpler model.
const COUNTS: [usize; 8] = [1, 2, 3, 5, 8, 13, 21, 34];

impl Neighbours {
    /// Registry entry of the nearest-neighbour model.
    pub const INFO: ModelInfo = ModelInfo {
        name: "knn",
        about: "the mean of the most similar training samples: assumes nothing and never extrapolates",
        settings: &[FeatureScale::SETTING, COUNT, SettingInfo::REFIT],
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(Neighbours::from_settings(settings)?)),
        load: NeighbourRegressor::load,
    };

    /// Builds the estimator from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<Neighbours, SettingError> {
        settings.check_keys(Neighbours::INFO.settings)?;
        Ok(Neighbours {
            scale: FeatureScale::from_settings(settings)?,
            count: settings.value(&COUNT, None, |text| number(text, 1..=1000).map(Some))?,
            refit: settings.refit()?,
        })
    }
}

/// Squared errors summed over held-out samples, `[counts][channels]`.
fn squares(
    learnt: &[f32],
    labels: &Mat<f64>,
    held: &[f32],
    truth: &Mat<f64>,
    counts: &[usize],
    progress: &dyn Progress,
) -> Result<Errors, ModelError> {
    let channels = labels.ncols();
    let width = learnt.len() / labels.nrows();
    let most = counts.iter().copied().max().unwrap_or(1);
    let samples: Result<Vec<Errors>, ModelError> = held
        .par_chunks_exact(width)
        .enumerate()
        .map(|(row, sample)| {
            interrupted(progress)?;
            let near = nearest(sample, learnt, most);
            let of = |count: usize, channel: usize| {
                let found = weighted(&near, count, |sample| labels[(sample, channel)]);
                (found - truth[(row, channel)]).powi(2)
            };
            let counts = counts.iter();
            Ok(counts
                .map(|&count| (0..channels).map(|channel| of(count, channel)).collect())
                .collect())
        })
        .collect();
    let mut total = vec![vec![0.0; channels]; counts.len()];
    for own in samples? {
        let places = total.iter_mut().flatten();
        places
            .zip(own.iter().flatten())
            .for_each(|(place, own)| *place += own);
    }
    Ok(total)
}

impl ModelEstimator for Neighbours {
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let problem = Problem::new(*training)?;
        let held = problem.validation(validation)?;
        let trials = Trials::new(&problem, held.as_ref(), self.count.is_none());
        let counts = self
            .count
            .map_or_else(|| COUNTS.to_vec(), |count| vec![count]);
        let errors = trials.errors(progress, |round| {
            let features = trials.features.select(&round.learnt);
            let standard = Standard::of(&features, self.scale);
            let learnt = standard.rows(&features);
            let labels = rows_of(&trials.labels, &round.learnt);
            let held = standard.rows(&trials.features.select(&round.held));
            let truth = rows_of(&trials.labels, &round.held);
            squares(&learnt, &labels, &held, &truth, &counts, progress)
        })?;
        let values: Vec<f64> = counts.iter().map(|&count| count as f64).collect();
        let (chosen, choice) = trials.choose(&problem, COUNT.key, &values, errors.as_ref());
        let rows = trials.learnt(self.refit);
        let standard = Standard::of(training.features, self.scale);
        let features = trials.features.select(&rows);
        let labels = rows_of(&trials.labels, &rows);
        let regressor = NeighbourRegressor::new(
            training.targets.channels.clone(),
            training.features.shape(),
            standard.rows(&features),
            standard,
            &labels,
            OutputScale::of(&problem),
            chosen.iter().map(|&candidate| counts[candidate]).collect(),
        );
        let refitted = self.refit && trials.has_validation();
        Ok(ModelFit {
            regressor: ModelRegressor::new(regressor),
            choice,
            refitted,
            scaling: problem.scaling.clone(),
        })
    }
}

estimator!(Neighbours, |_| Neighbours::INFO.name);
