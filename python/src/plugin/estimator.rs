//! A Python estimator, and its fitted objects.

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use taceva_core::{
    ArgSpec, Channels, DriverKey, ErrorKind, EstimatorFactory, FeatureShape, Features, FitRequest,
    ModelError, Regressor, Saved, SavedRegressor, TrainingSet, not_finite,
};
use taceva_host::EstimatorInfo;

use super::failure::{kind, line_of, short_words};
use super::objects::keywords;
use super::training::{Training, watched};
use crate::arrays::Table;
use crate::buffer::{Buffer, Number};
use crate::errors::value_error;

/// Estimator that is a Python class with `fit`, `predict`, `save` and `load`.
pub(super) struct PythonEstimator {
    info: EstimatorInfo,
    class: Py<PyAny>,
}

impl PythonEstimator {
    pub(super) fn new(info: EstimatorInfo, class: Py<PyAny>) -> PythonEstimator {
        PythonEstimator { info, class }
    }

    fn fitted(
        &self,
        py: Python<'_>,
        request: &FitRequest<'_>,
        training: Training,
    ) -> PyResult<Py<PyAny>> {
        let given = keywords(py, &self.info.settings, request.settings)?;
        let object = self.class.call(py, (), Some(&given))?;
        let learnt = samples(py, request.training)?;
        let validation = request.validation.map(|set| samples(py, set)).transpose()?;
        let training = Py::new(py, training)?;
        object.call_method1(py, "fit", (learnt, validation, training))?;
        Ok(object)
    }
}

/// Converts an exception of the estimator to an error; the host adds the estimator and the operation.
fn model_error(py: Python<'_>, error: &PyErr) -> ModelError {
    ModelError::new(kind(py, error), short_words(py, error))
}

/// A set of samples as `taceva.plugin.Samples`.
fn samples<'py>(py: Python<'py>, set: &TrainingSet<'_>) -> PyResult<Bound<'py, PyAny>> {
    let channels: Vec<&str> = set
        .targets
        .channels
        .iter()
        .map(|channel| channel.name())
        .collect();
    let given = PyDict::new(py);
    given.set_item("features", features(py, set.features)?)?;
    given.set_item(
        "targets",
        Buffer::of_rows(set.targets.values, channels.len())?,
    )?;
    given.set_item("channels", channels)?;
    given.set_item("groups", set.groups.map(<[u32]>::to_vec))?;
    py.import("taceva.plugin")?
        .getattr("Samples")?
        .call_method("of", (), Some(&given))
}

/// Features as float32, `[samples, height, width, depth]`.
fn features(py: Python<'_>, features: &Features) -> PyResult<Py<Buffer>> {
    let FeatureShape {
        height,
        width,
        depth,
    } = features.shape();
    let values = features.values().iter();
    let bytes: Vec<u8> = values.flat_map(|value| value.to_ne_bytes()).collect();
    let shape = [features.samples(), height, width, depth];
    Py::new(py, Buffer::new(bytes, Number::F32, &shape)?)
}

impl EstimatorFactory for PythonEstimator {
    fn key(&self) -> &DriverKey {
        &self.info.key
    }

    fn title(&self) -> &str {
        &self.info.title
    }

    fn settings(&self) -> &[ArgSpec] {
        &self.info.settings
    }

    fn fit(&self, request: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let (settings, training, validation) =
            (request.settings, request.training, request.validation);
        let fitted = watched(request.progress, |watching| {
            Python::attach(|py| {
                let silent = taceva_core::SilentProgress;
                let request =
                    FitRequest::new(settings, training, &silent).with_validation(validation);
                let fitted = self.fitted(py, &request, watching);
                fitted.map_err(|error| model_error(py, &error))
            })
        });
        let object = fitted??;
        Ok(Box::new(Fitted {
            object,
            channels: training.targets.channels.clone(),
            shape: training.features.shape(),
        }))
    }

