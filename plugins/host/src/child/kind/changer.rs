//! Changer: proxy in the host and server in the child.

use std::os::fd::OwnedFd;
use std::sync::Arc;

use taceva_core::{Changer, Deadline, DriverError, DriverKind, Interrupt};

use super::{Kind, Server, answered, unsupported};
use crate::child::link::Link;
use crate::child::reply::InPlace;
use crate::child::wire::{Answer, Call, Failure, OpenedDevice};

struct ChangerProxy {
    link: Link,
    holds: Vec<String>,
    interrupts: bool,
}

impl Kind for dyn Changer {
    const KIND: DriverKind = DriverKind::Changer;

    fn server(self: Box<dyn Changer>) -> Box<dyn Server> {
        Box::new(self)
    }

    fn proxy(link: Link, opened: OpenedDevice) -> Result<Box<dyn Changer>, DriverError> {
        match opened {
            OpenedDevice::Changer { holds, interrupts } => Ok(Box::new(ChangerProxy {
                link,
                holds,
                interrupts,
            })),
            _ => Err(link.broke("it opened no changer")),
        }
    }
}

impl Server for Box<dyn Changer> {
    fn opened(&mut self) -> OpenedDevice {
        OpenedDevice::Changer {
            holds: self.holds().to_vec(),
            interrupts: self.interrupt_handle().is_some(),
        }
    }

    fn interrupt(&self) -> Option<Arc<dyn Interrupt>> {
        self.interrupt_handle()
    }

    fn answer(&mut self, call: Call, _: Vec<OwnedFd>) -> Result<Answer, Failure> {
        match call {
            Call::Bring { name, deadline } => answered(self.bring(&name, deadline).map(InPlace)),
            _ => Err(unsupported()),
        }
    }
}

impl Changer for ChangerProxy {
    fn holds(&self) -> &[String] {
        &self.holds
    }

    fn bring(&mut self, name: &str, deadline: Deadline) -> Result<String, DriverError> {
        let name = name.to_owned();
        let call = Call::Bring { name, deadline };
        let InPlace(there) = self.link.ask(&call, "bring it into place", deadline)?;
        Ok(there)
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.interrupts.then(|| self.link.interrupt_handle())
    }
}
