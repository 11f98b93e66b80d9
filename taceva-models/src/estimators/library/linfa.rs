//! Models of linfa. Each adapter passes a checked task to the library and stores the fit as tensors.

mod elastic_net;
mod linear;
mod logistic;
mod pls;
mod svr;

use ndarray::{Array1, Array2, ShapeBuilder as _};
use taceva_core::{ErrorKind, ModelError};

use crate::estimators::library::{LibraryModel, LibraryTask};

/// Release of linfa in this build.
const RELEASE: &str = "linfa 0.8.1";

/// All models of linfa, the simplest first.
pub(crate) const ALL: &[&LibraryModel] = &[
    &linear::ADAPTER.model,
    &pls::ADAPTER.model,
    &elastic_net::ADAPTER.model,
    &svr::ADAPTER.model,
    &logistic::ADAPTER.model,
];

/// Converts `values`, stored row by row, to a matrix with `rows` rows.
fn matrix(values: &[f64], rows: usize) -> Result<Array2<f64>, ModelError> {
    let columns = values.len() / rows.max(1);
    Array2::from_shape_vec((rows, columns), values.to_vec()).map_err(|error| {
        ModelError::new(ErrorKind::Internal, "rows of unequal length").because(error)
    })
}

/// Features of a task as a matrix, one row per sample.
fn records(task: &LibraryTask<'_>) -> Result<Array2<f64>, ModelError> {
    matrix(task.rows, task.sizes.samples)
}

/// Features of a task as a matrix in column-major order, for methods that process features one by one.
fn columns(task: &LibraryTask<'_>) -> Result<Array2<f64>, ModelError> {
    let (samples, features) = (task.sizes.samples, task.sizes.features);
    let by_column = (0..features).flat_map(|feature| {
        let own = task.rows.iter().skip(feature);
        own.step_by(features).copied()
    });
    Array2::from_shape_vec((samples, features).f(), by_column.collect()).map_err(|error| {
        ModelError::new(ErrorKind::Internal, "rows of unequal length").because(error)
    })
}

/// Labels of one target.
fn labels(task: &LibraryTask<'_>, target: usize) -> Array1<f64> {
    Array1::from_vec(task.target(target))
}
