//! JPEG decoded at a fraction of its size: what a frame takes, against how much further off a model is that learns from it.

use std::path::Path;
use std::time::Instant;

use taceva_core::FrameInfo;
use taceva_dataset::{Dataset, DecodeScale};
use taceva_metrics::ClusterSums;

use super::models::{Raced, TrialError, unfitted};
use super::paired::{absolute_errors, difference};
use taceva_evaluate::EvaluateError;
use taceva_evaluate::FitRequest;
use taceva_evaluate::Work;
use taceva_evaluate::{DataPart, Divided};

/// Frames that are decoded one by one.
const SINGLES: usize = 50;
/// How often each of them; the least counts.
const ROUNDS: usize = 3;

/// One scale: what decoding takes, and how far off the model is.
#[derive(Clone, Debug, PartialEq)]
pub struct DecodeTrial {
    /// The scale.
    pub scale: DecodeScale,
    /// A frame at that scale.
    pub frame: FrameInfo,
    /// Seconds to read, verify and decode one frame on one thread, the median over frames.
    pub decode_s: f64,
    /// The error of each channel on the test part, and how much more it is than at full size; empty if the model could not be fitted.
    pub errors: Vec<(TrialError, Option<ErrorChange>)>,
    /// Why the model could not be fitted or scored.
    pub failed: Option<String>,
}

/// How much more an error is than at full size, on the same samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorChange {
    /// Mean absolute error at this scale less that at full size.
    pub value: f64,
    /// Its 95 % interval by contact point; `None` if there are too few points.
    pub ci95: Option<[f64; 2]>,
}

/// How the recording was divided, and what came of each scale.
#[derive(Clone, Debug, PartialEq)]
pub struct DecodeTrials {
    /// How: `by-point 70/20/10, seed 0`.
    pub split: String,
    /// Samples of the training part.
    pub train: usize,
    /// Samples of the part that is scored.
    pub test: usize,
    /// A scale each, the largest first.
    pub rows: Vec<DecodeTrial>,
}

/// Fits and scores the model of `request` on the recording at `path`, its frames decoded at full size, 1/2, 1/4 and 1/8.
///
/// A scale at which frames are too small for the features is a row that says so.
///
/// # Errors
/// [`EvaluateError`] if the request is not valid, the recording has frames that are no JPEG or cannot be read, or `work` asks to stop.
pub fn decode(
    path: &Path,
    request: &FitRequest,
    work: Work<'_>,
) -> Result<DecodeTrials, EvaluateError> {
    request.check()?;
    // A dataset has one digest, however its frames are decoded.
    let work = Work {
        cache: None,
        ..work
    };
    // Before the work: whether frames are JPEG.
    let smallest = Dataset::open_scaled(path, DecodeScale::Eighth)?;
    let divided = Divided::new(&smallest, request.split.as_deref(), request.seed)?;
    let mut rows = Vec::new();
    let mut full: Option<Full> = None;
    work.progress
        .begin("scales raced", Some(DecodeScale::ALL.len() as u64));
    for scale in DecodeScale::ALL {
        let dataset = Dataset::open_scaled(path, scale)?;
        let mut row = DecodeTrial {
            scale,
            frame: frame_info(&dataset)?,
            decode_s: decode_s(&dataset)?,
            errors: Vec::new(),
            failed: None,
        };
        let outcome = Raced::new(&dataset, request, work).map(|raced| match (&full, scale) {
            (Some(full), _) => row.errors = full.against(&raced),
            (None, scale) => {
                let errors = raced.errors.iter();
                row.errors = errors.map(|error| (error.clone(), None)).collect();
                full = (scale == DecodeScale::Full).then(|| Full::of(&raced));
            }
        });
        row.failed = unfitted(outcome)?;
        rows.push(row);
        work.progress.advance(1);
    }
    work.progress.end();
    Ok(DecodeTrials {
        split: format!("{}, seed {}", divided.spec, divided.seed),
        train: divided.rows(DataPart::Train).len(),
        test: divided.rows(DataPart::Test).len(),
        rows,
    })
}

fn frame_info(dataset: &Dataset) -> Result<FrameInfo, EvaluateError> {
    let frames = dataset.header().frames.as_ref();
    let frames =
        frames.ok_or_else(|| EvaluateError::Request("the dataset has no frames".to_owned()))?;
    Ok(frames.info)
}

/// The median over some frames of the least time of some rounds, so that files are in memory.
fn decode_s(dataset: &Dataset) -> Result<f64, EvaluateError> {
    let rows = dataset.table().frames().iter().enumerate();
    let rows = rows.filter_map(|(row, frame)| frame.as_ref().map(|_| row));
    let mut times = Vec::new();
    for row in rows.take(SINGLES) {
        let mut least = f64::INFINITY;
        for _ in 0..ROUNDS {
            let start = Instant::now();
            dataset.frame(row)?;
            least = least.min(start.elapsed().as_secs_f64());
        }
        times.push(least);
    }
    times.sort_by(f64::total_cmp);
    Ok(times.get(times.len() / 2).copied().unwrap_or(0.0))
}

/// What the model makes of frames at full size: every other scale is compared with it.
struct Full {
    errors: Vec<TrialError>,
    /// Of each channel the sums of absolute errors by contact point; `None` where samples have no point.
    sums: Vec<Option<ClusterSums>>,
}

impl Full {
    fn of(raced: &Raced) -> Full {
        Full {
            errors: raced.errors.clone(),
            sums: absolute_errors(&raced.predicted),
        }
    }

    /// The errors of `raced` beside how much more they are than these.
    fn against(&self, raced: &Raced) -> Vec<(TrialError, Option<ErrorChange>)> {
        let own = absolute_errors(&raced.predicted);
        let change = |error: &TrialError| {
            let full = self
                .errors
                .iter()
                .find(|full| full.channel == error.channel)?;
            let position = raced.predicted.channels().position(&error.channel)?;
            let sides = [own[position].as_ref(), self.sums[position].as_ref()];
            Some(match difference(sides) {
                Some(difference) => ErrorChange {
                    value: difference.value,
                    // So few points that every difference is possible have no interval.
                    ci95: Some(difference.interval)
                        .filter(|ends| ends.iter().all(|end| end.is_finite())),
                },
                // Too few points.
                None => ErrorChange {
                    value: error.mae - full.mae,
                    ci95: None,
                },
            })
        };
        let errors = raced.errors.iter();
        errors.map(|error| (error.clone(), change(error))).collect()
    }
}
