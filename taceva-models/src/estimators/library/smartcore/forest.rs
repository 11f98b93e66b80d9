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
use taceva_core::{ErrorKind, ModelError, whole_size};

use super::{RELEASE, records};
use crate::estimators::library::adapter::{Adapter, Number, Numbers, Unset, any};
use crate::estimators::library::guard::guarded;
use crate::estimators::library::predictor::{Node, Tree, Trees};
use crate::estimators::library::{
    LibraryModel, LibrarySettings, LibrarySizes, LibraryTask, LoadedPredictor,
};
use crate::linalg::progress::interrupted;
use crate::settings::SettingInfo;
use crate::training::info::ModelInfo;

const TREES: Number = Number {
    info: SettingInfo {
        key: "trees",
        accepts: "a whole number from 1 to 1000",
        default: "100",
        about: "number of trees",
    },
    range: [1.0, 1000.0],
    is_whole: true,
    unset: Unset::Is(100.0),
};
const LEAF: Number = Number {
    info: SettingInfo {
        key: "leaf",
        accepts: "a whole number from 1 to 1000",
        default: "1",
        about: "the least number of samples of a leaf",
    },
    range: [1.0, 1000.0],
    is_whole: true,
    unset: Unset::Is(1.0),
};
const SHARE: Number = Number {
    info: SettingInfo {
        key: "share",
        accepts: "a number from 0.001 to 1",
        default: "chosen for each channel",
        about: "the share of features that a split chooses among",
    },
    range: [0.001, 1.0],
    is_whole: false,
    unset: Unset::ChosenAmong(&SHARES),
};
const SEED: Number = Number {
    info: SettingInfo {
        key: "seed",
        accepts: "a whole number",
        default: "0",
        about: "the seed by which trees are drawn",
    },
    range: [0.0, u32::MAX as f64],
    is_whole: true,
    unset: Unset::Is(0.0),
};

/// Candidate fractions of the features that each split examines, descending. Of fractions with equal errors, the smallest and cheapest is chosen.
const SHARES: [f64; 3] = [0.3, 0.1, 0.03];

const NUMBERS: &[Number] = &[TREES, LEAF, SHARE, SEED];

const SETTINGS: &[SettingInfo] = &[
    LibrarySettings::SCALE,
    TREES.info,
    LEAF.info,
    SHARE.info,
    SEED.info,
    LibrarySettings::REFIT,
];

/// Random forest: each tree learns from a bootstrap sample and uses the best splits. Each target has its own forest.
pub(super) static FOREST: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            "smartcore/random-forest",
            "smartcore: random forest, one per channel",
            SETTINGS,
            |settings| FOREST.estimator(settings),
        ),
        release: RELEASE,
        work,
        load: Trees::load,
    },
    numbers: NUMBERS,
    is_classifier: false,
    check: any,
    fit: |set, task| fit(&FOREST, random_forest, set, task),
};

/// Extra trees: each tree learns from all samples and uses random splits. Each target has its own forest.
pub(super) static EXTRA_TREES: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            "smartcore/extra-trees",
            "smartcore: extremely randomised trees, one forest per channel",
            SETTINGS,
            |settings| EXTRA_TREES.estimator(settings),
        ),
        release: RELEASE,
        work,
        load: Trees::load,
    },
    numbers: NUMBERS,
    is_classifier: false,
    check: any,
    fit: |set, task| fit(&EXTRA_TREES, extra_trees, set, task),
};

/// Number of multiplications for a hundred trees that are grown four times: for each of the three `SHARES`, and for the chosen share. Every tree
/// sorts every feature at every depth.
fn work(sizes: LibrarySizes) -> Option<f64> {
    let [samples, features, targets] = sizes.real();
    let depth = 2.0 * samples.log2().max(1.0);
    Some(4.0 * 100.0 * 2.0 * targets * samples * features * depth)
}

/// Function that grows the trees of one target. The last argument is the number of features per split. Returns the trees in the serialised form of
/// the library, or its error.
type Grow = fn(&Numbers<'_>, &DenseMatrix<f64>, &Vec<f64>, usize) -> Result<Value, String>;

/// Defines a function of type `Grow` for the type `$regressor` of the library. Its parameter types have equal methods, but no common trait.
macro_rules! grow {
    ($name:ident, $regressor:ident, $parameters:ident) => {
        fn $name(
            set: &Numbers<'_>,
            records: &DenseMatrix<f64>,
            labels: &Vec<f64>,
            among: usize,
        ) -> Result<Value, String> {
            let parameters = $parameters::default()
                .with_n_trees(set.whole(&TREES) as usize)
                .with_min_samples_leaf(set.whole(&LEAF) as usize)
                .with_m(among)
                .with_seed(u64::from(set.whole(&SEED)));
            let fitted = $regressor::fit(records, labels, parameters);
            let fitted = fitted.map_err(|error| error.to_string())?;
            serde_json::to_value(&fitted).map_err(|error| error.to_string())
        }
    };
}

grow!(
    random_forest,
    RandomForestRegressor,
    RandomForestRegressorParameters
);
grow!(
    extra_trees,
    ExtraTreesRegressor,
    ExtraTreesRegressorParameters
);

/// Converts a forest in the serialised form of the library to trees; `None` for an unexpected form.
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

fn fit(
    adapter: &Adapter,
    grow: Grow,
    set: &Numbers<'_>,
    task: &LibraryTask<'_>,
) -> LoadedPredictor {
    let name = adapter.model.info.name;
    let records = records(name, task)?;
    let one = |target: usize| {
        interrupted(task.progress)?;
        let among = whole_size((task.values[target] * task.sizes.features as f64).ceil());
        let labels = task.target(target);
        let grown = guarded(name, || grow(set, &records, &labels, among.max(1)))?;
        let trees = trees(&grown).ok_or_else(|| {
            let why = format!("{name}: the library grew a tree that cannot be stored");
            ModelError::new(ErrorKind::OutOfRange, why)
        })?;
        Ok((0.0, 1.0 / trees.len().max(1) as f64, trees))
    };
    let targets = (0..task.sizes.targets).into_par_iter();
    let targets = targets.map(one).collect::<Result<_, ModelError>>()?;
    Ok(Box::new(Trees::new(name, targets)?))
}
