//! Tests of failing controllers and failing links.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::time::{Duration, Instant};

use taceva_core::{DriverError, ErrorKind, Factory, Pose, Rig};
use taceva_drivers::ufactory::xarm::XarmFactory;
use taceva_wire::xarm::Ports;
use taceva_wire::{Arm, ArmFault, Device, FaultKind};

use super::setup::setup;
use crate::waiting::support::{PATIENCE, inject, lower, moved, speed};

#[test]
fn an_emergency_stop_is_a_fault_that_nobody_but_a_person_ends() {
    let setup = setup(Ports::ANY);
    let (error, took) = moved(&setup.bench, &mut *setup.open(), || {
        setup.emulator.suffer(ArmFault::EmergencyStop)
    });
    assert_eq!(error.kind(), ErrorKind::DeviceFault);
    assert!(
        error
            .to_string()
            .contains("error 2: the emergency stop was pressed"),
        "{error}"
    );
    assert_eq!(error.fault(), Some(taceva_core::Fault::EmergencyStop));
    assert!(took < Duration::from_millis(100), "{took:?}");
    let stood = setup.bench.truth().tip_mm;
    let mut arm = setup.open();
    let (at, _) = arm.pose(PATIENCE).expect("a pose");
    for _ in 0..2 {
        let moved = arm.move_to(lower(at, 1.0), speed(5.0), PATIENCE);
        assert_eq!(moved.expect_err("a fault").kind(), ErrorKind::DeviceFault);
        let cleared = arm.clear_halt(PATIENCE);
        assert_eq!(cleared.expect_err("a fault").kind(), ErrorKind::DeviceFault);
    }
    let bits = |tip_mm: [f64; 3]| tip_mm.map(f64::to_bits);
    let now = setup.bench.truth().tip_mm;
    assert_eq!(bits(now), bits(stood), "nothing moved after it");
}

#[test]
fn a_collision_is_a_fault_that_is_named() {
    let setup = setup(Ports::ANY);
    let (error, _) = moved(&setup.bench, &mut *setup.open(), || {
        setup.emulator.suffer(ArmFault::Collision)
    });
    assert_eq!(error.kind(), ErrorKind::DeviceFault);
    assert!(
        error.to_string().contains("error 31: a collision"),
        "{error}"
    );
}

#[test]
fn reports_that_stop_stop_the_arm() {
    let setup = setup(Ports::ANY);
    let (error, took) = moved(&setup.bench, &mut *setup.open(), || {
        inject(&setup.bench, Device::Robot, FaultKind::Silent, 1_000);
    });
    assert_eq!(error.kind(), ErrorKind::Timeout, "{error}");
    // A quarter of a second without a report, 40 ms for a missing answer, and the check that the arm stands.
    assert!(took < Duration::from_millis(1_200), "{took:?}");
    assert!(!setup.bench.truth().is_moving);
}

#[test]
fn a_silence_that_is_over_keeps_an_arm_at_rest_no_longer_than_a_moment() {
    let setup = setup(Ports::ANY);
    let mut arm = setup.open();
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    // The stop connection is tested twice per second: the silences begin at all phases of these tests.
    for phase in 0..25_u8 {
        inject(&setup.bench, Device::Robot, FaultKind::Silent, 150);
        std::thread::sleep(Duration::from_millis(350));
        let target = lower(home, f64::from(phase % 2));
        let moved = arm.move_to(target, speed(20.0), PATIENCE);
        moved.unwrap_or_else(|error| panic!("phase {phase}: {error:?}"));
        std::thread::sleep(Duration::from_millis(70));
    }
}

#[test]
fn a_stop_waits_for_no_answer_that_somebody_else_waits_for() {
    let setup = setup(Ports::ANY);
    let mut arm = setup.open();
    let halt = arm.halt_handle();
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    // The stop connection is tested twice per second, and a silent controller blocks such a test for 120 ms: the stops occur at all phases
    // of it.
    for phase in 0..16_u64 {
        let stood_after = || {
            while !setup.bench.truth().is_moving {
                std::thread::yield_now();
            }
            inject(&setup.bench, Device::Robot, FaultKind::Silent, 300);
            std::thread::sleep(Duration::from_millis(50 + 13 * phase));
            let began = Instant::now();
            std::thread::scope(|scope| {
                let halting = scope.spawn(|| halt.halt());
                while setup.bench.truth().is_moving {
                    std::thread::yield_now();
                }
                let stood = began.elapsed();
                // The confirmation does not matter here.
                drop(halting.join().expect("no panic"));
                stood
            })
        };
        let stood = std::thread::scope(|scope| {
            let stood = scope.spawn(stood_after);
            drop(arm.move_to(lower(home, 15.0), speed(2.0), PATIENCE));
            stood.join().expect("it stands")
        });
        assert!(
            stood < Duration::from_millis(40),
            "phase {phase}: {stood:?}"
        );
        std::thread::sleep(Duration::from_millis(500));
        arm.clear_halt(PATIENCE).expect("it answers again");
        arm.move_to(home, speed(50.0), PATIENCE).expect("back");
    }
}

