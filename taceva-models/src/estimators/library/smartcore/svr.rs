//! `smartcore/svr`: support vector regression with a Gaussian kernel, for at least as many samples as features.

use rayon::prelude::*;
use serde_json::Value;
use smartcore::svm::Kernels;
use smartcore::svm::svr::{SVR, SVRParameters};
use taceva_core::{ErrorKind, ModelError, TrainingSet};

use super::{RELEASE, records};
use crate::estimators::library::adapter::{Adapter, Number, Numbers, Unset};
use crate::estimators::library::guard::guarded;
use crate::estimators::library::predictor::{Machine, Support};
use crate::estimators::library::support_vector::{LENGTH, TUBE};
use crate::estimators::library::{
    LibraryModel, LibrarySettings, LibrarySizes, LibraryTask, LoadedPredictor,
};
use crate::linalg::progress::interrupted;
use crate::settings::SettingInfo;
use crate::training::info::ModelInfo;

const NAME: &str = "smartcore/svr";

const COST: Number = Number {
    info: SettingInfo {
        key: "cost",
        accepts: "a number from 1e-3 to 1e6",
        default: "10",
        about: "cost of an error beyond the tube, for labels scaled to 0..1",
    },
    range: [1e-3, 1e6],
    is_whole: false,
    unset: Unset::Is(10.0),
};
/// Support vector regression by sequential minimal optimisation, each target separately. No setting is chosen by held-out error.
pub(super) static ADAPTER: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            NAME,
            "smartcore: support vector regression; needs at least as many samples as features",
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
            let [n, p, targets] = sizes.real();
            (n >= p).then_some(2.0 * targets * n * n * (3.0 * p + 400.0))
        },
        load: Support::load,
    },
    numbers: &[COST, LENGTH, TUBE],
    is_classifier: false,
    check,
    fit,
};

/// Reads a support vector machine from the serialised form of the library. Returns the support vectors in sample order.
fn machine(fitted: &Value, task: &LibraryTask<'_>) -> Option<Machine> {
    let vectors = fitted.get("instances")?.as_array()?;
    let mut found = vectors.iter().zip(fitted.get("w")?.as_array()?).peekable();
    let mut coefficients = Vec::with_capacity(task.sizes.samples);
    for row in task.rows.chunks_exact(task.sizes.features) {
        let is_row = |vector: &Value| {
            let own = vector.as_array().into_iter().flatten();
            own.zip(row).all(|(value, expected)| {
                value
                    .as_f64()
                    .is_some_and(|value| value.total_cmp(expected).is_eq())
            })
        };
        let own = found.next_if(|(vector, _)| is_row(vector));
        coefficients.push(own.map_or(Some(0.0), |(_, weight)| weight.as_f64())?);
    }
    // Rejects support vectors that match no sample.
    found.next().is_none().then_some(Machine {
        coefficients,
        bias: fitted.get("b")?.as_f64()?,
    })
}

fn check(training: &TrainingSet<'_>) -> Result<(), ModelError> {
    let samples = training.features.samples();
    let features = training.features.shape().len();
    if samples >= features {
        return Ok(());
    }
    Err(ModelError::new(
        ErrorKind::InvalidArgument,
        format!(
            "{samples} training samples, {NAME} needs at least as many as there are features, {features}: smartcore 0.7.0 truncates each sample to that number of values. Set a smaller `size` or `pca`, or use linfa/svr"
        ),
    ))
}

fn fit(set: &Numbers<'_>, task: &LibraryTask<'_>) -> LoadedPredictor {
    let records = records(NAME, task)?;
    let LibrarySizes {
        samples, features, ..
    } = task.sizes;
    let squares: f64 = task.rows.iter().map(|value| value * value).sum();
    let length = set.real(&LENGTH);
    let rate = samples as f64 / (2.0 * length * length * squares);
    let one = |target: usize| {
        interrupted(task.progress)?;
        let labels = task.target(target);
        let parameters = SVRParameters::default()
            .with_c(set.real(&COST))
            .with_eps(set.real(&TUBE))
            .with_kernel(Kernels::rbf().with_gamma(rate));
        let fitted = guarded(NAME, || {
            let fitted = SVR::fit(&records, &labels, &parameters);
            let fitted = fitted.map_err(|error| error.to_string())?;
            serde_json::to_value(&fitted).map_err(|error| error.to_string())
        })?;
        machine(&fitted, task).ok_or_else(|| {
            let why = format!("{NAME}: the library fitted a parameter that is not finite");
            ModelError::new(ErrorKind::OutOfRange, why)
        })
    };
    let targets = (0..task.sizes.targets).into_par_iter();
    let machines: Vec<Machine> = targets.map(one).collect::<Result<_, ModelError>>()?;
    Ok(Box::new(Support::new(
        NAME, task.rows, features, rate, &machines,
    )?))
}
