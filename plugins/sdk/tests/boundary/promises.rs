//! What a driver promises, through the tables.

#![expect(unsafe_code, reason = "the tables of a plugin are called")]

use std::ptr::null;
use std::thread;
use std::time::{Duration, Instant};

use taceva_core::{Degree, Millimetre, SiPose};
use taceva_plugin::abi::ext::{
    BENCH, BenchCalls, GUARDED_MOTION, GuardedMotionCalls, GuardedStop, SENSOR_LIGHTING,
    SensorLightingCalls, Specimen, TARE, TareCalls,
};
use taceva_plugin::abi::{
    ABI_MAJOR, FORCE_FACTORY, ForceCalls, Frame, LIGHTING_FACTORY, MAGIC, Motion, PixelFormat,
    Plugin, Pose, ROBOT_FACTORY, Rig, RobotCalls, SENSOR_FACTORY, SensorCalls, Stamp, Status, Text,
    Wrench,
};

use crate::fake_host::{Open, ended, exported, factory, plugin, taken, with_args};

const SECOND: u64 = 1_000_000_000;
/// Within which a blocked call answers an interrupt or a halt.
const AT_ONCE: Duration = Duration::from_millis(50);

/// A frame of the host with room for `buffer`.
pub(crate) fn frame(buffer: &mut [u8]) -> Frame {
    Frame {
        size: u32::try_from(size_of::<Frame>()).expect("small"),
        format: PixelFormat(0),
        width: 0,
        height: 0,
        flags: 0,
        reserved: 0,
        sequence: 0,
        stamp: Stamp::default(),
        buffer: buffer.as_mut_ptr(),
        buffer_length: buffer.len() as u64,
        data: null(),
        length: 0,
        release: None,
        private_data: std::ptr::null_mut(),
    }
}

pub(crate) fn motion(z: f64) -> Motion {
    Motion {
        size: u32::try_from(size_of::<Motion>()).expect("small"),
        reserved: 0,
        target: Pose {
            x: 0.0,
            y: 0.0,
            z,
            qw: 1.0,
            qx: 0.0,
            qy: 0.0,
            qz: 0.0,
        },
        speed_m_per_s: 0.002,
    }
}

#[test]
fn magic_version_and_id_stand_in_the_symbol_before_any_call() {
    let exported = exported();
    assert_eq!((exported.magic, exported.abi_major), (MAGIC, ABI_MAJOR));
    assert_eq!(usize::try_from(exported.size), Ok(size_of::<Plugin>()));
    // SAFETY: both texts are constants of the library.
    let (id, version) = unsafe { (exported.id.to_str(), exported.version.to_str()) };
    assert_eq!(
        (id, version),
        (Ok("org.example.test"), Ok(env!("CARGO_PKG_VERSION")))
    );
}

#[test]
fn a_driver_describes_itself_as_its_manifest_would() {
    let force = factory(FORCE_FACTORY);
    assert_eq!(force.drivers, 1);
    let describe = force.describe.expect("a function");
    // SAFETY: the list takes the text; no arguments stand for whatever they are.
    let (ended, texts) = taken(|context, error| unsafe {
        describe(0, null(), Some(crate::fake_host::take), context, error)
    });
    assert_eq!(ended.0, Status::OK);
    assert_eq!(
        texts.concat(),
        r#"kind = "force"
key = "wrist"
title = "wrist"
source = "simulated"
axes = ["Fx", "Fy", "Fz", "Tx", "Ty", "Tz"]
tare = true

[[args]]
key = "way"
type = "choice"
choices = ["well", "panic", "nan", "refuse", "block", "panic-at-drop"]
default = "well"
"#
    );
    let discover = factory(SENSOR_FACTORY).discover.expect("a function");
    // SAFETY: the list takes the texts.
    let (_, found) = taken(|context, error| unsafe {
        discover(0, Some(crate::fake_host::take), context, error)
    });
    assert_eq!(found, ["way=well"]);
}

#[test]
fn a_frame_is_written_into_the_buffer_of_the_host() {
    let sensor = Open::new(SENSOR_FACTORY, "well");
    let calls = sensor.calls::<SensorCalls>();
    let mut bytes = [0; 40];
    let mut frame = frame(&mut bytes);
    // SAFETY: the frame and its buffer live for the call.
    let (status, message) = ended(|error| unsafe {
        calls.start.expect("a function")(sensor.handle(), SECOND, error);
        calls.capture.expect("a function")(sensor.handle(), &raw mut frame, SECOND, error)
    });
    assert_eq!((status, message.as_str()), (Status::OK, ""));
    assert_eq!(
        (frame.width, frame.height, frame.format),
        (4, 3, PixelFormat::RGB8)
    );
    assert_eq!(
        (frame.length, frame.stamp.valid_ns, frame.stamp.received_ns),
        (36, 1_500_000_000, 0)
    );
    assert_eq!(frame.sequence, 1, "frames are counted");
    assert!(frame.release.is_none() && std::ptr::eq(frame.data, frame.buffer));
    assert_eq!(
        (bytes[35], bytes[36]),
        (1, 0),
        "no byte beyond the frame is touched"
    );
}

