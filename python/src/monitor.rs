//! Monitor of a sensor in use.

use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

use pyo3::prelude::*;
use taceva_core::Frame;
use taceva_evaluate::EvaluateError;
use taceva_models::Models;
use taceva_stress::{Alarm, Monitor};

use crate::buffer::Pixels;
use crate::dataset::Recording;
use crate::errors::{ModelError, study_error, value_error};
use crate::record::frame_info;

/// Alarm as Python receives it: change, number of the picture, strength, remedy and text.
type AlarmParts = (&'static str, u64, f64, &'static str, String);

/// A monitor that threads of Python share.
#[pyclass(module = "taceva._taceva", frozen)]
pub(crate) struct PictureMonitor {
    monitor: Mutex<Monitor>,
}

impl PictureMonitor {
    fn of_monitor(monitor: Monitor) -> PictureMonitor {
        PictureMonitor {
            monitor: Mutex::new(monitor),
        }
    }

    fn locked(&self) -> MutexGuard<'_, Monitor> {
        self.monitor.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl PictureMonitor {
    /// A monitor for the unit of `recording`, with the training pictures of the model file `model`, if given.
    #[new]
    #[pyo3(signature = (recording, model=None))]
    fn of(
        py: Python<'_>,
        recording: &Recording,
        model: Option<PathBuf>,
    ) -> PyResult<PictureMonitor> {
        let dataset = &recording.dataset;
        let monitor = py.detach(|| Monitor::of(dataset));
        let monitor = monitor.map_err(|error| study_error(&error))?;
        let Some(path) = model else {
            return Ok(PictureMonitor::of_monitor(monitor));
        };
        let model = Models::builtin()
            .open(&path)
            .map_err(|error| ModelError::new_err(error.to_string()))?;
        let monitor = py.detach(|| monitor.with_model(model, dataset));
        let monitor = monitor.map_err(|error| study_error(&error))?;
        Ok(PictureMonitor::of_monitor(monitor))
    }

    /// A monitor with the untouched picture `reference`; `contact` is the mean change of pictures by contact, a share of full scale.
    #[staticmethod]
    fn of_reference(
        py: Python<'_>,
        reference: &Bound<'_, PyAny>,
        contact: f64,
    ) -> PyResult<PictureMonitor> {
        let reference = frame_of(py, reference, "reference")?;
        let monitor = Monitor::new(reference, contact).map_err(|error| study_error(&error))?;
        Ok(PictureMonitor::of_monitor(monitor))
    }

    /// Takes the next untouched picture; returns the changes that it shows for the first time.
    fn untouched(&self, py: Python<'_>, frame: &Bound<'_, PyAny>) -> PyResult<Vec<AlarmParts>> {
        let frame = frame_of(py, frame, "frame")?;
        parts(py.detach(|| self.locked().untouched(&frame)))
    }

    /// Takes the next picture of contact; returns the change that it shows for the first time.
    fn touched(&self, py: Python<'_>, frame: &Bound<'_, PyAny>) -> PyResult<Vec<AlarmParts>> {
        let frame = frame_of(py, frame, "frame")?;
        parts(py.detach(|| self.locked().touched(&frame)))
    }

    /// Number of untouched pictures that the monitor still needs before it can find changes.
    fn missing(&self) -> usize {
        self.locked().missing()
    }

    /// Smallest detectable change of brightness, pattern, detail and single lines; `None` while untouched pictures are missing.
    fn smallest(&self) -> Option<[f64; 4]> {
        self.locked().smallest()
    }

    /// Names of all changes found.
    fn found(&self) -> Vec<&'static str> {
        let monitor = self.locked();
        monitor.found().iter().map(|change| change.name()).collect()
    }
}

/// A single picture, `[height, width, samples]`.
fn frame_of(py: Python<'_>, picture: &Bound<'_, PyAny>, name: &str) -> PyResult<Frame> {
    let pixels = Pixels::of(picture, name, 3)?;
    Frame::new(frame_info(&pixels)?, pixels.bytes(py, 0)).map_err(value_error)
}

fn parts(alarms: Result<Vec<Alarm>, EvaluateError>) -> PyResult<Vec<AlarmParts>> {
    let alarms = alarms.map_err(|error| study_error(&error))?;
    let parts = alarms.iter().map(|alarm| {
        let (change, text) = (alarm.change, alarm.to_string());
        (
            change.name(),
            alarm.picture,
            alarm.strength,
            change.remedy(),
            text,
        )
    });
    Ok(parts.collect())
}
