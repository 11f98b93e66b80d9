//! Drivers that block, panic, exit and report false values.

use std::sync::{Arc, Condvar, Mutex};
use std::time::Duration;

use taceva_core::{
    ArgSpec, Args, Deadline, Descriptor, DescriptorSpec, DriverError, DriverKey, DriverSource,
    ErrorKind, Factory, Facts, FrameInfo, FrameMut, Halt, Interrupt, PixelFormat, Pose, Rig, Robot,
    RobotFacts, Sensor, SensorFacts, Speed, Stamp,
};

pub(crate) const SENSOR: DriverKey = DriverKey::fixed("odd/sensor");
pub(crate) const ROBOT: DriverKey = DriverKey::fixed("odd/robot");

/// Frames of the misbehaving sensor, in the format of a common camera.
pub(crate) const FRAME: FrameInfo = FrameInfo {
    width: 640,
    height: 480,
    format: PixelFormat::Rgb8,
};

/// Opens sensors whose captures misbehave in the way that the argument `does` names.
pub(crate) struct OddSensorFactory(Descriptor);

impl OddSensorFactory {
    pub(crate) fn new() -> OddSensorFactory {
        let facts = SensorFacts::default().with_frame(FRAME);
        let facts = Facts::Sensor(Box::new(facts));
        let ways = [
            "counts", "waits", "hangs", "panics", "exits", "aborts", "lies",
        ];
        let descriptor = DescriptorSpec::new(SENSOR, "odd", DriverSource::Simulated, facts)
            .arguments([ArgSpec::choice("does", ways)])
            .check()
            .expect("sound");
        OddSensorFactory(descriptor)
    }
}

impl Factory<dyn Sensor> for OddSensorFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Sensor>, DriverError> {
        Ok(Box::new(OddSensor {
            does: args.text("does").to_owned(),
            count: 0,
            bell: Arc::default(),
        }))
    }
}

struct OddSensor {
    does: String,
    count: u8,
    bell: Arc<Bell>,
}

/// Event that wakes one waiting thread.
#[derive(Default)]
struct Bell {
    rung: Mutex<bool>,
    changed: Condvar,
}

impl Bell {
    fn ring(&self) {
        *self.rung.lock().expect("whole") = true;
        self.changed.notify_all();
    }

    /// True if the event occurs within `wait`. Resets the event.
    fn wait(&self, wait: Duration) -> bool {
        let rung = self.rung.lock().expect("whole");
        let (mut rung, _) = self
            .changed
            .wait_timeout_while(rung, wait, |rung| !*rung)
            .expect("whole");
        std::mem::take(&mut rung)
    }
}

impl Interrupt for Bell {
    fn interrupt(&self) {
        self.ring();
    }
}

impl Halt for Bell {
    fn halt(&self) -> Result<(), DriverError> {
        self.ring();
        Ok(())
    }
}

impl Sensor for OddSensor {
    fn frame_info(&self) -> FrameInfo {
        FRAME
    }

    fn capture(
        &mut self,
        mut into: FrameMut<'_>,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        match self.does.as_str() {
            "panics" => panic!("the lens fell off"),
            "exits" => std::process::exit(3),
            "aborts" => std::process::abort(),
            "hangs" => loop {
                std::thread::park();
            },
            "waits" => {
                let kind = match self.bell.wait(deadline.remaining()) {
                    true => ErrorKind::Interrupted,
                    false => ErrorKind::Timeout,
                };
                Err(DriverError::new(kind, &SENSOR, "capture a frame"))
            }
            "lies" => Ok(Stamp {
                valid_s: f64::NAN,
                received_s: None,
            }),
            _ => {
                self.count += 1;
                into.bytes_mut().fill(self.count);
                Ok(Stamp::at(Duration::from_millis(u64::from(self.count))))
            }
        }
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        Some(Arc::clone(&self.bell) as Arc<dyn Interrupt>)
    }
}

/// Opens a robot that never arrives.
pub(crate) struct PatientRobotFactory(Descriptor);

impl PatientRobotFactory {
    pub(crate) fn new() -> PatientRobotFactory {
        let facts = Facts::Robot(RobotFacts::default());
        let descriptor = DescriptorSpec::new(ROBOT, "patient", DriverSource::Simulated, facts)
            .check()
            .expect("sound");
        PatientRobotFactory(descriptor)
    }
}

impl Factory<dyn Robot> for PatientRobotFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }

    fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn Robot>, DriverError> {
        Ok(Box::new(PatientRobot::default()))
    }
}

#[derive(Default)]
struct PatientRobot {
    bell: Arc<Bell>,
}

impl Robot for PatientRobot {
    fn pose(&mut self, _: Deadline) -> Result<(Pose, Stamp), DriverError> {
        Ok((Pose::default(), Stamp::at(Duration::ZERO)))
    }

    fn move_to(&mut self, _: Pose, _: Speed, deadline: Deadline) -> Result<Stamp, DriverError> {
        let kind = match self.bell.wait(deadline.remaining()) {
            true => ErrorKind::Interrupted,
            false => ErrorKind::Timeout,
        };
        Err(DriverError::new(kind, &ROBOT, "move"))
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::clone(&self.bell) as Arc<dyn Halt>
    }

    fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
        Ok(())
    }
}
