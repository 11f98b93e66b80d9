//! A sensor of a child.

use std::sync::Arc;

use taceva_core::{
    Deadline, DriverError, ErrorKind, FrameInfo, FrameMut, Interrupt, Lighting, Sensor, Stamp,
};

use super::lighting::set_light;
use super::link::Link;
use crate::child::memory::SharedMemory;
use crate::child::wire::{Answer, Call};

/// The largest frame that is taken from a child, in bytes: a hundred million pixels.
const FRAME_MAX: usize = 600_000_000;

const CAPTURE: &str = "capture a frame";

pub(super) struct SensorProxy {
    link: Link,
    frame: FrameInfo,
    memory: SharedMemory,
    interrupts: bool,
    scenes: Option<Vec<String>>,
}

impl SensorProxy {
    pub(super) fn new(
        mut link: Link,
        frame: FrameInfo,
        interrupts: bool,
        scenes: Option<Vec<String>>,
    ) -> Result<SensorProxy, DriverError> {
        let doing = "open the sensor";
        let length = frame
            .byte_len()
            .filter(|length| (1..=FRAME_MAX).contains(length));
        let Some(length) = length else {
            let why = format!("frames of {frame}, expected 1 to {FRAME_MAX} bytes");
            return Err(link.fault(doing, why));
        };
        let memory = SharedMemory::new(length).map_err(|error| {
            DriverError::new(ErrorKind::Internal, link.driver(), doing).because(error)
        })?;
        match link.call_without_deadline(&Call::Attach {}, &[memory.file()], doing)? {
            Answer::Done {} => Ok(SensorProxy {
                link,
                frame,
                memory,
                interrupts,
                scenes,
            }),
            _ => Err(link.other_answer(doing)),
        }
    }
}

impl Sensor for SensorProxy {
    fn frame_info(&self) -> FrameInfo {
        self.frame
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.link.done(&Call::Start { deadline }, "start", deadline)
    }

    fn capture(
        &mut self,
        mut into: FrameMut<'_>,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        if into.info() != self.frame {
            let why = format!("a buffer for {}, expected {}", into.info(), self.frame);
            let refused = DriverError::new(ErrorKind::InvalidArgument, self.link.driver(), CAPTURE);
            return Err(refused.because(why));
        }
        match self
            .link
            .call(&Call::Capture { deadline }, CAPTURE, deadline)?
        {
            Answer::Stamped { stamp } => {
                let stamp = self.link.checked(stamp, CAPTURE)?;
                self.memory.copy_to(into.bytes_mut());
                Ok(stamp)
            }
            _ => Err(self.link.other_answer(CAPTURE)),
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

    fn lighting(&mut self) -> Option<&mut dyn Lighting> {
        match self.scenes {
            Some(_) => Some(self),
            None => None,
        }
    }
}

impl Lighting for SensorProxy {
    fn scenes(&self) -> &[String] {
        self.scenes.as_deref().unwrap_or_default()
    }

    fn set(&mut self, scene: &str, deadline: Deadline) -> Result<(), DriverError> {
        set_light(&mut self.link, scene, deadline)
    }
}
