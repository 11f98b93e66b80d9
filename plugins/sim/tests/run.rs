//! A whole study planned by `taceva-protocol` and run on the bench, under its supervisor.

use std::collections::BTreeSet;
use std::time::Duration;

use taceva_core::{
    Deadline, Device, DriverError, DriverKey, ErrorKind, Factory, Nanometre, Rig, SinkError,
};
use taceva_protocol::{
    Cancel, Controls, Devices, Digest, Event, Mode, Outcome, PhaseKind, Plan, PlannedPress,
    PressLog, PressRecord, RigInfo, RunSpec, Scene, SourceInfo, Specimen, SpecimenChanger,
    StopCause, Timekeeper, plan, run,
};
use taceva_sim::{
    ForceTransducerFactory, LightingFactory, Model, Mounted, RobotFactory, SensorFactory,
    SimulatedRig,
};

/// The clock and the hands of a rig.
struct Hands(SimulatedRig);

impl Timekeeper for Hands {
    fn now_s(&self) -> f64 {
        self.0.now_s()
    }

    fn rest(&mut self, rest: Duration) {
        self.0.rest(rest);
    }
}

impl SpecimenChanger for Hands {
    fn mount(&mut self, specimen: Specimen, _: Deadline) -> Result<(), DriverError> {
        let mounted = match specimen {
            Specimen::Sphere { radius } => Mounted::ball(radius),
            Specimen::Grating { kind, spacing } => Mounted::board(kind, spacing),
        };
        let key = DriverKey::fixed("sim/robot");
        mounted
            .and_then(|mounted| self.0.mount(mounted))
            .map_err(|error| {
                DriverError::new(ErrorKind::InvalidArgument, &key, "mount").because(error)
            })
    }
}

/// A log in memory.
#[derive(Default)]
struct Log {
    finished: BTreeSet<Digest>,
    records: Vec<PressRecord>,
}

impl Log {
    fn of(&self, press: Digest) -> &PressRecord {
        let mut records = self.records.iter();
        records
            .find(|record| record.press == press)
            .expect("it was made")
    }
}

impl PressLog for Log {
    fn is_finished(&self, press: Digest) -> bool {
        self.finished.contains(&press)
    }

    fn append(&mut self, record: &PressRecord) -> Result<(), SinkError> {
        self.finished.insert(record.press);
        self.records.push(record.clone());
        Ok(())
    }
}

fn open<D: Device + ?Sized>(factory: &dyn Factory<D>, text: &str, rig: &mut Rig) -> Box<D> {
    let args = factory.descriptor().args(text).expect(text);
    factory.open(&args, rig).expect("opens")
}

