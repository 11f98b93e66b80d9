//! Reader of recordings.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyCapsule};
use taceva_check::CheckRequest;
use taceva_core::FrameInfo;
use taceva_dataset::{Dataset, Pass};
use taceva_evaluate::{Divided, fold_divisions, subject_of};
use taceva_import::{ExportForm, ExportPlan};
use taceva_models::Models;

use crate::buffer::{Buffer, Number};
use crate::errors::{
    dataset_error, dataset_error_at, dataset_error_of, import_error, study_error, value_error,
};
use crate::worker;

/// A recording on disk. Its rows are samples: labels, and optionally a frame or signals.
#[pyclass(module = "taceva._taceva", frozen)]
pub(crate) struct Recording {
    pub(crate) dataset: Dataset,
}

impl Recording {
    fn frames_info(&self) -> PyResult<FrameInfo> {
        let known = self.dataset.require_view();
        known.map_err(|error| dataset_error(&error))?;
        let frames = self.dataset.header().frames.as_ref();
        frames
            .map(|frames| frames.info)
            .ok_or_else(|| dataset_error_of(self.dataset.path(), "the recording has no frames"))
    }

    fn buffer_of(&self, rows: usize, bytes: Vec<u8>) -> PyResult<Buffer> {
        let info = self.frames_info()?;
        let number = match info.format.bytes_per_sample() {
            1 => Number::U8,
            _ => Number::U16,
        };
        let size = |pixels: u32| usize::try_from(pixels).map_err(value_error);
        let shape = [
            rows,
            size(info.height)?,
            size(info.width)?,
            info.format.samples(),
        ];
        Buffer::new(native(bytes, number), number, &shape)
    }
}

/// Converts 16-bit samples from little-endian, as in files and frames, to native byte order.
fn native(mut bytes: Vec<u8>, number: Number) -> Vec<u8> {
    if matches!(number, Number::U16) && cfg!(target_endian = "big") {
        bytes.chunks_exact_mut(2).for_each(<[u8]>::reverse);
    }
    bytes
}

#[pymethods]
impl Recording {
    /// Opens the folder at `path` and checks its seal; `view` selects the pictures if samples have several.
    #[new]
    #[pyo3(signature = (path, view=None))]
    fn open(py: Python<'_>, path: PathBuf, view: Option<String>) -> PyResult<Recording> {
        let opened = py.detach(|| match view {
            Some(view) => Dataset::open(&path)?.seen(&view),
            None => Dataset::open(&path),
        });
        opened
            .map(|dataset| Recording { dataset })
            .map_err(|error| dataset_error(&error))
    }

    fn rows(&self) -> usize {
        self.dataset.table().rows()
    }

    fn path(&self) -> PathBuf {
        self.dataset.path().to_owned()
    }

    /// Names of the views if samples have several pictures.
    fn views(&self) -> Vec<String> {
        let views = self.dataset.views().into_iter();
        views.map(str::to_owned).collect()
    }

    /// Selected view; `None` if none was selected.
    fn view(&self) -> Option<String> {
        self.dataset.view()
    }

    fn digest(&self) -> String {
        self.dataset.digest().to_string()
    }

    fn sensor(&self) -> String {
        self.dataset.header().sensor.model.clone()
    }

    /// Source of the samples: `recorded`, `simulated` or `synthetic`.
    fn source(&self) -> String {
        subject_of(&self.dataset).source
    }

    /// Names and units of the channels.
    fn channels(&self) -> Vec<(String, &'static str)> {
        let channels = self.dataset.table().channels().iter();
        channels
            .map(|channel| (channel.name().to_owned(), channel.unit().symbol()))
            .collect()
    }

    /// Labels, `[rows, channels]`; a missing label is NaN.
    fn labels(&self) -> PyResult<Buffer> {
        let table = self.dataset.table();
        let width = table.channels().len();
        let label = |row: usize, channel: usize| table.truth(channel).get(row).unwrap_or(f64::NAN);
        let rows = (0..table.rows()).flat_map(|row| (0..width).map(move |channel| (row, channel)));
        let labels: Vec<f64> = rows.map(|(row, channel)| label(row, channel)).collect();
        Buffer::of_rows(&labels, width)
    }

    /// A column of the table as texts; `None` for an empty cell, or if the column does not exist.
    fn column(&self, name: &str) -> Option<Vec<Option<String>>> {
        let table = self.dataset.table();
        match name {
            "sample" => Some(table.samples().iter().cloned().map(Some).collect()),
            _ => table.as_text(name),
        }
    }

    /// Names of the columns other than channels.
    fn attributes(&self) -> Vec<String> {
        self.dataset.table().attribute_names().to_vec()
    }

