#![doc = include_str!("../README.md")]

mod content_id;
mod draw;
mod footprint_spec;
mod frame_size;
mod limit_spec;
mod limits;
mod phase;
mod phase_kind;
mod plan;
mod press;
mod reason;
mod rig_file;
mod run;
mod scene;
mod source;
mod text;

pub use content_id::ContentId;
pub use footprint_spec::{FootprintSpec, Shape};
pub use frame_size::FrameSize;
pub use limit_spec::LimitSpec;
pub use limits::{
    FROZEN_READINGS, Overshoot, RigLimits, SEGMENT_S, STALE_S, Signals, calm_threshold_n,
};
pub use phase_kind::PhaseKind;
pub use plan::{Cost, Fit, Plan, PlannedMetric, PlannedPress, PlannedWear, plan};
pub use press::{LoadCycle, Motion, Press, Waypoint};
pub use reason::{Cause, PlanReason, PlanSkip, Subject};
pub use rig_file::{
    Carried, Jogged, Latency, Registration, RigChangers, RigFile, RigForce, RigLatencies,
    RigOperator, RigRobot, RigSensor, SignedAxes, Taught, TeachError, Weighing,
};
pub use run::{
    Answer, Cancel, ChangedTouch, Controls, DepthZero, Devices, Enabling, Event, ForceZero, Left,
    Mode, MotionStage, Observation, Operator, Oversight, PressLog, PressRecord, Question,
    ReferenceTouch, RunError, RunReport, RunSpec, SessionRecord, SessionSpec, SharedSupervisor,
    ShearFault, SpecimenChanger, Spot, StopCause, Supervisor, TapError, TapHeard, TapListener,
    Tapped, Timekeeper, TouchFault, Trip, ZeroStep, ZeroUnknown, raise, run, run_guarded, tap,
    wrench_between,
};
pub use scene::{
    BuiltinScene, Calibration, Contact, DepthOrigin, DeviceSpec, GratingClassifier, Gratings,
    Hysteresis, Idle, LightSweep, LightingSpec, MetricSettings, MetricsSpec, ModelSpec,
    PluginFaultSpec, PosePairs, Protocol, Repeatability, ReportSpec, Scene, SensorSpec,
    ShapePresses, Slip, Spatial, StressSpec, Study, SurfaceMap, WantedWidth, WearLoad, WearSpec,
    WearStage,
};
pub use source::{RecordingInfo, RigInfo, SourceInfo};
pub use taceva_core::Specimen;
pub use text::{GREATEST_SCENE, SceneError, SceneProblem, Setting};
