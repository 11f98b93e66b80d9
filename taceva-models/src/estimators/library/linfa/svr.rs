//! `linfa/svr`: support vector regression with a Gaussian kernel, fitted to all samples.

use linfa::Dataset;
use linfa::traits::Fit;
use linfa_svm::Svm;
use rayon::prelude::*;
use taceva_core::ModelError;

use super::{RELEASE, labels, records};
use crate::estimators::library::adapter::{Adapter, Number, Numbers, Unset, any};
use crate::estimators::library::guard::guarded;
use crate::estimators::library::predictor::{Machine, Support};
use crate::estimators::library::support_vector::{LENGTH, TUBE};
use crate::estimators::library::{LibraryModel, LibrarySettings, LibraryTask, LoadedPredictor};
use crate::linalg::progress::interrupted;
use crate::settings::SettingInfo;
use crate::training::info::ModelInfo;

const NAME: &str = "linfa/svr";

const COST: Number = Number {
    info: SettingInfo {
        key: "cost",
        accepts: "a number from 1e-3 to 1e6",
        default: "chosen for each channel",
        about: "cost of an error beyond the tube, for labels scaled to 0..1",
    },
    range: [1e-3, 1e6],
    is_whole: false,
    unset: Unset::ChosenAmong(&COSTS),
};
/// Candidate costs of errors, descending. Of costs with equal errors, the smallest is chosen.
const COSTS: [f64; 4] = [100.0, 10.0, 1.0, 0.1];

/// Absolute value up to which the library treats a support vector coefficient as 0.
const NOTHING: f64 = 100.0 * f64::EPSILON;

/// Support vector regression by sequential minimal optimisation, each target separately.
///
/// The kernel of two samples with features x and v is exp(−‖x − v‖² / (2 ℓ² d²)). ℓ is the setting `length`, and d² the mean squared distance of
/// training samples from their mean.
pub(super) static ADAPTER: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            NAME,
            "linfa: support vector regression with a Gaussian kernel, on all samples",
            &[
                LibrarySettings::SCALE,
                COST.info,
                LENGTH.info,
                TUBE.info,
                LibrarySettings::REFIT,
            ],
            |settings| ADAPTER.estimator(settings),
        ),
        release: RELEASE,
        work: |sizes| {
            let [samples, features, targets] = sizes.real();
            let kernel = samples * samples * features;
            Some(5.0 * targets * (kernel + 200.0 * samples * samples))
        },
        load: Support::load,
    },
    numbers: &[COST, LENGTH, TUBE],
    is_classifier: false,
    check: any,
    fit,
};

/// Factor of squared distances in a kernel of length `length`, relative to the root mean square distance of samples from their mean.
pub(crate) fn rate(task: &LibraryTask<'_>, length: f64) -> f64 {
    let squares: f64 = task.rows.iter().map(|value| value * value).sum();
    task.sizes.samples as f64 / (2.0 * length * length * squares)
}

fn fit(set: &Numbers<'_>, task: &LibraryTask<'_>) -> LoadedPredictor {
    let records = records(task)?;
    let rate = rate(task, set.real(&LENGTH));
    let one = |target: usize| {
        interrupted(task.progress)?;
        let dataset = Dataset::new(records.clone(), labels(task, target));
        let fitted = guarded(NAME, || {
            Svm::<f64, f64>::params()
                .c_svr(task.values[target], Some(set.real(&TUBE)))
                .gaussian_kernel(1.0 / rate)
                .eps(1e-3)
                .fit(&dataset)
        })?;
        let coefficients = fitted.alpha.iter();
        Ok(Machine {
            coefficients: coefficients
                .map(|value| if value.abs() > NOTHING { *value } else { 0.0 })
                .collect(),
            bias: -fitted.rho,
        })
    };
    let targets = (0..task.sizes.targets).into_par_iter();
    let machines: Vec<Machine> = targets.map(one).collect::<Result<_, ModelError>>()?;
    let features = task.sizes.features;
    Ok(Box::new(Support::new(
        NAME, task.rows, features, rate, &machines,
    )?))
}