    /// Table as an Arrow stream in a capsule.
    fn arrow_stream<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        crate::columns::stream(py, &self.dataset)
    }

    /// Shape of a frame: `(height, width, samples per pixel)`; `None` without frames.
    fn frame_shape(&self) -> Option<(u32, u32, usize)> {
        let info = self.dataset.header().frames.as_ref()?.info;
        Some((info.height, info.width, info.format.samples()))
    }

    /// Frames of `rows`, `[rows, height, width, samples]`.
    #[pyo3(signature = (rows, jobs, bar = None))]
    fn frames(
        &self,
        py: Python<'_>,
        rows: Vec<usize>,
        jobs: usize,
        bar: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Buffer> {
        let frame = self.frames_info()?.byte_len().unwrap_or(usize::MAX);
        let mut bytes = Vec::new();
        let length = frame
            .checked_mul(rows.len())
            .ok_or_else(|| value_error("the array is larger than memory"))?;
        bytes.try_reserve_exact(length).map_err(value_error)?;
        let decoded = worker::run(py, bar, |progress| {
            let pass = Pass::new(&rows, jobs_of(jobs), progress);
            let take = |_, frame: taceva_core::Frame| {
                bytes.extend_from_slice(frame.bytes());
                Ok(())
            };
            self.dataset.map_frames(pass, |_, frame| frame, take)
        })?;
        // Frames are decoded in the order of the rows, so the first missing one failed.
        let taken = bytes.len().checked_div(frame).unwrap_or(0);
        decoded.map_err(|error| dataset_error_at(&error, rows.get(taken).copied()))?;
        self.buffer_of(rows.len(), bytes)
    }

    /// Frame of the untouched gel, `[height, width, samples]`, if any.
    fn reference(&self, py: Python<'_>) -> PyResult<Option<Buffer>> {
        let reference = py
            .detach(|| self.dataset.reference())
            .map_err(|error| dataset_error(&error))?;
        reference
            .map(|frame| self.buffer_of(1, frame.into_bytes()))
            .transpose()
    }

    /// Number of signals in a row; `None` without signals.
    fn signal_values(&self) -> Option<usize> {
        let signals = self.dataset.header().signals.as_ref()?;
        Some(signals.spec.info.len())
    }

    /// Signals of `rows`, `[rows, values]`, taxel by taxel.
    fn signals(&self, py: Python<'_>, rows: Vec<usize>) -> PyResult<Buffer> {
        let Some(header) = &self.dataset.header().signals else {
            return Err(dataset_error_of(
                self.dataset.path(),
                "the recording has no signals",
            ));
        };
        let width = header.spec.info.len();
        let mut bytes = Vec::new();
        py.detach(|| {
            for row in &rows {
                let signals = self.dataset.signals(*row)?;
                let values = signals.as_ref().map_or(&[][..], |signals| signals.values());
                bytes.extend(values.iter().flat_map(|value| value.to_ne_bytes()));
            }
            Ok(())
        })
        .map_err(|error: taceva_dataset::DatasetError| dataset_error(&error))?;
        Buffer::new(bytes, Number::F32, &[rows.len(), width])
    }

    /// Rows of each part, `(train, validation, test)`, as `evaluate` divides the recording, and the name of the split.
    #[pyo3(signature = (split, seed))]
    fn split(&self, split: Option<&str>, seed: u64) -> PyResult<([Vec<usize>; 3], String)> {
        use taceva_evaluate::DataPart::{Test, Train, Validation};
        let divided =
            Divided::of(&self.dataset, split, seed).map_err(|error| study_error(&error))?;
        let parts = [Train, Validation, Test].map(|part| divided.rows(part));
        Ok((parts, divided.spec.to_string()))
    }

    /// Rows of each part for each fold of the cross-validation `split`, and the name of the split.
    #[pyo3(signature = (split, seed))]
    fn folds(&self, split: &str, seed: u64) -> PyResult<(Vec<[Vec<usize>; 3]>, String)> {
        use taceva_evaluate::DataPart::{Test, Train, Validation};
        let divided =
            fold_divisions(&self.dataset, split, seed).map_err(|error| study_error(&error))?;
        let name = divided.first().map(|fold| fold.spec.to_string());
        let parts = divided
            .iter()
            .map(|fold| [Train, Validation, Test].map(|part| fold.rows(part)));
        Ok((parts.collect(), name.unwrap_or_default()))
    }

    /// Exports the recording to the folder `out` like `taceva export`; returns the data that the format cannot express.
    #[pyo3(signature = (form, out, jobs, bar = None))]
    fn export(
        &self,
        py: Python<'_>,
        form: &str,
        out: PathBuf,
        jobs: usize,
        bar: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<String>> {
        let known = ExportForm::ALL.into_iter();
        let known = known
            .clone()
            .find(|known| known.name() == form)
            .ok_or_else(|| {
                let names: Vec<&str> = known.map(ExportForm::name).collect();
                value_error(format_args!("form {form:?}: expected {}", names.join(", ")))
            })?;
        let exported = worker::run(py, bar, |progress| {
            ExportPlan::new(&self.dataset, known)?.run(&out, jobs_of(jobs), progress)
        })?;
        exported
            .map(|report| report.left_out)
            .map_err(|error| import_error(&error))
    }

    /// Findings of `taceva check`, as its JSON output.
    #[pyo3(signature = (jobs, bar = None))]
    fn check<'py>(
        &self,
        py: Python<'py>,
        jobs: usize,
        bar: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let checked = worker::run(py, bar, |progress| {
            let request = CheckRequest {
                only: Vec::new(),
                split: None,
                seed: 0,
                jobs: jobs_of(jobs),
            };
            taceva_check::check(&self.dataset, &request, progress)
        })?;
        let report = checked.map_err(|error| study_error(&error))?;
        let text = serde_json::to_vec(&report).map_err(value_error)?;
        Ok(PyBytes::new(py, &text))
    }
}

/// Number of threads; 0 selects all cores.
pub(crate) fn jobs_of(jobs: usize) -> NonZeroUsize {
    let all = || std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    NonZeroUsize::new(jobs).unwrap_or_else(all)
}

/// All models: built-in models and models of libraries.
pub(crate) fn models() -> Models {
    Models::builtin().with_libraries(taceva_models::library_models())
}
