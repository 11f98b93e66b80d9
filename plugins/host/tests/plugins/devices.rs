//! Devices of a plugin in this process behave like any other device.

use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use taceva_conformance::{self as conformance, Report, Trial};
use taceva_core::{
    Args, Deadline, Descriptor, DriverError, DriverKind, ErrorKind, Fault, FrameMut, Guard,
    GuardedStop, Millimetre, Newton, NewtonMillimetre, Pose, Sensor, Speed,
};
use taceva_host::{PluginSensor, Session};

use crate::fixture::{ARM, EYE, Fixture, LAMP, WRIST};

pub(crate) const SECOND: Deadline = Deadline::after(Duration::from_secs(1));

fn args(fixture: &Fixture, text: &str) -> Args {
    let plugin = fixture.plugin();
    let descriptor = plugin.manifest.drivers().next().expect("the eye");
    descriptor.args(text).expect("its own arguments")
}

pub(crate) fn eye(fixture: &Fixture) -> PluginSensor {
    let session = fixture.session();
    let eye = session.open_sensor(&EYE, &args(fixture, "level=5"));
    eye.unwrap_or_else(|error| panic!("{error}"))
}

pub(crate) fn capture(sensor: &mut dyn Sensor) -> Result<Vec<u8>, DriverError> {
    let info = sensor.frame_info();
    let mut pixels = vec![0; info.byte_len().expect("small")];
    sensor.capture(FrameMut::new(info, &mut pixels).expect("fits"), SECOND)?;
    Ok(pixels)
}

#[test]
fn every_device_keeps_the_contract_of_its_kind() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let (host, lines) = fixture.trusted();
    let trial = Trial::default();
    let passed = |report: Report| assert!(report.passed(), "{report}");
    for driver in host.drivers::<dyn Sensor>() {
        passed(conformance::sensor(&*driver, &trial));
    }
    for driver in host.drivers::<dyn taceva_core::Robot>() {
        passed(conformance::robot(&*driver, &trial));
    }
    for driver in host.drivers::<dyn taceva_core::ForceTransducer>() {
        passed(conformance::force(&*driver, &trial));
    }
    for driver in host.drivers::<dyn taceva_core::Lighting>() {
        passed(conformance::lighting(&*driver, &trial));
    }
    let lines = lines.lock().expect("nobody panics");
    let expected = "org.example.fixture Info fixture: begins";
    assert_eq!(
        *lines,
        [expected],
        "loaded once, however often it is opened"
    );
}

#[test]
fn a_blocked_capture_ends_within_50_ms_of_an_interrupt_and_the_sensor_stays_usable() {
    let Some(fixture) = Fixture::built(&["BLOCK"]) else {
        return;
    };
    let mut eye = eye(&fixture);
    eye.start(SECOND).expect("starts");
    let interrupt = eye.interrupt_handle().expect("it can");
    let begun = Instant::now();
    let interrupter = thread::spawn(move || {
        thread::sleep(Duration::from_millis(30));
        interrupt.interrupt();
        (Instant::now(), interrupt)
    });
    let error = capture(&mut eye).expect_err("interrupted");
    let ended = Instant::now();
    let (interrupted, interrupt) = interrupter.join().expect("no panic");
    assert_eq!(error.kind(), ErrorKind::Interrupted, "{error}");
    assert!(ended - interrupted < Duration::from_millis(50));
    assert!(ended - begun < Duration::from_secs(1));
    let error = eye.capture_within(Duration::from_millis(5));
    assert_eq!(error, ErrorKind::Timeout);
    drop(eye);
    // The handle may outlive the device.
    interrupt.interrupt();
}

trait Within {
    fn capture_within(&mut self, time: Duration) -> ErrorKind;
}

impl Within for PluginSensor {
    fn capture_within(&mut self, time: Duration) -> ErrorKind {
        let info = self.frame_info();
        let mut pixels = vec![0; info.byte_len().expect("small")];
        let into = FrameMut::new(info, &mut pixels).expect("fits");
        let captured = self.capture(into, Deadline::after(time));
        captured.expect_err("no frame comes").kind()
    }
}

#[test]
fn a_halt_ends_a_motion_within_50_ms_and_latches_until_it_is_cleared() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let session = fixture.session();
    let mut arm = session.robot(&ARM, &Args::default()).expect("opens");
    let halt = arm.halt_handle();
    let far = at(0.0, 0.0, 5.0);
    let slow = Speed::try_new(1.0).expect("above 0");
    let halter = thread::spawn({
        let halt = Arc::clone(&halt);
        move || {
            thread::sleep(Duration::from_millis(30));
            let now = Instant::now();
            halt.halt().expect("sent");
            now
        }
    });
    let error = arm.move_to(far, slow, SECOND).expect_err("halted");
    let ended = Instant::now();
    assert_eq!(error.kind(), ErrorKind::Interrupted);
    assert!(ended - halter.join().expect("no panic") < Duration::from_millis(50));
    let fast = Speed::try_new(100.0).expect("above 0");
    let error = arm.move_to(far, fast, SECOND).expect_err("latched");
    assert_eq!(error.kind(), ErrorKind::Interrupted);
    arm.clear_halt(SECOND).expect("cleared");
    arm.move_to(far, fast, SECOND).expect("moves again");
    assert_eq!(arm.pose(SECOND).expect("answers").0, far);
    drop(arm);
    halt.halt().expect("nothing is left to stop");
}

