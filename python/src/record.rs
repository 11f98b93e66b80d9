//! Recordings from arrays, and from folders of other programs.

use std::collections::BTreeMap;
use std::path::PathBuf;

use pyo3::prelude::*;
use taceva_core::{Clock, Frame, FrameInfo, PixelFormat, Progress, Readings, Sample, Stamp};
use taceva_dataset::{
    DatasetError, Footprint, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source, settle,
};
use taceva_import::{Decoders, ImportMap, ImportPlan};

use crate::arrays::{Points, Table};
use crate::buffer::Pixels;
use crate::dataset::jobs_of;
use crate::errors::{dataset_error, import_error, value_error};
use crate::metrics::channels_of;
use crate::worker;

/// Facts of a recording, parsed by the Python side.
#[derive(FromPyObject)]
pub(crate) struct Facts {
    #[pyo3(item)]
    sensor: String,
    #[pyo3(item)]
    serial: String,
    #[pyo3(item)]
    gel: String,
    #[pyo3(item)]
    opaque: Option<bool>,
    #[pyo3(item)]
    source: String,
    #[pyo3(item)]
    clock: String,
    #[pyo3(item)]
    footprint_mm: Option<(f64, f64)>,
}

impl Facts {
    fn recording(self) -> PyResult<RecordingFacts> {
        let source = match self.source.as_str() {
            "recorded" => Source::Recorded,
            "simulated" => Source::Simulated,
            "synthetic" => Source::Synthetic,
            other => {
                return Err(value_error(format_args!(
                    "source {other:?}: expected recorded, simulated or synthetic"
                )));
            }
        };
        let clock = match self.clock.as_str() {
            "unix" => Clock::Unix,
            "monotonic" => Clock::Monotonic,
            "unknown" => Clock::Unknown,
            other => {
                return Err(value_error(format_args!(
                    "clock {other:?}: expected unix, monotonic or unknown"
                )));
            }
        };
        let sensor = SensorFacts::new(self.sensor)
            .with_serial(self.serial)
            .with_gel(self.gel);
        let sensor = match self.opaque {
            Some(opaque) => sensor.with_opaque(opaque),
            None => sensor,
        };
        let facts = RecordingFacts::new(source, clock, sensor);
        Ok(match self.footprint_mm {
            Some((width, height)) => {
                facts.with_footprint(Footprint::rectangle(width / 2.0, height / 2.0))
            }
            None => facts,
        })
    }
}

