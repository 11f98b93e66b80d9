//! Models that a Python program fits and calls itself: their training rows, and scores of their predictions by the rules of the program.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use pyo3::prelude::*;
use taceva_evaluate::{EvaluateError, GivenModel, GivenRequest, GivenRows, Work, feature_table};
use taceva_models::ModelSettings;

use crate::arrays::Table;
use crate::buffer::{Buffer, Number};
use crate::dataset::{Recording, jobs_of};
use crate::errors::{study_error, value_error};
use crate::evaluate::part_of;
use crate::{results, worker};

/// Rows of a recording that train and test a model of a Python program.
#[pyclass(module = "taceva._taceva", frozen)]
pub(crate) struct Given {
    /// Training and test rows; `None` after the only call of `score`.
    rows: Mutex<Option<GivenRows>>,
}

impl Given {
    fn with<T>(&self, of: impl FnOnce(&GivenRows) -> T) -> PyResult<T> {
        let rows = self.rows.lock().unwrap_or_else(PoisonError::into_inner);
        rows.as_ref()
            .map(of)
            .ok_or_else(|| value_error("already scored"))
    }
}

#[pymethods]
impl Given {
    #[new]
    #[expect(clippy::too_many_arguments, reason = "the Python side names them")]
    fn new(
        recording: &Recording,
        channels: Vec<String>,
        learns: bool,
        split: Option<String>,
        seed: u64,
        part: Option<&str>,
        reads_frames: bool,
        is_unbounded: bool,
    ) -> PyResult<Given> {
        let request = GivenRequest {
            channels,
            learns,
            split,
            seed,
            part: part.map(part_of).transpose()?,
            reads_frames,
            is_unbounded,
        };
        let rows = GivenRows::new(&recording.dataset, &request);
        Ok(Given {
            rows: Mutex::new(Some(rows.map_err(|error| study_error(&error))?)),
        })
    }

    fn channels(&self) -> PyResult<Vec<String>> {
        self.with(|rows| {
            let channels = rows.channels().iter();
            channels.map(|channel| channel.name().to_owned()).collect()
        })
    }

    /// Rows to learn from.
    fn train(&self) -> PyResult<Vec<usize>> {
        self.with(|rows| rows.train().to_vec())
    }

    /// Rows to predict.
    fn target(&self) -> PyResult<Vec<usize>> {
        self.with(|rows| rows.target().to_vec())
    }

    /// Labels of the rows to learn from, `[rows, channels]`.
    fn labels(&self, recording: &Recording) -> PyResult<Buffer> {
        self.with(|rows| {
            let labels = rows.labels(&recording.dataset);
            Buffer::of_rows(&labels, rows.channels().len())
        })?
    }

    /// Results file of `predictions`, `[rows, channels]`, for the rows to predict, and the table of their samples if they are kept.
    #[expect(clippy::too_many_arguments, reason = "the Python side names them")]
    fn score(
        &self,
        py: Python<'_>,
        recording: &Recording,
        name: String,
        settings: BTreeMap<String, String>,
        predictions: &Bound<'_, PyAny>,
        metrics: Vec<String>,
        jobs: usize,
    ) -> PyResult<(String, Option<String>)> {
        let width = self.with(|rows| rows.channels().len())?;
        let table = Table::of(predictions, "predictions", width)?;
        let numbers = table.row_by_row(py);
        let rows = self
            .rows
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .take();
        let rows = rows.ok_or_else(|| value_error("already scored"))?;
        let model = GivenModel { name, settings };
        // Runs watched, so that Ctrl-C is handled at once.
        let scored = worker::run(py, None, |_| {
            rows.score(&recording.dataset, model, numbers, metrics, jobs_of(jobs))
        })?;
        results::sealed_with_samples(&scored.map_err(|error| study_error(&error))?.report)
    }
}

/// Features of `rows`, `[rows, values]`, computed with `settings`; then their specification, and the height, width and depth of one row's features.
#[pyfunction]
#[pyo3(signature = (recording, settings, rows, jobs, bar = None))]
pub(crate) fn features(
    py: Python<'_>,
    recording: &Recording,
    settings: Vec<String>,
    rows: Vec<usize>,
    jobs: usize,
    bar: Option<&Bound<'_, PyAny>>,
) -> PyResult<(Buffer, String, [usize; 3])> {
    let taken = worker::run(py, bar, |progress| -> Result<_, EvaluateError> {
        let settings = ModelSettings::parse(settings.iter().map(String::as_str))?;
        let work = Work {
            jobs: jobs_of(jobs),
            progress,
            cache: None,
        };
        feature_table(&recording.dataset, &settings, &rows, work)
    })?;
    let table = taken.map_err(|error| study_error(&error))?;
    let shape = table.features.shape();
    let values = table.features.values();
    let bytes: Vec<u8> = values
        .iter()
        .flat_map(|value| value.to_ne_bytes())
        .collect();
    let buffer = Buffer::new(bytes, Number::F32, &[rows.len(), shape.len()])?;
    let size = [shape.height, shape.width, shape.depth];
    Ok((buffer, table.spec.to_string(), size))
}
