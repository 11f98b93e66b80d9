//! Interface of each kind of device, built in or from a plugin: sensor, robot, force transducer, lighting, changer.
//!
//! # The order of calls
//! 1. A [`Factory`](crate::Factory) opens a device from checked [`Args`](crate::Args). Opening moves nothing and changes no light.
//! 2. The caller calls `start`, then reads any number of times, then calls `stop`. Calling `start` or `stop` twice is allowed, and a stopped
//!    device can start again.
//! 3. Dropping a device stops it and releases its resources, in every state.
//!
//! # Time
//! This crate reads no clock. A caller states its timeout as a [`Deadline`]: a real device measures the time on the clock of the machine, a
//! simulated device on the virtual clock of its bench. A call that does not finish in time returns
//! [`ErrorKind::Timeout`](crate::ErrorKind::Timeout) and leaves the device usable.
//!
//! # Threads
//! Each device takes one call at a time. The exceptions are [`Halt`], [`RobotWatch`], [`EnablingSwitch`] and [`Interrupt`]: any thread
//! may call these during any other call.
//!
//! # Values
//! Values are in mm, degrees, N and N·mm, in the sensor's frame, and must be finite. NaN or infinity from the caller is the
//! error [`InvalidArgument`](crate::ErrorKind::InvalidArgument). From the device, it is [`DeviceFault`](crate::ErrorKind::DeviceFault).
//! [`check_pose`] and [`check_wrench`] check poses and wrenches.

mod bench;
mod changer;
mod deadline;
mod enabling;
mod error;
mod expiring_motion;
mod fault;
mod finite;
mod force;
mod guarded_motion;
mod halt;
mod interrupt;
mod kind;
mod lighting;
mod robot;
mod robot_watch;
mod sample_timing;
mod sensor;
mod speed;
mod stamp_age;
mod stamp_rate;

pub use bench::SimulatedBench;
pub use changer::Changer;
pub use deadline::Deadline;
pub use enabling::EnablingSwitch;
pub use error::DriverError;
pub use expiring_motion::{EXPIRES, ExpiringMotion};
pub use fault::Fault;
pub use finite::{NotFinite, check_pose, check_wrench};
pub use force::{Axes, Axis, ForceTransducer, Tare};
pub use guarded_motion::{Guard, GuardedMotion, GuardedStop};
pub use halt::Halt;
pub use interrupt::Interrupt;
pub use kind::{Device, DriverKind};
pub use lighting::Lighting;
pub use robot::Robot;
pub use robot_watch::RobotWatch;
pub use sample_timing::{SampleTiming, TimingError};
pub use sensor::Sensor;
pub use speed::{Speed, SpeedError};
pub use stamp_age::StampAge;
pub use stamp_rate::StampRate;
