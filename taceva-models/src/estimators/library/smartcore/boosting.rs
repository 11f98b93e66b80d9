//! `smartcore/gradient-boosting`: fits each tree to the errors of the previous trees.

use rayon::prelude::*;
use serde_json::Value;
use smartcore::xgboost::{XGRegressor, XGRegressorParameters};
use taceva_core::{ErrorKind, ModelError};

use super::{RELEASE, records};
use crate::estimators::library::adapter::{Adapter, Number, Numbers, Unset, any};
use crate::estimators::library::guard::guarded;
use crate::estimators::library::predictor::{Node, Tree, Trees};
use crate::estimators::library::{LibraryModel, LibrarySettings, LibraryTask, LoadedPredictor};
use crate::linalg::progress::interrupted;
use crate::settings::SettingInfo;
use crate::training::info::ModelInfo;

const NAME: &str = "smartcore/gradient-boosting";

const TREES: Number = Number {
    info: SettingInfo {
        key: "trees",
        accepts: "a whole number from 1 to 1000",
        default: "50",
        about: "number of trees",
    },
    range: [1.0, 1000.0],
    is_whole: true,
    unset: Unset::Is(50.0),
};
const DEPTH: Number = Number {
    info: SettingInfo {
        key: "depth",
        accepts: "a whole number from 1 to 16",
        default: "3",
        about: "the greatest depth: comparisons on the way to a leaf",
    },
    range: [1.0, 16.0],
    is_whole: true,
    unset: Unset::Is(3.0),
};
const RATE: Number = Number {
    info: SettingInfo {
        key: "rate",
        accepts: "a number from 0.001 to 1",
        default: "0.15",
        about: "the share of the prediction of each tree that is added",
    },
    range: [0.001, 1.0],
    is_whole: false,
    unset: Unset::Is(0.15),
};
const SUBSAMPLE: Number = Number {
    info: SettingInfo {
        key: "subsample",
        accepts: "a number from 0.05 to 1",
        default: "0.5",
        about: "the share of samples that a tree is grown on",
    },
    range: [0.05, 1.0],
    is_whole: false,
    unset: Unset::Is(0.5),
};
const SEED: Number = Number {
    info: SettingInfo {
        key: "seed",
        accepts: "a whole number",
        default: "0",
        about: "the seed by which samples are drawn",
    },
    range: [0.0, u32::MAX as f64],
    is_whole: true,
    unset: Unset::Is(0.0),
};

/// Gradient boosting with exact splits and a penalty on leaf values, each target separately. No setting is chosen by held-out error, because each fit
/// is slow: every split sorts every feature.
pub(super) static ADAPTER: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            NAME,
            "smartcore: gradient boosting with exact splits; slow with many features",
            &[
                LibrarySettings::SCALE,
                TREES.info,
                DEPTH.info,
                RATE.info,
                SUBSAMPLE.info,
                SEED.info,
                LibrarySettings::REFIT,
            ],
            |settings| ADAPTER.estimator(settings),
        ),
        release: RELEASE,
        work: |sizes| {
            let [samples, features, targets] = sizes.real();
            let sorted = 0.5 * samples * samples.log2().max(1.0);
            Some(2.0 * 50.0 * 3.0 * 10.0 * targets * features * sorted)
        },
        load: Trees::load,
    },
    numbers: &[TREES, DEPTH, RATE, SUBSAMPLE, SEED],
    is_classifier: false,
    check: any,
    fit,
};

/// Converts a tree in the serialised form of the library to nodes, root first; `None` for an unexpected form.
fn tree(root: &Value) -> Option<Tree> {
    let mut nodes = Tree::new();
    grow(root, &mut nodes)?;
    Some(nodes)
}

/// Appends `node` and its descendants; returns its index.
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

fn fit(set: &Numbers<'_>, task: &LibraryTask<'_>) -> LoadedPredictor {
    let records = records(NAME, task)?;
    let rate = set.real(&RATE);
    let depth = u16::try_from(set.whole(&DEPTH)).unwrap_or(u16::MAX);
    let one = |target: usize| {
        interrupted(task.progress)?;
        let labels = task.target(target);
        let parameters = XGRegressorParameters::default()
            .with_n_estimators(set.whole(&TREES) as usize)
            .with_max_depth(depth)
            .with_learning_rate(rate)
            .with_subsample(set.real(&SUBSAMPLE))
            .with_base_score(0.0)
            .with_seed(u64::from(set.whole(&SEED)));
        let fitted = guarded(NAME, || {
            let fitted = XGRegressor::fit(&records, &labels, parameters);
            let fitted = fitted.map_err(|error| error.to_string())?;
            serde_json::to_value(&fitted).map_err(|error| error.to_string())
        })?;
        let grown = fitted.get("regressors").and_then(Value::as_array);
        let trees: Option<Vec<Tree>> = grown.and_then(|trees| trees.iter().map(tree).collect());
        let trees = trees.ok_or_else(|| {
            let why = format!("{NAME}: the library grew a tree that cannot be stored");
            ModelError::new(ErrorKind::OutOfRange, why)
        })?;
        Ok((0.0, rate, trees))
    };
    let targets = (0..task.sizes.targets).into_par_iter();
    let targets = targets.map(one).collect::<Result<_, ModelError>>()?;
    Ok(Box::new(Trees::new(NAME, targets)?))
}
