//! The simulated bench gives bit-identical results with and without a child.

use std::fmt::Write;

use taceva_core::{
    Args, DriverKey, FrameMut, Guard, Millimetre, Newton, Point, Pose, Registry, Rotation, Sensor,
    Speed,
};
use taceva_host::{Patience, Session};

use crate::runner::Test;
use crate::{LONG, child, odd, served};

pub(crate) const TESTS: &[Test] = &[
    (
        "every_simulated_device_says_the_same_through_a_child",
        every_simulated_device_says_the_same_through_a_child,
    ),
    (
        "an_error_reads_the_same_through_a_child",
        an_error_reads_the_same_through_a_child,
    ),
    (
        "a_thousand_devices_are_opened_and_closed_without_a_trace",
        a_thousand_devices_are_opened_and_closed_without_a_trace,
    ),
    (
        "devices_of_one_child_answer_beside_each_other",
        devices_of_one_child_answer_beside_each_other,
    ),
    (
        "a_description_with_arguments_is_that_of_the_driver",
        a_description_with_arguments_is_that_of_the_driver,
    ),
];

const SENSORS: [&str; 4] = [
    "sim/vitactip",
    "sim/magictac",
    "sim/gelsight",
    "sim/gelsight-wm",
];

fn args(driver: &str, text: &str) -> Args {
    let served = served().expect("sound");
    let parse = |specs: &[taceva_core::ArgSpec]| Args::parse(specs, text).expect("sound");
    served
        .sensors
        .get(driver)
        .map(|factory| parse(factory.descriptor().arguments()))
        .or_else(|_| {
            served
                .robots
                .get(driver)
                .map(|factory| parse(factory.descriptor().arguments()))
        })
        .or_else(|_| {
            served
                .lightings
                .get(driver)
                .map(|factory| parse(factory.descriptor().arguments()))
        })
        .or_else(|_| {
            served
                .force_transducers
                .get(driver)
                .map(|factory| parse(factory.descriptor().arguments()))
        })
        .expect("a driver")
}

fn key(text: &str) -> DriverKey {
    text.parse().expect("a key")
}

fn place(x: f64, z: f64) -> Pose {
    Pose {
        position: Point {
            x: Millimetre(x),
            y: Millimetre(-0.3),
            z: Millimetre(z),
        },
        rotation: Rotation::default(),
    }
}

/// All results of a press on a sensor, with bit-exact numbers.
fn press(session: &dyn Session, sensor: &str) -> String {
    let mut told = String::new();
    let mut note = |what: &dyn std::fmt::Debug| writeln!(told, "{what:?}").expect("a string");
    let open = format!("rig={sensor}").replace('/', "-");
    let mut camera = session
        .sensor(&key(sensor), &args(sensor, &format!("{open};seed=7")))
        .expect("a sensor");
    let mut robot = session
        .robot(&key("sim/robot"), &args("sim/robot", &open))
        .expect("a robot");
    let mut force = session
        .force(
            &key("sim/force-transducer"),
            &args("sim/force-transducer", &open),
        )
        .expect("a transducer");
    note(&camera.frame_info());
    note(&force.axes());
    camera.start(LONG).expect("started");
    force.start(LONG).expect("started");
    let speed = Speed::try_new(5.0).expect("positive");
    if let Some(tare) = force.tare() {
        tare.zero(LONG).expect("in the air");
    }
    for (x, z) in [(0.1, -1.0), (0.1, 0.2), (0.1, 0.45), (0.1, -1.0)] {
        let arrived = robot.move_to(place(x, z), speed, LONG);
        note(&arrived.expect("arrived").valid_s.to_bits());
        let (pose, _) = robot.pose(LONG).expect("a pose");
        note(&pose.position.z.0.to_bits());
        let (wrench, stamp) = force.read(LONG).expect("a reading");
        note(&wrench.force.map(|force| force.0.to_bits()));
        note(&wrench.torque.map(|torque| torque.0.to_bits()));
        note(&stamp);
        let mut bytes = vec![0; camera.frame_info().byte_len().expect("small")];
        let into = FrameMut::new(camera.frame_info(), &mut bytes).expect("fits");
        note(&camera.capture(into, LONG).expect("a frame"));
        note(&bytes);
    }
    if let Some(motion) = robot.guarded_motion() {
        let guard = Guard::at(Newton(0.1));
        note(
            &motion
                .move_guarded(place(0.1, 0.4), speed, guard, LONG)
                .expect("ended"),
        );
    }
    if let Some(light) = camera.lighting() {
        let scenes = light.scenes().to_vec();
        note(&scenes);
        light.set(&scenes[scenes.len() - 1], LONG).expect("steady");
    }
    camera.stop().expect("stopped");
    told
}

