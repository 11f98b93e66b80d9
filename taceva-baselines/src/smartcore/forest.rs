//! `smartcore/random-forest` and `smartcore/extra-trees`: the mean of many trees.

use rayon::prelude::*;
use serde_json::Value;
use smartcore::ensemble::extra_trees_regressor::{
    ExtraTreesRegressor, ExtraTreesRegressorParameters,
};
use smartcore::ensemble::random_forest_regressor::{
    RandomForestRegressor, RandomForestRegressorParameters,
};
use smartcore::linalg::basic::matrix::DenseMatrix;
use taceva_core::{ErrorKind, ModelError};
use taceva_models::{
    LibraryLearner, LibraryModel, LibraryPredictor, LibrarySettings, LibrarySizes, LibraryTask,
    ModelInfo, SettingError, SettingInfo, Settings, library_estimator,
};

use super::{RELEASE, records};
use crate::guard::{guarded, interrupted};
use crate::predictor::{Node, Tree, Trees};
use crate::setting::{candidates, number, open};

/// A forest, each target alone: of trees on samples drawn with replacement that split where that explains most, or (extra trees) of trees
/// on all samples that split at random places.
struct Forest {
    settings: LibrarySettings,
    model: &'static LibraryModel,
    trees: usize,
    leaf: usize,
    share: Option<f64>,
    seed: u32,
}

const TREES: SettingInfo = SettingInfo {
    key: "trees",
    accepts: "a whole number from 1 to 1000",
    default: "100",
    about: "how many trees there are",
};
const LEAF: SettingInfo = SettingInfo {
    key: "leaf",
    accepts: "a whole number from 1 to 1000",
    default: "1",
    about: "samples that a leaf has at least",
};
const SHARE: SettingInfo = SettingInfo {
    key: "share",
    accepts: "a number from 0.001 to 1",
    default: "chosen for each channel",
    about: "the share of features that a split chooses among",
};
const SEED: SettingInfo = SettingInfo {
    key: "seed",
    accepts: "a whole number",
    default: "0",
    about: "what trees are drawn from",
};

/// From the most to the fewest: of equals the last is the cheapest.
const SHARES: [f64; 3] = [0.3, 0.1, 0.03];

const SETTINGS: &[SettingInfo] = &[
    LibrarySettings::SCALE,
    TREES,
    LEAF,
    SHARE,
    SEED,
    LibrarySettings::REFIT,
];

pub(super) static FOREST: LibraryModel = LibraryModel {
    info: ModelInfo::of_library(
        "smartcore/random-forest",
        "smartcore: random forest, a forest a channel",
        SETTINGS,
        |settings| Ok(library_estimator(Forest::from_settings(&FOREST, settings)?)),
    ),
    release: RELEASE,
    work,
    load: Trees::load,
};

pub(super) static EXTRA_TREES: LibraryModel = LibraryModel {
    info: ModelInfo::of_library(
        "smartcore/extra-trees",
        "smartcore: extremely randomised trees, a forest a channel",
        SETTINGS,
        |settings| {
            Ok(library_estimator(Forest::from_settings(
                &EXTRA_TREES,
                settings,
            )?))
        },
    ),
    release: RELEASE,
    work,
    load: Trees::load,
};

/// A hundred trees at four shares, each of which keeps every feature sorted at every depth.
fn work(sizes: LibrarySizes) -> Option<f64> {
    let LibrarySizes {
        samples,
        features,
        targets,
    } = sizes;
    let samples = samples as f64;
    let depth = 2.0 * samples.log2().max(1.0);
    Some(4.0 * 100.0 * 2.0 * targets as f64 * samples * features as f64 * depth)
}