fn at(x: f64, y: f64, z: f64) -> Pose {
    let mut pose = Pose::default();
    pose.position.x = Millimetre(x);
    pose.position.y = Millimetre(y);
    pose.position.z = Millimetre(z);
    pose
}

#[test]
fn a_guarded_motion_stops_at_the_force_and_a_guard_of_nothing_is_refused() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let session = fixture.session();
    let mut arm = session.robot(&ARM, &Args::default()).expect("opens");
    let fast = Speed::try_new(100.0).expect("above 0");
    let guarded = arm.guarded_motion().expect("it can");
    let guard = |force| Guard::at(Newton(force));
    let stop = guarded.move_guarded(at(0.0, 0.0, 2.0), fast, guard(1.25), SECOND);
    match stop.expect("moves") {
        GuardedStop::Guarded { pose, .. } => assert_eq!(pose, at(0.0, 0.0, 1.25)),
        arrived @ GuardedStop::Arrived { .. } => panic!("{arrived:?}"),
    }
    let stop = guarded.move_guarded(at(0.0, 0.0, 1.0), fast, guard(5.0), SECOND);
    assert!(matches!(stop.expect("moves"), GuardedStop::Arrived { .. }));
    for nothing in [0.0, -1.0, f64::NAN] {
        let stop = guarded.move_guarded(at(0.0, 0.0, 1.0), fast, guard(nothing), SECOND);
        let error = stop.expect_err("no guard");
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    }
}

#[test]
fn a_force_is_what_is_measured_and_nothing_else() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let session = fixture.session();
    let mut wrist = session.force(&WRIST, &Args::default()).expect("opens");
    wrist.start(SECOND).expect("starts");
    let (wrench, stamp) = wrist.read(SECOND).expect("reads");
    assert_eq!(
        (wrench.force[2], wrench.torque[0].0.to_bits()),
        (Newton(1.5), 0)
    );
    assert_eq!(stamp.received_s, None);
    wrist.tare().expect("it can").zero(SECOND).expect("tares");
    assert_eq!(wrist.read(SECOND).expect("reads").0.force[2], Newton(0.0));
}

#[test]
fn a_torque_in_c_is_the_same_number_here() {
    let Some(fixture) = Fixture::built(&[r#"AXES="[\"Fz\", \"Tx\"]""#]) else {
        return;
    };
    let fixture = fixture.with_manifest("axes = [\"Fz\"]", "axes = [\"Fz\", \"Tx\"]");
    let session = fixture.session();
    let mut wrist = session.force(&WRIST, &Args::default()).expect("opens");
    wrist.start(SECOND).expect("starts");
    let (wrench, _) = wrist.read(SECOND).expect("reads");
    assert_eq!(wrench.torque[0], NewtonMillimetre(42.0));
}

#[test]
fn a_library_for_an_earlier_minor_version_loads_and_its_torques_are_newton_metres() {
    let earlier = [
        "MINOR=2",
        "FORCE_ID=\"taceva.force/1\"",
        "FORCE_SIZE=offsetof(taceva_force_calls, lost)",
        r#"AXES="[\"Fz\", \"Tx\"]""#,
    ];
    let Some(fixture) = Fixture::built(&earlier) else {
        return;
    };
    let fixture = fixture.with_manifest("axes = [\"Fz\"]", "axes = [\"Fz\", \"Tx\"]");
    let session = fixture.session();
    let mut wrist = session.force(&WRIST, &Args::default()).expect("opens");
    wrist.start(SECOND).expect("starts");
    let (wrench, _) = wrist.read(SECOND).expect("reads");
    assert_eq!(wrench.torque[0], NewtonMillimetre(42_000.0));
}

#[test]
fn readings_have_the_numbers_that_the_device_gave_them_and_none_where_it_gives_none() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let session = fixture.session();
    let mut wrist = session.force(&WRIST, &Args::default()).expect("opens");
    wrist.start(SECOND).expect("starts");
    wrist.read(SECOND).expect("reads");
    assert_eq!(wrist.sequence(), None);

    let Some(fixture) = Fixture::built(&["NUMBERED"]) else {
        return;
    };
    let fixture = fixture.with_manifest("tare = true", "tare = true\nnumbered = true");
    let session = fixture.session();
    let mut wrist = session.force(&WRIST, &Args::default()).expect("opens");
    assert_eq!(wrist.sequence(), None);
    wrist.start(SECOND).expect("starts");
    for number in 1..4 {
        wrist.read(SECOND).expect("reads");
        assert_eq!(wrist.sequence(), Some(number));
    }
    let (host, _) = fixture.trusted();
    for driver in host.drivers::<dyn taceva_core::ForceTransducer>() {
        let report = conformance::force(&*driver, &Trial::default());
        assert!(report.passed(), "{report}");
    }
}

