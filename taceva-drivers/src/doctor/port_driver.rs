//! Drivers that open a device file, each declared in the folder of its driver.

use taceva_core::{DriverKey, inventory};

use super::machine::Machine;

/// Class of device files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PortClass {
    /// Cameras, `/dev/video*`.
    Camera,
    /// Serial ports.
    Serial,
    /// HID devices, `/dev/hidraw*`.
    Hid,
}

/// Driver that opens device files of one class.
pub(crate) struct PortDriver {
    /// Class of the files.
    pub(crate) class: PortClass,
    /// Key of the driver.
    pub(crate) key: DriverKey,
    /// Argument of its selector that names the file.
    pub(crate) argument: &'static str,
    /// Function that is true if the driver can use the named file below `/dev`, according to system files.
    pub(crate) reads: fn(&Machine, &str) -> bool,
}

inventory::collect!(PortDriver);

/// Drivers that open files of `class`, by key.
pub(super) fn drivers_of(class: PortClass) -> Vec<&'static PortDriver> {
    let mut drivers: Vec<&PortDriver> = inventory::iter::<PortDriver>
        .into_iter()
        .filter(|driver| driver.class == class)
        .collect();
    drivers.sort_by(|one, other| one.key.cmp(&other.key));
    drivers
}
