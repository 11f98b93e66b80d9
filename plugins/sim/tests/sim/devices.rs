//! The bench as devices: one press from the air to the label.

use std::time::Duration;

use taceva_core::{
    Args, Deadline, ErrorKind, Factory, ForceTransducer, FrameMut, GratingKind, Guard, GuardedStop,
    Millimetre, Nanometre, Newton, Pose, Rig, Robot, Sensor, SiPose, Specimen, Speed, Stamp,
};
use taceva_sim::{
    ForceTransducerFactory, LightingFactory, Model, MountError, Mounted, RobotFactory,
    SensorFactory, SimulatedRig,
};

const DEADLINE: Deadline = Deadline::after(Duration::from_secs(60));

/// A sensor with its robot and transducer on one bench.
struct Station {
    rig: SimulatedRig,
    sensor: Box<dyn Sensor>,
    robot: Box<dyn Robot>,
    force: Box<dyn ForceTransducer>,
}

fn open<D: ?Sized>(factory: &dyn Factory<D>, text: &str, rig: &mut Rig) -> Box<D> {
    let args = factory.descriptor().args(text).expect(text);
    factory.open(&args, rig).expect("opens")
}

impl Station {
    fn new(model: Model, arguments: &str) -> Station {
        let mut rig = Rig::new();
        let sensors = SensorFactory::new(model).expect("a driver");
        let mut station = Station {
            robot: open(&RobotFactory::new().expect("a driver"), "", &mut rig),
            force: open(
                &ForceTransducerFactory::new().expect("a driver"),
                "",
                &mut rig,
            ),
            sensor: open(&sensors, arguments, &mut rig),
            rig: SimulatedRig::of(&mut rig, "bench"),
        };
        station.sensor.start(DEADLINE).expect("starts");
        station
    }

    fn go(&mut self, x: f64, y: f64, z: f64) {
        let speed = Speed::try_new(2.0).expect("positive");
        self.robot
            .move_to(pose(x, y, z), speed, DEADLINE)
            .expect("arrives");
    }

    fn force_z(&mut self) -> f64 {
        let (wrench, _) = self.force.read(DEADLINE).expect("reads");
        wrench.force[2].0
    }

    /// Moves over a place, tares, and moves down in steps until the force exceeds 0.02 N. Returns that depth.
    fn search(&mut self, x: f64, y: f64) -> f64 {
        self.go(x, y, -3.0);
        self.force
            .tare()
            .expect("can")
            .zero(DEADLINE)
            .expect("zero");
        for step in 0..400 {
            let z = -3.0 + 0.1 * f64::from(step);
            self.go(x, y, z);
            if self.force_z() > 0.02 {
                return z;
            }
        }
        panic!("no gel");
    }

    fn picture(&mut self) -> Vec<u8> {
        let info = self.sensor.frame_info();
        let mut bytes = vec![0; info.byte_len().expect("small")];
        let frame = FrameMut::new(info, &mut bytes).expect("its own length");
        self.sensor.capture(frame, DEADLINE).expect("a frame");
        bytes
    }
}

fn pose(x: f64, y: f64, z: f64) -> Pose {
    let mut pose = Pose::default();
    let position = &mut pose.position;
    (position.x, position.y, position.z) = (Millimetre(x), Millimetre(y), Millimetre(z));
    pose
}

#[test]
fn a_press_from_the_air_to_the_gel_meets_the_truth_of_the_bench() {
    for model in Model::ALL {
        let mut station = Station::new(model, "seed=5");
        let contact_z = station.search(2.0, -1.0);
        let depth = 0.5 * model.parameters().probing.depth_max_mm;
        station.go(2.0, -1.0, contact_z + depth);
        let truth = station.rig.truth().expect("a ball");
        let force = station.force_z();
        assert!(truth.touches());
        assert!(
            (force - truth.force_n[2]).abs() < 0.05,
            "{model}: {force} {truth:?}"
        );
        assert!(
            truth.depth_mm > depth - 0.06 && truth.depth_mm < depth + 0.5,
            "{model}"
        );
        station.go(2.0, -1.0, -3.0);
        assert!(!station.rig.truth().expect("a ball").touches());
        let provenance = station.rig.provenance().expect("a sensor").to_string();
        assert!(provenance.starts_with("source = simulated") && provenance.contains("seed = 5"));
    }
}

#[test]
fn equal_visits_are_equal_whatever_was_done_elsewhere_before() {
    let press = |station: &mut Station| {
        let contact_z = station.search(3.0, 3.0);
        station.go(3.0, 3.0, contact_z + 0.4);
        (contact_z, station.force_z().to_bits(), station.picture())
    };
    let mut fresh = Station::new(Model::GelSight, "seed=5");
    let mut busy = Station::new(Model::GelSight, "seed=5");
    for place in [-4.0, 0.0, 5.0] {
        let contact_z = busy.search(place, 1.0);
        busy.go(place, 1.0, contact_z + 0.3);
        busy.picture();
        busy.go(place, 1.0, -3.0);
    }
    assert_eq!(press(&mut fresh), press(&mut busy));
}

