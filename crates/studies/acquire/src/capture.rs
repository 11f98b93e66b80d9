//! A sensor without a robot: what its camera shows and what a transducer reads become a recording, or are looked at.
//!
//! One thread takes frames and puts them into a queue of 8, another reads the transducer; the calling thread gives each frame the wrench at its
//! time and records some at once. A frame that finds no room is counted and left out: nobody waits for a disk.

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

use std::path::{Path, PathBuf};
use std::time::Duration;

use taceva_core::{
    Axis, Channel, Channels, Clock, DriverError, DriverKey, DriverSource, ErrorKind, Progress,
};
use taceva_dataset::{
    DatasetError, Header, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source,
    StreamFacts, Streamed,
};

use crate::error::AcquireError;
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

/// Frames that are made durable at once.
const TOGETHER: usize = 8;

/// What is to be recorded.
#[derive(Clone, Debug)]
pub struct CaptureRequest {
    /// The folder of the recording: a new one.
    pub path: PathBuf,
    /// Which sensor it is.
    pub sensor: SensorFacts,
    /// How long, by the stamps of the frames; until somebody stops it where it is not said.
    pub lasts: Option<Duration>,
    /// How many frames.
    pub frames: Option<u64>,
}

/// Onlookers of a capture, which nobody waits for.
#[derive(Clone, Copy, Default)]
#[non_exhaustive]
pub struct Onlookers<'a> {
    /// A viewer of forces, and of what was lost.
    pub viewer: Option<&'a dyn Viewer>,
    /// A predictor of frames; its [table](LivePredictor::with_table) is written beside the recording.
    pub predictor: Option<&'a LivePredictor<'a>>,
}

impl<'a> Onlookers<'a> {
    /// Nobody.
    pub fn none() -> Onlookers<'a> {
        Onlookers::default()
    }

    /// The same, and `viewer`.
    #[must_use]
    pub fn with_viewer(self, viewer: &'a dyn Viewer) -> Onlookers<'a> {
        Onlookers {
            viewer: Some(viewer),
            ..self
        }
    }

    /// The same, and `predictor`.
    #[must_use]
    pub fn with_predictor(self, predictor: &'a LivePredictor<'a>) -> Onlookers<'a> {
        Onlookers {
            predictor: Some(predictor),
            ..self
        }
    }
}

/// What a capture is doing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CaptureStage {
    /// The zero of the force and the frame without contact are taken: nothing may touch the gel.
    Zeroing,
    /// Frames are recorded.
    Recording(CaptureState),
}

/// How far a capture is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct CaptureState {
    /// Frames that are recorded, and durable.
    pub frames: u64,
    /// Frames a second, over all of them; 0 before the second.
    pub rate_hz: f64,
    /// Frames that were lost.
    pub stream: StreamFacts,
    /// Contacts that began.
    pub contacts: u64,
    /// Frames at whose time no force was known, where there is a transducer.
    pub without_force: u64,
    /// The normal force at the last frame, in N.
    pub normal_n: Option<f64>,
    /// The least normal force so far, in N: far below 0 where an axis is the wrong way round.
    pub least_normal_n: f64,
}

/// A capture that is over.
#[derive(Debug)]
#[non_exhaustive]
pub struct Captured {
    /// How far it went.
    pub state: CaptureState,
    /// The header of the recording.
    pub header: Header,
}

/// Records what `live` sees until `request` is met, somebody cancels, a recorded sensor ends, or a device fails.
///
/// `on_stage` hears what is done, some times a second at most.
///
/// # Errors
/// [`AcquireError::Device`] if a device failed before there was anything to keep; [`AcquireError::CaptureEnded`] if one failed later: what was
/// recorded before is a whole recording then. [`AcquireError::CaptureBroken`] if it cannot be written; [`AcquireError::Dataset`] if the folder
/// is taken; [`AcquireError::Model`] if the model does not fit the frames. A model that fails later ends its predictions and no capture.
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
    let facts = RecordingFacts::new(source(live), Clock::Monotonic, request.sensor.clone())
        .with_settings(live.settings());
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

/// Closes a capture that was interrupted by a full disk, a power cut or a kill: what is durable becomes a recording.
///
/// # Errors
/// [`AcquireError::Dataset`] if nothing was recorded there, if it was closed, or if there is no room.
pub fn close_capture(path: &Path) -> Result<Header, AcquireError> {
    Ok(Recorder::resume(path)?.close()?)
}

/// What is recorded so far, and what of it is asked for.
struct Recording<'a> {
    recorder: Recorder,
    request: &'a CaptureRequest,
    labels: Labels,
    contacts: Option<Contacts>,
    viewer: Option<&'a dyn Viewer>,
    state: CaptureState,
    /// The time of the first frame.
    first_s: Option<f64>,
}

impl Recording<'_> {
    /// Records frames until it is enough, or no more come.
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
                // What was lost after the last frame is written too.
                self.recorder.append_stream(&[], self.state.stream)?;
                return Ok(());
            }
        }
    }

    /// Counts a sample; whether it is the last that is asked for.
    fn count(&mut self, streamed: &Streamed, stamp_s: f64) -> bool {
        let first_s = *self.first_s.get_or_insert(stamp_s);
        let state = &mut self.state;
        let number = self.labels.frames();
        #[expect(
            clippy::cast_precision_loss,
            reason = "a count of frames, for people to read"
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
        let lasts = self.request.lasts;
        let has_lasted = lasts.is_some_and(|lasts| stamp_s - first_s >= lasts.as_secs_f64());
        has_lasted || self.request.frames == Some(number)
    }
}

/// The forces that the transducer measures.
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
    match live.is_emulated() || live.sensor_source() == DriverSource::Simulated {
        true => Source::Simulated,
        false => Source::Recorded,
    }
}

/// After a write that failed: the recording is opened anew and closed, if there is room for that.
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

/// An error of a device that says `why`.
fn device_error(
    kind: ErrorKind,
    driver: &DriverKey,
    doing: &'static str,
    why: String,
) -> DriverError {
    DriverError::new(kind, driver, doing).because(why)
}