impl Forest {
    fn from_settings(
        model: &'static LibraryModel,
        settings: &Settings,
    ) -> Result<Forest, SettingError> {
        settings.check_keys(SETTINGS)?;
        Ok(Forest {
            settings: LibrarySettings::from_settings(settings)?,
            model,
            trees: number(settings, &TREES, 100, 1..=1000)?,
            leaf: number(settings, &LEAF, 1, 1..=1000)?,
            share: open(settings, &SHARE, 0.001..=1.0)?,
            seed: number(settings, &SEED, 0, 0..=u32::MAX)?,
        })
    }

    /// The trees of one target as the library serialises them.
    fn grown(
        &self,
        records: &DenseMatrix<f64>,
        labels: &Vec<f64>,
        among: usize,
    ) -> Result<Value, ModelError> {
        let name = self.model.info.name;
        let said = |error: smartcore::error::Failed| error.to_string();
        let kept = |error: serde_json::Error| error.to_string();
        if std::ptr::eq(self.model, &EXTRA_TREES) {
            let parameters = ExtraTreesRegressorParameters::default()
                .with_n_trees(self.trees)
                .with_min_samples_leaf(self.leaf)
                .with_m(among)
                .with_seed(u64::from(self.seed));
            return guarded(name, || {
                let fitted = ExtraTreesRegressor::fit(records, labels, parameters).map_err(said)?;
                serde_json::to_value(&fitted).map_err(kept)
            });
        }
        let parameters = RandomForestRegressorParameters::default()
            .with_n_trees(self.trees)
            .with_min_samples_leaf(self.leaf)
            .with_m(among)
            .with_seed(u64::from(self.seed));
        guarded(name, || {
            let fitted = RandomForestRegressor::fit(records, labels, parameters).map_err(said)?;
            serde_json::to_value(&fitted).map_err(kept)
        })
    }
}

/// The trees of a serialised forest.
fn trees(forest: &Value) -> Option<Vec<Tree>> {
    let trees = forest.get("forest_regressor")?.get("trees")?.as_array()?;
    let trees = trees.iter().map(|tree| {
        let nodes = tree.get("nodes")?.as_array()?;
        nodes.iter().map(node).collect()
    });
    trees.collect()
}

fn node(node: &Value) -> Option<Node> {
    let place = |key: &str| -> Option<u32> {
        let place = node.get(key)?.as_u64();
        place.map_or(Some(0), |place| u32::try_from(place).ok())
    };
    let (low, high) = (place("true_child")?, place("false_child")?);
    let is_leaf = low == 0 || high == 0;
    Some(Node {
        feature: if is_leaf { 0 } else { place("split_feature")? },
        threshold: match is_leaf {
            true => 0.0,
            false => node.get("split_value")?.as_f64()?,
        },
        low: if is_leaf { 0 } else { low },
        high: if is_leaf { 0 } else { high },
        value: node.get("output")?.as_f64()?,
    })
}

impl LibraryLearner for Forest {
    fn model(&self) -> &'static LibraryModel {
        self.model
    }

    fn settings(&self) -> LibrarySettings {
        self.settings
    }

    fn candidates(&self) -> Option<(&'static str, Vec<f64>)> {
        Some((SHARE.key, candidates(self.share, &SHARES)))
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a share of the number of features"
    )]
    fn fit(&self, task: &LibraryTask<'_>) -> Result<Box<dyn LibraryPredictor>, ModelError> {
        let name = self.model.info.name;
        let records = records(name, task)?;
        let one = |target: usize| {
            interrupted(task.progress)?;
            let among = (task.values[target] * task.sizes.features as f64).ceil() as usize;
            let grown = self.grown(&records, &task.target(target), among.max(1))?;
            let trees = trees(&grown).ok_or_else(|| {
                let why = format!("{name}: the library grew a tree that cannot be kept");
                ModelError::new(ErrorKind::OutOfRange, why)
            })?;
            Ok((0.0, 1.0 / trees.len().max(1) as f64, trees))
        };
        let targets = (0..task.sizes.targets).into_par_iter();
        let targets = targets.map(one).collect::<Result<_, ModelError>>()?;
        Ok(Box::new(Trees::new(name, targets)?))
    }
}
