//! A random forest.

use rayon::prelude::*;
use taceva_core::{Estimator, ModelError, Progress, Regressor, TrainingSet};

use super::bins::Binned;
use super::grow::{Ground, Growth};
use super::regressor::{Member, TreeRegressor};
use crate::choice::Choice;
use crate::features::FeatureSpec;
use crate::fit::{ModelEstimator, ModelFit, ModelRegressor};
use crate::output::OutputScale;
use crate::problem::Problem;
use crate::progress::{Stage, interrupted};
use crate::registry::ModelInfo;
use crate::settings::{SettingError, SettingInfo, Settings, number};
use taceva_core::random::SplitMix64;

/// A random forest: the mean of trees that each saw its own draw of the samples, and at each split its own draw of the features.
///
/// A tree predicts all channels at once, a split explaining the most of their summed variance, each channel relative to the range of
/// its labels. Nothing is chosen by error, so the validation part is only scored.
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
}

const TREES: SettingInfo = SettingInfo {
    key: "trees",
    accepts: "a number from 1 to 10000",
    default: "100",
    about: "how many trees there are",
};
const SHARE: SettingInfo = SettingInfo {
    key: "share",
    accepts: "a number above 0 and at most 1",
    default: "0.1",
    about: "the share of the features that a split looks at",
};
const DEPTH: SettingInfo = SettingInfo {
    key: "depth",
    accepts: "a number from 1 to 60",
    default: "30",
    about: "questions on the way to a leaf at most",
};
const LEAF: SettingInfo = SettingInfo {
    key: "leaf",
    accepts: "a number from 1 to 10000",
    default: "2",
    about: "samples of a leaf at least",
};
const SEED: SettingInfo = SettingInfo {
    key: "seed",
    accepts: "a whole number",
    default: "1",
    about: "what samples and features are drawn from",
};

impl RandomForest {
    /// What the registry says of it.
    pub const INFO: ModelInfo = ModelInfo {
        name: "random-forest",
        about: "the mean of many trees: no scale to choose, and hard to upset",
        settings: &[TREES, SHARE, DEPTH, LEAF, SEED],
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(RandomForest::from_settings(settings)?)),
    };

    /// A random forest as `settings` ask for.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &Settings) -> Result<RandomForest, SettingError> {
        settings.check_keys(RandomForest::INFO.settings)?;
        Ok(RandomForest {
            trees: settings.value(&TREES, 100, |text| number(text, 1..=10_000))?,
            share: settings.value(&SHARE, 0.1, share)?,
            depth: settings.value(&DEPTH, 30, |text| number(text, 1..=60))?,
            leaf: settings.value(&LEAF, 2, |text| number(text, 1..=10_000))?,
            seed: settings.value(&SEED, 1, |text| text.parse().ok())?,
        })
    }
}

/// A share above 0.
pub(super) fn share(text: &str) -> Option<f64> {
    number(text, 0.0..=1.0).filter(|share| *share > 0.0)
}

/// A share of some features, at least one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "at most the number of features"
)]
pub(super) fn part(share: f64, features: usize) -> usize {
    (share * features as f64).ceil().max(1.0) as usize
}

/// The generator of one draw among many from one seed.
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
        let binned = Binned::new(training.features);
        let growth = Growth {
            depth: self.depth,
            leaf: self.leaf,
            features: part(self.share, binned.features()),
        };
        let samples = problem.centred.nrows();
        let stage = Stage::begin(progress, "trees", self.trees);
        let trees: Result<Vec<Member>, ModelError> = (0..self.trees)
            .into_par_iter()
            .map(|number| {
                interrupted(progress)?;
                let mut random = draw(self.seed, number);
                let mut rows: Vec<u32> = (0..samples)
                    .map(|_| u32::try_from(random.below(samples)).expect("fewer than 2^32"))
                    .collect();
                rows.sort_unstable();
                let ground = Ground {
                    binned: &binned,
                    targets: &problem.centred,
                    growth,
                };
                let mut tree = ground.grow(rows, &mut random);
                tree.values
                    .iter_mut()
                    .for_each(|value| *value /= self.trees as f64);
                stage.advance();
                Ok(Member {
                    tree,
                    channel: None,
                })
            })
            .collect();
        drop(stage);
        let regressor = TreeRegressor::new(
            (training.targets.channels.clone(), training.features.shape()),
            OutputScale::of(&problem),
            trees?,
        );
        let errors = match &held {
            None => vec![None; problem.channels()],
            Some(part) => {
                let mut found = vec![0.0; part.labels.nrows() * problem.channels()];
                regressor.predict(part.features, &mut found)?;
                problem.errors_of(&found, part)
            }
        };
        Ok(ModelFit {
            choice: Choice::nobodys(errors),
            regressor: ModelRegressor::Trees(Box::new(regressor)),
            refitted: false,
            scaling: problem.scaling,
        })
    }
}

impl Estimator for RandomForest {
    fn name(&self) -> &'static str {
        RandomForest::INFO.name
    }

    fn fit(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<Box<dyn Regressor>, ModelError> {
        Ok(Box::new(
            self.fit_model(training, validation, progress)?.regressor,
        ))
    }
}
