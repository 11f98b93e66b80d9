//! Force transducer: proxy in the host and server in the child.

use std::os::fd::OwnedFd;
use std::sync::Arc;

use taceva_core::{
    Axes, Deadline, DriverError, DriverKind, ForceTransducer, Interrupt, Stamp, Tare, Wrench,
};

use super::{Kind, Server, answered, answered_if_able, unsupported};
use crate::child::link::Link;
use crate::child::reply::Reading;
use crate::child::wire::{Answer, Call, Failure, OpenedDevice};

struct ForceProxy {
    link: Link,
    axes: Axes,
    interrupts: bool,
    tare: bool,
    /// Sequence number of the last reading; `None` before the first, or if the device does not number readings.
    sequence: Option<u64>,
    /// Number of lost readings, as stated after the last reading; `None` if the device does not count them.
    lost: Option<u64>,
}

impl Kind for dyn ForceTransducer {
    const KIND: DriverKind = DriverKind::Force;

    fn server(self: Box<dyn ForceTransducer>) -> Box<dyn Server> {
        Box::new(self)
    }

    fn proxy(link: Link, opened: OpenedDevice) -> Result<Box<dyn ForceTransducer>, DriverError> {
        match opened {
            OpenedDevice::Force {
                axes,
                interrupts,
                tare,
            } => Ok(Box::new(ForceProxy {
                link,
                axes,
                interrupts,
                tare,
                sequence: None,
                lost: None,
            })),
            _ => Err(link.broke("it opened no force transducer")),
        }
    }
}

impl Server for Box<dyn ForceTransducer> {
    fn opened(&mut self) -> OpenedDevice {
        OpenedDevice::Force {
            axes: self.axes(),
            interrupts: self.interrupt_handle().is_some(),
            tare: self.tare().is_some(),
        }
    }

    fn interrupt(&self) -> Option<Arc<dyn Interrupt>> {
        self.interrupt_handle()
    }

    fn answer(&mut self, call: Call, _: Vec<OwnedFd>) -> Result<Answer, Failure> {
        match call {
            Call::Start { deadline } => answered(self.start(deadline)),
            Call::Read { deadline } => {
                let read = self.read(deadline);
                let [sequence, lost] = [self.sequence(), self.lost()];
                answered(read.map(|(wrench, stamp)| Reading {
                    wrench,
                    stamp,
                    sequence,
                    lost,
                }))
            }
            Call::Zero { deadline } => {
                answered_if_able(self.tare().map(|tare| tare.zero(deadline)))
            }
            Call::Stop {} => answered(self.stop()),
            _ => Err(unsupported()),
        }
    }
}

impl ForceTransducer for ForceProxy {
    fn axes(&self) -> Axes {
        self.axes
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let call = Call::Start { deadline };
        self.link.ask(&call, "start", deadline)
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let call = Call::Read { deadline };
        let read: Reading = self.link.ask(&call, "read the force", deadline)?;
        (self.sequence, self.lost) = (read.sequence, read.lost);
        Ok((read.wrench, read.stamp))
    }

    fn sequence(&self) -> Option<u64> {
        self.sequence
    }

    fn lost(&self) -> Option<u64> {
        self.lost
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.link.ask_without_deadline(&Call::Stop {}, &[], "stop")
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
        let call = Call::Zero { deadline };
        self.link.ask(&call, "zero the force", deadline)
    }
}
