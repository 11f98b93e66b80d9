//! What arguments of several drivers have in common.

use taceva_core::{ArgSpec, ArgValue, Args, Speed, SpeedError};

/// A port of a network, `usual` where nobody says otherwise.
#[cfg(feature = "tcp")]
pub(crate) fn port(key: &str, usual: i64, help: &str) -> ArgSpec {
    ArgSpec::whole(key, 1, 65_535)
        .default(ArgValue::Whole(usual))
        .help(help)
}

/// The port that an argument of [`port`] gives.
#[cfg(feature = "tcp")]
pub(crate) fn port_of(args: &Args, key: &str) -> u16 {
    // Its range was checked.
    u16::try_from(args.whole(key)).unwrap_or(0)
}

/// The number that an optional argument gives, if it was given.
#[cfg(any(
    feature = "camera",
    feature = "hid",
    feature = "netft",
    feature = "sri"
))]
pub(crate) fn optional_number(args: &Args, key: &str) -> Option<f64> {
    args.get(key).and_then(ArgValue::as_number)
}

/// The greatest speed that may be asked of a robot, at least `least` and `usual` where nobody says otherwise, in mm/s.
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
pub(crate) fn speed_limit(least: f64, usual: f64) -> ArgSpec {
    ArgSpec::number(SPEED_MAX, least, SPEED_LIMIT_MM_S)
        .default(ArgValue::Number(usual))
        .help("the greatest speed of the tip, in mm/s")
        .changes_facts()
}

/// The speed that an argument of [`speed_limit`] gives.
///
/// # Errors
/// [`SpeedError`] where it is none, which its range rules out.
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
pub(crate) fn speed_max(args: &Args) -> Result<Speed, SpeedError> {
    Speed::try_new(args.number(SPEED_MAX))
}

#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
const SPEED_MAX: &str = "speed_max_mm_s";
/// No tip is moved faster: what people beside it are taken to bear of an arm at reduced speed.
#[cfg(any(feature = "gcode", feature = "ur", feature = "xarm"))]
const SPEED_LIMIT_MM_S: f64 = 250.0;
