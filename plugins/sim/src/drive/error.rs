//! Common parts of the devices: the argument that names their bench, and their errors.

use taceva_core::{ArgSpec, ArgValue, Args, DriverError, DriverKey, ErrorKind};

/// Key of the robot, which also reports failed mounts of specimens.
pub(super) const ROBOT: DriverKey = DriverKey::fixed("sim/robot");

/// Argument with the name of the bench. Devices with the same name share a bench.
pub(super) fn rig_argument() -> ArgSpec {
    ArgSpec::text("rig")
        .default(ArgValue::Text("bench".to_owned()))
        .help("name of the bench; devices with the same name share one gel")
}

/// Name of the bench in `args`.
pub(super) fn rig_name(args: &Args) -> &str {
    args.text("rig")
}

/// Creates an error of a device, with its reason.
pub(super) fn failed(
    kind: ErrorKind,
    driver: &DriverKey,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, driver, doing).because(why)
}
