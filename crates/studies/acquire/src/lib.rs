#![doc = include_str!("../README.md")]

mod capture;
mod error;
mod instruments;
mod presses;
mod rig;
mod scene;
mod viewer;

pub use capture::{
    CaptureRequest, CaptureStage, CaptureState, Captured, Latencies, LiveDevices, LiveModel,
    LivePredictor, LiveSpec, Onlookers, Prediction, PredictionCounts, capture, close_capture,
    preview,
};
pub use error::AcquireError;
pub use presses::{
    AIR_MM, HeldRigs, Surroundings, SurroundingsOf, Upcoming, Workshop, rehearse_scene,
};
pub use rig::{
    HaltTrip, RigCheck, RigProblem, RigTap, RigWeight, Stock, Stream, SwitchCheck, check_rig,
    read_rig, tap_rig, teach_rig, weigh_rig,
};
pub use scene::{Overrides, PlannedScene, PlannedStudy, SceneText};
pub use viewer::Viewer;
