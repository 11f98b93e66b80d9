//! Devices in virtual time with one flaw each, to show that each check of the suites can fail.

mod robot;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::time::Duration;

use taceva_core::{
    Args, Axes, Changer, ChangerFacts, Deadline, Descriptor, DescriptorSpec, Device, DriverError,
    DriverKey, DriverSource, ErrorKind, Factory, Facts, ForceFacts, ForceTransducer, FrameInfo,
    FrameMut, Hertz, Interrupt, Lighting, LightingFacts, Millimetre, Newton, PixelFormat, Point,
    Pose, Rig, Robot, RobotFacts, Sensor, SensorFacts, Speed, Stamp, Tare, Workspace, Wrench,
};

pub(crate) const KEY: DriverKey = DriverKey::fixed("test/toy");

/// Flaw of a toy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flaw {
    Nothing,
    Panics,
    OtherFrame,
    StampsStandStill,
    TakesAnyBuffer,
    IsSlow,
    StopsForGood,
    StopsOnce,
    DiffersEachTime,
    HidesLight,
    DeclaresNoLight,
    TakesAnyScene,
    BringsAnother,
    OtherAxes,
    Overflows,
    FillsUnmeasured,
    CannotTare,
    RepeatsNumber,
    Creeps,
    Overshoots,
    TakesNaN,
    LeavesWorkspace,
    TakesAnySpeed,
    IgnoresDeadline,
    ForgetsHalt,
    IgnoresHandle,
    HandleDies,
    TakesAnyGuard,
    IsFaultyBeforeStart,
    DiesOfInterrupt,
    OpensToFail,
}

/// Opens a toy of any kind.
pub(crate) struct ToyFactory {
    descriptor: Descriptor,
    flaw: Flaw,
    opened: AtomicU8,
    halted_for_good: Arc<AtomicBool>,
}

impl ToyFactory {
    fn new(facts: Facts, flaw: Flaw) -> ToyFactory {
        let spec = DescriptorSpec::new(KEY, "a toy", DriverSource::Simulated, facts);
        ToyFactory {
            descriptor: spec.check().expect("no contradiction"),
            flaw,
            opened: AtomicU8::new(0),
            halted_for_good: Arc::default(),
        }
    }

    pub(crate) fn sensor(flaw: Flaw) -> ToyFactory {
        let scenes = match flaw {
            Flaw::DeclaresNoLight => Vec::new(),
            _ => scenes(),
        };
        let facts = SensorFacts::default()
            .with_frame(FRAME)
            .with_rate(Hertz(10.0))
            .with_scenes(scenes);
        ToyFactory::new(Facts::Sensor(Box::new(facts)), flaw)
    }

    pub(crate) fn force(flaw: Flaw) -> ToyFactory {
        let facts = ForceFacts::default()
            .with_axes(Axes::FORCE)
            .with_force_max(FULL_SCALE)
            .with_tare(true)
            .with_numbered(true);
        ToyFactory::new(Facts::Force(facts), flaw)
    }

    pub(crate) fn robot(flaw: Flaw) -> ToyFactory {
        let corner = |side| Point {
            x: Millimetre(side),
            y: Millimetre(side),
            z: Millimetre(side),
        };
        let facts = RobotFacts::default()
            .with_workspace(Workspace {
                least: corner(-20.0),
                greatest: corner(20.0),
            })
            .with_speed_max(Speed::try_new(10.0).expect("positive"))
            .with_repeatability(Millimetre(0.0))
            .with_guarded_motion(true);
        ToyFactory::new(Facts::Robot(facts), flaw)
    }

    pub(crate) fn lighting(flaw: Flaw) -> ToyFactory {
        let facts = LightingFacts::default().with_scenes(scenes());
        ToyFactory::new(Facts::Lighting(facts), flaw)
    }

    /// Creates a changer that holds items named like the lighting scenes.
    pub(crate) fn changer(flaw: Flaw) -> ToyFactory {
        let facts = ChangerFacts::default().with_holds(scenes());
        ToyFactory::new(Facts::Changer(facts), flaw)
    }
}

pub(crate) const FULL_SCALE: Newton = Newton(10.0);

const FRAME: FrameInfo = FrameInfo {
    width: 4,
    height: 3,
    format: PixelFormat::Gray8,
};

fn scenes() -> Vec<String> {
    vec!["dark".to_owned(), "bright".to_owned()]
}

fn error(kind: ErrorKind, doing: &'static str) -> DriverError {
    DriverError::new(kind, &KEY, doing)
}

/// A toy of any kind of device.
struct Toy {
    flaw: Flaw,
    shade: u8,
    /// Number of the last reading.
    number: u64,
    readings: f64,
    stopped: bool,
    started: bool,
    interrupted: Arc<AtomicBool>,
    pose: Pose,
    halted: Arc<AtomicBool>,
    scenes: Vec<String>,
}

macro_rules! opens {
    ($($device:ty),*) => {$(
        impl Factory<$device> for ToyFactory {
            fn descriptor(&self) -> &Descriptor {
                &self.descriptor
            }
            fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<$device>, DriverError> {
                let before = self.opened.fetch_add(1, Ordering::Relaxed);
                if self.flaw == Flaw::StopsOnce && before > 0 {
                    return Err(error(ErrorKind::Busy, "open"));
                }
                let differs = self.flaw == Flaw::DiffersEachTime;
                let outlives = self.flaw == Flaw::HandleDies;
                Ok(Box::new(Toy {
                    flaw: self.flaw,
                    shade: if differs { before } else { 0 },
                    number: 0,
                    readings: 0.0,
                    stopped: false,
                    started: false,
                    interrupted: Arc::default(),
                    pose: Pose::default(),
                    halted: if outlives { Arc::clone(&self.halted_for_good) } else { Arc::default() },
                    scenes: scenes(),
                }))
            }
        }
    )*};
}

