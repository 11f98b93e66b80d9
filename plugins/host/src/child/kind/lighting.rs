//! Lighting: proxy in the host and server in the child. A sensor with its own lighting uses the same call.

use std::os::fd::OwnedFd;

use taceva_core::{Deadline, DriverError, DriverKind, Lighting};

use super::{Kind, Server, answered, unsupported};
use crate::child::link::Link;
use crate::child::wire::{Answer, Call, Failure, OpenedDevice};

struct LightingProxy {
    link: Link,
    scenes: Vec<String>,
}

impl Kind for dyn Lighting {
    const KIND: DriverKind = DriverKind::Lighting;

    fn server(self: Box<dyn Lighting>) -> Box<dyn Server> {
        Box::new(self)
    }

    fn proxy(link: Link, opened: OpenedDevice) -> Result<Box<dyn Lighting>, DriverError> {
        match opened {
            OpenedDevice::Lighting { scenes } => Ok(Box::new(LightingProxy { link, scenes })),
            _ => Err(link.broke("it opened no lighting")),
        }
    }
}

impl Server for Box<dyn Lighting> {
    fn opened(&mut self) -> OpenedDevice {
        OpenedDevice::Lighting {
            scenes: self.scenes().to_vec(),
        }
    }

    fn answer(&mut self, call: Call, _: Vec<OwnedFd>) -> Result<Answer, Failure> {
        match call {
            Call::Light { scene, deadline } => answered(self.set(&scene, deadline)),
            _ => Err(unsupported()),
        }
    }
}

impl Lighting for LightingProxy {
    fn scenes(&self) -> &[String] {
        &self.scenes
    }

    fn set(&mut self, scene: &str, deadline: Deadline) -> Result<(), DriverError> {
        self.link.set_light(scene, deadline)
    }
}