#[test]
fn a_pose_that_is_no_number_is_a_fault_and_ends_no_motion_as_arrived() {
    let setup = setup(Ports::ANY);
    let mut arm = setup.open();
    arm.pose(PATIENCE).expect("a pose");
    inject(&setup.bench, Device::Robot, FaultKind::NotANumber, 300);
    let until = Instant::now() + Duration::from_millis(250);
    let mut faults = 0;
    while Instant::now() < until {
        if let Err(error) = arm.pose(PATIENCE) {
            assert_eq!(error.kind(), ErrorKind::DeviceFault);
            assert!(error.to_string().contains("`z` is NaN"), "{error}");
            faults += 1;
        }
    }
    assert!(faults > 0);
}

#[test]
fn an_arm_that_goes_away_is_disconnected() {
    let mut robot = setup(Ports::ANY).open();
    let moved = robot.move_to(Pose::default(), speed(5.0), PATIENCE);
    assert_eq!(moved.expect_err("outside").kind(), ErrorKind::OutOfRange);
    // The emulator was dropped: its ports are closed.
    let posed = (0..100).find_map(|_| {
        std::thread::sleep(Duration::from_millis(20));
        robot.pose(PATIENCE).err()
    });
    assert_eq!(posed.expect("gone").kind(), ErrorKind::Disconnected);
    let handle = robot.halt_handle();
    // The last client of the emulator is closed within a moment; until then a stop still arrives.
    let halted = (0..100).find_map(|_| {
        std::thread::sleep(Duration::from_millis(20));
        handle.halt().err()
    });
    assert_eq!(halted.expect("gone").kind(), ErrorKind::Disconnected);
    drop(robot);
    assert!(handle.halt().is_ok(), "there is nothing left to stop");
}

/// Error of opening a controller that sends `answer` to every client, whatever the request.
fn opened_against(answer: &'static [u8]) -> DriverError {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("bound").port();
    std::thread::spawn(move || {
        let serve = |mut stream: TcpStream| {
            let mut question = [0; 64];
            let _ = stream.read(&mut question);
            let _ = stream.write_all(answer);
            let _ = stream.read(&mut question);
        };
        listener.incoming().flatten().for_each(serve);
    });
    let factory = XarmFactory::new().expect("a factory");
    let arguments = format!("host=127.0.0.1;port={port};pose_port=1;status_port=1");
    let args = factory.descriptor().args(&arguments).expect("good");
    match factory.open(&args, &mut Rig::new()) {
        Ok(_) => panic!("opened against {answer:?}"),
        Err(error) => error,
    }
}

#[test]
fn whoever_is_no_controller_is_refused_by_what_it_said() {
    for (answer, kind, words) in [
        (
            &b"HTTP/1.1 400 Bad Request\r\n\r\n"[..],
            ErrorKind::Protocol,
            "protocol 0x5450",
        ),
        (
            b"\x00\x01\x00\x02\xff\xff\x01\x00",
            ErrorKind::Protocol,
            "65535 bytes",
        ),
        (
            b"\x00\x01\x00\x02\x00\x08\x01\x00hello\x1b",
            ErrorKind::Protocol,
            "hello\\u{1b}",
        ),
        (b"", ErrorKind::Timeout, "the query of its version"),
        (
            b"\x00\x09\x00\x02\x00\x02\x01\x00",
            ErrorKind::Timeout,
            "no answer",
        ),
    ] {
        let error = opened_against(answer);
        assert_eq!(error.kind(), kind, "{error}");
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn a_controller_of_another_version_of_the_protocol_is_refused_by_its_number() {
    let error = opened_against(b"\x00\x01\x00\x04\x00\x02\x01\x00");
    assert_eq!(error.kind(), ErrorKind::Protocol, "{error}");
    assert!(error.to_string().contains("protocol 0x0004"), "{error}");
}

#[test]
fn a_port_where_nobody_listens_is_not_found() {
    let factory = XarmFactory::new().expect("a factory");
    let args = factory
        .descriptor()
        .args("host=127.0.0.1;port=1")
        .expect("good");
    let Err(error) = factory.open(&args, &mut Rig::new()) else {
        panic!("opened nothing")
    };
    assert_eq!(error.kind(), ErrorKind::NotFound);
}
