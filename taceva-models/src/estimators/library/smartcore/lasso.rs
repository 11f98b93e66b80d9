//! `smartcore/lasso`: least squares with a penalty on absolute weights.

use rayon::prelude::*;
use smartcore::linalg::basic::arrays::Array;
use smartcore::linear::lasso::{Lasso, LassoParameters};
use taceva_core::ModelError;

use super::{RELEASE, matrix};
use crate::estimators::library::adapter::{Adapter, Number, Numbers, Unset, any};
use crate::estimators::library::guard::guarded;
use crate::estimators::library::predictor::Linear;
use crate::estimators::library::{
    LibraryModel, LibrarySettings, LibrarySizes, LibraryTask, LoadedPredictor,
};
use crate::linalg::progress::interrupted;
use crate::settings::SettingInfo;
use crate::training::info::ModelInfo;

const NAME: &str = "smartcore/lasso";

const STRENGTH: Number = Number {
    info: SettingInfo {
        key: "strength",
        accepts: "a number from 1e-4 to 1",
        default: "chosen for each channel",
        about: "the penalty on weights, relative to the least penalty that sets every weight to 0",
    },
    range: [1e-4, 1.0],
    is_whole: false,
    unset: Unset::ChosenAmong(&STRENGTHS),
};

/// Candidate strengths of the penalty, ascending.
const STRENGTHS: [f64; 4] = [1e-2, 3e-2, 1e-1, 3e-1];

/// Maximum number of interior-point steps. The method stops earlier at a relative duality gap of `TOLERANCE`.
const STEPS: usize = 50;
const TOLERANCE: f64 = 1e-2;

/// Lasso by an interior-point method, each target separately: minimises ‖y − Xw‖² + λ ‖w‖₁ for labels y, features X and weights w.
///
/// λ is the strength times the least λ at which every weight is 0. The library rejects fewer samples than features. In that case, samples of zeros
/// are appended, which do not change the minimum.
pub(super) static ADAPTER: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            NAME,
            "smartcore: the lasso, which leaves most weights near 0; slow with many features",
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
            let rows = samples.max(features);
            Some(6.0 * targets * features * features * (rows + 3000.0))
        },
        load: Linear::load,
    },
    numbers: &[STRENGTH],
    is_classifier: false,
    check: any,
    fit,
};

/// Least penalty factor λ at which every weight of the lasso is 0: twice the largest absolute product of a feature column with the labels.
fn least(rows: &[f64], features: usize, labels: &[f64]) -> f64 {
    let mut products = vec![0.0; features];
    for (row, label) in rows.chunks_exact(features).zip(labels) {
        let places = products.iter_mut().zip(row);
        places.for_each(|(place, value)| *place += value * label);
    }
    2.0 * products
        .iter()
        .fold(0.0, |most: f64, one| most.max(one.abs()))
}

fn fit(_: &Numbers<'_>, task: &LibraryTask<'_>) -> LoadedPredictor {
    let LibrarySizes {
        samples,
        features,
        targets,
    } = task.sizes;
    let rows = samples.max(features);
    let mut values = task.rows.to_vec();
    values.resize(rows * features, 0.0);
    let records = matrix(NAME, &values, rows)?;
    let one = |target: usize| {
        interrupted(task.progress)?;
        let mut labels = task.target(target);
        let lambda = task.values[target] * least(task.rows, features, &labels);
        labels.resize(rows, 0.0);
        let parameters = LassoParameters {
            // The library multiplies alpha by the number of rows.
            alpha: lambda / rows as f64,
            normalize: false,
            tol: TOLERANCE,
            max_iter: STEPS,
            fit_intercept: false,
        };
        let weights = guarded(NAME, || {
            Lasso::fit(&records, &labels, parameters).map(|fitted| {
                let weights = fitted.coefficients();
                weights.iterator(0).copied().collect::<Vec<f64>>()
            })
        })?;
        Ok((weights, 0.0))
    };
    let targets = (0..targets).into_par_iter();
    let linear = targets.map(one).collect::<Result<_, ModelError>>()?;
    Ok(Box::new(Linear::new(NAME, linear)?))
}
