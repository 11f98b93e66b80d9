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
    /// No known limits.
    pub fn none() -> Limits {
        Limits::default()
    }

    /// The same limits with maximum forces, N.
    #[must_use]
    pub fn with_forces(self, normal_max_n: f64, shear_max_n: f64) -> Limits {
        Limits {
            normal_max_n: Some(normal_max_n),
            shear_max_n: Some(shear_max_n),
            ..self
        }
    }

    /// The same limits with the maximum depth, mm.
    #[must_use]
    pub fn with_depth(self, depth_max_mm: f64) -> Limits {
        Limits {
            depth_max_mm: Some(depth_max_mm),
            ..self
        }
    }
}

/// A place to be pressed on the gel, in the frame of the sensor, with the state of its press.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Place {
    /// Along x, mm.
    pub x_mm: f64,
    /// Along y, mm.
    pub y_mm: f64,
    /// The state of the press.
    pub state: PlaceState,
}

/// Counts of frames given to a model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct PredictedFrames {
    /// Frames received.
    pub seen: u64,
    /// Frames that were dropped because the model was busy.
    pub dropped: u64,
    /// Predicted frames outside the training data; `None` if the model does not state it.
    pub outside: Option<u64>,
}

impl PredictedFrames {
    /// Counts of `seen` frames, of which `dropped` were dropped and `outside` are outside the training data.
    pub fn new(seen: u64, dropped: u64, outside: Option<u64>) -> PredictedFrames {
        PredictedFrames {
            seen,
            dropped,
            outside,
        }
    }
}

/// The state of a press.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum PlaceState {
    /// Not yet made.
    Open,
    /// In progress.
    Now,
    /// Recorded.
    Done,
    /// Recorded, but ended early by a limit or a miss.
    Short,
    /// Not part of this run.
    Skipped,
}

/// State that is sent ten times a second.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct State {
    pub(crate) title: String,
    /// Current stage, in words.
    pub(crate) stage: String,
    /// Normal force and shear, N.
    #[serde(rename = "Fz_N")]
    pub(crate) normal_n: Option<f64>,
    #[serde(rename = "Fxy_N")]
    pub(crate) shear_n: Option<f64>,
    /// Depth of the tip in the gel, mm; negative above it.
    #[serde(rename = "Pz_mm")]
    pub(crate) depth_mm: Option<f64>,
    pub(crate) limits: Limits,
    /// The model behind the predictions over pictures, in words.
    pub(crate) predicted_by: Option<String>,
    pub(crate) predicted: Option<PredictedFrames>,
    /// Frames given to the page, and their rate, 1/s.
    pub(crate) frames: u64,
    pub(crate) rate_hz: f64,
    pub(crate) dropped: u64,
    pub(crate) damaged: u64,
    /// True if all dropped frames are counted.
    pub(crate) numbered: bool,
    /// Share of values at full scale in the newest frame.
    pub(crate) saturated: Option<f64>,
    /// See [`Sight`](crate::sight::Sight).
    pub(crate) sharpness: Option<f64>,
    /// Recorded presses, and all presses.
    pub(crate) presses: [usize; 2],
    pub(crate) question: Option<Asked>,
    /// True once stop was pressed.
    pub(crate) is_stopping: bool,
    /// Result of the run, once it has ended.
    pub(crate) ended: Option<String>,
}

/// An open question.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Asked {
    /// Number of the question; answers to other numbers are ignored.
    pub(crate) number: u64,
    pub(crate) text: String,
    /// Label of the button that continues.
    pub(crate) done: String,
    /// True if the question can be skipped.
    pub(crate) can_skip: bool,
    /// A picture of the specimen to mount, as SVG.
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
