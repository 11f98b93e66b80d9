#![doc = include_str!("../README.md")]

mod args;
mod batch;
mod channel;
mod count;
mod date;
mod display;
mod distinct;
mod driver;
mod error;
mod estimator_factory;
mod field;
mod footprint;
mod frame;
mod geometry;
mod grating;
mod id;
mod input;
mod isa;
mod magnitude;
mod model;
mod nanometre;
mod needs;
mod orientation;
mod outcome;
mod panic;
mod phase;
mod precision;
mod printable;
mod progress;
mod quantity;
pub mod random;
mod registry;
mod sample;
mod si;
mod signals;
mod skip_reason;
mod specimen;
mod stamp;
mod stream;
mod suggestion;
mod traceability;
mod unit;
mod wrench;

pub use args::{ArgError, ArgKind, ArgSpec, ArgValue, Args, Presence};
pub use batch::{Batch, BatchBuilder, Column, Labels};
pub use channel::{Channel, ChannelError, Channels};
pub use count::{by_count, counted};
pub use date::{Date, DateError};
pub use distinct::distinct;
pub use driver::{
    Axes, Axis, Changer, Deadline, Device, DriverError, DriverKind, EXPIRES, EnablingSwitch,
    ExpiringMotion, Fault, ForceTransducer, Guard, GuardedMotion, GuardedStop, Halt, Interrupt,
    Lighting, NotFinite, Robot, RobotWatch, SampleTiming, Sensor, SimulatedBench, Speed,
    SpeedError, StampAge, StampRate, Tare, TimingError, check_pose, check_wrench,
};
pub use error::ErrorKind;
pub use estimator_factory::{EstimatorFactory, FitRequest};
pub use field::{Field, FieldSet};
pub use footprint::{Footprint, FootprintError, Outline};
pub use frame::{Frame, FrameError, FrameInfo, FrameMut, PixelFormat};
pub use geometry::{Point, Pose, Rotation};
pub use grating::GratingKind;
pub use id::{DriverKey, DriverKeyError};
pub use input::{Input, InputInfo};
pub use isa::{Isa, IsaError};
pub use magnitude::{MAGNITUDE_MAX, is_scorable};
pub use model::{
    Estimator, FeatureShape, Features, ModelError, Regressor, Saved, SavedRegressor, Targets,
    TrainingSet, not_finite,
};
pub use nanometre::{Nanometre, NanometreError};
pub use needs::Needs;
pub use orientation::Orientation;
pub use outcome::{Limit, PressOutcome};
pub use panic::{caught, contained};
pub use phase::Phase;
pub use precision::{single, whole_count, whole_size};
pub use printable::{Shown, is_obeyed, markdown, shown, shown_lines};
pub use progress::{Progress, SilentProgress};
pub use quantity::{Degree, Hertz, Lux, Millimetre, Newton, NewtonMillimetre};
pub use registry::{
    Access, Builtin, ChangerFacts, Descriptor, DescriptorError, DescriptorSpec, DriverSource,
    Factory, Facts, ForceFacts, Found, LightingFacts, Registry, RegistryError, Rig, RobotFacts,
    SensorFacts, Workspace,
};
pub use sample::{Readings, Sample};
pub use si::SiPose;
pub use signals::{SignalError, SignalInfo, Signals};
pub use skip_reason::{SkipReason, Skipped};
pub use specimen::Specimen;
pub use stamp::{Clock, Stamp};
pub use stream::{SampleSink, Select, SinkError, Tee};
pub use suggestion::{nearest, suggestion};
pub use traceability::{
    Certificate, CertificateContradiction, CertificateError, CertificateFault, Coverage,
    Instrument, StatedCorrelation, Traceability,
};
pub use unit::{Amount, AmountError, SourceUnit, Unit, UnitError};
pub use wrench::Wrench;

// For `submit_builtin!`, so that users of the macro need no dependency on `inventory`.
#[cfg(feature = "inventory")]
#[doc(hidden)]
pub use inventory;
