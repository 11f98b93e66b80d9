//! Tests of mistakes of host and driver. Each mistake gives a typed error, and the program continues.

#![expect(unsafe_code, reason = "the tables of a plugin are called")]

use std::ffi::c_void;
use std::ptr::{null, null_mut, without_provenance_mut};
use std::thread;
use std::time::Duration;

use taceva_plugin::abi::{
    Args, Error, FORCE_FACTORY, ForceCalls, Frame, Host, Motion, Pose, ROBOT_FACTORY, RobotCalls,
    SENSOR_FACTORY, SensorCalls, Stamp, Status, Text, Wrench,
};

use crate::fake_host::{Ended, Open, ended, factory, init, plugin};
use crate::places::{frame, motion};

fn capture(sensor: &Open, frame: *mut Frame) -> Ended {
    let capture = sensor.calls::<SensorCalls>().capture.expect("a function");
    // SAFETY: the frame is NULL or lives for the call. Its fields may be false, which is the test.
    ended(|error| unsafe { capture(sensor.handle(), frame, 1_000_000, error) })
}

fn captured(sensor: &Open) -> Ended {
    let mut bytes = [0; 36];
    let mut frame = frame(&mut bytes);
    capture(sensor, &raw mut frame)
}

fn read(force: &Open) -> (Status, Wrench) {
    let (mut wrench, mut stamp) = (Wrench::default(), Stamp::default());
    let read = force.calls::<ForceCalls>().read.expect("a function");
    // SAFETY: both places live for the call.
    let (status, _) = ended(|error| unsafe {
        read(
            force.handle(),
            &raw mut wrench,
            &raw mut stamp,
            500_000_000,
            error,
        )
    });
    (status, wrench)
}

#[test]
fn a_panic_kills_its_handle_and_no_other() {
    let (dead, other) = (
        Open::new(SENSOR_FACTORY, "panic"),
        Open::new(SENSOR_FACTORY, "well"),
    );
    assert_eq!(
        captured(&dead),
        (Status::PANICKED, "the plugin panicked: frame 0".to_owned())
    );
    let (status, message) = captured(&dead);
    assert_eq!(status, Status::PANICKED);
    assert!(message.contains("an earlier call panicked"), "{message}");
    assert!(dead.extension::<u32>("taceva.sensor.lighting/1").is_none());
    dead.interrupt();
    dead.close();
    assert_eq!(captured(&other).0, Status::OK);
}

#[test]
fn a_panic_of_a_motion_leaves_its_halt_in_force() {
    let robot = Open::new(ROBOT_FACTORY, "panic");
    let moved = robot.move_to(&motion(0.001));
    let panicked = moved.and_then(|token| robot.wait(token, 1));
    assert_eq!(panicked.expect_err("it panics").0, Status::PANICKED);
    let calls = robot.calls::<RobotCalls>();
    // SAFETY: the device is open.
    unsafe {
        assert_eq!(
            ended(|error| calls.halt.expect("a function")(robot.handle(), error)).0,
            Status::OK
        );
    }
}

#[test]
fn a_device_that_panics_while_it_is_dropped_is_closed_all_the_same() {
    let sensor = Open::new(SENSOR_FACTORY, "panic-at-drop");
    sensor.close();
    assert_eq!(captured(&sensor).0, Status::INVALID_ARGUMENT);
}

#[test]
fn handles_that_are_closed_of_another_kind_or_made_up_are_refused_unfollowed() {
    let (sensor, force) = (
        Open::new(SENSOR_FACTORY, "well"),
        Open::new(FORCE_FACTORY, "well"),
    );
    let calls = sensor.calls::<SensorCalls>();
    sensor.close();
    sensor.close();
    sensor.interrupt();
    let handles = [
        sensor.handle(),
        force.handle(),
        null_mut(),
        without_provenance_mut(usize::MAX),
    ];
    for handle in handles {
        // SAFETY: a handle is a number and is never dereferenced.
        let (status, message) =
            ended(|error| unsafe { calls.start.expect("a function")(handle, 1, error) });
        assert_eq!(status, Status::INVALID_ARGUMENT);
        assert!(message.contains("the handle is closed"), "{message}");
    }
    assert_eq!(read(&force).0, Status::OK);
}

