//! Tests of links that split or merge messages, skip numbers, or insert foreign bytes.

use std::net::Ipv4Addr;
use std::time::{Duration, Instant};

use taceva_core::{ErrorKind, Factory, ForceTransducer, Rig};
use taceva_drivers::ati::netft::NetftFactory;
use taceva_drivers::sri::m8128::M8128Factory;
use taceva_drivers::ufactory::xarm::XarmFactory;
use taceva_drivers::ur::rtde::UrFactory;
use taceva_wire::{Arm, BenchOptions, Device, FaultKind, WallBench, netft, sri, ur, xarm};

use crate::waiting::setup::Setup;
use crate::waiting::support::{MOMENT, PATIENCE, inject, lower, speed};

/// Allowed errors of a driver on a faulty link.
pub(crate) const TYPED: [ErrorKind; 4] = [
    ErrorKind::Protocol,
    ErrorKind::Timeout,
    ErrorKind::Disconnected,
    ErrorKind::DeviceFault,
];
/// Duration of a link fault, ms.
const BAD_MS: u64 = 300;

/// Calls `act` with a started transducer of each kind and the simulated gel that it measures, while the emulators run.
fn each_transducer(mut act: impl FnMut(&WallBench, &mut dyn ForceTransducer)) {
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let sri = sri::Emulator::start(&bench, Ipv4Addr::LOCALHOST, 0).expect("a box");
    let netft = netft::Emulator::start(&bench, Ipv4Addr::LOCALHOST, 0, 0).expect("a box");
    let factories: [Box<dyn Factory<dyn ForceTransducer>>; 2] = [
        Box::new(M8128Factory::new().expect("a factory")),
        Box::new(NetftFactory::new().expect("a factory")),
    ];
    for (factory, selector) in factories.iter().zip([sri.selector(), netft.selector()]) {
        let (_, arguments) = selector.split_once(':').expect("a driver and arguments");
        let args = factory.descriptor().args(arguments).expect("good");
        let mut transducer = factory.open(&args, &mut Rig::new()).expect("a box");
        transducer.start(MOMENT).expect("it starts");
        act(&bench, &mut *transducer);
    }
}

#[test]
fn readings_come_whole_and_once_however_their_link_splits_and_merges_them() {
    each_transducer(|bench, transducer| {
        for kind in [FaultKind::Split, FaultKind::Merged] {
            inject(bench, Device::Force, kind, BAD_MS);
            let mut last = None;
            for _ in 0..20 {
                let (wrench, _) = transducer.read(MOMENT).expect("a reading");
                let number = transducer.sequence().expect("they are numbered");
                assert!(last.is_none_or(|last| last < number), "{kind}: {number}");
                assert!(wrench.force[2].0.abs() < 1.0, "{kind}: {wrench:?}");
                last = Some(number);
            }
        }
    });
}

#[test]
fn numbers_that_are_left_out_are_seen_in_the_sequence_and_no_reading_comes_twice() {
    each_transducer(|bench, transducer| {
        inject(bench, Device::Force, FaultKind::Gap, BAD_MS);
        let (mut last, mut widest) = (None, 0);
        for _ in 0..30 {
            transducer.read(MOMENT).expect("a reading");
            let number = transducer.sequence().expect("they are numbered");
            if let Some(last) = last {
                assert!(number > last, "{number} after {last}");
                widest = widest.max(number - last);
            }
            last = Some(number);
        }
        assert!(widest >= 7, "at most {widest}");
    });
}

#[test]
fn readings_that_a_slow_reader_leaves_are_not_lost_and_those_that_never_came_are() {
    each_transducer(|bench, transducer| {
        transducer.read(MOMENT).expect("a reading");
        let before = transducer.sequence().expect("they are numbered");
        // Longer than a busy machine keeps a box from its turn.
        std::thread::sleep(Duration::from_millis(200));
        transducer.read(MOMENT).expect("a reading");
        let after = transducer.sequence().expect("they are numbered");
        assert!(
            after > before + 2,
            "{before} {after}: nothing was overtaken"
        );
        assert_eq!(transducer.lost(), Some(0));
        inject(bench, Device::Force, FaultKind::Gap, BAD_MS);
        let until = Instant::now() + Duration::from_millis(BAD_MS);
        while Instant::now() < until {
            transducer.read(MOMENT).expect("a reading");
        }
        assert!(transducer.lost() >= Some(7), "{:?}", transducer.lost());
    });
}

