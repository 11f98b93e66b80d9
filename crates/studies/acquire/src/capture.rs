//! Capture and preview of a sensor without a robot: frames of its camera and readings of a transducer.
//!
//! One thread adds frames to a queue of 8, and another reads the transducer. The calling thread labels each frame with the wrench at the time of the frame, and
//! records frames in batches. If the queue is full, a new frame is counted and dropped, so that no device waits for a disk.

mod camera;
mod contacts;
mod devices;
mod labels;
mod latencies;
mod live_model;
mod prediction;
mod prediction_table;
mod predictor;
mod preview;
mod streams;
mod track;
mod transducer;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use taceva_core::{Axis, Channel, Channels, Clock, DriverError, DriverKey, ErrorKind, Progress};
use taceva_dataset::{
    DatasetError, Header, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source,
    StreamFacts, Streamed, add_device_warnings, add_measured_settings,
};
use taceva_protocol::RigFile;

use crate::error::AcquireError;
use crate::instruments::{day_of, kept};
use crate::presses::{measured_settings, of_rig_file};
use crate::viewer::Viewer;
use contacts::Contacts;
pub use devices::{LiveDevices, LiveSpec};
use labels::Labels;
pub use latencies::Latencies;
pub use live_model::LiveModel;
pub use prediction::Prediction;
pub use predictor::{LivePredictor, PredictionCounts};
pub use preview::preview;
use streams::Streams;

/// Number of frames that are written to disk together.
const TOGETHER: usize = 8;

/// Settings of a capture.
#[derive(Clone, Debug)]
pub struct CaptureRequest {
    /// Folder of the recording. It must not exist yet.
    pub path: PathBuf,
    /// Description of the sensor for the header of the recording.
    pub sensor: SensorFacts,
    /// Duration of the capture by the time stamps of frames; `None` records until the capture is cancelled.
    pub lasts: Option<Duration>,
    /// Number of frames to record; `None` records until the capture is cancelled.
    pub frames: Option<u64>,
    /// Rig file that describes all devices; `None` if selectors name the devices. The recording stores the axes and latencies in this file.
    pub rig: Option<RigFile>,
    /// Settings `operator` and `laboratory` of the recording. They replace the settings of the rig file.
    pub stated: BTreeMap<String, String>,
}

/// Optional viewer and predictor of a capture. They never delay the capture.
#[derive(Clone, Copy, Default)]
#[non_exhaustive]
pub struct Onlookers<'a> {
    /// Viewer that receives forces and counts of lost frames; `None` without a viewer.
    pub viewer: Option<&'a dyn Viewer>,
    /// Predictor that receives frames, if any. Its [table](LivePredictor::with_table) is written next to the recording.
    pub predictor: Option<&'a LivePredictor<'a>>,
}

impl<'a> Onlookers<'a> {
    /// Creates onlookers with neither a viewer nor a predictor.
    pub fn none() -> Onlookers<'a> {
        Onlookers::default()
    }
}

/// Stages of a capture.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CaptureStage {
    /// Measurement of the force zero and of the frame without contact. Nothing may touch the gel.
    Zeroing,
    /// Frames are being recorded. The value is the progress so far.
    Recording(CaptureState),
}

/// Progress of a capture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct CaptureState {
    /// Number of frames that are safely on disk.
    pub frames: u64,
    /// Mean frame rate, in Hz; 0 before the second frame.
    pub rate_hz: f64,
    /// Counts of lost frames.
    pub stream: StreamFacts,
    /// Number of contacts that have begun.
    pub contacts: u64,
    /// Number of frames without a known force; 0 without a transducer.
    pub without_force: u64,
    /// Number of frames before the first force reading. They have no force.
    pub before_force: u64,
    /// Number of frames between two force readings that are too far apart. They have no force.
    pub in_force_gaps: u64,
    /// Number of frames after which no force reading arrived in time. They have no force.
    pub late_force: u64,
    /// Normal force at the last frame, in N; `None` if it is unknown.
    pub normal_n: Option<f64>,
    /// Least normal force since the start, in N. A value far below 0 indicates an axis with the wrong sign.
    pub least_normal_n: f64,
}

/// A finished capture.
#[derive(Debug)]
#[non_exhaustive]
pub struct Captured {
    /// State at the end of the capture.
    pub state: CaptureState,
    /// Header of the recording.
    pub header: Header,
}

