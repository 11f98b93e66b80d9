//! Drivers of the devices of an emulated rig, `World`.

use std::sync::Arc;
use std::time::Duration;

use taceva_core::{
    ArgSpec, Args, Axes, Changer, ChangerFacts, Deadline, Descriptor, DescriptorError,
    DescriptorSpec, DriverError, DriverKey, DriverSource, EnablingSwitch, ErrorKind, Factory,
    Facts, Fault, Footprint, ForceFacts, ForceTransducer, FrameInfo, FrameMut, Halt, Hertz,
    Lighting, LightingFacts, Millimetre, Newton, PixelFormat, Pose, Registry, Rig, Robot,
    RobotFacts, RobotWatch, Sensor, SensorFacts, Speed, Stamp, Wrench,
};
use taceva_drivers::{Drivers, MonotonicClock, OpenError, Switches};

use crate::waiting::changer::Carousel;
use crate::waiting::world::{World, pose};

const ROBOT: DriverKey = DriverKey::fixed("wall/robot");
/// Key of the test robot if it reports poses in a base frame.
const ARM: DriverKey = DriverKey::fixed("wall/arm");
const FORCE: DriverKey = DriverKey::fixed("wall/force");
const SWITCH: DriverKey = DriverKey::fixed("wall/pedal");
pub(crate) const CAROUSEL: DriverKey = DriverKey::fixed("wall/carousel");
const REVOLVER: DriverKey = DriverKey::fixed("wall/revolver");
const LAMP: DriverKey = DriverKey::fixed("wall/lamp");
const SENSOR: DriverKey = DriverKey::fixed("wall/gel");
/// Interval between force readings, in s.
const READING_S: f64 = 0.005;
/// Delay between a force and its time stamp, in ms.
const LATENCY_MS: f64 = 1.0;

/// Drivers of the devices of the emulated rig `world`.
pub(crate) fn drivers(world: &World) -> Drivers {
    let robot = RobotFacts::default().with_repeatability(Millimetre(0.002));
    let force = ForceFacts::default()
        .with_axes(Axes::FORCE)
        .with_rate(Hertz(1.0 / READING_S))
        .with_force_max(Newton(20.0))
        .with_latency_ms(LATENCY_MS)
        .with_numbered(true);
    let sensor = SensorFacts::default()
        .with_frame(FRAME)
        .with_footprint(Footprint::rectangle(4.0, 4.0, Some(1.0)).ok())
        .with_force_max(Newton(2.0));
    let mut drivers = Drivers {
        sensors: Registry::empty(),
        robots: Registry::empty(),
        forces: Registry::empty(),
        lightings: Registry::empty(),
        changers: Registry::empty(),
        switches: Switches::default(),
    };
    let gel = OnWall::new(SENSOR, Facts::Sensor(Box::new(sensor)), world);
    drivers.sensors.add(Box::new(gel)).expect("one");
    for (key, is_base) in [(ROBOT, false), (ARM, true)] {
        let facts = Facts::Robot(robot.with_base_frame(is_base));
        let arm = OnWall::new(key, facts, world);
        drivers.robots.add(Box::new(arm)).expect("one");
    }
    let transducer = OnWall::new(FORCE, Facts::Force(force), world);
    drivers.forces.add(Box::new(transducer)).expect("one");
    for key in [CAROUSEL, REVOLVER] {
        let holds = ArgSpec::text("holds").changes_facts();
        let facts = Facts::Changer(ChangerFacts::default());
        let is_simulated = key == REVOLVER;
        let mut changer = OnWall::new(key, facts, world);
        let mut spec = changer.descriptor.to_spec().arguments([holds]);
        if is_simulated {
            spec.source = DriverSource::Simulated;
        }
        changer.descriptor = spec.check().expect("no contradiction");
        drivers.changers.add(Box::new(changer)).expect("one");
    }
    let facts = LightingFacts::default().with_scenes(scenes());
    let lamp = OnWall::new(LAMP, Facts::Lighting(facts), world);
    drivers.lightings.add(Box::new(lamp)).expect("one");
    let held = world.clone();
    let title = "what somebody holds with a foot";
    drivers.switches.add(SWITCH, title, Vec::new(), move |_| {
        match held.state().is_unplugged {
            true => Err(OpenError::Device(unplugged("open"))),
            false => Ok(Arc::new(Pedal(held.clone()))),
        }
    });
    drivers
}