/// Writes a recording at `path`: one row for each sample, NaN for a missing label.
#[pyfunction]
#[pyo3(signature = (path, facts, channels, labels, points, times, columns, frames, reference, bar = None))]
#[expect(clippy::too_many_arguments, reason = "the Python side names them")]
pub(crate) fn record(
    py: Python<'_>,
    path: PathBuf,
    facts: Facts,
    channels: Vec<(String, String)>,
    labels: &Bound<'_, PyAny>,
    points: Option<&Bound<'_, PyAny>>,
    times: Option<Vec<f64>>,
    columns: BTreeMap<String, Vec<String>>,
    frames: Option<&Bound<'_, PyAny>>,
    reference: Option<&Bound<'_, PyAny>>,
    bar: Option<&Bound<'_, PyAny>>,
) -> PyResult<()> {
    let channels = channels_of(&channels)?;
    let width = channels.len();
    let labels = Table::of(labels, "labels", width)?;
    let rows = labels.rows();
    let mut values = vec![Vec::with_capacity(rows); width];
    labels.read(py, 0..rows, &mut values);
    let points =
        points.map(|points| Points::of(points).map(|points| points.read(py, 0..points.rows())));
    let points = points.transpose()?;
    let frames = frames
        .map(|frames| Pixels::of(frames, "frames", 4))
        .transpose()?;
    let reference = reference
        .map(|frame| Pixels::of(frame, "reference", 3))
        .transpose()?;
    let spec = RecordingSpec::new(facts.recording()?, channels);
    let info = frames.as_ref().map(frame_info).transpose()?;
    let reference = reference.map(|frame| {
        let info = frame_info(&frame)?;
        Frame::new(info, frame.bytes(py, 0)).map_err(value_error)
    });
    let reference = reference.transpose()?;
    let read = |row: usize| -> PyResult<Option<Frame>> {
        let (Some(frames), Some(info)) = (&frames, info) else {
            return Ok(None);
        };
        let bytes = Python::attach(|py| frames.bytes(py, row));
        Frame::new(info, bytes).map(Some).map_err(value_error)
    };
    worker::run(py, bar, |progress| -> PyResult<()> {
        let mut recorder = Recorder::create(&path, &spec).map_err(|error| dataset_error(&error))?;
        let done = (|| {
            if let Some(reference) = &reference {
                recorder
                    .append_reference(reference)
                    .map_err(|error| dataset_error(&error))?;
            }
            progress.begin("record", Some(rows as u64));
            for row in 0..rows {
                if progress.is_cancelled() {
                    return Err(dataset_error(&DatasetError::Cancelled));
                }
                let truth = values
                    .iter()
                    .map(|column| Some(column[row]).filter(|value| !value.is_nan()));
                let sample = Sample::new(row.to_string())
                    .with_truth(Readings::new(truth.collect()))
                    .with_point_id(
                        points
                            .as_ref()
                            .and_then(|points| points.get(row))
                            .map(str::to_owned),
                    )
                    .with_stamp(times.as_ref().map(|times| Stamp {
                        valid_s: times[row],
                        received_s: None,
                    }))
                    .with_scene_id(columns.get("scene").map(|scenes| scenes[row].clone()))
                    .with_unit_id(columns.get("unit_id").map(|units| units[row].clone()))
                    .with_frame(read(row)?);
                recorder
                    .append(&sample)
                    .map_err(|error| dataset_error(&error))?;
                progress.advance(1);
            }
            progress.end();
            Ok(())
        })();
        match done {
            Ok(()) => recorder
                .close()
                .map(drop)
                .map_err(|error| dataset_error(&error)),
            Err(error) => Err(error),
        }
    })?
}

/// Format of one frame of `[rows, height, width, samples]` or `[height, width, samples]`.
pub(crate) fn frame_info(pixels: &Pixels) -> PyResult<FrameInfo> {
    let [height, width, samples] = pixels.frame_shape();
    let format = match (samples, pixels.is_deep()) {
        (1, false) => PixelFormat::Gray8,
        (3, false) => PixelFormat::Rgb8,
        (1, true) => PixelFormat::Gray16,
        (3, true) => PixelFormat::Rgb16,
        (other, _) => {
            return Err(value_error(format_args!(
                "frames have {other} samples per pixel, expected 1 (gray) or 3 (red, green, blue) in the last axis"
            )));
        }
    };
    let size = |pixels: usize| u32::try_from(pixels).map_err(value_error);
    Ok(FrameInfo {
        width: size(width)?,
        height: size(height)?,
        format,
    })
}

/// Imports the folder `source` to `out`, with the map at `map`.
#[pyfunction]
#[pyo3(signature = (source, map, out, replace, ffmpeg, jobs, bar = None))]
#[expect(clippy::too_many_arguments, reason = "the Python side names them")]
pub(crate) fn import_recording(
    py: Python<'_>,
    source: PathBuf,
    map: PathBuf,
    out: PathBuf,
    replace: bool,
    ffmpeg: Option<PathBuf>,
    jobs: usize,
    bar: Option<&Bound<'_, PyAny>>,
) -> PyResult<()> {
    let imported = worker::run(py, bar, |progress: &dyn Progress| {
        // Recovers an interrupted replacement first, which restores the earlier dataset.
        settle(&out)?;
        let decoders = Decoders { ffmpeg, av1: None };
        let plan = ImportPlan::with_decoders(&source, &ImportMap::read(&map)?, &decoders)?;
        match replace {
            true => plan.replace(&out, jobs_of(jobs), progress),
            false => plan.run(&out, jobs_of(jobs), progress),
        }
    })?;
    imported.map(drop).map_err(|error| import_error(&error))
}
