//! Gradient boosting: sums of trees, each fitted to the errors of earlier trees.

use faer::Mat;
use rayon::prelude::*;
use taceva_core::{Features, ModelError, Progress, TrainingSet};

use super::bins::Binned;
use super::forest::{draw, part, share};
use super::grow::{Growth, Samples, Tree};
use super::regressor::{Member, TreeRegressor};
use crate::features::FeatureSpec;
use crate::linalg::progress::{ReportedStage, interrupted};
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};
use crate::training::fit::{ModelEstimator, ModelFit, estimator};
use crate::training::info::ModelInfo;
use crate::training::output::OutputScale;
use crate::training::problem::{Problem, centred};
use crate::training::regressor::ModelRegressor;
use crate::training::trials::{Trials, rows_of};

/// Gradient boosting of squared errors. Each tree is fitted to the residuals of the previous trees, and a share of its predictions is added.
///
/// Each channel has its own trees. Their number is chosen by the least squared error on the validation part. Without a validation part, folds of the
/// training part are left out in turn.
///
/// # Reference
/// J. H. Friedman, Ann. Stat. 29 (2001) 1189, algorithm 2; Comput. Stat. Data Anal. 38 (2002) 367 (features are drawn here instead of samples).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GradientBoosting {
    most: usize,
    trees: Option<usize>,
    rate: f64,
    growth: Growing,
    seed: u64,
    refit: bool,
}

/// Channel to fit, and the number of its trees.
#[derive(Clone, Copy)]
struct Ensemble {
    channel: usize,
    /// Number of trees.
    trees: usize,
}

/// Limits of each tree: share of features per split, depth, and samples per leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Growing {
    share: f64,
    depth: usize,
    leaf: usize,
}

const MOST: SettingInfo = SettingInfo {
    key: "most",
    accepts: "a whole number from 1 to 10000",
    default: "300",
    about: "greatest number of trees of a channel to try, if their number is chosen",
};
const TREES: SettingInfo = SettingInfo {
    key: "trees",
    accepts: "a whole number from 1 to 10000",
    default: "chosen for each channel",
    about: "number of trees of each channel",
};
const RATE: SettingInfo = SettingInfo {
    key: "rate",
    accepts: "a number above 0 and at most 1",
    default: "0.1",
    about: "the share of each tree that is added",
};
const SHARE: SettingInfo = SettingInfo {
    key: "share",
    accepts: "a number above 0 and at most 1",
    default: "0.1",
    about: "the share of the features that a split considers",
};
const DEPTH: SettingInfo = SettingInfo {
    key: "depth",
    accepts: "a whole number from 1 to 30",
    default: "5",
    about: "the greatest depth: comparisons on the way to a leaf",
};
const LEAF: SettingInfo = SettingInfo {
    key: "leaf",
    accepts: "a whole number from 1 to 10000",
    default: "5",
    about: "the least number of samples of a leaf",
};
const SEED: SettingInfo = SettingInfo {
    key: "seed",
    accepts: "a whole number",
    default: "1",
    about: "the seed by which features are drawn",
};

