//! What the devices have in common: the argument that names their bench, and how their errors are made.

use taceva_core::{ArgSpec, ArgValue, Args, DriverError, DriverKey, ErrorKind};

/// The key of the robot, which the bench names too where it cannot exchange the specimen.
pub(super) const ROBOT: DriverKey = DriverKey::fixed("sim/robot");

/// The argument by which devices find each other.
pub(super) fn rig_argument() -> ArgSpec {
    ArgSpec::text("rig")
        .default(ArgValue::Text("bench".to_owned()))
        .help("the name of the bench; devices of one name work on one gel")
}

/// The name of the bench in `args`.
pub(super) fn rig_name(args: &Args) -> &str {
    args.text("rig")
}

/// An error of a device with its reason.
pub(super) fn failed(
    kind: ErrorKind,
    driver: &DriverKey,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, driver, doing).because(why)
}