fn unplugged(doing: &'static str) -> DriverError {
    DriverError::new(ErrorKind::Disconnected, &SWITCH, doing).because("it was unplugged")
}

/// Test enabling switch: a foot pedal.
struct Pedal(World);

impl EnablingSwitch for Pedal {
    fn is_held(&self) -> Result<bool, DriverError> {
        let state = self.0.state();
        match state.is_unplugged {
            true => Err(unplugged("read")),
            false => Ok(state.is_held),
        }
    }
}

/// Factory that opens one device of an emulated rig.
struct OnWall {
    descriptor: Descriptor,
    world: World,
}

impl OnWall {
    fn new(key: DriverKey, facts: Facts, world: &World) -> OnWall {
        let spec = DescriptorSpec::new(key, "a device of this test", DriverSource::Real, facts);
        // There are several sensors, selected by `unit`.
        let spec = match spec.facts {
            Facts::Sensor(_) => spec.arguments([ArgSpec::text("unit").optional()]),
            _ => spec,
        };
        OnWall {
            descriptor: spec.check().expect("no contradiction"),
            world: world.clone(),
        }
    }
}

/// Implements `Factory` of [`OnWall`] for one kind of device.
macro_rules! opens {
    ($kind:ty, $device:path) => {
        impl Factory<$kind> for OnWall {
            fn descriptor(&self) -> &Descriptor {
                &self.descriptor
            }

            fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<$kind>, DriverError> {
                Ok(Box::new($device(self.world.clone())))
            }
        }
    };
}

impl Factory<dyn Changer> for OnWall {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let mut spec = self.descriptor.to_spec();
        spec.facts = Facts::Changer(ChangerFacts::default().with_holds(held(args)));
        spec.check()
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn Changer>, DriverError> {
        Ok(Box::new(Carousel::new(self.world.clone(), held(args))))
    }
}

/// Names in the driver argument `holds`, separated by `+`.
fn held(args: &Args) -> Vec<String> {
    args.text("holds").split('+').map(str::to_owned).collect()
}

opens!(dyn Robot, Arm);
opens!(dyn ForceTransducer, Transducer);
opens!(dyn Sensor, Gel);
opens!(dyn Lighting, Lamp::over);

/// Names of the light scenes of the test lamp.
fn scenes() -> Vec<String> {
    ["dark", "lamp"].map(str::to_owned).to_vec()
}

struct Lamp {
    world: World,
    scenes: Vec<String>,
}

impl Lamp {
    fn over(world: World) -> Lamp {
        Lamp {
            world,
            scenes: scenes(),
        }
    }
}

impl Lighting for Lamp {
    fn scenes(&self) -> &[String] {
        &self.scenes
    }

    fn set(&mut self, scene: &str, _: Deadline) -> Result<(), DriverError> {
        let now_s = MonotonicClock.now_s();
        let mut state = self.world.state();
        let height_mm = state.tip(now_s)[2];
        state.lights.push((scene.to_owned(), height_mm));
        Ok(())
    }
}

struct Arm(World);

impl Halt for Arm {
    fn halt(&self) -> Result<(), DriverError> {
        self.0.halt();
        Ok(())
    }
}

fn stopped(doing: &'static str) -> DriverError {
    let error = DriverError::new(ErrorKind::DeviceFault, &ROBOT, doing);
    error.with_fault(Fault::EmergencyStop)
}

impl RobotWatch for Arm {
    fn pose(&self, _: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let now = MonotonicClock.now();
        let state = self.0.state();
        match state.is_stopped {
            true => Err(stopped("look on")),
            false => Ok((pose(state.tip(now.as_secs_f64())), Stamp::at(now))),
        }
    }
}

impl Robot for Arm {
    fn is_emulated(&self) -> bool {
        self.0.state().is_emulated
    }

