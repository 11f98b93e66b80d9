//! Tests of `hid/scale` and `hid/pedal` with the HID layer of a kernel.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use taceva_conformance::{self as conformance, Trial};
use taceva_core::{
    Deadline, DriverError, EnablingSwitch as _, ErrorKind, Factory, ForceTransducer, Rig,
};
use taceva_drivers::hid::pedal::Pedal;
use taceva_drivers::hid::scale::ScaleFactory;
use taceva_wire::uhid::{Emulator, PEDAL, SCALE};

use super::machine::carry_out;

const PATIENCE: Deadline = Deadline::after(Duration::from_secs(20));

#[test]
fn a_scale_and_a_pedal_are_read_through_the_kernel() {
    carry_out("kernel::hid::in_the_machine", &["uhid", "hid_generic"]);
}

#[test]
#[ignore = "carried out in a virtual machine"]
fn in_the_machine() {
    let factory = ScaleFactory::new().expect("a factory");
    assert_eq!(factory.discover().expect("none"), []);
    assert_eq!(
        opened("").map(drop).expect_err("none").kind(),
        ErrorKind::NotFound
    );
    a_scale_passes_its_suite(&factory);
    a_scale_weighs_and_says_when_it_does_not();
    a_pedal_is_held_until_it_is_released_or_gone();
}

fn opened(arguments: &str) -> Result<Box<dyn ForceTransducer>, DriverError> {
    let factory = ScaleFactory::new().expect("a factory");
    let args = factory.descriptor().args(arguments).expect("good");
    factory.open(&args, &mut Rig::new())
}

/// Retries until `attempt` succeeds: the kernel creates device files shortly after a device appears.
fn soon<T>(what: &str, mut attempt: impl FnMut() -> Option<T>) -> T {
    let began = Instant::now();
    loop {
        if let Some(found) = attempt() {
            return found;
        }
        assert!(
            began.elapsed() < Duration::from_secs(30),
            "{what} did not come"
        );
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// A scale that sends the same report repeatedly.
struct Sending {
    is_over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Sending {
    fn start(report: [u8; 6]) -> Sending {
        let mut scale = Emulator::start(&SCALE).expect("a scale");
        let is_over = Arc::new(AtomicBool::new(false));
        let over = Arc::clone(&is_over);
        let thread = std::thread::spawn(move || {
            while !over.load(Ordering::Acquire) {
                scale.report(&report).expect("it is sent");
                std::thread::sleep(Duration::from_millis(20));
            }
        });
        Sending {
            is_over,
            thread: Some(thread),
        }
    }
}

impl Drop for Sending {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Release);
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

fn a_scale_passes_its_suite(factory: &ScaleFactory) {
    let _scale = Sending::start([3, 4, 2, 0, 124, 0]);
    let found = soon("a scale", || factory.discover().expect("a list").pop());
    assert_eq!(found.title, "Emulated scale");
    assert_eq!(found.arguments, "usb=0922:8003;serial=EMU-1");
    let mut trial = Trial::with_arguments(found.arguments);
    // The emulated processor is slow.
    let slow = Duration::from_secs(5);
    (trial.deadline, trial.at_once, trial.overrun) = (PATIENCE, slow, slow);
    let report = conformance::force(factory, &trial);
    assert!(report.passed(), "{report}");
}

fn a_scale_weighs_and_says_when_it_does_not() {
    let mut scale = Emulator::start(&SCALE).expect("a scale");
    let mut transducer = soon("a scale", || opened("usb=0922:8003").ok());
    transducer.start(PATIENCE).expect("nothing to begin");
    scale.report(&[3, 4, 2, 0, 124, 0]).expect("it is sent");
    let (wrench, _) = transducer.read(PATIENCE).expect("a weight");
    assert!(
        (wrench.force[2].0 - 0.124 * 9.806_65).abs() < 1e-9,
        "{wrench:?}"
    );
    let step_n = transducer.resolution().expect("of its report").0;
    assert!((step_n - 0.001 * 9.806_65).abs() < 1e-12, "{step_n}");
    scale.report(&[3, 6, 2, 0, 124, 0]).expect("it is sent");
    let overloaded = transducer.read(PATIENCE).expect_err("overloaded");
    assert_eq!(overloaded.kind(), ErrorKind::OutOfRange, "{overloaded}");
    scale.report(&[3, 8, 2, 0, 124, 0]).expect("it is sent");
    let lost = transducer.read(PATIENCE).expect_err("no zero");
    assert_eq!(lost.kind(), ErrorKind::DeviceFault, "{lost}");
    let silent = transducer.read(Deadline::after(Duration::from_millis(100)));
    assert_eq!(silent.expect_err("silent").kind(), ErrorKind::Timeout);
    drop(scale);
    let gone = transducer.read(PATIENCE).expect_err("unplugged");
    assert_eq!(gone.kind(), ErrorKind::Disconnected, "{gone}");
}

fn a_pedal_is_held_until_it_is_released_or_gone() {
    const UP: [u8; 8] = [0; 8];
    const DOWN: [u8; 8] = [0, 0, 5, 0, 0, 0, 0, 0];
    let mut device = Emulator::start(&PEDAL).expect("a pedal");
    let selector = "hid/pedal:usb=0c45:7403".parse().expect("a selector");
    let pedal = soon("a pedal", || Pedal::open(&selector).ok());
    assert!(!pedal.is_held().expect("there"), "before its first report");
    device.report(&DOWN).expect("it is sent");
    soon("a pressed pedal", || {
        pedal.is_held().expect("there").then_some(())
    });
    assert!(pedal.is_held().expect("there"), "it stays held");
    device.report(&UP).expect("it is sent");
    device.report(&DOWN).expect("it is sent");
    soon("the short release", || {
        (!pedal.is_held().expect("there")).then_some(())
    });
    soon("the press behind it", || {
        pedal.is_held().expect("there").then_some(())
    });
    device.report(&UP).expect("it is sent");
    soon("a released pedal", || {
        (!pedal.is_held().expect("there")).then_some(())
    });
    drop(device);
    let gone = soon("the end of the pedal", || pedal.is_held().err());
    assert_eq!(gone.kind(), ErrorKind::Disconnected, "{gone}");
    let foreign = "ur/rtde:host=x".parse().expect("a selector");
    assert_eq!(
        Pedal::open(&foreign)
            .map(drop)
            .expect_err("no switch")
            .kind(),
        ErrorKind::NotFound
    );
}