#[test]
fn a_pose_goes_out_as_it_came_in_to_the_bit() {
    let robot = Open::new(ROBOT_FACTORY, "well");
    let calls = robot.calls::<RobotCalls>();
    let mut there = taceva_core::Pose::default();
    there.position.z = Millimetre(12.345_678);
    there.rotation.z = Degree(90.0);
    let SiPose {
        position_m: [x, y, z],
        quaternion: [qw, qx, qy, qz],
    } = there.into();
    let target = Pose {
        x,
        y,
        z,
        qw,
        qx,
        qy,
        qz,
    };
    let asked = Motion {
        target,
        ..motion(0.0)
    };
    let (mut token, mut stamp, mut pose) = (0, Stamp::default(), asked.target);
    // SAFETY: all places live for the calls.
    unsafe {
        assert_eq!(
            ended(|error| calls.move_to.expect("a function")(
                robot.handle(),
                &raw const asked,
                &raw mut token,
                error
            ))
            .0,
            Status::OK
        );
        assert_eq!(
            ended(|error| calls.wait.expect("a function")(
                robot.handle(),
                token,
                &raw mut stamp,
                SECOND,
                error
            ))
            .0,
            Status::OK
        );
        assert_eq!(stamp.valid_ns, 2 * SECOND, "the driver was told 2 mm/s");
        assert_eq!(
            ended(|error| calls.pose.expect("a function")(
                robot.handle(),
                &raw mut pose,
                &raw mut stamp,
                SECOND,
                error
            ))
            .0,
            Status::OK
        );
    }
    assert_eq!(pose, asked.target);
    assert_eq!(
        (stamp.valid_ns, stamp.received_ns),
        (2 * SECOND, 2 * SECOND)
    );
}

#[test]
fn a_motion_beyond_what_the_robot_says_of_itself_is_refused_before_it_begins() {
    let robot = Open::new(ROBOT_FACTORY, "well");
    let move_to = robot.calls::<RobotCalls>().move_to.expect("a function");
    let mut token = 0;
    let mut refused = |asked: Motion| {
        // SAFETY: both places live for the call.
        ended(|error| unsafe { move_to(robot.handle(), &raw const asked, &raw mut token, error) })
    };
    let (status, message) = refused(motion(0.9));
    assert_eq!(status, Status::OUT_OF_RANGE);
    assert_eq!(message, "0 mm, 0 mm, 900 mm lies outside the workspace");
    let fast = Motion {
        speed_m_per_s: 0.2,
        ..motion(0.0)
    };
    let (status, message) = refused(fast);
    assert_eq!(status, Status::OUT_OF_RANGE);
    assert_eq!(message, "200 mm/s, expected at most 100 mm/s");
}

#[test]
fn a_guarded_motion_says_where_it_ended_and_why() {
    let robot = Open::new(ROBOT_FACTORY, "well");
    let calls = robot
        .extension::<GuardedMotionCalls>(GUARDED_MOTION)
        .expect("it can");
    let asked = motion(0.01);
    let mut stop = GuardedStop {
        size: u32::try_from(size_of::<GuardedStop>()).expect("small"),
        is_guarded: 7,
        pose: asked.target,
        stamp: Stamp::default(),
    };
    for (guard_n, is_guarded, z) in [(2.0, 1, 0.005), (9.0, 0, 0.01)] {
        // SAFETY: both places live for the call.
        let (status, _) = ended(|error| unsafe {
            calls.move_guarded.expect("a function")(
                robot.handle(),
                &raw const asked,
                guard_n,
                &raw mut stop,
                SECOND,
                error,
            )
        });
        assert_eq!(
            (status, stop.is_guarded, stop.pose.z.to_bits()),
            (Status::OK, is_guarded, f64::to_bits(z))
        );
    }
    // SAFETY: as above.
    let (status, _) = ended(|error| unsafe {
        calls.move_guarded.expect("a function")(
            robot.handle(),
            &raw const asked,
            f64::NAN,
            &raw mut stop,
            SECOND,
            error,
        )
    });
    assert_eq!(status, Status::INVALID_ARGUMENT);
}