#[test]
fn null_and_short_places_are_refused() {
    let sensor = Open::new(SENSOR_FACTORY, "well");
    assert_eq!(
        capture(&sensor, null_mut()),
        (Status::INVALID_ARGUMENT, "`frame` is NULL".to_owned())
    );
    let mut bytes = [0; 36];
    let mut short = frame(&mut bytes);
    short.size = 16;
    assert_eq!(capture(&sensor, &raw mut short).0, Status::ABI);
    let mut tight = frame(&mut bytes[..35]);
    let (status, message) = capture(&sensor, &raw mut tight);
    assert_eq!(status, Status::INVALID_ARGUMENT);
    assert_eq!(
        message,
        "a buffer of 35 bytes, expected 36 for a frame of 4×3 rgb8"
    );
    let mut without = frame(&mut bytes);
    without.buffer = null_mut();
    assert_eq!(capture(&sensor, &raw mut without).1, "`buffer` is NULL");
    let robot = Open::new(ROBOT_FACTORY, "well");
    let pose = robot.calls::<RobotCalls>().pose.expect("a function");
    // SAFETY: NULL is rejected.
    let answer =
        ended(|error| unsafe { pose(robot.handle(), null_mut::<Pose>(), null_mut(), 1, error) });
    assert_eq!(answer.1, "`pose` is NULL");
}

#[test]
fn a_host_without_a_place_for_messages_still_hears_the_status() {
    let sensor = Open::new(SENSOR_FACTORY, "panic");
    let calls = sensor.calls::<SensorCalls>();
    let mut bytes = [0; 36];
    let mut frame = frame(&mut bytes);
    let mut none = Error::new();
    none.size = 0;
    for error in [null_mut(), &raw mut none, without_provenance_mut(9)] {
        // SAFETY: an error that is NULL, too short or misaligned is not written.
        let status = unsafe {
            calls.capture.expect("a function")(sensor.handle(), &raw mut frame, 1, error)
        };
        assert_eq!(status, Status::PANICKED);
    }
}

#[test]
fn numbers_that_are_not_finite_go_neither_way() {
    let sensor = Open::new(SENSOR_FACTORY, "nan");
    let (status, message) = captured(&sensor);
    assert_eq!(status, Status::DEVICE_FAULT);
    assert!(message.contains("expected finite times"), "{message}");
    let (status, wrench) = read(&Open::new(FORCE_FACTORY, "nan"));
    assert_eq!((status, wrench), (Status::DEVICE_FAULT, Wrench::default()));
    let robot = Open::new(ROBOT_FACTORY, "nan");
    let calls = robot.calls::<RobotCalls>();
    let (mut pose, mut stamp) = (motion(0.0).target, Stamp::default());
    // SAFETY: all places live for the calls.
    unsafe {
        assert_eq!(
            ended(|error| calls.pose.expect("a function")(
                robot.handle(),
                &raw mut pose,
                &raw mut stamp,
                1,
                error
            ))
            .0,
            Status::DEVICE_FAULT
        );
    }
    let refused = robot.move_to(&motion(f64::NAN)).expect_err("refused");
    assert_eq!(refused.0, Status::INVALID_ARGUMENT);
}