#[test]
fn dragging_a_ball_pulls_the_gel_along_and_turning_back_lets_it_go() {
    let mut station = Station::new(Model::GelSight, "");
    let z = station.search(0.0, 0.0) + 0.6;
    station.go(0.0, 0.0, z);
    station.go(0.5, 0.0, z);
    let dragged = station.rig.truth().expect("a ball").force_n[0];
    station.go(0.0, 0.0, z);
    assert!(dragged > 0.1, "{dragged}");
}

#[test]
fn a_gel_that_is_held_relaxes_and_one_that_is_left_recovers() {
    let mut station = Station::new(Model::ViTacTip, "");
    let z = station.search(0.0, 0.0) + 2.0;
    station.go(0.0, 0.0, z);
    let force = |station: &Station| station.rig.truth().expect("a ball").force_n[2];
    let at_once = force(&station);
    station.rig.rest(Duration::from_secs(60));
    let later = force(&station);
    assert!(
        later < 0.8 * at_once && later > 0.5 * at_once,
        "{at_once} {later}"
    );
}

#[test]
fn pictures_change_when_the_gel_is_pressed_and_light_reaches_only_clear_gels() {
    for model in Model::ALL {
        let mut station = Station::new(model, "");
        let before = station.picture();
        let z = station.search(0.0, 0.0) + 0.5;
        station.go(0.0, 0.0, z);
        assert_ne!(before, station.picture(), "{model}");
        let is_clear = model.parameters().camera.transparency > 0.5;
        assert_eq!(station.sensor.lighting().is_some(), is_clear, "{model}");
    }
}

#[test]
fn light_of_the_lamps_brightens_a_clear_gel() {
    let mut rig = Rig::new();
    let mut lamps = open(&LightingFactory::new().expect("a driver"), "", &mut rig);
    let sensors = SensorFactory::new(Model::ViTacTip).expect("a driver");
    let mut sensor = open(&sensors, "", &mut rig);
    sensor.start(DEADLINE).expect("starts");
    let mut brightness = || -> u64 {
        let info = sensor.frame_info();
        let mut bytes = vec![0; info.byte_len().expect("small")];
        let frame = FrameMut::new(info, &mut bytes).expect("its own length");
        sensor.capture(frame, DEADLINE).expect("a frame");
        // High bytes of the little-endian samples.
        bytes
            .iter()
            .skip(1)
            .step_by(2)
            .map(|byte| u64::from(*byte))
            .sum()
    };
    let dark = brightness();
    lamps.set("S4", DEADLINE).expect("a scene");
    assert!(brightness() > 2 * dark);
    let error = lamps.set("S9", DEADLINE).expect_err("no scene");
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    assert!(
        error.to_string().contains("expected one of `normal`, `S1`"),
        "{error}"
    );
}

#[test]
fn boards_and_balls_are_mounted_in_the_air_and_only_those_there_are() {
    let mut station = Station::new(Model::GelSight, "");
    let board = Mounted::board(GratingKind::Line, Nanometre(500_000)).expect("in the catalogue");
    station.rig.mount(board).expect("in the air");
    let blank = station.picture();
    for step in 0..100 {
        station.go(0.0, 0.0, 0.05 * f64::from(step));
        if station.force_z() > 1.0 {
            break;
        }
    }
    assert!(station.force_z() > 0.8);
    assert_ne!(blank, station.picture());
    assert_eq!(station.rig.truth(), None);
    let ball = Mounted::ball(Nanometre(2_000_000)).expect("in the catalogue");
    assert_eq!(station.rig.mount(ball), Err(MountError::InContact));
    assert!(Mounted::ball(Nanometre(3_000_000)).is_err());
    assert!(Mounted::board(GratingKind::Dot, Nanometre(260_000)).is_err());
}

#[test]
fn a_guarded_motion_stops_at_its_force() {
    let mut station = Station::new(Model::MagicTac, "");
    station.go(0.0, 0.0, -1.0);
    let guard = Guard::at(Newton(0.3));
    let speed = Speed::try_new(1.0).expect("positive");
    let guarded = station.robot.guarded_motion().expect("can");
    let stop = guarded
        .move_guarded(pose(0.0, 0.0, 3.0), speed, guard, DEADLINE)
        .expect("stops");
    assert!(matches!(stop, GuardedStop::Guarded { .. }));
    let force = station.rig.truth().expect("a ball").force_n[2];
    assert!((0.3..0.4).contains(&force), "{force}");
}