#[test]
fn lost_readings_are_those_that_the_device_counts_and_a_table_of_an_earlier_interface_counts_none()
{
    let Some(fixture) = Fixture::built(&["LOST"]) else {
        return;
    };
    let session = fixture.session();
    let mut wrist = session.force(&WRIST, &Args::default()).expect("opens");
    assert_eq!(wrist.lost(), None);
    wrist.start(SECOND).expect("starts");
    for readings in 1..4 {
        wrist.read(SECOND).expect("reads");
        assert_eq!(wrist.lost(), Some(2 * readings));
    }

    // The table of minor 3 ended before this function. Its bytes are there, and nobody reads them.
    let size = "FORCE_SIZE=offsetof(taceva_force_calls, lost)";
    let Some(fixture) = Fixture::built(&["LOST", "MINOR=3", size]) else {
        return;
    };
    let session = fixture.session();
    let mut wrist = session.force(&WRIST, &Args::default()).expect("opens");
    wrist.start(SECOND).expect("starts");
    let (wrench, _) = wrist.read(SECOND).expect("reads");
    assert_eq!(wrench.force[2], Newton(1.5));
    assert_eq!(wrist.lost(), None);
}

#[test]
fn a_frozen_number_is_found_by_the_conformance_suite() {
    let Some(fixture) = Fixture::built(&["NUMBERED", "FROZEN"]) else {
        return;
    };
    let fixture = fixture.with_manifest("tare = true", "tare = true\nnumbered = true");
    let (host, _) = fixture.trusted();
    for driver in host.drivers::<dyn taceva_core::ForceTransducer>() {
        let report = conformance::force(&*driver, &Trial::default());
        assert!(!report.passed(), "{report}");
        let said = report.to_string();
        assert!(said.contains("two readings have the number 7"), "{said}");
    }
}

#[test]
fn the_fault_of_a_robot_crosses_with_its_kind_and_its_words() {
    for (name, fault) in [
        ("EMERGENCY_STOP", Fault::EmergencyStop),
        ("COLLISION", Fault::Collision),
        ("BOUNDARY", Fault::Boundary),
        ("SERVO", Fault::Servo),
    ] {
        let macros = [
            &format!("FAULT=TACEVA_FAULT_{name}"),
            "FAULT_WORDS=\"axis 3\"",
        ];
        let Some(fixture) = Fixture::built(&macros) else {
            return;
        };
        let session = fixture.session();
        let mut arm = session.robot(&ARM, &Args::default()).expect("opens");
        let fast = Speed::try_new(100.0).expect("above 0");
        let error = arm.move_to(at(0.0, 0.0, 1.0), fast, SECOND);
        let error = error.expect_err("it stopped");
        assert_eq!(error.fault(), Some(fault));
        assert_eq!(error.kind(), ErrorKind::DeviceFault);
        assert!(
            error.to_string().ends_with(&format!("{fault}: axis 3")),
            "{error}"
        );
    }
}

#[test]
fn what_is_asked_for_and_not_there_is_not_found() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let session = fixture.session();
    let error = session.robot(&LAMP, &Args::default()).map(|_| ());
    let error = error.expect_err("a lamp");
    assert_eq!(error.kind(), ErrorKind::NotFound);
    assert!(
        error.to_string().contains("no robot driver of that name"),
        "{error}"
    );
}

#[test]
fn listing_opens_no_library() {
    let folder = tempfile::tempdir().expect("a folder");
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    for number in 0..20 {
        let within = folder.path().join(format!("{number:02}"));
        std::fs::create_dir(&within).expect("made");
        std::fs::copy(fixture.library(), within.join("libfixture.so")).expect("copied");
        let manifest = std::fs::read_to_string(fixture.folder().join("plugin.toml"));
        let manifest = manifest.expect("there");
        let manifest = manifest.replace("org.example.fixture", &format!("org.example.n{number}"));
        std::fs::write(within.join("plugin.toml"), manifest).expect("written");
    }
    let path = taceva_host::SearchPath::empty().given([folder.path().to_owned()]);
    let plugins = taceva_host::Plugins::search(path, &[]);
    let drivers = plugins.iter().flat_map(|plugin| plugin.manifest.drivers());
    let kinds: Vec<DriverKind> = drivers.map(Descriptor::kind).collect();
    assert_eq!((plugins.len(), kinds.len()), (20, 80));
    // Other tests open their own libraries, but none in this folder.
    let maps = std::fs::read_to_string("/proc/self/maps").expect("readable");
    assert!(!maps.contains(&folder.path().display().to_string()));
}
