//! The bench shared by the devices of a rig.

#![expect(unsafe_code, reason = "the tables of a plugin are called")]

use taceva_plugin::abi::ext::{BENCH, BenchCalls, Specimen};
use taceva_plugin::abi::{ROBOT_FACTORY, Rig, Status, Text};

use crate::fake_host::{Open, ended, plugin, taken};

#[test]
fn a_bench_is_reached_through_the_rig_in_which_its_devices_were_opened() {
    let mut rig: *mut Rig = std::ptr::null_mut();
    let plugin = plugin();
    // SAFETY: the place lives for the call, and the rig lives until it is closed below.
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
            (
                Status::INVALID_ARGUMENT,
                "cannot do it: dot grating of 2 mm".to_owned(),
            ),
        ),
        (
            9,
            (
                Status::INVALID_ARGUMENT,
                "the specimen has the unknown kind 9".to_owned(),
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
    // SAFETY: `take` appends the text to the list.
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
    // SAFETY: closing is allowed at any time here, because a device keeps its own resources.
    unsafe { plugin.close_rig.expect("a function")(rig) };
    assert_eq!(now("bench"), 0);
}