/// Records from `live` until the request is fulfilled, the capture is cancelled, a replayed sensor ends, or a device fails.
///
/// Calls `on_stage` with each stage, at most a few times a second.
///
/// # Errors
/// - [`AcquireError::Device`] if a device fails before the first frame.
/// - [`AcquireError::CaptureEnded`] if a device fails later. The earlier frames are then a complete recording.
/// - [`AcquireError::CaptureBroken`] if the recording cannot be written.
/// - [`AcquireError::Dataset`] if the folder exists.
/// - [`AcquireError::Model`] if the model cannot read the frames. A model that fails later ends the predictions, but not the capture.
pub fn capture(
    live: &mut LiveDevices,
    request: &CaptureRequest,
    onlookers: Onlookers<'_>,
    progress: &dyn Progress,
    on_stage: &mut dyn FnMut(CaptureStage),
) -> Result<Captured, AcquireError> {
    if request.path.exists() {
        return Err(DatasetError::TargetExists {
            path: request.path.clone(),
        }
        .into());
    }
    if let Some(predictor) = onlookers.predictor {
        predictor.model().check(live.frame_info())?;
    }
    on_stage(CaptureStage::Zeroing);
    let failed = AcquireError::Device;
    live.begin().map_err(failed)?;
    let untouched = live.untouched().map_err(failed)?;
    if let Some(predictor) = onlookers.predictor {
        predictor.begin(live.frame_info(), Some(&untouched))?;
    }
    let channels = channels(live);
    let source = source(live);
    let mut settings = live.settings();
    settings.extend(request.rig.as_ref().map(of_rig_file).unwrap_or_default());
    settings.extend(request.stated.clone());
    let facts = RecordingFacts::new(source, Clock::Monotonic, request.sensor.clone())
        .with_traceability(kept(live.traceability(), &settings))
        .with_settings(settings)
        .with_recorded_on(day_of(source));
    let mut recorder =
        Recorder::create(&request.path, &RecordingSpec::new(facts, channels.clone()))?;
    recorder.append_reference(&untouched)?;
    let labels = Labels::new(channels);
    let contacts = live
        .measures(Axis::Fz)
        .then(|| Contacts::after(recorder.table()));
    let mut recording = Recording {
        recorder,
        request,
        labels,
        contacts,
        viewer: onlookers.viewer,
        state: CaptureState::default(),
        first_s: None,
    };
    let (done, device) = live.stream(onlookers.predictor, |streams| {
        recording.take_all(streams, progress, on_stage)
    });
    let Recording {
        mut recorder,
        state,
        ..
    } = recording;
    if let Some(predictor) = onlookers.predictor
        && let Some(table) = predictor.table()
    {
        let model = predictor.model();
        let table = table.csv(recorder.table());
        recorder.keep_predictions(model.name(), model.digest(), table);
    }
    match done {
        Err(source) => Err(kept_after(recorder, &request.path, state, source)),
        Ok(()) => {
            // A failure to store a warning or a drift must not lose the recording.
            drop(add_device_warnings(&request.path, &live.device_warnings()));
            let measured = measured_settings(live.settings());
            drop(add_measured_settings(&request.path, &measured));
            let closed = recorder.close();
            let header = closed.map_err(|source| broken(&request.path, state, false, source))?;
            match device {
                None => Ok(Captured { state, header }),
                Some(source) if source.kind() == ErrorKind::EndOfStream => {
                    Ok(Captured { state, header })
                }
                Some(source) => Err(AcquireError::CaptureEnded {
                    path: request.path.clone(),
                    frames: state.frames,
                    source: Box::new(source),
                }),
            }
        }
    }
}

/// Closes a capture that a full disk, a power cut or a kill interrupted. The frames on disk become a recording.
///
/// # Errors
/// [`AcquireError::Dataset`] if nothing was recorded, if the capture is already closed, or if the disk is full.
pub fn close_capture(path: &Path) -> Result<Header, AcquireError> {
    Ok(Recorder::resume(path)?.close()?)
}

/// A capture in progress, with its request.
struct Recording<'a> {
    recorder: Recorder,
    request: &'a CaptureRequest,
    labels: Labels,
    contacts: Option<Contacts>,
    viewer: Option<&'a dyn Viewer>,
    state: CaptureState,
    /// Time of the first frame, in s; `None` before this frame.
    first_s: Option<f64>,
}

