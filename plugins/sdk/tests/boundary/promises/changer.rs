//! Guarantees of a changer.

#![expect(unsafe_code, reason = "the tables of a plugin are called")]

use std::thread;
use std::time::{Duration, Instant};

use taceva_plugin::abi::{CHANGER_FACTORY, ChangerCalls, Status, Text};

use super::{AT_ONCE, SECOND};
use crate::fake_host::{Ended, Open, take, taken};

fn bring(changer: &Open, name: &str, timeout_ns: u64) -> (Ended, Vec<String>) {
    let calls = changer.calls::<ChangerCalls>();
    taken(|context, error| {
        let name = Text::from(name);
        // SAFETY: the device is open, and the text and the list live for the call.
        unsafe {
            calls.bring.expect("a function")(
                changer.handle(),
                name,
                timeout_ns,
                Some(take),
                context,
                error,
            )
        }
    })
}

#[test]
fn the_name_of_what_is_in_place_crosses_and_a_failure_hands_over_none() {
    let well = Open::new(CHANGER_FACTORY, "well");
    assert_eq!(
        bring(&well, "b", SECOND),
        ((Status::OK, String::new()), vec!["b".to_owned()])
    );
    let ((status, _), names) = bring(&well, "c", SECOND);
    assert_eq!((status, names.len()), (Status::INVALID_ARGUMENT, 0));
    let other = Open::new(CHANGER_FACTORY, "nan");
    assert_eq!(bring(&other, "a", SECOND).1, ["c"]);
    let stuck = Open::new(CHANGER_FACTORY, "refuse");
    let ((status, said), names) = bring(&stuck, "a", SECOND);
    assert_eq!((status, names.len()), (Status::DEVICE_FAULT, 0));
    assert!(said.contains("stuck"), "{said}");
    let panics = Open::new(CHANGER_FACTORY, "panic");
    for _ in 0..2 {
        assert_eq!(bring(&panics, "a", SECOND).0.0, Status::PANICKED);
    }
}

#[test]
fn nobody_who_takes_the_name_is_refused_before_anything_moves() {
    let changer = Open::new(CHANGER_FACTORY, "panic");
    let calls = changer.calls::<ChangerCalls>();
    let ((status, said), _) = taken(|context, error| {
        // SAFETY: the device is open, and the text lives for the call.
        unsafe {
            calls.bring.expect("a function")(
                changer.handle(),
                Text::from("a"),
                SECOND,
                None,
                context,
                error,
            )
        }
    });
    assert_eq!(
        (status, said.as_str()),
        (Status::INVALID_ARGUMENT, "`take` is NULL")
    );
}

#[test]
fn an_interrupt_ends_a_change_that_waits() {
    let changer = Open::new(CHANGER_FACTORY, "block");
    assert_eq!(bring(&changer, "a", 1_000_000).0.0, Status::TIMEOUT);
    thread::scope(|scope| {
        let blocked = scope.spawn(|| bring(&changer, "a", 60 * SECOND).0.0);
        thread::sleep(Duration::from_millis(20));
        let asked = Instant::now();
        changer.interrupt();
        assert_eq!(blocked.join().expect("it answers"), Status::INTERRUPTED);
        assert!(asked.elapsed() < AT_ONCE, "{:?}", asked.elapsed());
    });
}