#[test]
fn a_wrench_arrives_in_newton_and_newton_metres_and_a_tare_calls_it_zero() {
    let force = Open::new(FORCE_FACTORY, "well");
    let calls = force.calls::<ForceCalls>();
    let (mut wrench, mut stamp) = (Wrench::default(), Stamp::default());
    let mut read = || {
        // SAFETY: both places live for the call.
        let (status, _) = ended(|error| unsafe {
            calls.read.expect("a function")(
                force.handle(),
                &raw mut wrench,
                &raw mut stamp,
                SECOND,
                error,
            )
        });
        assert_eq!((status, stamp.valid_ns), (Status::OK, 1_234_567_891));
        wrench
    };
    assert_eq!(
        read(),
        Wrench {
            force_n: [0.0, 0.0, 4.0],
            torque_nm: [0.0125, 0.0, 0.0]
        }
    );
    let tare = force.extension::<TareCalls>(TARE).expect("it can");
    // SAFETY: the device is open.
    let answer =
        ended(|error| unsafe { tare.zero.expect("a function")(force.handle(), SECOND, error) });
    assert_eq!(answer.0, Status::OK);
    assert!(read().force_n[2].abs() < f64::EPSILON);
    assert!(
        force
            .extension::<TareCalls>("taceva.unheard-of/9")
            .is_none()
    );
}

#[test]
fn the_light_of_a_sensor_is_an_ability_that_some_have() {
    let lit = Open::new(SENSOR_FACTORY, "well");
    let light = lit
        .extension::<SensorLightingCalls>(SENSOR_LIGHTING)
        .expect("it can");
    let set = |scene: &str| {
        // SAFETY: the text lives for the call.
        ended(|error| unsafe {
            light.set.expect("a function")(lit.handle(), Text::from(scene), SECOND, error)
        })
    };
    assert_eq!(set("room").0, Status::OK);
    assert_eq!(
        set("moon"),
        (Status::INVALID_ARGUMENT, "no scene moon".to_owned())
    );
    assert!(
        Open::new(SENSOR_FACTORY, "block")
            .extension::<SensorLightingCalls>(SENSOR_LIGHTING)
            .is_none()
    );
}

#[test]
fn an_interrupt_ends_a_blocked_capture_and_leaves_the_sensor_usable() {
    let sensor = Open::new(SENSOR_FACTORY, "block");
    let calls = sensor.calls::<SensorCalls>();
    let capture = |timeout_ns| {
        let mut bytes = [0; 36];
        let mut frame = frame(&mut bytes);
        // SAFETY: the frame and its buffer live for the call.
        ended(|error| unsafe {
            calls.capture.expect("a function")(sensor.handle(), &raw mut frame, timeout_ns, error)
        })
    };
    sensor.interrupt();
    assert_eq!(
        capture(1_000_000).0,
        Status::TIMEOUT,
        "an interrupt of nothing is none of the next call"
    );
    let interrupted = thread::scope(|scope| {
        let blocked = scope.spawn(|| (capture(60 * SECOND), Instant::now()));
        thread::sleep(Duration::from_millis(20));
        let asked = Instant::now();
        sensor.interrupt();
        let (ended, at) = blocked.join().expect("it answers");
        assert!(at - asked < AT_ONCE, "{:?}", at - asked);
        ended
    });
    assert_eq!(
        interrupted,
        (Status::INTERRUPTED, "it was interrupted".to_owned())
    );
    assert_eq!(capture(1_000_000).0, Status::TIMEOUT);
}

#[test]
fn a_halt_from_another_thread_stops_a_motion_and_latches() {
    let robot = Open::new(ROBOT_FACTORY, "block");
    let calls = robot.calls::<RobotCalls>();
    let go = |timeout_ns| {
        let (asked, mut token, mut stamp) = (motion(0.001), 0, Stamp::default());
        // SAFETY: all places live for the calls.
        ended(|error| unsafe {
            match calls.move_to.expect("a function")(
                robot.handle(),
                &raw const asked,
                &raw mut token,
                error,
            ) {
                Status::OK => calls.wait.expect("a function")(
                    robot.handle(),
                    token,
                    &raw mut stamp,
                    timeout_ns,
                    error,
                ),
                refused => refused,
            }
        })
        .0
    };
    thread::scope(|scope| {
        let blocked = scope.spawn(|| (go(60 * SECOND), Instant::now()));
        thread::sleep(Duration::from_millis(20));
        let asked = Instant::now();
        // SAFETY: from any thread while the device is open.
        let answer =
            ended(|error| unsafe { calls.halt.expect("a function")(robot.handle(), error) });
        assert_eq!(answer.0, Status::OK);
        let (status, at) = blocked.join().expect("it answers");
        assert_eq!(status, Status::INTERRUPTED);
        assert!(at - asked < AT_ONCE, "{:?}", at - asked);
    });
    assert_eq!(go(SECOND), Status::INTERRUPTED, "latched");
    // SAFETY: the device is open.
    let answer = ended(|error| unsafe {
        calls.clear_halt.expect("a function")(robot.handle(), SECOND, error)
    });
    assert_eq!(answer.0, Status::OK);
    assert_eq!(go(1_000_000), Status::TIMEOUT);
}

