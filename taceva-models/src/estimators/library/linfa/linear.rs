//! `linfa/linear`: least squares without a penalty.

use linfa::Dataset;
use linfa::traits::Fit;
use linfa_linear::LinearRegression;
use ndarray::Array1;
use taceva_core::ModelError;

use super::{RELEASE, labels, matrix};
use crate::estimators::library::adapter::{Adapter, Numbers, any};
use crate::estimators::library::guard::guarded;
use crate::estimators::library::predictor::{Linear, Weighted};
use crate::estimators::library::span::Span;
use crate::estimators::library::{
    LibraryModel, LibrarySettings, LibrarySizes, LibraryTask, LoadedPredictor,
};
use crate::linalg::progress::interrupted;
use crate::training::info::ModelInfo;

const NAME: &str = "linfa/linear";

/// Ordinary least squares by Householder decomposition, each target separately.
///
/// If features are dependent or no fewer than samples, the library receives the samples in coordinates of their span. The result is then the
/// least-squares solution of least norm.
pub(super) static ADAPTER: Adapter = Adapter {
    model: LibraryModel {
        info: ModelInfo::of_library(
            NAME,
            "linfa: least squares without a penalty; fits noise if samples are few",
            &[LibrarySettings::SCALE, LibrarySettings::REFIT],
            |settings| ADAPTER.estimator(settings),
        ),
        release: RELEASE,
        work: |sizes| {
            let [samples, features, targets] = sizes.real();
            let (small, large) = (samples.min(features), samples.max(features));
            Some(2.0 * (4.0 + 8.0 * targets) * small * small * large)
        },
        load: Linear::load,
    },
    numbers: &[],
    is_classifier: false,
    check: any,
    fit,
};

/// Solves the least-squares problem for one target and returns its weights.
fn solved(rows: &[f64], labels: &Array1<f64>) -> Result<Vec<f64>, ModelError> {
    let records = matrix(rows, labels.len())?;
    let dataset = Dataset::new(records, labels.clone());
    let fitted = guarded(NAME, || {
        LinearRegression::new().with_intercept(false).fit(&dataset)
    })?;
    Ok(fitted.params().to_vec())
}

fn fit(_: &Numbers<'_>, task: &LibraryTask<'_>) -> LoadedPredictor {
    let LibrarySizes {
        samples,
        features,
        targets,
    } = task.sizes;
    let whole = || -> Result<Vec<Weighted>, ModelError> {
        let one = |target: usize| {
            interrupted(task.progress)?;
            Ok((solved(task.rows, &labels(task, target))?, 0.0))
        };
        (0..targets).map(one).collect()
    };
    let spanned = || -> Result<Vec<Weighted>, ModelError> {
        let span = Span::new(task.rows, features);
        let one = |target: usize| {
            interrupted(task.progress)?;
            let weights = solved(&span.rows, &labels(task, target))?;
            Ok(span.weights(&weights))
        };
        (0..targets).map(one).collect()
    };
    let weights = match samples > features {
        true => whole().or_else(|_| spanned())?,
        false => spanned()?,
    };
    Ok(Box::new(Linear::new(NAME, weights)?))
}
