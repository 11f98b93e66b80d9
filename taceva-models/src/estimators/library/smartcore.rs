//! Models of smartcore. Each adapter passes a checked task to the library and stores the fit as tensors.

mod boosting;
mod forest;
mod knn;
mod lasso;
mod ridge;
mod svr;

use smartcore::linalg::basic::matrix::DenseMatrix;
use taceva_core::ModelError;

use crate::estimators::library::guard::guarded;
use crate::estimators::library::{LibraryModel, LibraryTask};

/// Release of smartcore in this build.
const RELEASE: &str = "smartcore 0.7.0";

/// All models of smartcore, the simplest first.
pub(crate) const ALL: &[&LibraryModel] = &[
    &ridge::ADAPTER.model,
    &lasso::ADAPTER.model,
    &svr::ADAPTER.model,
    &knn::ADAPTER.model,
    &knn::CLASSIFIER.model,
    &forest::FOREST.model,
    &forest::EXTRA_TREES.model,
    &boosting::ADAPTER.model,
];

/// Converts `values`, stored row by row, to a matrix with `rows` rows.
fn matrix(name: &str, values: &[f64], rows: usize) -> Result<DenseMatrix<f64>, ModelError> {
    let columns = values.len() / rows.max(1);
    let by_column = (0..columns).flat_map(|column| {
        let own = values.iter().skip(column);
        own.step_by(columns).copied()
    });
    guarded(name, || {
        DenseMatrix::new(rows, columns, by_column.collect(), true)
    })
}

/// Features of a task as a matrix, one row per sample.
fn records(name: &str, task: &LibraryTask<'_>) -> Result<DenseMatrix<f64>, ModelError> {
    matrix(name, task.rows, task.sizes.samples)
}
