//! Tests of `sri/m8128` with the emulated box, over sockets.

use std::io::{Read, Write};
use std::net::{Ipv4Addr, TcpListener};
use std::time::{Duration, Instant};

use taceva_conformance::{self as conformance, Trial};
use taceva_core::{Deadline, DriverError, ErrorKind, Factory, ForceTransducer, Millimetre, Rig};
use taceva_drivers::sri::m8128::M8128Factory;
use taceva_drivers::ufactory::xarm::XarmFactory;
use taceva_wire::sri::Emulator;
use taceva_wire::{BenchOptions, Device, FaultKind, WallBench, xarm};

use crate::waiting::support::{MOMENT, inject, speed};

struct Setup {
    bench: WallBench,
    emulator: Emulator,
}

fn setup() -> Setup {
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let emulator = Emulator::start(&bench, Ipv4Addr::LOCALHOST, 0).expect("a box");
    Setup { bench, emulator }
}

impl Setup {
    fn arguments(&self, more: &str) -> String {
        let port = self.emulator.address().port();
        format!("host=127.0.0.1;port={port};force_max_n=50{more}")
    }

    fn started(&self, more: &str) -> Box<dyn ForceTransducer> {
        let mut transducer = opened(&self.arguments(more)).expect("a box");
        transducer.start(MOMENT).expect("it starts");
        transducer
    }
}

fn opened(arguments: &str) -> Result<Box<dyn ForceTransducer>, DriverError> {
    let factory = M8128Factory::new().expect("a factory");
    let args = factory.descriptor().args(arguments).expect("good");
    factory.open(&args, &mut Rig::new())
}

#[test]
fn the_suite_passes() {
    let setup = setup();
    let factory = M8128Factory::new().expect("a factory");
    for more in [";rate=200 Hz", ";rate=1000 Hz", ";zero=box", ";check=crc32"] {
        let trial = Trial::with_arguments(setup.arguments(more));
        let report = conformance::force(&factory, &trial);
        assert!(report.passed(), "{report}");
    }
}

#[test]
fn the_matrix_of_a_box_its_rate_and_its_checksum_are_settings() {
    let setup = setup();
    let transducer = opened(&setup.arguments(";rate=500 Hz;check=crc32")).expect("a box");
    let settings = transducer.settings();
    for (name, expected) in [
        ("decoupling_unit", "MVPV"),
        ("rate_hz", "500"),
        ("check", "crc32"),
    ] {
        assert_eq!(settings[name], expected, "{name}");
    }
    assert!(settings["decoupling"].starts_with("(1,0,0,0,0,0);(0,1"));
}

#[test]
fn every_reading_has_the_number_that_the_box_gave_it() {
    let setup = setup();
    let mut transducer = setup.started("");
    let mut last = None;
    for _ in 0..20 {
        transducer.read(MOMENT).expect("a reading");
        let number = transducer.sequence();
        assert!(number.is_some() && number != last, "{last:?}, {number:?}");
        last = number;
    }
}

#[test]
fn two_hundred_readings_come_a_second() {
    let setup = setup();
    let mut transducer = setup.started("");
    let mut stamps = Vec::new();
    for _ in 0..100 {
        stamps.push(transducer.read(MOMENT).expect("a reading").1.valid_s);
    }
    let mean_s = (stamps[99] - stamps[0]) / 99.0;
    // Late readings are skipped on a busy machine, never doubled.
    assert!((0.004_5..0.02).contains(&mean_s), "{mean_s} s a reading");
}

#[test]
fn a_press_is_felt_in_the_axes_of_the_transducer_and_zero_is_taken_off() {
    let setup = setup();
    let arm = xarm::Emulator::start(&setup.bench, xarm::Ports::ANY).expect("an arm");
    let port = |port| arm.address(port).port();
    let arguments = format!(
        "host=127.0.0.1;port={};pose_port={};status_port={}",
        port(xarm::Port::Command),
        port(xarm::Port::Pose),
        port(xarm::Port::Status)
    );
    let factory = XarmFactory::new().expect("a factory");
    let args = factory.descriptor().args(&arguments).expect("good");
    let mut robot = factory.open(&args, &mut Rig::new()).expect("an arm");
    let mut transducer = setup.started("");
    let tare = |transducer: &mut Box<dyn ForceTransducer>| {
        let tare = transducer.tare().expect("it can");
        tare.zero(MOMENT).expect("zero");
    };
    tare(&mut transducer);
    let mut pressed = robot.pose(MOMENT).expect("a pose").0;
    pressed.position.z = Millimetre(250.8);
    robot
        .move_to(pressed, speed(100.0), MOMENT)
        .expect("it arrives");
    // The first reading is the newest one, perhaps of the last moment of the motion; its stamp shows it.
    transducer.read(MOMENT).expect("a reading");
    transducer.read(MOMENT).expect("a reading");
    let (wrench, _) = transducer.read(MOMENT).expect("a reading");
    let truth = setup.bench.truth();
    // The axes of the transducer are those of the base frame: a pressing force points down.
    assert!(wrench.force[2].0 < -0.1, "{wrench:?}");
    assert!(
        (wrench.force[2].0 + truth.force_n[2]).abs() < 0.002,
        "{wrench:?}, {truth:?}"
    );
    tare(&mut transducer);
    let (wrench, _) = transducer.read(MOMENT).expect("a reading");
    assert!(wrench.force[2].0.abs() < 0.002, "{wrench:?}");
}

