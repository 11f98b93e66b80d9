//! Sensor: proxy in the host and server in the child. Frames are stored in shared memory.

use std::os::fd::OwnedFd;
use std::sync::Arc;

use taceva_core::{
    Deadline, DriverError, DriverKind, ErrorKind, FrameInfo, FrameMut, Interrupt, Lighting, Sensor,
    Stamp,
};

use super::{Kind, Server, answered, answered_if_able, unsupported};
use crate::child::link::Link;
use crate::child::memory::SharedMemory;
use crate::child::reply::{Captured, Reply};
use crate::child::wire::{Answer, Call, Failure, OpenedDevice};

/// Maximum size of a child's frame, bytes: a hundred million pixels.
const FRAME_MAX: usize = 600_000_000;

const CAPTURE: &str = "capture a frame";
const OPEN: &str = "open the sensor";

struct SensorProxy {
    link: Link,
    frame: FrameInfo,
    memory: SharedMemory,
    interrupts: bool,
    scenes: Option<Vec<String>>,
    /// Sequence number of the last frame; `None` before the first, or if the device does not number frames.
    sequence: Option<u64>,
}

/// Sensor in the child, with the shared memory for its frames.
struct SensorServer {
    sensor: Box<dyn Sensor>,
    frame: FrameInfo,
    memory: Option<SharedMemory>,
}

impl Kind for dyn Sensor {
    const KIND: DriverKind = DriverKind::Sensor;

    fn server(self: Box<dyn Sensor>) -> Box<dyn Server> {
        Box::new(SensorServer {
            frame: self.frame_info(),
            sensor: self,
            memory: None,
        })
    }

    fn proxy(mut link: Link, opened: OpenedDevice) -> Result<Box<dyn Sensor>, DriverError> {
        let OpenedDevice::Sensor {
            frame,
            interrupts,
            scenes,
        } = opened
        else {
            return Err(link.broke("it opened no sensor"));
        };
        let memory = memory_of(&link, frame)?;
        link.ask_without_deadline::<()>(&Call::Attach {}, &[memory.file()], OPEN)?;
        Ok(Box::new(SensorProxy {
            link,
            frame,
            memory,
            interrupts,
            scenes,
            sequence: None,
        }))
    }
}

/// Allocates shared memory for one frame. Fails for a frame of 0 or more than [`FRAME_MAX`] bytes.
fn memory_of(link: &Link, frame: FrameInfo) -> Result<SharedMemory, DriverError> {
    let length = frame
        .byte_len()
        .filter(|length| (1..=FRAME_MAX).contains(length));
    let Some(length) = length else {
        let why = format!("frames of {frame}, expected 1 to {FRAME_MAX} bytes");
        return Err(link.fault(OPEN, why));
    };
    SharedMemory::new(length)
        .map_err(|error| DriverError::new(ErrorKind::Internal, link.driver(), OPEN).because(error))
}

impl SensorServer {
    fn attach(&mut self, files: Vec<OwnedFd>) -> Result<Answer, Failure> {
        let refused = |why: &str| Failure::new(ErrorKind::Protocol, "attach memory", why);
        let file = files.into_iter().next();
        let file = file.ok_or_else(|| refused("no memory was sent"))?;
        let memory = SharedMemory::attach(file).map_err(|error| refused(&error.to_string()))?;
        if self.frame.byte_len() != Some(memory.length()) {
            let why = format!("{} bytes for a frame of {}", memory.length(), self.frame);
            return Err(refused(&why));
        }
        self.memory = Some(memory);
        Ok(().into_answer())
    }

    fn capture(&mut self, deadline: Deadline) -> Result<Answer, Failure> {
        let refused = |why: &str| Failure::new(ErrorKind::Protocol, CAPTURE, why);
        let memory = self
            .memory
            .as_mut()
            .ok_or_else(|| refused("no memory was sent"))?;
        let into = FrameMut::new(self.frame, memory.bytes_mut())
            .map_err(|error| refused(&error.to_string()))?;
        let captured = self.sensor.capture(into, deadline);
        let sequence = self.sensor.sequence();
        answered(captured.map(|stamp| Captured { stamp, sequence }))
    }
}

impl Server for SensorServer {
    fn opened(&mut self) -> OpenedDevice {
        OpenedDevice::Sensor {
            frame: self.frame,
            interrupts: self.sensor.interrupt_handle().is_some(),
            scenes: self.sensor.lighting().map(|light| light.scenes().to_vec()),
        }
    }

    fn interrupt(&self) -> Option<Arc<dyn Interrupt>> {
        self.sensor.interrupt_handle()
    }

    fn answer(&mut self, call: Call, files: Vec<OwnedFd>) -> Result<Answer, Failure> {
        match call {
            Call::Attach {} => self.attach(files),
            Call::Capture { deadline } => self.capture(deadline),
            Call::Start { deadline } => answered(self.sensor.start(deadline)),
            Call::Stop {} => answered(self.sensor.stop()),
            Call::Light { scene, deadline } => {
                let light = self.sensor.lighting();
                answered_if_able(light.map(|light| light.set(&scene, deadline)))
            }
            _ => Err(unsupported()),
        }
    }
}

impl Sensor for SensorProxy {
    fn frame_info(&self) -> FrameInfo {
        self.frame
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let call = Call::Start { deadline };
        self.link.ask(&call, "start", deadline)
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
        let call = Call::Capture { deadline };
        let captured: Captured = self.link.ask(&call, CAPTURE, deadline)?;
        self.sequence = captured.sequence;
        self.memory.copy_to(into.bytes_mut());
        Ok(captured.stamp)
    }

    fn sequence(&self) -> Option<u64> {
        self.sequence
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.link.ask_without_deadline(&Call::Stop {}, &[], "stop")
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
        self.link.set_light(scene, deadline)
    }
}