impl Recording<'_> {
    /// Records frames until the request is fulfilled, or until no more frames arrive.
    fn take_all(
        &mut self,
        streams: &Streams<'_>,
        progress: &dyn Progress,
        on_stage: &mut dyn FnMut(CaptureStage),
    ) -> Result<(), DatasetError> {
        let mut is_enough = false;
        loop {
            let is_over = is_enough || progress.is_cancelled();
            if is_over {
                streams.end();
            }
            let has_more = self.labels.collect(streams);
            let mut together = Vec::with_capacity(TOGETHER);
            while together.len() < TOGETHER && !is_enough {
                let Some(labelled) = self.labels.next(streams) else {
                    break;
                };
                let (streamed, stamp_s) = match self.labels.sample(labelled, &mut self.contacts) {
                    Ok(sample) => sample,
                    Err(_) => {
                        streams.count_damaged();
                        continue;
                    }
                };
                is_enough = self.count(&streamed, stamp_s);
                together.push(streamed);
            }
            self.state.stream = streams.facts();
            if let Some(viewer) = self.viewer {
                viewer.lost(self.state.stream);
                if let Some(wrench) = streams.track.and_then(|track| track.newest()) {
                    viewer.force(&wrench);
                }
            }
            if !together.is_empty() {
                self.recorder.append_stream(&together, self.state.stream)?;
                self.state.frames += together.len() as u64;
                on_stage(CaptureStage::Recording(self.state));
            } else if !has_more || is_enough {
                // Also stores frames lost after the last batch.
                self.recorder.append_stream(&[], self.state.stream)?;
                return Ok(());
            }
        }
    }

    /// Counts a sample. Returns true if the request is fulfilled.
    fn count(&mut self, streamed: &Streamed, stamp_s: f64) -> bool {
        let first_s = *self.first_s.get_or_insert(stamp_s);
        let state = &mut self.state;
        let number = self.labels.frames();
        #[expect(
            clippy::cast_precision_loss,
            reason = "a count of frames, for display only"
        )]
        if number > 1 && stamp_s > first_s {
            state.rate_hz = (number - 1) as f64 / (stamp_s - first_s);
        }
        state.contacts = self.contacts.as_ref().map_or(0, Contacts::count);
        let normal_n = self.labels.normal_n(&streamed.sample);
        state.normal_n = normal_n;
        state.least_normal_n = state.least_normal_n.min(normal_n.unwrap_or(0.0));
        let has_none = streamed.sample.truth.as_slice().iter().all(Option::is_none);
        state.without_force += u64::from(has_none && !self.labels.is_empty());
        let lost = self.labels.lost();
        (state.before_force, state.in_force_gaps, state.late_force) =
            (lost.before, lost.in_gaps, lost.late);
        let lasts = self.request.lasts;
        let has_lasted = lasts.is_some_and(|lasts| stamp_s - first_s >= lasts.as_secs_f64());
        has_lasted || self.request.frames == Some(number)
    }
}

/// Force channels that the transducer measures.
fn channels(live: &LiveDevices) -> Channels {
    let measured = [
        (Axis::Fx, Channel::FX),
        (Axis::Fy, Channel::FY),
        (Axis::Fz, Channel::FZ),
    ];
    let measured = measured
        .into_iter()
        .filter(|(axis, _)| live.measures(*axis))
        .map(|(_, channel)| channel);
    Channels::new(measured).expect("three different names")
}

fn source(live: &LiveDevices) -> Source {
    match live.is_simulated() {
        true => Source::Simulated,
        false => Source::Recorded,
    }
}

/// Reopens and closes the recording after a failed write, if the disk has space.
fn kept_after(
    recorder: Recorder,
    path: &Path,
    state: CaptureState,
    source: DatasetError,
) -> AcquireError {
    drop(recorder);
    let is_whole = close_capture(path).is_ok();
    broken(path, state, is_whole, source)
}

fn broken(path: &Path, state: CaptureState, is_whole: bool, source: DatasetError) -> AcquireError {
    AcquireError::CaptureBroken {
        path: path.to_owned(),
        frames: state.frames,
        is_whole,
        source: Box::new(source),
    }
}

/// Creates an error for a device failure, with its reason.
fn device_error(
    kind: ErrorKind,
    driver: &DriverKey,
    doing: &'static str,
    why: String,
) -> DriverError {
    DriverError::new(kind, driver, doing).because(why)
}