#[test]
fn a_silent_box_is_a_timeout_and_one_that_comes_back_goes_on() {
    let setup = setup();
    let mut transducer = setup.started("");
    transducer.read(MOMENT).expect("a reading");
    inject(&setup.bench, Device::Force, FaultKind::Silent, 200);
    let patience = Deadline::after(Duration::from_millis(30));
    let silent = (0..5).find_map(|_| transducer.read(patience).err());
    assert_eq!(silent.expect("nothing came").kind(), ErrorKind::Timeout);
    transducer.read(MOMENT).expect("it is back");
    inject(&setup.bench, Device::Force, FaultKind::Drop, 50);
    std::thread::sleep(Duration::from_millis(60));
    transducer.read(MOMENT).expect("it is back");
    inject(&setup.bench, Device::Force, FaultKind::Silent, 200);
    let silent = (0..5).find_map(|_| transducer.read(patience).err());
    let message = silent.expect("nothing came").to_string();
    assert!(message.contains("frames were lost"), "{message}");
}

#[test]
fn what_a_link_held_back_is_not_taken_for_what_is_true_now() {
    let setup = setup();
    let mut transducer = setup.started("");
    transducer.read(MOMENT).expect("a reading");
    inject(&setup.bench, Device::Force, FaultKind::Late, 100);
    let began = Instant::now();
    transducer.read(MOMENT).expect("a reading from before");
    let (_, after) = transducer.read(MOMENT).expect("the newest of those held");
    let (_, next) = transducer.read(MOMENT).expect("the next");
    assert!(began.elapsed() > Duration::from_millis(90));
    // Twenty readings arrived at once, and one of them is returned.
    assert!(next.valid_s - after.valid_s < 0.1 && next.valid_s > after.valid_s);
}

#[test]
fn a_number_that_is_none_is_a_fault_of_that_reading_alone() {
    let setup = setup();
    let mut transducer = setup.started("");
    inject(&setup.bench, Device::Force, FaultKind::NotANumber, 60);
    let until = Instant::now() + Duration::from_millis(40);
    let mut faults = 0;
    while Instant::now() < until {
        if let Err(error) = transducer.read(MOMENT) {
            assert_eq!(error.kind(), ErrorKind::DeviceFault);
            assert!(error.to_string().contains("`Fz` is NaN"), "{error}");
            faults += 1;
        }
    }
    assert!(faults > 0);
    std::thread::sleep(Duration::from_millis(40));
    transducer.read(MOMENT).expect("a number again");
}

#[test]
fn an_interrupt_ends_a_reading_that_is_waited_for() {
    let setup = setup();
    let mut transducer = setup.started("");
    inject(&setup.bench, Device::Force, FaultKind::Silent, 3_000);
    let handle = transducer.interrupt_handle().expect("it can");
    let reading = std::thread::spawn(move || {
        let patience = Deadline::after(Duration::from_secs(20));
        (0..3).find_map(|_| transducer.read(patience).err())
    });
    while !reading.is_finished() {
        handle.interrupt();
        std::thread::sleep(Duration::from_millis(1));
    }
    let error = reading.join().expect("it ended").expect("interrupted");
    assert_eq!(error.kind(), ErrorKind::Interrupted);
}

#[test]
fn a_box_that_goes_away_is_disconnected() {
    let Setup { bench, emulator } = setup();
    let mut transducer = Setup { bench, emulator }.started("");
    let gone = (0..1_000).find_map(|_| transducer.read(MOMENT).err());
    assert_eq!(gone.expect("gone").kind(), ErrorKind::Disconnected);
}

#[test]
fn a_box_that_refuses_a_command_says_which() {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("bound").port();
    std::thread::spawn(move || {
        for mut stream in listener.incoming().flatten() {
            let mut bytes = [0; 256];
            while let Ok(count @ 1..) = stream.read(&mut bytes) {
                let text = String::from_utf8_lossy(&bytes[..count]).into_owned();
                let word = text.trim_start_matches("AT+");
                let word = word.split(['=', '\r']).next().unwrap_or_default();
                let _ = stream.write_all(format!("ACK+{word}=?$NO\u{1b}\r\n").as_bytes());
            }
        }
    });
    let mut transducer = opened(&format!("host=127.0.0.1;port={port}")).expect("it accepts");
    let error = transducer.start(MOMENT).expect_err("refused");
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    let message = error.to_string();
    assert!(
        message.contains("the answer to `AT+SMPR=200` is `ACK+SMPR=?$NO\\u{1b}`"),
        "{message}"
    );
}