    fn pose(&mut self, _: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let now = MonotonicClock.now();
        let state = self.0.state();
        if state.is_lost {
            return Err(DriverError::new(
                ErrorKind::Disconnected,
                &ROBOT,
                "read the pose",
            ));
        }
        Ok((pose(state.tip(now.as_secs_f64())), Stamp::at(now)))
    }

    fn move_to(&mut self, target: Pose, speed: Speed, _: Deadline) -> Result<Stamp, DriverError> {
        if self.0.state().refuses() {
            return Err(stopped("move"));
        }
        let position = target.position;
        let to = [position.x.0, position.y.0, position.z.0];
        match self.0.travel(to, speed.mm_per_s()) {
            true => Ok(Stamp::at(MonotonicClock.now())),
            false => Err(DriverError::new(ErrorKind::Interrupted, &ROBOT, "move")),
        }
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::new(Arm(self.0.clone()))
    }

    fn watch_handle(&self) -> Option<Arc<dyn RobotWatch>> {
        Some(Arc::new(Arm(self.0.clone())))
    }

    fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
        if self.0.state().refuses() {
            return Err(stopped("end the halt"));
        }
        self.0.state().is_halted = false;
        Ok(())
    }
}

struct Transducer(World);

impl ForceTransducer for Transducer {
    fn axes(&self) -> Axes {
        Axes::FORCE
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let now_s = MonotonicClock.now_s();
        let next_s = ((now_s / READING_S).floor() + 1.0) * READING_S;
        let is_silent = {
            let mut state = self.0.state();
            let is_silent = state.withheld > 0;
            state.withheld = state.withheld.saturating_sub(1);
            is_silent
        };
        if is_silent {
            std::thread::sleep(deadline.remaining());
            return Err(DriverError::new(ErrorKind::Timeout, &FORCE, "read"));
        }
        std::thread::sleep(Duration::from_secs_f64(next_s - now_s));
        let mut state = self.0.state();
        let now = MonotonicClock.now();
        state.readings += 1;
        // A load of 0.3 N rests on it. Its noise depends on the number of the reading.
        let noise_n = if state.readings.is_multiple_of(2) {
            0.001
        } else {
            -0.001
        };
        let force_n = state.force_n(now.as_secs_f64()) + noise_n + 0.3;
        let force = [Newton(0.0), Newton(0.0), Newton(force_n)];
        // The stamp is late by the latency in the descriptor.
        let stamp = Stamp::at(now + Duration::from_micros(1_000));
        let wrench = Wrench {
            force,
            ..Wrench::default()
        };
        Ok((wrench, stamp))
    }

    fn sequence(&self) -> Option<u64> {
        Some(self.0.state().readings)
    }

    fn warnings(&self) -> Vec<String> {
        vec!["a low pass delays forces: switch it off".to_owned()]
    }
}

const FRAME: FrameInfo = FrameInfo {
    width: 2,
    height: 2,
    format: PixelFormat::Gray8,
};

/// Test camera behind the gel, whose frames show the depth of the tip.
struct Gel(World);

impl Sensor for Gel {
    fn frame_info(&self) -> FrameInfo {
        FRAME
    }

    fn capture(&mut self, mut into: FrameMut<'_>, _: Deadline) -> Result<Stamp, DriverError> {
        let now = MonotonicClock.now();
        let mut state = self.0.state();
        if let Some(kind) = state.camera {
            let error = DriverError::new(kind, &SENSOR, "take a picture");
            return Err(error.because("a frame of 4 × 4, expected 2 × 2, or none"));
        }
        state.pictures += 1;
        let [_, _, z] = state.tip(now.as_secs_f64());
        let seen = match z > 0.0 {
            _ if state.is_frozen => state.touched,
            // Another depth looks otherwise, as a camera that is not frozen shows it.
            true => {
                let [_, coarse, fine, ..] = z.to_be_bytes();
                state.touched = [60, 90, coarse, fine];
                state.touched
            }
            false => [60; 4],
        };
        into.bytes_mut().copy_from_slice(&seen);
        Ok(Stamp::at(now))
    }
}
