//! Registry of the drivers that open a device file.

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
    /// Selector argument that names the device file, such as `port`.
    pub(crate) argument: &'static str,
    /// Returns true if the driver can open the file with this name below `/dev`, according to the system files of the machine.
    pub(crate) reads: fn(&Machine, &str) -> bool,
}

inventory::collect!(PortDriver);

/// Drivers that open files of `class`, sorted by key.
pub(super) fn drivers_of(class: PortClass) -> Vec<&'static PortDriver> {
    let mut drivers: Vec<&PortDriver> = inventory::iter::<PortDriver>
        .into_iter()
        .filter(|driver| driver.class == class)
        .collect();
    drivers.sort_by(|one, other| one.key.cmp(&other.key));
    drivers
}
