//! What the host holds of the devices of a child: the traits of core, each call a question to the child.

mod bench;
mod force;
mod lighting;
mod link;
mod model;
mod robot;
mod sensor;

pub(crate) use bench::BenchProxy;
pub(crate) use link::{CLOSING, Link};
pub(crate) use model::{ModelProxy, of_failure, of_link};

use taceva_core::{DriverError, ForceTransducer, Lighting, Robot, Sensor};

use super::wire::OpenedDevice;
use force::ForceProxy;
use lighting::LightingProxy;
use robot::RobotProxy;
use sensor::SensorProxy;

/// The sensor behind `link`, if that is what was opened.
pub(crate) fn sensor(link: Link, opened: OpenedDevice) -> Result<Box<dyn Sensor>, DriverError> {
    match opened {
        OpenedDevice::Sensor {
            frame,
            interrupts,
            scenes,
        } => Ok(Box::new(SensorProxy::new(link, frame, interrupts, scenes)?)),
        _ => Err(link.broke("it opened no sensor")),
    }
}

/// The robot behind `link`, if that is what was opened.
pub(crate) fn robot(link: Link, opened: OpenedDevice) -> Result<Box<dyn Robot>, DriverError> {
    match opened {
        OpenedDevice::Robot { guarded } => Ok(Box::new(RobotProxy::new(link, guarded))),
        _ => Err(link.broke("it opened no robot")),
    }
}

/// The force transducer behind `link`, if that is what was opened.
pub(crate) fn force(
    link: Link,
    opened: OpenedDevice,
) -> Result<Box<dyn ForceTransducer>, DriverError> {
    match opened {
        OpenedDevice::Force {
            axes,
            interrupts,
            tare,
        } => Ok(Box::new(ForceProxy::new(link, axes, interrupts, tare))),
        _ => Err(link.broke("it opened no force transducer")),
    }
}

/// The lighting behind `link`, if that is what was opened.
pub(crate) fn lighting(link: Link, opened: OpenedDevice) -> Result<Box<dyn Lighting>, DriverError> {
    match opened {
        OpenedDevice::Lighting { scenes } => Ok(Box::new(LightingProxy::new(link, scenes))),
        _ => Err(link.broke("it opened no lighting")),
    }
}
