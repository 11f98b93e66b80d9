//! Guarantees of force transducers: wrenches and tare.

#![expect(unsafe_code, reason = "the tables of a plugin are called")]

use taceva_plugin::abi::ext::{TARE, TareCalls};
use taceva_plugin::abi::{FORCE_FACTORY, ForceCalls, Stamp, Status, Wrench};

use super::SECOND;
use crate::fake_host::{Open, ended};

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
            torque_n_mm: [12.5, 0.0, 0.0]
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
fn lost_readings_are_those_that_the_driver_counts() {
    for (way, expected) in [("well", (Status::OK, 3)), ("nan", (Status::NOT_FOUND, 0))] {
        let force = Open::new(FORCE_FACTORY, way);
        let lost = force.calls::<ForceCalls>().lost.expect("a function");
        let mut count = 0;
        // SAFETY: the number lives for the call.
        let (status, _) = ended(|error| unsafe { lost(force.handle(), &raw mut count, error) });
        assert_eq!((status, count), expected, "{way}");
    }
}
