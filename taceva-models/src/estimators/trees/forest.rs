//! Random forests: means of trees that are fitted to random samples.

use faer::Mat;
use rayon::prelude::*;
use taceva_core::random::SplitMix64;
use taceva_core::{Features, ModelError, Progress, Regressor, TrainingSet, whole_size};

use super::bins::Binned;
use super::grow::{Growth, Samples};
use super::regressor::{Member, TreeRegressor};
use crate::features::FeatureSpec;
use crate::linalg::progress::{ReportedStage, interrupted};
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};
use crate::training::choice::Choice;
use crate::training::fit::{ModelEstimator, ModelFit, estimator};
use crate::training::info::ModelInfo;
use crate::training::output::OutputScale;
use crate::training::problem::{Problem, centred};
use crate::training::regressor::ModelRegressor;
use crate::training::trials::{Trials, rows_of};

/// Random forest: the prediction of a channel is the mean over its trees. Each tree draws its own samples, and each split its own features.
///
/// No setting is chosen by error. With a validation part, a forest fitted to the training part is scored on it. The final forest then learns from
/// both parts, unless `refit` is false.
///
/// # Reference
/// L. Breiman, Mach. Learn. 45 (2001) 5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RandomForest {
    trees: usize,
    share: f64,
    depth: usize,
    leaf: usize,
    seed: u64,
    refit: bool,
}

const TREES: SettingInfo = SettingInfo {
    key: "trees",
    accepts: "a whole number from 1 to 10000",
    default: "100",
    about: "number of trees of each channel",
};
const SHARE: SettingInfo = SettingInfo {
    key: "share",
    accepts: "a number above 0 and at most 1",
    default: "0.3",
    about: "the share of the features that a split considers",
};
const DEPTH: SettingInfo = SettingInfo {
    key: "depth",
    accepts: "a whole number from 1 to 60",
    default: "30",
    about: "the greatest depth: comparisons on the way to a leaf",
};
const LEAF: SettingInfo = SettingInfo {
    key: "leaf",
    accepts: "a whole number from 1 to 10000",
    default: "2",
    about: "the least number of samples of a leaf",
};
const SEED: SettingInfo = SettingInfo {
    key: "seed",
    accepts: "a whole number",
    default: "1",
    about: "the seed by which samples and features are drawn",
};

impl RandomForest {
    /// Entry of the random forest in the model registry.
    pub const INFO: ModelInfo = ModelInfo {
        name: "random-forest",
        about: "the mean of many trees: the scale of features does not matter, and outliers change little",
        settings: &[TREES, SHARE, DEPTH, LEAF, SEED, SettingInfo::REFIT],
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(RandomForest::from_settings(settings)?)),
        load: TreeRegressor::load,
    };

    /// Builds the estimator from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<RandomForest, SettingError> {
        settings.check_keys(RandomForest::INFO.settings)?;
        Ok(RandomForest {
            trees: settings.value(&TREES, 100, |text| number(text, 1..=10_000))?,
            share: settings.value(&SHARE, 0.3, share)?,
            depth: settings.value(&DEPTH, 30, |text| number(text, 1..=60))?,
            leaf: settings.value(&LEAF, 2, |text| number(text, 1..=10_000))?,
            seed: settings.value(&SEED, 1, |text| text.parse().ok())?,
            refit: settings.refit()?,
        })
    }

    /// Grows the trees of every channel on `features` and the centred `labels`. Their predictions are divided by the number of trees.
    fn grown(
        &self,
        features: &Features,
        labels: &Mat<f64>,
        progress: &dyn Progress,
    ) -> Result<Vec<Member>, ModelError> {
        let binned = Binned::new(features);
        let growth = Growth {
            depth: self.depth,
            leaf: self.leaf,
            features: part(self.share, binned.features()),
        };
        let columns: Vec<Mat<f64>> = (0..labels.ncols())
            .map(|channel| Mat::from_fn(labels.nrows(), 1, |row, _| labels[(row, channel)]))
            .collect();
        let count = columns.len() * self.trees;
        let stage = ReportedStage::begin(progress, "trees", count);
        let trees = (0..count).into_par_iter().map(|place| {
            interrupted(progress)?;
            let (channel, number) = (place / self.trees, place % self.trees);
            let mut random = draw(self.seed.wrapping_add(channel as u64), number);
            let samples = labels.nrows();
            let mut rows: Vec<u32> = (0..samples)
                .map(|_| u32::try_from(random.below(samples)).expect("fewer than 2^32"))
                .collect();
            rows.sort_unstable();
            let known = Samples {
                binned: &binned,
                targets: &columns[channel],
                growth,
            };
            let mut tree = known.grow(rows, &mut random);
            let values = tree.values.iter_mut();
            values.for_each(|value| *value /= self.trees as f64);
            stage.advance();
            Ok(Member {
                tree,
                channel: Some(channel),
            })
        });
        trees.collect()
    }

    /// Fits a forest to the samples of `trials` with the indices `rows`.
    fn regressor(
        &self,
        problem: &Problem<'_>,
        trials: &Trials<'_>,
        rows: &[usize],
        progress: &dyn Progress,
    ) -> Result<TreeRegressor, ModelError> {
        let features = trials.features.select(rows);
        let (shift, labels) = centred(rows_of(&trials.labels, rows));
        let members = self.grown(&features, &labels, progress)?;
        let scale = OutputScale::of(problem).moved(&shift);
        let training = &problem.training;
        let channels = training.targets.channels.clone();
        let shape = training.features.shape();
        Ok(TreeRegressor::new(channels, shape, scale, members))
    }
}

/// Parses a setting that is a share: a number above 0 and at most 1. `None` for any other text.
pub(super) fn share(text: &str) -> Option<f64> {
    number(text, 0.0..=1.0).filter(|share| *share > 0.0)
}

/// Number of features that a split considers: `share` × `features`, rounded up, at least one.
pub(super) fn part(share: f64, features: usize) -> usize {
    whole_size((share * features as f64).ceil().max(1.0))
}

/// Random generator of the tree with the index `number`. Generators with the same seed and different numbers are independent.
pub(super) fn draw(seed: u64, number: usize) -> SplitMix64 {
    SplitMix64::new(SplitMix64::new(seed ^ (number as u64).rotate_left(32)).next_u64())
}

impl ModelEstimator for RandomForest {
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let problem = Problem::new(*training)?;
        let held = problem.validation(validation)?;
        let trials = Trials::new(&problem, held.as_ref(), false);
        let all = trials.learnt(self.refit);
        let regressor = self.regressor(&problem, &trials, &all, progress)?;
        let errors = match &held {
            None => vec![None; problem.channels()],
            Some(part) => {
                let apart = match self.refit {
                    true => {
                        Some(self.regressor(&problem, &trials, &trials.learnt(false), progress)?)
                    }
                    false => None,
                };
                let scored = apart.as_ref().unwrap_or(&regressor);
                let mut found = vec![0.0; part.labels.nrows() * problem.channels()];
                scored.predict(part.features, &mut found)?;
                problem.errors_of(&found, part)
            }
        };
        let refitted = self.refit && trials.has_validation();
        Ok(ModelFit {
            choice: Choice::nobodys(errors),
            regressor: ModelRegressor::new(regressor),
            refitted,
            scaling: problem.scaling.clone(),
        })
    }
}

estimator!(RandomForest, |_| RandomForest::INFO.name);
