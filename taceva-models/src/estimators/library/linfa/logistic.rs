//! `linfa/logistic`: multinomial logistic regression, a classifier.

use linfa::Dataset;
use linfa::traits::Fit;
use linfa_logistic::MultiLogisticRegression;
use ndarray::Array1;
use rayon::prelude::*;
use taceva_core::ModelError;

use super::{RELEASE, records};
use crate::estimators::library::adapter::{Adapter, Number, Numbers, Unset, few_labels};
use crate::estimators::library::guard::guarded;
use crate::estimators::library::predictor::{Classes, Planes};
use crate::estimators::library::{LibraryModel, LibrarySettings, LibraryTask, LoadedPredictor};
use crate::linalg::progress::interrupted;
use crate::settings::SettingInfo;
use crate::training::info::ModelInfo;

const NAME: &str = "linfa/logistic";

const STRENGTH: Number = Number {
    info: SettingInfo {
        key: "strength",
        accepts: "a number from 1e-6 to 1e6",
        default: "chosen for each channel",
        about: "the penalty on squared weights, added to the summed loss of all samples",
    },
    range: [1e-6, 1e6],
    is_whole: false,
    unset: Unset::ChosenAmong(&STRENGTHS),
};

/// Candidate strengths of the penalty, ascending.
const STRENGTHS: [f64; 5] = [1e-1, 1.0, 1e1, 1e2, 1e3];

/// Multinomial logistic regression with a penalty on squared weights, each target separately. Each prediction is one of the training labels of the
/// channel. Suitable for channels with few distinct labels, such as grating spacings.
pub(super) static ADAPTER: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            NAME,
            "linfa: logistic regression, which predicts one of the labels of the training part",
            &[
                LibrarySettings::SCALE,
                STRENGTH.info,
                LibrarySettings::REFIT,
            ],
            |settings| ADAPTER.estimator(settings),
        ),
        release: RELEASE,
        work: |sizes| {
            let [samples, features, targets] = sizes.real();
            // A hundred steps at six strengths; two products per step for each of about forty classes.
            Some(6.0 * 100.0 * 2.0 * 40.0 * targets * samples * features)
        },
        load: Planes::load,
    },
    numbers: &[STRENGTH],
    is_classifier: true,
    check: |training| few_labels(NAME, training),
    fit,
};

/// Distinct labels, ascending.
fn levels(mut labels: Vec<f64>) -> Vec<f64> {
    labels.sort_by(f64::total_cmp);
    labels.dedup_by(|a, b| a.total_cmp(b).is_eq());
    labels
}

/// Fits one target with the penalty `strength`. Returns a linear function per class.
fn planes(task: &LibraryTask<'_>, target: usize, strength: f64) -> Result<Classes, ModelError> {
    let labels = task.target(target);
    let known = levels(labels.clone());
    let class = |label: &f64| known.partition_point(|level| level.total_cmp(label).is_lt());
    let classes: Array1<usize> = labels.iter().map(class).collect();
    let dataset = Dataset::new(records(task)?, classes);
    let fitted = guarded(NAME, || {
        MultiLogisticRegression::default()
            .alpha(strength)
            .fit(&dataset)
    })?;
    // `[features, classes]`, classes ascending.
    let weights = fitted.params().t();
    Ok(Classes {
        labels: fitted.classes().iter().map(|&class| known[class]).collect(),
        offsets: fitted.intercept().to_vec(),
        weights: weights.iter().copied().collect(),
    })
}

fn fit(_: &Numbers<'_>, task: &LibraryTask<'_>) -> LoadedPredictor {
    let one = |target: usize| {
        interrupted(task.progress)?;
        planes(task, target, task.values[target])
    };
    let targets = (0..task.sizes.targets).into_par_iter();
    let targets: Vec<Classes> = targets.map(one).collect::<Result<_, ModelError>>()?;
    Ok(Box::new(Planes::new(NAME, targets)?))
}