opens!(
    dyn Sensor,
    dyn ForceTransducer,
    dyn Robot,
    dyn Lighting,
    dyn Changer
);

impl Toy {
    fn stamp(&mut self) -> Stamp {
        if self.flaw != Flaw::StampsStandStill {
            self.readings += 0.1;
        }
        Stamp {
            valid_s: self.readings,
            received_s: None,
        }
    }

    fn ready(&self, doing: &'static str, deadline: Deadline) -> Result<(), DriverError> {
        assert!(self.flaw != Flaw::Panics, "the toy is broken");
        let is_late = match self.flaw {
            Flaw::IsSlow => deadline.has_passed(),
            Flaw::IgnoresDeadline => deadline.remaining() < Duration::from_millis(100),
            _ => false,
        };
        if is_late {
            std::thread::sleep(Duration::from_millis(600));
        }
        let is_gone = match self.flaw {
            Flaw::StopsForGood => self.stopped,
            Flaw::DiesOfInterrupt => self.interrupted.load(Ordering::Acquire),
            Flaw::OpensToFail => true,
            _ => false,
        };
        if is_gone {
            return Err(error(ErrorKind::Disconnected, doing));
        }
        if !self.started && self.flaw == Flaw::IsFaultyBeforeStart {
            return Err(error(ErrorKind::DeviceFault, doing));
        }
        Ok(())
    }
}

/// Interrupt of a toy. A toy never waits, so the interrupt affects only a flawed toy.
struct Bell(Arc<AtomicBool>);

impl Interrupt for Bell {
    fn interrupt(&self) {
        self.0.store(true, Ordering::Release);
    }
}

impl Sensor for Toy {
    fn start(&mut self, _: Deadline) -> Result<(), DriverError> {
        self.started = true;
        Ok(())
    }
    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        Some(Arc::new(Bell(Arc::clone(&self.interrupted))))
    }
    fn frame_info(&self) -> FrameInfo {
        let width = FRAME.width + u32::from(self.flaw == Flaw::OtherFrame);
        FrameInfo { width, ..FRAME }
    }
    fn capture(
        &mut self,
        mut into: FrameMut<'_>,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        self.ready("capture a frame", deadline)?;
        if into.info() != self.frame_info() && self.flaw != Flaw::TakesAnyBuffer {
            return Err(error(ErrorKind::InvalidArgument, "capture a frame"));
        }
        into.bytes_mut().fill(self.shade);
        Ok(self.stamp())
    }
    fn stop(&mut self) -> Result<(), DriverError> {
        self.stopped = true;
        Ok(())
    }
    fn lighting(&mut self) -> Option<&mut dyn Lighting> {
        (self.flaw != Flaw::HidesLight).then_some(self)
    }
}

impl Lighting for Toy {
    fn scenes(&self) -> &[String] {
        let hidden = usize::from(self.flaw == Flaw::HidesLight);
        &self.scenes[hidden..]
    }
    fn set(&mut self, scene: &str, deadline: Deadline) -> Result<(), DriverError> {
        self.ready("set the light", deadline)?;
        let known = self.scenes.iter().any(|known| known == scene);
        if !known && self.flaw != Flaw::TakesAnyScene {
            return Err(error(ErrorKind::InvalidArgument, "set the light"));
        }
        Ok(())
    }
}

impl Changer for Toy {
    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        Some(Arc::new(Bell(Arc::clone(&self.interrupted))))
    }
    fn holds(&self) -> &[String] {
        Lighting::scenes(self)
    }
    fn bring(&mut self, name: &str, deadline: Deadline) -> Result<String, DriverError> {
        Lighting::set(self, name, deadline)?;
        match self.flaw {
            Flaw::BringsAnother => Ok(self.scenes[0].clone()),
            _ => Ok(name.to_owned()),
        }
    }
}

impl ForceTransducer for Toy {
    fn start(&mut self, _: Deadline) -> Result<(), DriverError> {
        self.started = true;
        Ok(())
    }
    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        Some(Arc::new(Bell(Arc::clone(&self.interrupted))))
    }
    fn axes(&self) -> Axes {
        match self.flaw {
            Flaw::OtherAxes => Axes::NORMAL,
            _ => Axes::FORCE,
        }
    }
    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        self.ready("read the force", deadline)?;
        let mut wrench = Wrench::default();
        wrench.force[2] = match self.flaw {
            Flaw::Overflows => FULL_SCALE,
            _ => Newton(f64::from(self.shade) / 32.0),
        };
        if self.flaw == Flaw::FillsUnmeasured {
            wrench.torque[0].0 = 0.5;
        }
        if self.flaw != Flaw::RepeatsNumber {
            self.number += 1;
        }
        Ok((wrench, self.stamp()))
    }
    fn sequence(&self) -> Option<u64> {
        Some(self.number)
    }
    fn stop(&mut self) -> Result<(), DriverError> {
        self.stopped = true;
        Ok(())
    }
    fn tare(&mut self) -> Option<&mut dyn Tare> {
        (self.flaw != Flaw::CannotTare).then_some(self)
    }
}

impl Tare for Toy {
    fn zero(&mut self, _: Deadline) -> Result<(), DriverError> {
        Ok(())
    }
}

/// Opens a toy without arguments.
pub(crate) fn open<D: Device + ?Sized>(factory: &dyn Factory<D>) -> Box<D> {
    factory
        .open(&Args::default(), &mut Rig::new())
        .expect("opens")
}
