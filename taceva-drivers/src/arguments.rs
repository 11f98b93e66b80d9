//! Arguments shared by several drivers.

#[cfg(any(feature = "hid", feature = "netft", feature = "sri"))]
pub(crate) mod force;
#[cfg(any(feature = "netft", feature = "sri", feature = "ur", feature = "xarm"))]
pub(crate) mod network;
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
pub(crate) mod robot;

use taceva_core::{ArgValue, Args};

/// Value of an optional number argument; `None` if it is not given.
pub(crate) fn optional_number(args: &Args, key: &str) -> Option<f64> {
    args.get(key).and_then(ArgValue::as_number)
}

/// Optional argument for a fact that no device protocol reports. Its value is from a data sheet or a measurement. Without a value the fact is
/// unknown.
#[cfg(any(
    feature = "gcode",
    feature = "hid",
    feature = "netft",
    feature = "sri",
    feature = "ur",
    feature = "xarm"
))]
fn fact(key: &str, [least, most]: [f64; 2], help: &str) -> taceva_core::ArgSpec {
    taceva_core::ArgSpec::number(key, least, most)
        .optional()
        .help(help)
        .changes_facts()
}