#[test]
fn the_error_of_a_driver_keeps_its_kind_and_its_reason() {
    let sensor = Open::new(SENSOR_FACTORY, "refuse");
    let mut bytes = [0; 36];
    let mut frame = frame(&mut bytes);
    // SAFETY: the frame and its buffer live for the call.
    let ended = ended(|error| unsafe {
        sensor.calls::<SensorCalls>().capture.expect("a function")(
            sensor.handle(),
            &raw mut frame,
            SECOND,
            error,
        )
    });
    assert_eq!(ended, (Status::DISCONNECTED, "the cable is out".to_owned()));
    let refused = Open::in_rig(LIGHTING_FACTORY, "well", std::ptr::null_mut()).err();
    assert_eq!(
        refused,
        Some((Status::PERMISSION_DENIED, "not for you".to_owned()))
    );
}

#[test]
fn a_bench_is_reached_through_the_rig_in_which_its_devices_were_opened() {
    let mut rig: *mut Rig = std::ptr::null_mut();
    let plugin = plugin();
    // SAFETY: the place lives for the call, and the rig until it is closed below.
    let bench = unsafe {
        assert_eq!(
            ended(|error| plugin.open_rig.expect("a function")(&raw mut rig, error)).0,
            Status::OK
        );
        plugin.rig_extension.expect("a function")(rig, Text::from(BENCH))
            .cast::<BenchCalls>()
            .as_ref()
    };
    let bench = bench.expect("it has benches");
    let now = |name: &str| {
        // SAFETY: the text lives for the call.
        unsafe { bench.now_ns.expect("a function")(rig, Text::from(name)) }
    };
    assert_eq!(now("bench"), 0, "before a device was opened");
    let _robot = Open::in_rig(ROBOT_FACTORY, "well", rig).expect("opens");
    assert_eq!((now("bench"), now("other")), (77, 0));
    for (kind, expected) in [
        (Specimen::SPHERE, (Status::OK, String::new())),
        (
            Specimen::DOT,
            (Status::INVALID_ARGUMENT, "dot grating of 2 mm".to_owned()),
        ),
        (
            9,
            (
                Status::INVALID_ARGUMENT,
                "a specimen of the unknown kind 9".to_owned(),
            ),
        ),
    ] {
        let specimen = Specimen {
            size: 16,
            kind,
            size_nm: 2_000_000,
        };
        // SAFETY: the specimen and the text live for the call.
        let mounted = ended(|error| unsafe {
            bench.mount.expect("a function")(rig, Text::from("bench"), &raw const specimen, error)
        });
        assert_eq!(mounted, expected);
    }
    // SAFETY: the list takes the text.
    let (_, words) = taken(|context, error| unsafe {
        bench.provenance.expect("a function")(
            rig,
            Text::from("bench"),
            Some(crate::fake_host::take),
            context,
            error,
        )
    });
    assert_eq!(words, ["a table"]);
    // SAFETY: after its last device, or even before: what a device needs, it keeps.
    unsafe { plugin.close_rig.expect("a function")(rig) };
    assert_eq!(now("bench"), 0);
}

#[test]
fn arguments_are_checked_once_more_on_this_side() {
    let open = factory(SENSOR_FACTORY).open.expect("a function");
    for (pairs, expected) in [
        (&[("wy", "well")][..], "did you mean `way`?"),
        (&[("way", "wel")], "did you mean `well`?"),
        (&[("way", "well"), ("way", "well")], "given twice"),
    ] {
        let mut device = taceva_plugin::abi::Device {
            handle: std::ptr::null_mut(),
            calls: null(),
        };
        let (status, message) = with_args(pairs, |args| {
            // SAFETY: everything lives for the call.
            ended(|error| unsafe { open(0, args, std::ptr::null_mut(), &raw mut device, error) })
        });
        assert_eq!(status, Status::INVALID_ARGUMENT);
        assert!(
            message.contains(expected) && device.handle.is_null(),
            "{message}"
        );
    }
}

#[test]
fn the_clock_of_the_host_is_that_of_the_driver() {
    plugin();
    assert_eq!(taceva_plugin::now(), Duration::from_nanos(42));
}
