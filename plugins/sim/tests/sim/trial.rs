//! A bench on which `taceva-protocol` runs a plan, and a log in memory.

use std::collections::BTreeSet;
use std::time::Duration;

use taceva_core::{
    Deadline, Device, DriverError, Factory, Frame, Rig, Sensor, SimulatedBench, SinkError, Stamp,
};
use taceva_protocol::{
    Cancel, ContentId, Controls, Devices, Event, Mode, Plan, PressLog, PressRecord, RigInfo,
    RunError, RunSpec, Scene, SourceInfo, Specimen, SpecimenChanger, StopCause, Timekeeper, plan,
    run,
};
use taceva_sim::{
    ForceTransducerFactory, LightingFactory, Model, RobotFactory, SensorFactory, SimulatedRig,
};

/// Clock of a simulated rig. It also changes specimens.
struct BenchClock(SimulatedRig);

impl Timekeeper for BenchClock {
    fn now_s(&self) -> f64 {
        Stamp::at(self.0.now()).valid_s
    }

    fn rest(&mut self, rest: Duration) {
        self.0.rest(rest);
    }
}

impl SpecimenChanger for BenchClock {
    fn mount(&mut self, specimen: Specimen, _: Deadline) -> Result<(), DriverError> {
        SimulatedBench::mount(&self.0, specimen)
    }
}

/// Log in memory.
#[derive(Default)]
pub(crate) struct Log {
    finished: BTreeSet<ContentId>,
    pub(crate) records: Vec<PressRecord>,
    pub(crate) untouched: Vec<Frame>,
}

impl PressLog for Log {
    fn is_finished(&self, press: ContentId) -> bool {
        self.finished.contains(&press)
    }

    fn append(&mut self, record: &PressRecord) -> Result<(), SinkError> {
        self.finished.insert(record.press);
        self.records.push(record.clone());
        Ok(())
    }

    fn untouched(&mut self, frame: &Frame) -> Result<(), SinkError> {
        self.untouched.push(frame.clone());
        Ok(())
    }
}

fn open<D: Device + ?Sized>(factory: &dyn Factory<D>, text: &str, rig: &mut Rig) -> Box<D> {
    let args = factory.descriptor().args(text).expect(text);
    factory.open(&args, rig).expect("opens")
}

/// A bench with a planned study of `model`.
pub(crate) struct Trial {
    pub(crate) model: Model,
    pub(crate) plan: Plan,
    sensors: SensorFactory,
    robots: RobotFactory,
    forces: ForceTransducerFactory,
    lamps: LightingFactory,
}

impl Trial {
    /// Plans the first study of a scene for `model`.
    pub(crate) fn new(model: Model, scene: &str) -> Trial {
        let sensors = SensorFactory::new(model).expect("a driver");
        let robots = RobotFactory::new().expect("a driver");
        let forces = ForceTransducerFactory::new().expect("a driver");
        let lamps = LightingFactory::new().expect("a driver");
        let scene = Scene::parse("trial", scene).expect("a scene");
        let info = RigInfo {
            sensor: Some(sensors.descriptor().clone()),
            robot: Some(robots.descriptor().clone()),
            force: Some(forces.descriptor().clone()),
            lighting: Some(lamps.descriptor().clone()),
        };
        let plans = plan(&scene, |_| SourceInfo::Rig(Box::new(info.clone()))).expect("a plan");
        Trial {
            model,
            plan: plans.into_iter().next().expect("a study"),
            sensors,
            robots,
            forces,
            lamps,
        }
    }

    /// Runs the presses of a unit that `log` lacks, at most `most`, on a new bench.
    pub(crate) fn run(&self, unit: &str, log: &mut Log, most: usize) {
        match self.run_seen_by(unit, log, most, |sensor| sensor) {
            Ok(_) => {}
            Err(error) if matches!(error.cause, StopCause::Cancelled) => {}
            Err(error) => panic!("{}: {error}", self.model),
        }
    }

    /// As `run`, with another sensor in place of the bench's. Returns the number of repeated frames.
    pub(crate) fn run_seen_by(
        &self,
        unit: &str,
        log: &mut Log,
        most: usize,
        instead: impl FnOnce(Box<dyn Sensor>) -> Box<dyn Sensor>,
    ) -> Result<usize, RunError> {
        let mut rig = Rig::new();
        let arguments = format!("unit={unit};seed=7;reduction=40");
        let mut sensor = instead(open(&self.sensors, &arguments, &mut rig));
        let mut robot = open(&self.robots, "", &mut rig);
        let mut force = open(&self.forces, "", &mut rig);
        let mut lighting = open(&self.lamps, "", &mut rig);
        let bench = SimulatedRig::of(&mut rig, "bench");
        let (mut clock, mut changer) = (BenchClock(bench.clone()), BenchClock(bench.clone()));
        let cancel = Cancel::new();
        let (mut begun, mut retried) = (0, 0);
        let mut events = |event: &Event| {
            retried += usize::from(matches!(event, Event::FrameRetried));
            if let Event::Approaching { press, .. } = event {
                bench.name_press(name(*press));
                begun += 1;
                if begun > most {
                    cancel.cancel();
                }
            }
        };
        let done = run(
            &RunSpec {
                plan: &self.plan,
                unit,
                mode: Mode::Acquire,
            },
            Devices {
                robot: robot.as_mut(),
                force: force.as_mut(),
                sensor: Some(sensor.as_mut()),
                lighting: Some(lighting.as_mut()),
                specimens: Some(&mut changer),
            },
            log,
            Controls {
                clock: &mut clock,
                cancel: &cancel,
                events: &mut events,
                operator: None,
            },
        );
        done.map(|_| retried)
    }
}

/// Number that names a press.
fn name(press: ContentId) -> u64 {
    let text = press.to_string();
    u64::from_str_radix(&text[..16], 16).expect("a digest is written in hexadecimal")
}
