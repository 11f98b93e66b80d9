//! `smartcore/ridge`: least squares with a penalty on squared weights.

use rayon::prelude::*;
use smartcore::linalg::basic::arrays::Array;
use smartcore::linear::ridge_regression::{RidgeRegression, RidgeRegressionParameters};
use taceva_core::ModelError;

use super::{RELEASE, matrix};
use crate::estimators::library::adapter::{Adapter, Number, Numbers, Unset, any};
use crate::estimators::library::guard::guarded;
use crate::estimators::library::predictor::Linear;
use crate::estimators::library::span::Span;
use crate::estimators::library::{
    LibraryModel, LibrarySettings, LibrarySizes, LibraryTask, LoadedPredictor,
};
use crate::linalg::progress::interrupted;
use crate::settings::SettingInfo;
use crate::training::info::ModelInfo;

const NAME: &str = "smartcore/ridge";

const STRENGTH: Number = Number {
    info: SettingInfo {
        key: "strength",
        accepts: "a number from 1e-6 to 1e6",
        default: "chosen for each channel",
        about: "the penalty on squared weights, relative to the mean squared length of samples",
    },
    range: [1e-6, 1e6],
    is_whole: false,
    unset: Unset::ChosenAmong(&STRENGTHS),
};

/// Candidate strengths of the penalty, ascending.
const STRENGTHS: [f64; 9] = [1e-4, 1e-3, 1e-2, 3e-2, 1e-1, 3e-1, 1.0, 1e1, 1e2];

/// Ridge regression by the normal equations, each target separately.
///
/// The library requires more samples than features. With fewer samples, the library receives the samples in coordinates of their span. The weights
/// are the same as those of the full problem.
pub(super) static ADAPTER: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            NAME,
            "smartcore: ridge regression",
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
            let small = samples.min(features);
            Some(10.0 * targets * 3.0 * small * small * (samples + small))
        },
        load: Linear::load,
    },
    numbers: &[STRENGTH],
    is_classifier: false,
    check: any,
    fit,
};

fn fit(_: &Numbers<'_>, task: &LibraryTask<'_>) -> LoadedPredictor {
    let LibrarySizes {
        samples,
        features,
        targets,
    } = task.sizes;
    let squares: f64 = task.rows.iter().map(|value| value * value).sum();
    let mean = squares / samples as f64;
    let span = (samples <= features).then(|| Span::new(task.rows, features));
    let rows = span.as_ref().map_or(task.rows, |span| &span.rows);
    let records = matrix(NAME, rows, samples)?;
    let one = |target: usize| {
        interrupted(task.progress)?;
        let labels = task.target(target);
        let parameters = RidgeRegressionParameters::default()
            .with_alpha(task.values[target] * mean)
            .with_normalize(false);
        let weights = guarded(NAME, || {
            RidgeRegression::fit(&records, &labels, parameters).map(|fitted| {
                let weights = fitted.coefficients();
                weights.iterator(0).copied().collect::<Vec<f64>>()
            })
        })?;
        Ok(match &span {
            Some(span) => span.weights(&weights),
            None => (weights, 0.0),
        })
    };
    let targets = (0..targets).into_par_iter();
    let linear = targets.map(one).collect::<Result<_, ModelError>>()?;
    Ok(Box::new(Linear::new(NAME, linear)?))
}