fn every_simulated_device_says_the_same_through_a_child() {
    let without = served().expect("sound");
    let with = child(Patience::default());
    for sensor in SENSORS {
        let (without, with) = (press(&without, sensor), press(&with, sensor));
        assert!(without.len() > 10_000, "{sensor} said nothing");
        assert!(
            without == with,
            "{sensor} says something else through a child"
        );
    }
}

fn an_error_reads_the_same_through_a_child() {
    let refused = |session: &dyn Session| {
        let key = key("sim/robot");
        let mut robot = session
            .robot(&key, &args("sim/robot", "rig=a"))
            .expect("a robot");
        let speed = Speed::try_new(5.0).expect("positive");
        let far = robot.move_to(place(1e6, 0.0), speed, LONG);
        let nowhere = robot.move_to(place(f64::NAN, 0.0), speed, LONG);
        let unknown = session.robot(&DriverKey::fixed("sim/robbot"), &Args::default());
        [
            far.map(drop).expect_err("too far"),
            nowhere.map(drop).expect_err("no number"),
            unknown.map(drop).expect_err("unknown"),
        ]
        .map(|error| (error.kind(), error.to_string()))
    };
    assert_eq!(
        refused(&child(Patience::default())),
        refused(&served().expect("sound"))
    );
}

fn a_thousand_devices_are_opened_and_closed_without_a_trace() {
    let session = child(Patience::default());
    let files = |process: u32| {
        std::fs::read_dir(format!("/proc/{process}/fd")).map_or(0, |entries| entries.count())
    };
    let args = args("odd/sensor", "does=counts");
    let open = || drop(session.sensor(&odd::SENSOR, &args).expect("a sensor"));
    let count = || {
        open();
        // The urgent thread ends shortly after its device.
        std::thread::sleep(std::time::Duration::from_millis(50));
        (files(std::process::id()), files(session.child().process()))
    };
    let before = count();
    for _ in 0..1000 {
        open();
    }
    assert_eq!(before, count());
}

fn devices_of_one_child_answer_beside_each_other() {
    let session = child(Patience::default());
    let mut waiting = session
        .sensor(&odd::SENSOR, &args("odd/sensor", "does=waits"))
        .expect("a sensor");
    let mut counting = session
        .sensor(&odd::SENSOR, &args("odd/sensor", "does=counts"))
        .expect("a sensor");
    let capture = |sensor: &mut dyn Sensor, deadline| {
        let mut bytes = vec![0; odd::FRAME.byte_len().expect("small")];
        let into = FrameMut::new(odd::FRAME, &mut bytes).expect("fits");
        sensor.capture(into, deadline).map(|_| bytes)
    };
    let interrupt = waiting.interrupt_handle().expect("it can be interrupted");
    std::thread::scope(|scope| {
        let waiter = scope.spawn(|| capture(&mut *waiting, LONG));
        for count in 1..=100 {
            let bytes = capture(&mut *counting, LONG).expect("a frame");
            assert!(bytes.iter().all(|byte| *byte == count));
        }
        assert!(!waiter.is_finished(), "it waits for twenty seconds");
        interrupt.interrupt();
        let ended = waiter.join().expect("whole").expect_err("interrupted");
        assert_eq!(ended.kind(), taceva_core::ErrorKind::Interrupted);
    });
}

fn a_description_with_arguments_is_that_of_the_driver() {
    let registry = Registry::<dyn Sensor>::builtin().expect("sound");
    let factory = registry.get("sim/gelsight").expect("there");
    let args = factory.descriptor().args("reduction=4").expect("sound");
    let without = factory.describe(&args).expect("sound");
    let with = child(Patience::default()).describe(without.key(), &args);
    assert_eq!(with.expect("described"), without);
    assert_ne!(&without, factory.descriptor());
}