#[test]
fn bytes_of_others_and_absurd_lengths_are_typed_errors_and_readings_follow_them() {
    each_transducer(|bench, transducer| {
        for kind in [FaultKind::Foreign, FaultKind::Hostile] {
            inject(bench, Device::Force, kind, BAD_MS);
            let until = Instant::now() + Duration::from_millis(BAD_MS);
            while Instant::now() < until {
                if let Err(error) = transducer.read(MOMENT) {
                    assert!(TYPED.contains(&error.kind()), "{kind}: {error}");
                    std::thread::sleep(Duration::from_millis(5));
                }
            }
            let until = Instant::now() + Duration::from_secs(5);
            let reads = |transducer: &mut dyn ForceTransducer| {
                transducer.read(MOMENT).is_ok()
                    || transducer.start(MOMENT).is_ok() && transducer.read(MOMENT).is_ok()
            };
            while !reads(transducer) {
                assert!(Instant::now() < until, "{kind}: no reading follows");
            }
        }
    });
}

impl<E: Arm> Setup<E> {
    /// Tests that a motion arrives although its reports are split and merged.
    fn arrives_in_pieces_and_heaps(&self) {
        let mut arm = self.open();
        let (home, _) = arm.pose(PATIENCE).expect("a pose");
        for (kind, mm) in [(FaultKind::Split, 2.0), (FaultKind::Merged, 4.0)] {
            inject(&self.bench, Device::Robot, kind, 1_500);
            let target = lower(home, mm);
            arm.move_to(target, speed(5.0), PATIENCE)
                .unwrap_or_else(|error| panic!("{kind}: {error}"));
            let (seen, _) = arm.pose(PATIENCE).expect("a pose");
            let apart_mm = (seen.position.z.0 - target.position.z.0).abs();
            assert!(apart_mm < 0.05, "{kind}: {apart_mm} mm");
        }
    }

    /// Tests that foreign bytes during a motion lead to an arrival or a typed error, and that the arm then stands.
    fn stands_among_bytes_of_others(&self) {
        for kind in [FaultKind::Foreign, FaultKind::Hostile] {
            let mut arm = self.open();
            let (home, _) = arm.pose(PATIENCE).expect("a pose");
            let bench = &self.bench;
            std::thread::scope(|scope| {
                scope.spawn(move || {
                    std::thread::sleep(Duration::from_millis(200));
                    inject(bench, Device::Robot, kind, BAD_MS);
                });
                if let Err(error) = arm.move_to(lower(home, 4.0), speed(5.0), PATIENCE) {
                    assert!(TYPED.contains(&error.kind()), "{kind}: {error}");
                }
            });
            std::thread::sleep(Duration::from_millis(BAD_MS));
            assert!(!self.bench.truth().is_moving, "{kind}");
            drop(arm);
            // A reopened arm works.
            let mut arm = self.open();
            arm.clear_halt(PATIENCE).expect("nothing is wrong with it");
            arm.move_to(home, speed(50.0), PATIENCE).expect("up again");
        }
    }
}

pub(crate) fn xarm_setup() -> Setup<xarm::Emulator> {
    Setup::new(XarmFactory::new().expect("a factory"), |bench| {
        xarm::Emulator::start(bench, xarm::Ports::ANY)
    })
}

pub(crate) fn ur_setup() -> Setup<ur::Emulator> {
    Setup::new(UrFactory::new().expect("a factory"), |bench| {
        ur::Emulator::start(bench, Ipv4Addr::LOCALHOST, [0, 0])
    })
}

#[test]
fn a_motion_arrives_however_the_reports_of_the_arm_are_split_and_merged() {
    xarm_setup().arrives_in_pieces_and_heaps();
    ur_setup().arrives_in_pieces_and_heaps();
}

#[test]
fn bytes_of_others_among_the_reports_end_in_a_typed_error_and_an_arm_that_stands() {
    xarm_setup().stands_among_bytes_of_others();
    ur_setup().stands_among_bytes_of_others();
}
