//! USB devices in manifests, listed without opening them or running plugin code.

use nusb::{DeviceInfo, MaybeFuture as _};

use crate::manifest::UsbId;

/// A connected USB device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct UsbDevice {
    pub(crate) id: UsbId,
    /// Product name of the device; `None` if it has none.
    pub(crate) product: Option<String>,
}

/// Connected USB devices, sorted by bus and port. Empty if the system cannot list devices.
pub(crate) fn plugged_in() -> Vec<UsbDevice> {
    let Ok(listed) = nusb::list_devices().wait() else {
        return Vec::new();
    };
    let mut devices: Vec<DeviceInfo> = listed.collect();
    devices.sort_by(|first, second| place(first).cmp(&place(second)));
    devices.iter().map(UsbDevice::of).collect()
}

fn place(device: &DeviceInfo) -> (&str, &[u8]) {
    (device.bus_id(), device.port_chain())
}

impl UsbDevice {
    /// Reads the system's record of a device, without opening it.
    fn of(device: &DeviceInfo) -> UsbDevice {
        UsbDevice {
            id: UsbId {
                vendor: device.vendor_id(),
                product: device.product_id(),
            },
            product: device
                .product_string()
                .map(|name| crate::text::shown(name.trim())),
        }
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;
    use std::fs;

    /// In the kernel's list, only devices have a port as name, such as `1-2`. Root hubs (`usb1`) and interfaces (`1-2:1.0`) do not count.
    #[test]
    fn as_many_devices_are_listed_as_the_kernel_has() {
        let listed = fs::read_dir("/sys/bus/usb/devices").into_iter().flatten();
        let names = listed.flatten().map(|entry| entry.file_name());
        let devices = names.filter(|name| {
            let name = name.to_string_lossy();
            name.contains('-') && !name.contains(':')
        });
        assert_eq!(plugged_in().len(), devices.count());
    }
}
