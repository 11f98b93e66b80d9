#![doc = include_str!("../README.md")]

mod batch;
mod channel;
mod error;
mod field;
mod frame;
mod geometry;
mod model;
mod needs;
mod phase;
mod progress;
mod quantity;
mod sample;
mod skip;
mod stamp;
mod stream;
mod unit;
mod wrench;

pub use batch::{Batch, BatchBuilder, Column, Labels};
pub use channel::{Channel, ChannelError, Channels};
pub use error::ErrorKind;
pub use field::{Field, FieldSet};
pub use frame::{Frame, FrameError, FrameInfo, FrameMut, PixelFormat};
pub use geometry::{Point, Pose, Rotation};
pub use model::{Estimator, FeatureShape, Features, ModelError, Regressor, Targets, TrainingSet};
pub use needs::Needs;
pub use phase::Phase;
pub use progress::{Progress, Silent};
pub use quantity::{Degree, Hertz, Lux, Millimetre, Newton, NewtonMillimetre};
pub use sample::{Readings, Sample};
pub use skip::{SkipReason, Skipped};
pub use stamp::{Clock, Stamp};
pub use stream::{SampleSink, Select, SinkError, Tee};
pub use unit::{SourceUnit, Unit, UnitError};
pub use wrench::Wrench;
