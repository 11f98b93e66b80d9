//! What arguments of several drivers have in common.

#[cfg(any(feature = "hid", feature = "netft", feature = "sri"))]
pub(crate) mod force;
#[cfg(any(feature = "netft", feature = "sri", feature = "ur", feature = "xarm"))]
pub(crate) mod network;
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
pub(crate) mod robot;

use taceva_core::{ArgValue, Args};

/// The number that an optional argument gives, if it was given.
pub(crate) fn optional_number(args: &Args, key: &str) -> Option<f64> {
    args.get(key).and_then(ArgValue::as_number)
}

/// A fact of a device that no protocol tells: from a data sheet or a measurement, and unknown where nobody says it.
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
