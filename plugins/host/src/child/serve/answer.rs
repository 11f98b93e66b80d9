//! Which call of a driver answers which call of the host.

use std::os::fd::OwnedFd;

use taceva_core::{
    Deadline, DriverError, ErrorKind, ForceTransducer, FrameInfo, FrameMut, Lighting, Robot, Sensor,
};

use super::device::Answers;
use crate::child::memory::SharedMemory;
use crate::child::wire::{Answer, Call, Failure, OpenedDevice};

/// A sensor, and the memory that its frames are written into.
pub(super) struct SensorServer {
    sensor: Box<dyn Sensor>,
    frame: FrameInfo,
    memory: Option<SharedMemory>,
}

impl SensorServer {
    pub(super) fn new(sensor: Box<dyn Sensor>) -> SensorServer {
        SensorServer {
            frame: sensor.frame_info(),
            sensor,
            memory: None,
        }
    }

    fn attach(&mut self, files: Vec<OwnedFd>) -> Result<Answer, Failure> {
        let refused = |why: &str| Failure::new(ErrorKind::Protocol, "attach memory", why);
        let file = files.into_iter().next();
        let file = file.ok_or_else(|| refused("no memory came"))?;
        let memory = SharedMemory::attach(file).map_err(|error| refused(&error.to_string()))?;
        if self.frame.byte_len() != Some(memory.length()) {
            let why = format!("{} bytes for a frame of {}", memory.length(), self.frame);
            return Err(refused(&why));
        }
        self.memory = Some(memory);
        Ok(Answer::Done {})
    }

    fn capture(&mut self, deadline: Deadline) -> Result<Answer, Failure> {
        let refused = |why: &str| Failure::new(ErrorKind::Protocol, "capture a frame", why);
        let memory = self
            .memory
            .as_mut()
            .ok_or_else(|| refused("no memory came"))?;
        let into = FrameMut::new(self.frame, memory.bytes_mut())
            .map_err(|error| refused(&error.to_string()))?;
        let stamp = self.sensor.capture(into, deadline).map_err(failed)?;
        Ok(Answer::Stamped { stamp })
    }
}

impl Answers for SensorServer {
    fn opened(&mut self) -> OpenedDevice {
        OpenedDevice::Sensor {
            frame: self.frame,
            interrupts: self.sensor.interrupt_handle().is_some(),
            scenes: self.sensor.lighting().map(|light| light.scenes().to_vec()),
        }
    }

    fn answer(&mut self, call: Call, files: Vec<OwnedFd>) -> Result<Answer, Failure> {
        match call {
            Call::Attach {} => self.attach(files),
            Call::Capture { deadline } => self.capture(deadline),
            Call::Start { deadline } => done(self.sensor.start(deadline)),
            Call::Stop {} => done(self.sensor.stop()),
            Call::Light { scene, deadline } => match self.sensor.lighting() {
                Some(light) => done(light.set(&scene, deadline)),
                None => Err(unsupported()),
            },
            _ => Err(unsupported()),
        }
    }
}

/// A robot.
pub(super) struct RobotServer(pub(super) Box<dyn Robot>);

impl Answers for RobotServer {
    fn opened(&mut self) -> OpenedDevice {
        OpenedDevice::Robot {
            guarded: self.0.guarded_motion().is_some(),
        }
    }

    fn answer(&mut self, call: Call, _files: Vec<OwnedFd>) -> Result<Answer, Failure> {
        match call {
            Call::Pose { deadline } => {
                let (pose, stamp) = self.0.pose(deadline).map_err(failed)?;
                Ok(Answer::At { pose, stamp })
            }
            Call::MoveTo {
                target,
                speed,
                deadline,
            } => {
                let stamp = self.0.move_to(target, speed, deadline).map_err(failed)?;
                Ok(Answer::Stamped { stamp })
            }
            Call::MoveGuarded {
                target,
                speed,
                guard,
                deadline,
            } => {
                let motion = self.0.guarded_motion().ok_or_else(unsupported)?;
                let stop = motion
                    .move_guarded(target, speed, guard, deadline)
                    .map_err(failed)?;
                Ok(Answer::Stopped { stop })
            }
            Call::ClearHalt { deadline } => done(self.0.clear_halt(deadline)),
            _ => Err(unsupported()),
        }
    }
}

/// A force transducer.
pub(super) struct ForceServer(pub(super) Box<dyn ForceTransducer>);

impl Answers for ForceServer {
    fn opened(&mut self) -> OpenedDevice {
        OpenedDevice::Force {
            axes: self.0.axes(),
            interrupts: self.0.interrupt_handle().is_some(),
            tare: self.0.tare().is_some(),
        }
    }

    fn answer(&mut self, call: Call, _files: Vec<OwnedFd>) -> Result<Answer, Failure> {
        match call {
            Call::Start { deadline } => done(self.0.start(deadline)),
            Call::Read { deadline } => {
                let (wrench, stamp) = self.0.read(deadline).map_err(failed)?;
                Ok(Answer::Load { wrench, stamp })
            }
            Call::Zero { deadline } => match self.0.tare() {
                Some(tare) => done(tare.zero(deadline)),
                None => Err(unsupported()),
            },
            Call::Stop {} => done(self.0.stop()),
            _ => Err(unsupported()),
        }
    }
}

/// A lighting.
pub(super) struct LightingServer(pub(super) Box<dyn Lighting>);

impl Answers for LightingServer {
    fn opened(&mut self) -> OpenedDevice {
        OpenedDevice::Lighting {
            scenes: self.0.scenes().to_vec(),
        }
    }

    fn answer(&mut self, call: Call, _files: Vec<OwnedFd>) -> Result<Answer, Failure> {
        match call {
            Call::Light { scene, deadline } => done(self.0.set(&scene, deadline)),
            _ => Err(unsupported()),
        }
    }
}

fn done(result: Result<(), DriverError>) -> Result<Answer, Failure> {
    result.map(|()| Answer::Done {}).map_err(failed)
}

#[expect(
    clippy::needless_pass_by_value,
    reason = "it is handed to `map_err`, which gives the error away"
)]
fn failed(error: DriverError) -> Failure {
    Failure::of(&error)
}

fn unsupported() -> Failure {
    Failure {
        kind: ErrorKind::Unsupported,
        doing: "answer a call of another kind of device".to_owned(),
        cause: None,
    }
}
