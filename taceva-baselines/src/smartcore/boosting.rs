//! `smartcore/gradient-boosting`: trees, each of which learns what those before it left over.

use rayon::prelude::*;
use serde_json::Value;
use smartcore::xgboost::{XGRegressor, XGRegressorParameters};
use taceva_core::{ErrorKind, ModelError};
use taceva_models::{
    LibraryLearner, LibraryModel, LibraryPredictor, LibrarySettings, LibrarySizes, LibraryTask,
    ModelInfo, SettingError, SettingInfo, Settings, library_estimator,
};

use super::{RELEASE, records};
use crate::guard::{guarded, interrupted};
use crate::predictor::{Node, Tree, Trees};
use crate::setting::number;

/// Gradient boosting with exact splits and a penalty on leaves, each target alone. Nothing is chosen by error: every split sorts every
/// feature anew, so that one fit takes as long as others take to choose.
struct Boosting {
    settings: LibrarySettings,
    trees: usize,
    depth: u16,
    rate: f64,
    subsample: f64,
    seed: u32,
}

const NAME: &str = "smartcore/gradient-boosting";

const TREES: SettingInfo = SettingInfo {
    key: "trees",
    accepts: "a whole number from 1 to 1000",
    default: "50",
    about: "how many trees there are",
};
const DEPTH: SettingInfo = SettingInfo {
    key: "depth",
    accepts: "a whole number from 1 to 16",
    default: "3",
    about: "questions from the root of a tree to a leaf, at most",
};
const RATE: SettingInfo = SettingInfo {
    key: "rate",
    accepts: "a number from 0.001 to 1",
    default: "0.15",
    about: "the share of what a tree says that is added",
};
const SUBSAMPLE: SettingInfo = SettingInfo {
    key: "subsample",
    accepts: "a number from 0.05 to 1",
    default: "0.5",
    about: "the share of samples that a tree is grown on",
};
const SEED: SettingInfo = SettingInfo {
    key: "seed",
    accepts: "a whole number",
    default: "0",
    about: "what samples are drawn from",
};

pub(super) static MODEL: LibraryModel = LibraryModel {
    info: ModelInfo::of_library(
        NAME,
        "smartcore: gradient boosting with exact splits; slow with many features",
        &[
            LibrarySettings::SCALE,
            TREES,
            DEPTH,
            RATE,
            SUBSAMPLE,
            SEED,
            LibrarySettings::REFIT,
        ],
        |settings| Ok(library_estimator(Boosting::from_settings(settings)?)),
    ),
    release: RELEASE,
    work: |sizes| {
        let LibrarySizes {
            samples,
            features,
            targets,
        } = sizes;
        let sorted = 0.5 * samples as f64 * (samples as f64).log2().max(1.0);
        Some(2.0 * 50.0 * 3.0 * 10.0 * targets as f64 * features as f64 * sorted)
    },
    load: Trees::load,
};

impl Boosting {
    fn from_settings(settings: &Settings) -> Result<Boosting, SettingError> {
        settings.check_keys(MODEL.info.settings)?;
        Ok(Boosting {
            settings: LibrarySettings::from_settings(settings)?,
            trees: number(settings, &TREES, 50, 1..=1000)?,
            depth: number(settings, &DEPTH, 3, 1..=16)?,
            rate: number(settings, &RATE, 0.15, 0.001..=1.0)?,
            subsample: number(settings, &SUBSAMPLE, 0.5, 0.05..=1.0)?,
            seed: number(settings, &SEED, 0, 0..=u32::MAX)?,
        })
    }
}

/// The nodes of a serialised tree, root first.
fn tree(root: &Value) -> Option<Tree> {
    let mut nodes = Tree::new();
    grow(root, &mut nodes)?;
    Some(nodes)
}

/// Adds `node` and what is below it; gives its place.
fn grow(node: &Value, nodes: &mut Tree) -> Option<u32> {
    let place = nodes.len();
    nodes.push(Node {
        feature: 0,
        threshold: 0.0,
        low: 0,
        high: 0,
        value: node.get("value")?.as_f64()?,
    });
    let (low, high) = (node.get("left")?, node.get("right")?);
    if !low.is_null() && !high.is_null() {
        let feature = u32::try_from(node.get("split_feature_idx")?.as_u64()?).ok()?;
        let threshold = node.get("threshold")?.as_f64()?;
        let (low, high) = (grow(low, nodes)?, grow(high, nodes)?);
        nodes[place] = Node {
            feature,
            threshold,
            low,
            high,
            value: 0.0,
        };
    }
    u32::try_from(place).ok()
}

impl LibraryLearner for Boosting {
    fn model(&self) -> &'static LibraryModel {
        &MODEL
    }

    fn settings(&self) -> LibrarySettings {
        self.settings
    }

    fn fit(&self, task: &LibraryTask<'_>) -> Result<Box<dyn LibraryPredictor>, ModelError> {
        let records = records(NAME, task)?;
        let one = |target: usize| {
            interrupted(task.progress)?;
            let labels = task.target(target);
            let parameters = XGRegressorParameters::default()
                .with_n_estimators(self.trees)
                .with_max_depth(self.depth)
                .with_learning_rate(self.rate)
                .with_subsample(self.subsample)
                .with_base_score(0.0)
                .with_seed(u64::from(self.seed));
            let fitted = guarded(NAME, || {
                let fitted = XGRegressor::fit(&records, &labels, parameters);
                let fitted = fitted.map_err(|error| error.to_string())?;
                serde_json::to_value(&fitted).map_err(|error| error.to_string())
            })?;
            let grown = fitted.get("regressors").and_then(Value::as_array);
            let trees: Option<Vec<Tree>> = grown.and_then(|trees| trees.iter().map(tree).collect());
            let trees = trees.ok_or_else(|| {
                let why = format!("{NAME}: the library grew a tree that cannot be kept");
                ModelError::new(ErrorKind::OutOfRange, why)
            })?;
            Ok((0.0, self.rate, trees))
        };
        let targets = (0..task.sizes.targets).into_par_iter();
        let targets = targets.map(one).collect::<Result<_, ModelError>>()?;
        Ok(Box::new(Trees::new(NAME, targets)?))
    }
}