impl GradientBoosting {
    /// Entry of gradient boosting in the model registry.
    pub const INFO: ModelInfo = ModelInfo {
        name: "gradient-boosting",
        about: "gradient boosting: trees that are each fitted to the errors of earlier trees",
        settings: &[
            TREES,
            MOST,
            RATE,
            SHARE,
            DEPTH,
            LEAF,
            SEED,
            SettingInfo::REFIT,
        ],
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(GradientBoosting::from_settings(settings)?)),
        load: TreeRegressor::load,
    };

    /// Builds the estimator from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<GradientBoosting, SettingError> {
        settings.check_keys(GradientBoosting::INFO.settings)?;
        Ok(GradientBoosting {
            most: settings.value(&MOST, 300, |text| number(text, 1..=10_000))?,
            trees: settings.value(&TREES, None, |text| number(text, 1..=10_000).map(Some))?,
            rate: settings.value(&RATE, 0.1, share)?,
            growth: Growing {
                share: settings.value(&SHARE, 0.1, share)?,
                depth: settings.value(&DEPTH, 5, |text| number(text, 1..=30))?,
                leaf: settings.value(&LEAF, 5, |text| number(text, 1..=10_000))?,
            },
            seed: settings.value(&SEED, 1, |text| text.parse().ok())?,
            refit: settings.refit()?,
        })
    }

    /// Fits the trees of one channel to centred `labels`, and calls `take` with each. The predictions of each tree are already multiplied by the
    /// learning rate.
    fn boost(
        &self,
        features: &Features,
        binned: &Binned,
        labels: &[f64],
        ensemble: Ensemble,
        progress: &dyn Progress,
        mut take: impl FnMut(Tree),
    ) -> Result<(), ModelError> {
        let Ensemble { channel, trees } = ensemble;
        let growth = Growth {
            depth: self.growth.depth,
            leaf: self.growth.leaf,
            features: part(self.growth.share, binned.features()),
        };
        let mut left = Mat::from_fn(labels.len(), 1, |row, _| labels[row]);
        let rows: Vec<u32> = (0..labels.len())
            .map(|row| u32::try_from(row).expect("fewer than 2^32"))
            .collect();
        for number in 0..trees {
            interrupted(progress)?;
            let samples = Samples {
                binned,
                targets: &left,
                growth,
            };
            let mut random = draw(self.seed.wrapping_add(channel as u64), number);
            let mut tree = samples.grow(rows.clone(), &mut random);
            tree.values.iter_mut().for_each(|value| *value *= self.rate);
            let places = left.col_as_slice_mut(0).par_iter_mut();
            places.enumerate().for_each(|(row, place)| {
                *place -= tree.values[tree.leaf(features.sample(row))];
            });
            take(tree);
        }
        Ok(())
    }
}

impl ModelEstimator for GradientBoosting {
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let problem = Problem::new(*training)?;
        let held = problem.validation(validation)?;
        let trials = Trials::new(&problem, held.as_ref(), self.trees.is_none());
        let channels = problem.channels();
        // Descending: of numbers with equal errors, the last and smallest number is chosen.
        let counts: Vec<usize> = match self.trees {
            Some(trees) => vec![trees],
            None => (1..=self.most).rev().collect(),
        };
        let most = counts[0];
        let errors = trials.errors(progress, |round| {
            let features = trials.features.select(&round.learnt);
            let binned = Binned::new(&features);
            let (shift, labels) = centred(rows_of(&trials.labels, &round.learnt));
            let held = trials.features.select(&round.held);
            let mut squares = vec![vec![0.0; channels]; counts.len()];
            for channel in 0..channels {
                let mut left: Vec<f64> = round
                    .held
                    .iter()
                    .map(|&row| trials.labels[(row, channel)] - shift[channel])
                    .collect();
                let mut number = 0;
                let column = labels.col_as_slice(channel);
                self.boost(
                    &features,
                    &binned,
                    column,
                    Ensemble {
                        channel,
                        trees: most,
                    },
                    progress,
                    |tree| {
                        let places = left.par_iter_mut().enumerate();
                        places.for_each(|(row, place)| {
                            *place -= tree.values[tree.leaf(held.sample(row))];
                        });
                        number += 1;
                        if let Some(candidate) = counts.iter().position(|&count| count == number) {
                            squares[candidate][channel] = left.iter().map(|left| left * left).sum();
                        }
                    },
                )?;
            }
            Ok(squares)
        })?;
        let values: Vec<f64> = counts.iter().map(|&count| count as f64).collect();
        let (chosen, choice) = trials.choose(&problem, TREES.key, &values, errors.as_ref());
        let rows = trials.learnt(self.refit);
        let features = trials.features.select(&rows);
        let binned = Binned::new(&features);
        let (shift, labels) = centred(rows_of(&trials.labels, &rows));
        let mut members = Vec::new();
        let stage = ReportedStage::begin(progress, "trees", channels);
        for (channel, &candidate) in chosen.iter().enumerate() {
            let column = labels.col_as_slice(channel);
            let trees = counts[candidate];
            self.boost(
                &features,
                &binned,
                column,
                Ensemble { channel, trees },
                progress,
                |tree| {
                    members.push(Member {
                        tree,
                        channel: Some(channel),
                    });
                },
            )?;
            stage.advance();
        }
        drop(stage);
        let scale = OutputScale::of(&problem).moved(&shift);
        let refitted = self.refit && trials.has_validation();
        let shape = training.features.shape();
        let regressor =
            TreeRegressor::new(training.targets.channels.clone(), shape, scale, members);
        Ok(ModelFit {
            regressor: ModelRegressor::new(regressor),
            choice,
            refitted,
            scaling: problem.scaling.clone(),
        })
    }
}

estimator!(GradientBoosting, |_| GradientBoosting::INFO.name);