    fn load(&self, saved: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let (channels, shape) = (saved.channels, saved.shape);
        let object = Python::attach(|py| {
            let names: Vec<&str> = channels.iter().map(|channel| channel.name()).collect();
            let shape = (shape.height, shape.width, shape.depth);
            let bytes = PyBytes::new(py, saved.bytes);
            let loaded = self.class.call_method1(py, "load", (bytes, names, shape));
            // Any exception means that the bytes are not a model of this estimator.
            loaded.map_err(|error| ModelError::new(ErrorKind::Protocol, short_words(py, &error)))
        })?;
        Ok(Box::new(Fitted {
            object,
            channels: channels.clone(),
            shape,
        }))
    }
}

/// Python object that `fit` or `load` of the class returned.
struct Fitted {
    object: Py<PyAny>,
    channels: Channels,
    shape: FeatureShape,
}

impl Fitted {
    fn predicted(&self, py: Python<'_>, given: &Features) -> PyResult<Vec<f64>> {
        let numpy = py.import("numpy")?;
        let seen = numpy.call_method1("asarray", (features(py, given)?,))?;
        let said = self.object.call_method1(py, "predict", (seen,))?;
        if said.is_none(py) {
            let why = format!(
                "`predict` returned None, expected an array {:?}: one row per sample, one column per channel",
                [given.samples(), self.channels.len()]
            );
            return Err(self.at_predict(py, value_error(why)));
        }
        // Applies the same checks as to models outside of plugins: rejects complex numbers and matches named columns by name.
        let names = self.channels.iter().map(|channel| channel.name());
        let names: Vec<&str> = names.collect();
        let rows = py.import("taceva._predictions")?.call_method1(
            "prediction_rows",
            (said, "the model", given.samples(), names),
        );
        let rows = rows.map_err(|error| self.at_predict(py, error))?;
        let table = Table::of(&rows, "the prediction", self.channels.len())?;
        Ok(table.row_by_row(py))
    }

    /// Adds the file and line of `predict` to an `error` about its predictions, because the traceback no longer contains the call.
    fn at_predict(&self, py: Python<'_>, error: PyErr) -> PyErr {
        let line = || -> PyResult<String> {
            let code = self
                .object
                .bind(py)
                .getattr("predict")?
                .getattr("__code__")?;
            let file: String = code.getattr("co_filename")?.extract()?;
            Ok(line_of(&file, code.getattr("co_firstlineno")?.extract()?))
        };
        match line() {
            Ok(line) => {
                PyErr::from_type(error.get_type(py), format!("{} ({line})", error.value(py)))
            }
            Err(_) => error,
        }
    }
}

impl Regressor for Fitted {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        self.shape
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        if features.samples() == 0 && into.is_empty() {
            return Ok(());
        }
        let predicted = Python::attach(|py| {
            let predicted = self.predicted(py, features);
            predicted.map_err(|error| model_error(py, &error))
        })?;
        if predicted.len() != into.len() {
            let why = format!("{} numbers for {}", predicted.len(), into.len());
            return Err(ModelError::new(ErrorKind::InvalidArgument, why));
        }
        if let Some(why) = not_finite(&self.channels, &predicted) {
            return Err(ModelError::new(ErrorKind::DeviceFault, why));
        }
        into.copy_from_slice(&predicted);
        Ok(())
    }
}

impl SavedRegressor for Fitted {
    fn save(&self) -> Result<Vec<u8>, ModelError> {
        Python::attach(|py| {
            let saved = self.object.call_method0(py, "save").and_then(|saved| {
                saved
                    .bind(py)
                    .cast::<PyBytes>()
                    .map(|bytes| bytes.as_bytes().to_vec())
                    .map_err(|_| {
                        value_error(
                            "save returned no bytes, expected the model as an object of type bytes",
                        )
                    })
            });
            saved.map_err(|error| model_error(py, &error))
        })
    }
}