#[test]
fn a_motion_is_waited_for_once_and_by_its_own_token() {
    let robot = Open::new(ROBOT_FACTORY, "well");
    let wait = |token| robot.wait(token, 1).map_err(|(status, _)| status);
    let invalid = Err(Status::INVALID_ARGUMENT);
    assert_eq!(wait(0), invalid);
    let asked = motion(0.001);
    let token = robot.move_to(&asked).expect("it begins");
    assert_eq!(wait(token + 1), invalid);
    assert!(wait(token).is_ok());
    assert_eq!(wait(token), invalid);
    let short = Motion { size: 4, ..asked };
    let (status, _) = robot.move_to(&short).expect_err("refused");
    assert_eq!(status, Status::ABI);
}

#[test]
fn the_second_of_two_calls_at_once_is_busy() {
    let force = Open::new(FORCE_FACTORY, "block");
    thread::scope(|scope| {
        let first = scope.spawn(|| read(&force).0);
        thread::sleep(Duration::from_millis(50));
        assert_eq!(read(&force).0, Status::BUSY);
        assert_eq!(first.join().expect("it ends"), Status::TIMEOUT);
    });
}

#[test]
fn a_device_that_is_closed_under_a_call_lives_until_that_call_ends() {
    let force = Open::new(FORCE_FACTORY, "block");
    thread::scope(|scope| {
        let first = scope.spawn(|| read(&force).0);
        thread::sleep(Duration::from_millis(50));
        force.close();
        assert_eq!(first.join().expect("it ends"), Status::TIMEOUT);
    });
    assert_eq!(read(&force).0, Status::INVALID_ARGUMENT);
}

#[test]
fn what_a_host_asks_for_wrongly_is_refused() {
    let sensors = factory(SENSOR_FACTORY);
    let take = Some(crate::fake_host::take as unsafe extern "C" fn(*mut c_void, Text));
    let describe = sensors.describe.expect("a function");
    // SAFETY: a number out of range is rejected before `take` is called, and so is a NULL function.
    unsafe {
        assert_eq!(
            ended(|error| describe(1, null(), take, null_mut(), error)).1,
            "no driver has the number 1, expected less than 1"
        );
        assert_eq!(
            ended(|error| describe(0, null(), None, null_mut(), error)).1,
            "`take` is NULL"
        );
        let lies = Args {
            items: null(),
            count: 3,
        };
        assert_eq!(
            ended(|error| describe(0, &raw const lies, take, null_mut(), error)).1,
            "`args` is NULL"
        );
        let endless = Args {
            items: null(),
            count: usize::MAX,
        };
        assert_eq!(
            ended(|error| describe(0, &raw const endless, take, null_mut(), error)).0,
            Status::INVALID_ARGUMENT
        );
        let open = sensors.open.expect("a function");
        assert_eq!(
            ended(|error| open(0, null(), null_mut(), null_mut(), error)).1,
            "`device` is NULL"
        );
        let factory = plugin().factory.expect("a function");
        assert!(
            factory(Text {
                data: null(),
                length: 5
            })
            .is_null()
        );
        let latin = [0xe9_u8];
        assert!(
            factory(Text {
                data: latin.as_ptr().cast(),
                length: 1
            })
            .is_null()
        );
        assert!(factory(Text::from("taceva.sensor/2")).is_null());
    }
    let made_up = without_provenance_mut(0x5000);
    let refused = Open::in_rig(SENSOR_FACTORY, "well", made_up)
        .err()
        .expect("no rig");
    assert_eq!(refused.0, Status::INVALID_ARGUMENT);
}

#[test]
fn a_host_that_is_no_host_is_refused() {
    assert_eq!(
        init(null()),
        (Status::INVALID_ARGUMENT, "`host` is NULL".to_owned())
    );
    let old = Host {
        size: 8,
        abi_minor: 0,
        context: null_mut(),
        log: None,
        now_ns: None,
    };
    assert_eq!(init(&raw const old).0, Status::ABI);
}

#[test]
fn ten_thousand_devices_come_and_go() {
    for _ in 0..10_000 {
        let force = Open::new(FORCE_FACTORY, "well");
        assert_eq!(read(&force).0, Status::OK);
    }
}
