//! A force transducer of a child.

use std::sync::Arc;

use taceva_core::{
    Axes, Deadline, DriverError, ForceTransducer, Interrupt, Stamp, Tare, Wrench, check_wrench,
};

use super::link::Link;
use crate::child::wire::{Answer, Call};

const READ: &str = "read the force";

pub(super) struct ForceProxy {
    link: Link,
    axes: Axes,
    interrupts: bool,
    tare: bool,
}

impl ForceProxy {
    pub(super) fn new(link: Link, axes: Axes, interrupts: bool, tare: bool) -> ForceProxy {
        ForceProxy {
            link,
            axes,
            interrupts,
            tare,
        }
    }
}

impl ForceTransducer for ForceProxy {
    fn axes(&self) -> Axes {
        self.axes
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.link.done(&Call::Start { deadline }, "start", deadline)
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        match self.link.call(&Call::Read { deadline }, READ, deadline)? {
            Answer::Load { wrench, stamp } => {
                check_wrench(&wrench).map_err(|error| self.link.fault(READ, error))?;
                Ok((wrench, self.link.checked(stamp, READ)?))
            }
            _ => Err(self.link.other_answer(READ)),
        }
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        match self
            .link
            .call_without_deadline(&Call::Stop {}, &[], "stop")?
        {
            Answer::Done {} => Ok(()),
            _ => Err(self.link.other_answer("stop")),
        }
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.interrupts.then(|| self.link.interrupt_handle())
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        if self.tare { Some(self) } else { None }
    }
}

impl Tare for ForceProxy {
    fn zero(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.link
            .done(&Call::Zero { deadline }, "call the load zero", deadline)
    }
}
