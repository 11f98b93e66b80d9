//! A rig on wall-clock time: the gel is in the same state whether the robot moves in one call or in slices of a millisecond.

use std::time::Duration;

use taceva_core::{Deadline, Factory, FrameMut, Millimetre, Pose, Rig, Speed};
use taceva_sim::optics::{Camera, OpticsSpec};
use taceva_sim::{Bench, Model, Parameters, RobotFactory, SimulatedRig};

/// Parameters of a rig without errors, so two paths to the same place differ only by rounding.
fn parameters() -> Parameters {
    let table = Model::GelSight.table().replace(
        "positioning_mm = { value = 0.01",
        "positioning_mm = { value = 0.0",
    );
    Parameters::parse(&table).expect("a table of ours")
}

fn at_mm([x, y, z]: [f64; 3]) -> Pose {
    let mut pose = Pose::default();
    let position = &mut pose.position;
    (position.x, position.y, position.z) = (Millimetre(x), Millimetre(y), Millimetre(z));
    pose
}

/// Path over a place beside the centre, then into the gel, then sideways.
const WAY_MM: [[f64; 3]; 3] = [[1.5, -2.0, -3.0], [1.5, -2.0, 0.45], [1.9, -2.0, 0.45]];

fn speed(mm_per_s: f64) -> Speed {
    Speed::try_new(mm_per_s).expect("above 0")
}

#[test]
fn slices_of_a_millisecond_press_as_one_motion_does() {
    let laid = |name: &str| {
        let mut rig = Rig::new();
        let bench = SimulatedRig::of(&mut rig, name);
        bench.lay(Bench::new(parameters(), 0, 7));
        (rig, bench)
    };
    let (mut rig, whole) = laid("whole");
    let factory = RobotFactory::new().expect("a factory");
    let args = factory.descriptor().args("rig=whole").expect("a name");
    let mut robot = factory.open(&args, &mut rig).expect("a robot");
    let (_, sliced) = laid("sliced");
    for target in WAY_MM {
        let patience = Deadline::after(Duration::from_secs(60));
        robot
            .move_to(at_mm(target), speed(5.0), patience)
            .expect("it arrives");
        sliced.set_out(at_mm(target), speed(5.0));
        while sliced.is_moving() {
            sliced.advance(sliced.now() + Duration::from_millis(1));
        }
        assert_eq!(sliced.pose_now(), at_mm(target));
    }
    let [whole, sliced] = [whole, sliced].map(|rig| (rig.tip_mm(), rig.truth().expect("a ball")));
    assert_eq!(whole.0.map(f64::to_bits), sliced.0.map(f64::to_bits));
    for axis in 0..3 {
        let [one, other] = [whole.1.force_n[axis], sliced.1.force_n[axis]];
        // Rounding a slice up gives the gel slightly more time to relax.
        assert!((one - other).abs() < 1e-3, "{one} N, {other} N");
    }
    assert!(whole.1.force_n[2] > 0.3, "{:?}", whole.1.force_n);
}

#[test]
fn a_tip_that_stops_on_its_way_stands_where_it_is_and_believes_so() {
    let bench = SimulatedRig::of(&mut Rig::new(), "stop");
    bench.lay(Bench::new(parameters(), 0, 1));
    bench.set_out(at_mm([0.0, 0.0, -10.0]), speed(5.0));
    bench.advance(Duration::from_millis(700));
    bench.stand();
    let stopped = bench.pose_now();
    assert!((stopped.position.z.0 + 16.5).abs() < 1e-6, "{stopped:?}");
    bench.advance(Duration::from_secs(5));
    assert_eq!(bench.pose_now(), stopped);
    assert!((bench.tip_mm()[2] + 16.5).abs() < 1e-6);
    // A time in the past has no effect.
    bench.advance(Duration::from_secs(1));
    assert_eq!(bench.now(), Duration::from_secs(5));
}

#[test]
fn a_picture_of_this_moment_shows_the_ball_in_the_gel() {
    let parameters = parameters();
    let bench = SimulatedRig::of(&mut Rig::new(), "picture");
    let spec = OpticsSpec::new(&parameters);
    let mut camera = Camera::new(&spec, [164, 123], 0, 7).expect("a camera");
    bench.lay(Bench::new(parameters, 0, 7));
    let info = camera.frame_info();
    let mut draw = || {
        let mut pixels = vec![0; info.byte_len().expect("a small frame")];
        let into = FrameMut::new(info, &mut pixels).expect("the buffer fits");
        bench.render_now(&mut camera, into).expect("a picture");
        pixels
    };
    let untouched = draw();
    bench.set_out(at_mm([0.0, 0.0, 0.6]), speed(50.0));
    bench.advance(Duration::from_secs(2));
    let pressed = draw();
    let changed = untouched.iter().zip(&pressed);
    assert!(changed.filter(|(one, other)| one != other).count() > pressed.len() / 10);
}
