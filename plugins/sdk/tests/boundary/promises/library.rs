//! Properties of the library and of every driver in it.

#![expect(unsafe_code, reason = "the tables of a plugin are called")]

use std::ptr::null;
use std::time::Duration;

use taceva_plugin::abi::{
    ABI_MAJOR, Args, FORCE_FACTORY, LIGHTING_FACTORY, MAGIC, Plugin, SENSOR_FACTORY, Status,
};

use crate::fake_host::{ended, exported, factory, plugin, taken, with_args};

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
    // SAFETY: `take` appends the text to the list; NULL stands for any arguments.
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
choices = ["well", "panic", "nan", "refuse", "block", "panic-at-drop", "numbered"]
default = "well"
"#
    );
    let discover = factory(SENSOR_FACTORY).discover.expect("a function");
    // SAFETY: `take` appends the texts to the list.
    let (_, found) = taken(|context, error| unsafe {
        discover(0, Some(crate::fake_host::take), context, error)
    });
    assert_eq!(found, ["way=well"]);
}

#[test]
fn a_driver_that_must_be_given_something_describes_itself_before_it_is() {
    let lamps = factory(LIGHTING_FACTORY);
    let describe = lamps.describe.expect("a function");
    let nothing = Args {
        items: null(),
        count: 0,
    };
    for args in [null(), &raw const nothing] {
        // SAFETY: `take` appends the text to the list, and the arguments live for the call.
        let (ended, texts) = taken(|context, error| unsafe {
            describe(1, args, Some(crate::fake_host::take), context, error)
        });
        assert_eq!(ended, (Status::OK, String::new()));
        assert!(texts.concat().contains("key = \"port\""), "{texts:?}");
    }
    let open = lamps.open.expect("a function");
    let mut device = taceva_plugin::abi::Device {
        handle: std::ptr::null_mut(),
        calls: null(),
    };
    // SAFETY: all places live for the call.
    let (status, message) = ended(|error| unsafe {
        open(
            1,
            &raw const nothing,
            std::ptr::null_mut(),
            &raw mut device,
            error,
        )
    });
    assert_eq!(status, Status::INVALID_ARGUMENT);
    assert!(message.contains("`port`: missing"), "{message}");
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
            // SAFETY: all arguments live for the call.
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