#[test]
fn one_bench_holds_one_sensor_at_a_time() {
    let mut rig = Rig::new();
    let sensors = SensorFactory::new(Model::GelSight).expect("a driver");
    let args = sensors.descriptor().args("").expect("none");
    let first = sensors.open(&args, &mut rig).expect("opens");
    let second = sensors.open(&args, &mut rig).map(drop).expect_err("taken");
    assert_eq!(second.kind(), ErrorKind::Busy);
    drop(first);
    assert!(sensors.open(&args, &mut rig).is_ok());
}

#[test]
fn a_table_of_one_s_own_takes_the_place_of_the_compiled_in_one() {
    let sensors = SensorFactory::new(Model::GelSight).expect("a driver");
    let specs = sensors.descriptor().arguments();
    let mine = Model::GelSight.table().replace(
        "force_max_n = { value = 1.83",
        "force_max_n = { value = 9.0",
    );
    let args = Args::from_pairs(specs, [("table", mine.as_str())]).expect("a table");
    let facts = sensors.describe(&args).expect("a sensor");
    assert_eq!(
        facts.sensor().expect("a sensor").force_max,
        Some(Newton(9.0))
    );
    let broken = Args::from_pairs(specs, [("table", "name = 3")]).expect("a text");
    let error = sensors
        .open(&broken, &mut Rig::new())
        .map(drop)
        .expect_err("no table");
    assert!(
        error
            .to_string()
            .contains("invalid `table`: line 1: `name`: found 3"),
        "{error}"
    );
}

#[test]
fn a_force_beyond_the_transducer_is_no_force() {
    let table = Model::GelSight
        .table()
        .replace("range_n = { value = 50.0", "range_n = { value = 0.5");
    let sensors = SensorFactory::new(Model::GelSight).expect("a driver");
    let args =
        Args::from_pairs(sensors.descriptor().arguments(), [("table", table)]).expect("a table");
    let mut rig = Rig::new();
    let _sensor = sensors.open(&args, &mut rig).expect("opens");
    let mut robot = open(&RobotFactory::new().expect("a driver"), "", &mut rig);
    let mut force = open(
        &ForceTransducerFactory::new().expect("a driver"),
        "",
        &mut rig,
    );
    let speed = Speed::try_new(10.0).expect("positive");
    robot
        .move_to(pose(0.0, 0.0, 1.5), speed, DEADLINE)
        .expect("arrives");
    let error = force.read(DEADLINE).expect_err("clipped");
    assert_eq!(error.kind(), ErrorKind::OutOfRange);
}

#[test]
fn what_the_devices_say_lies_on_the_grid_of_the_plugin_boundary() {
    let mut station = Station::new(Model::GelSight, "seed=5");
    let speed = Speed::try_new(1.0 / 3.0).expect("positive");
    let crooked = pose(1.0 / 3.0, -2.0 / 7.0, -1.0 / 9.0);
    let stamp = station
        .robot
        .move_to(crooked, speed, DEADLINE)
        .expect("arrives");
    let (stands, at) = station.robot.pose(DEADLINE).expect("stands");
    assert_eq!(stands, crooked.on_grid());
    assert_eq!(Some(stands), SiPose::from(stands).to_pose());
    let guard = Guard::at(Newton(0.3));
    let guarded = station.robot.guarded_motion().expect("can");
    let stop = guarded.move_guarded(pose(0.1, 0.1, 3.0), speed, guard, DEADLINE);
    let Ok(GuardedStop::Guarded { pose: stopped, .. }) = stop else {
        panic!("no gel");
    };
    assert_eq!(stopped, stopped.on_grid());
    for stamp in [stamp, at] {
        assert_eq!(stamp, Stamp::new(stamp.valid(), stamp.received()));
    }
}

#[test]
fn the_bench_is_offered_in_the_rig_of_its_devices_under_their_key_and_its_name() {
    let mut rig = Rig::new();
    let sensors = SensorFactory::new(Model::GelSight).expect("a driver");
    let _sensor = open(&sensors, "rig=left;seed=3", &mut rig);
    assert!(rig.bench("sim bench").is_none());
    let bench = rig.bench("sim left").expect("offered");
    bench.rest(Duration::from_secs(7)).expect("rests");
    assert_eq!(SimulatedRig::of(&mut rig, "left").now(), bench.now());
    assert_eq!(bench.now(), Duration::from_secs(7));
    let provenance = bench.provenance().expect("a sensor");
    assert!(provenance.starts_with("bench 2, parameters ") && provenance.ends_with(", seed 3"));
    let radius = Nanometre(3_000_000);
    let error = bench.mount(Specimen::Sphere { radius }).expect_err("none");
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
}
