//! What the page shows beside frames.

use serde::Serialize;
use taceva_protocol::{Answer, Question};

/// The greatest forces and the deepest indentation that the run allows; `None` where there is no limit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Limits {
    /// The greatest normal force, in N.
    #[serde(rename = "Fz_max_N")]
    pub normal_max_n: Option<f64>,
    /// The greatest shear force, in N.
    #[serde(rename = "Fxy_max_N")]
    pub shear_max_n: Option<f64>,
    /// The deepest indentation, in mm.
    #[serde(rename = "Pz_max_mm")]
    pub depth_max_mm: Option<f64>,
}

impl Limits {
    /// No limit is known.
    pub fn none() -> Limits {
        Limits::default()
    }

    /// The same with the greatest forces, in N.
    #[must_use]
    pub fn with_forces(self, normal_max_n: f64, shear_max_n: f64) -> Limits {
        Limits {
            normal_max_n: Some(normal_max_n),
            shear_max_n: Some(shear_max_n),
            ..self
        }
    }

    /// The same with the deepest indentation, in mm.
    #[must_use]
    pub fn with_depth(self, depth_max_mm: f64) -> Limits {
        Limits {
            depth_max_mm: Some(depth_max_mm),
            ..self
        }
    }
}

/// A place where the gel is pressed, in the sensor's frame, and the state of that press.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Place {
    /// Along x, in mm.
    pub x_mm: f64,
    /// Along y, in mm.
    pub y_mm: f64,
    /// The state of the press.
    pub state: PlaceState,
}

/// Frames that a model was shown, counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct PredictedFrames {
    /// Frames that came.
    pub seen: u64,
    /// Frames that the model had no time for.
    pub dropped: u64,
    /// Predicted frames outside what the model has seen; `None` where it does not know.
    pub outside: Option<u64>,
}

impl PredictedFrames {
    /// So many frames, of which some were left out, and so many lay outside what the model has seen.
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
    /// It is still to come.
    Open,
    /// It is being made.
    Now,
    /// It is recorded.
    Done,
    /// It is recorded, and a limit or a miss ended it early.
    Short,
    /// It is left out of this run.
    Skipped,
}

/// Everything that is said ten times a second.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct State {
    pub(crate) title: String,
    /// What is going on, in words.
    pub(crate) stage: String,
    /// Normal force and shear, in N.
    #[serde(rename = "Fz_N")]
    pub(crate) normal_n: Option<f64>,
    #[serde(rename = "Fxy_N")]
    pub(crate) shear_n: Option<f64>,
    /// How deep the tip is in the gel, in mm; below 0 above it.
    #[serde(rename = "Pz_mm")]
    pub(crate) depth_mm: Option<f64>,
    pub(crate) limits: Limits,
    /// The model behind predictions over pictures, in words.
    pub(crate) predicted_by: Option<String>,
    pub(crate) predicted: Option<PredictedFrames>,
    /// Frames that were shown to the page, and a second.
    pub(crate) frames: u64,
    pub(crate) rate_hz: f64,
    pub(crate) dropped: u64,
    pub(crate) damaged: u64,
    /// Whether lost frames can be counted.
    pub(crate) numbered: bool,
    /// Share of the newest frame's numbers at full scale.
    pub(crate) saturated: Option<f64>,
    /// See [`Sight`](crate::sight::Sight).
    pub(crate) sharpness: Option<f64>,
    /// Presses that are recorded, and all.
    pub(crate) presses: [usize; 2],
    pub(crate) question: Option<Asked>,
    /// Whether somebody pressed stop.
    pub(crate) is_stopping: bool,
    /// How it ended, once it has.
    pub(crate) ended: Option<String>,
}

/// A question that is open.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Asked {
    /// Its number: an answer to another is none to this.
    pub(crate) number: u64,
    pub(crate) text: String,
    /// What the button says that lets it go on.
    pub(crate) done: String,
    /// Whether it can be left out.
    pub(crate) can_skip: bool,
    /// A picture of what to mount, as SVG.
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
                Question::Enable(robot) => format!("Let {robot} move"),
                Question::Resume(_) => "Go on all the same".to_owned(),
                Question::GoOn => "Go on, hands out of reach".to_owned(),
                _ => "Done, hands out of reach".to_owned(),
            },
            can_skip: !matches!(
                question,
                Question::Enable(_) | Question::Resume(_) | Question::GoOn
            ),
            picture: crate::picture::of(question),
            answer: None,
        }
    }
}