fn scene(model: Model) -> String {
    format!(
        "scene_version = 1
name = \"small\"
seed = 7
[robot]
driver = \"sim/robot\"
[force]
driver = \"sim/force-transducer\"
[lighting]
driver = \"sim/lighting\"
[model]
name = \"ridge\"
[protocol.calibration]
points = 6
indentations = 3
[protocol.spatial]
points = 4
[protocol.gratings]
step_mm = 0.75
presses = 2
[protocol.lighting]
points = 2
[protocol.repeatability]
points = 2
trials = 3
depth_step_mm = 0.5
[protocol.hysteresis]
points = 2
[protocol.surface]
points = 4
[protocol.idle]
frames = 3
[[study]]
name = \"one\"
[study.sensor]
driver = \"sim/{}\"
units = [\"1\", \"2\"]
",
        model.key()
    )
}

/// A bench with a study of `model` planned on it.
struct Trial {
    model: Model,
    plan: Plan,
    sensors: SensorFactory,
    robots: RobotFactory,
    forces: ForceTransducerFactory,
    lamps: LightingFactory,
}

impl Trial {
    fn new(model: Model) -> Trial {
        let sensors = SensorFactory::new(model).expect("a driver");
        let robots = RobotFactory::new().expect("a driver");
        let forces = ForceTransducerFactory::new().expect("a driver");
        let lamps = LightingFactory::new().expect("a driver");
        let scene = Scene::parse("small", &scene(model)).expect("a scene");
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

    /// Runs what `log` does not have of a unit on a new bench, but no more than `most` presses.
    fn run(&self, unit: &str, log: &mut Log, most: usize) {
        let mut rig = Rig::new();
        let arguments = format!("unit={unit};seed=7;reduction=40");
        let mut sensor = open(&self.sensors, &arguments, &mut rig);
        let mut robot = open(&self.robots, "", &mut rig);
        let mut force = open(&self.forces, "", &mut rig);
        let mut lighting = open(&self.lamps, "", &mut rig);
        let bench = SimulatedRig::of(&mut rig, "bench");
        let (mut clock, mut hands) = (Hands(bench.clone()), Hands(bench.clone()));
        let cancel = Cancel::new();
        let mut begun = 0;
        let mut events = |event: &Event| {
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
                specimens: Some(&mut hands),
            },
            log,
            Controls {
                clock: &mut clock,
                cancel: &cancel,
                events: &mut events,
            },
        );
        match done {
            Ok(_) => {}
            Err(error) if matches!(error.cause, StopCause::Cancelled) => {}
            Err(error) => panic!("{}: {error}", self.model),
        }
    }
}

/// A number that names a press.
fn name(press: Digest) -> u64 {
    let text = press.to_string();
    u64::from_str_radix(&text[..16], 16).expect("a digest is written in hexadecimal")
}

/// Readings of force have errors: more than any of those here has.
const NOISE_N: f64 = 0.05;

#[test]
fn every_part_of_a_study_runs_to_its_end_on_every_sensor() {
    for model in Model::ALL {
        let trial = Trial::new(model);
        let mut log = Log::default();
        for unit in ["1", "2"] {
            trial.run(unit, &mut log, usize::MAX);
        }
        assert_eq!(log.records.len(), trial.plan.presses.len(), "{model}");
        for kind in PhaseKind::ALL {
            // Light does not reach the camera behind a coated gel.
            let is_left_out = kind == PhaseKind::LightSweep
                && matches!(model, Model::GelSight | Model::GelSightWm);
            let presses: Vec<&PlannedPress> = trial.plan.presses_of(kind).collect();
            assert_eq!(presses.is_empty(), is_left_out, "{model}: {kind}");
            for planned in presses {
                trial.check(planned, log.of(planned.id));
            }
        }
    }
}

impl Trial {
    /// Whether a record keeps what its press promised.
    fn check(&self, planned: &PlannedPress, record: &PressRecord) {
        let name = format!("{} {:?} {}", self.model, planned.phases, planned.id);
        let (samples, wanted) = (&record.samples, planned.press.samples());
        match record.outcome {
            Outcome::Complete => assert_eq!(samples.len(), wanted, "{name}"),
            Outcome::Limited => assert!(samples.len() < wanted, "{name}"),
            other => panic!("{name}: {other:?}"),
        }
        let times: Vec<f64> = samples
            .iter()
            .map(|sample| sample.stamp.expect("taken at a time").valid_s)
            .collect();
        assert!(times.is_sorted_by(|one, next| one < next), "{name}");
        for (number, sample) in samples.iter().enumerate() {
            assert_eq!(sample.id, format!("{}/{number}", planned.id));
            assert_eq!(sample.frame.is_some(), planned.frames, "{name}");
            let mut truth = sample.truth.as_slice().iter().flatten();
            assert!(truth.clone().count() > 0, "{name}");
            assert!(truth.all(|value| value.is_finite()), "{name}");
            let is_board = matches!(planned.press.specimen, Specimen::Grating { .. });
            assert_eq!(sample.kind.is_some(), is_board, "{name}");
        }
        self.check_forces(planned, record);
    }

    /// Whether a gel that is pressed deeper presses back harder, and one that is left presses back less.
    fn check_forces(&self, planned: &PlannedPress, record: &PressRecord) {
        let mut channels = self.plan.channels.iter();
        let channel = channels
            .position(|name| name == "Fz")
            .expect("it is measured");
        let curve: Vec<(f64, f64)> = planned
            .press
            .stations()
            .iter()
            .zip(&record.samples)
            .filter(|(station, _)| station.shear == [Nanometre(0); 2])
            .map(|(station, sample)| {
                let force_n = sample.truth.get(channel).expect("it is read");
                (station.depth.to_millimetres(), force_n)
            })
            .collect();
        for pair in curve.windows(2) {
            let [(depth, force), (next_depth, next_force)] = [pair[0], pair[1]];
            let wants = next_depth - depth;
            let rises = if wants == 0.0 { 0.0 } else { wants.signum() } * (next_force - force);
            assert!(rises > -NOISE_N, "{}: {curve:?}", self.model);
        }
    }
}

#[test]
fn a_run_that_was_interrupted_records_what_an_uninterrupted_one_does() {
    let trial = Trial::new(Model::ViTacTip);
    let (mut whole, mut pieces) = (Log::default(), Log::default());
    trial.run("1", &mut whole, usize::MAX);
    for most in [3, 8, 10, usize::MAX] {
        trial.run("1", &mut pieces, most);
    }
    assert_eq!(whole.records.len(), pieces.records.len());
    for (one, other) in whole.records.iter().zip(&pieces.records) {
        assert_eq!(one.press, other.press);
        for (one, other) in one.samples.iter().zip(&other.samples) {
            // The time of day differs, and nothing else.
            assert_eq!(one.truth, other.truth, "{}", one.id);
            assert_eq!(one.frame, other.frame, "{}", one.id);
        }
    }
}
