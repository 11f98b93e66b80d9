#![doc = include_str!("../README.md")]

mod digest;
mod draw;
mod limits;
mod phase;
mod plan;
mod press;
mod run;
mod scene;
#[cfg(feature = "simulation")]
pub mod simulation;
mod source;
mod specimen;

pub use digest::Digest;
pub use limits::{FROZEN_READINGS, Limits, Overshoot};
pub use phase::PhaseKind;
pub use plan::{
    Cause, Cost, Fit, Plan, PlanReason, PlanSkip, PlannedMetric, PlannedPress, Subject, plan,
};
pub use press::{Motion, Press, Station};
pub use run::{
    Cancel, Controls, Devices, Event, Left, Mode, Observation, PressLog, PressRecord, RunError,
    RunReport, RunSpec, SpecimenChanger, Stage, StopCause, Supervisor, Timekeeper, Trip, run,
};
pub use scene::{
    BuiltinScene, Calibration, Contact, DeviceSpec, FootprintSpec, GREATEST_SCENE, GratingTeller,
    Gratings, Hysteresis, Idle, LightSweep, LightingSpec, LimitSpec, MetricSettings, MetricsSpec,
    ModelSpec, Protocol, Repeatability, ReportSpec, Scene, SceneError, SceneProblem, SensorSpec,
    Setting, Shape, Spatial, Study, SurfaceMap,
};
pub use source::{RecordingInfo, RigInfo, SourceInfo};
pub use taceva_core::Specimen;
