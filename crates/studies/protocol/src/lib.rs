#![doc = include_str!("../README.md")]

mod content_id;
mod draw;
mod limits;
mod phase;
mod plan;
mod press;
mod rig_file;
mod run;
mod scene;
mod source;
mod specimen;

pub use content_id::ContentId;
pub use limits::{FROZEN_READINGS, Overshoot, RigLimits, SEGMENT_S, STALE_S, Signals};
pub use phase::PhaseKind;
pub use plan::{
    Cause, Cost, Fit, Plan, PlanReason, PlanSkip, PlannedMetric, PlannedPress, Subject, plan,
};
pub use press::{Motion, Press, Waypoint};
pub use rig_file::{
    Carried, Jogged, Latency, Registration, RigChangers, RigFile, RigForce, RigLatencies,
    RigOperator, RigRobot, RigSensor, SignedAxes, Taught, TeachError,
};
pub use run::{
    Answer, Cancel, ChangedTouch, Controls, Devices, Enabling, Event, Left, Mode, MotionStage,
    Observation, Operator, PressLog, PressRecord, Question, ReferenceTouch, RunError, RunGuard,
    RunReport, RunSpec, SessionRecord, SessionSpec, SharedSupervisor, SpecimenChanger, Spot,
    StopCause, Supervisor, TapError, TapHeard, TapListener, Tapped, Timekeeper, TouchFault, Trip,
    raise, run, run_guarded, tap, wrench_between,
};
pub use scene::{
    BuiltinScene, Calibration, Contact, DeviceSpec, FootprintSpec, FrameSize, GREATEST_SCENE,
    GratingClassifier, Gratings, Hysteresis, Idle, LightSweep, LightingSpec, LimitSpec,
    MetricSettings, MetricsSpec, ModelSpec, Protocol, Repeatability, ReportSpec, Scene, SceneError,
    SceneProblem, SensorSpec, Setting, Shape, Spatial, Study, SurfaceMap,
};
pub use source::{RecordingInfo, RigInfo, SourceInfo};
pub use taceva_core::Specimen;
