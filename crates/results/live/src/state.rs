//! State of the page without frames.

use serde::Serialize;
use taceva_protocol::{Answer, Question};

/// Limits of force and depth of the run; `None` for no limit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Limits {
    /// Maximum normal force, N.
    #[serde(rename = "Fz_max_N")]
    pub normal_max_n: Option<f64>,
    /// Maximum shear force, N.
    #[serde(rename = "Fxy_max_N")]
    pub shear_max_n: Option<f64>,
    /// Maximum depth, mm.
    #[serde(rename = "Pz_max_mm")]
    pub depth_max_mm: Option<f64>,
}

impl Limits {
    /// Creates limits without any maximum.
    pub fn none() -> Limits {
        Limits::default()
    }

    /// Sets the maximum normal force and shear force, N.
    #[must_use]
    pub fn with_forces(self, normal_max_n: f64, shear_max_n: f64) -> Limits {
        Limits {
            normal_max_n: Some(normal_max_n),
            shear_max_n: Some(shear_max_n),
            ..self
        }
    }

    /// Sets the maximum depth, mm.
    #[must_use]
    pub fn with_depth(self, depth_max_mm: f64) -> Limits {
        Limits {
            depth_max_mm: Some(depth_max_mm),
            ..self
        }
    }
}

/// Planned place of a press on the gel, in the frame of the sensor, with the state of the press.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Place {
    /// Position along x, mm.
    pub x_mm: f64,
    /// Position along y, mm.
    pub y_mm: f64,
    /// State of the press.
    pub state: PlaceState,
}

/// Counts of frames for a model: received, dropped, and outside the training data.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct PredictedFrames {
    /// Number of received frames.
    pub seen: u64,
    /// Number of frames that were dropped because the model was busy.
    pub dropped: u64,
    /// Number of predicted frames outside the training data; `None` if the model computes no distance.
    pub outside: Option<u64>,
}

impl PredictedFrames {
    /// Creates the counts of `seen` received, `dropped` dropped, and `outside` frames outside the training data.
    pub fn new(seen: u64, dropped: u64, outside: Option<u64>) -> PredictedFrames {
        PredictedFrames {
            seen,
            dropped,
            outside,
        }
    }
}

/// State of a press.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum PlaceState {
    /// Not yet started.
    Open,
    /// In progress.
    Now,
    /// Recorded.
    Done,
    /// Recorded, but ended early by a limit or because the tip missed the gel.
    Short,
    /// Not part of this run.
    Skipped,
}

/// State of the page that the server sends ten times a second.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct State {
    pub(crate) title: String,
    /// Current stage, in words.
    pub(crate) stage: String,
    /// Normal force and shear, N; `None` before the first reading.
    #[serde(rename = "Fz_N")]
    pub(crate) normal_n: Option<f64>,
    #[serde(rename = "Fxy_N")]
    pub(crate) shear_n: Option<f64>,
    /// Depth of the tip in the gel, mm; negative above the gel, `None` before the first pose.
    #[serde(rename = "Pz_mm")]
    pub(crate) depth_mm: Option<f64>,
    pub(crate) limits: Limits,
    /// Name of the model behind the predictions over pictures; `None` if not given.
    pub(crate) predicted_by: Option<String>,
    pub(crate) predicted: Option<PredictedFrames>,
    /// Number of frames given to the page. The next field is their rate, 1/s.
    pub(crate) frames: u64,
    pub(crate) rate_hz: f64,
    pub(crate) dropped: u64,
    pub(crate) damaged: u64,
    /// True if the count of dropped frames is complete.
    pub(crate) numbered: bool,
    /// Share of values at full scale in the last measured frame; `None` before the first measurement.
    pub(crate) saturated: Option<f64>,
    /// Sharpness of the last measured frame; see [`Sight`](crate::sight::Sight).
    pub(crate) sharpness: Option<f64>,
    /// Number of recorded presses, and number of all presses.
    pub(crate) presses: [usize; 2],
    pub(crate) question: Option<Asked>,
    /// True after a user has pressed the stop button.
    pub(crate) is_stopping: bool,
    /// Result of the run; `None` until the end of the run.
    pub(crate) ended: Option<String>,
}

/// Open question on the page.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Asked {
    /// Number of the question. Answers with other numbers are ignored.
    pub(crate) number: u64,
    pub(crate) text: String,
    /// Text on the button that continues.
    pub(crate) done: String,
    /// True if the question can be skipped.
    pub(crate) can_skip: bool,
    /// Drawing of the specimen to mount, as SVG; `None` without a specimen.
    pub(crate) picture: Option<String>,
    #[serde(skip)]
    pub(crate) answer: Option<Answer>,
}

impl Asked {
    pub(crate) fn new(number: u64, question: &Question) -> Asked {
        Asked {
            number,
            text: question.to_string(),
            done: match question {
                Question::Enable { robot, .. } => format!("Let {robot} move"),
                Question::Resume(_) => "Continue anyway".to_owned(),
                Question::GoOn => "Continue, hands out of reach".to_owned(),
                _ => "Done, hands out of reach".to_owned(),
            },
            can_skip: !matches!(
                question,
                Question::Enable { .. } | Question::Resume(_) | Question::GoOn
            ),
            picture: crate::picture::of(question),
            answer: None,
        }
    }
}
