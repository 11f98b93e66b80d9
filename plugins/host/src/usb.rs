//! Devices on USB that a manifest names, found without opening any and without running code of a plugin.

use nusb::{DeviceInfo, MaybeFuture as _};

use crate::manifest::UsbId;

/// A device that is plugged in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct UsbDevice {
    pub(crate) id: UsbId,
    /// What it calls itself, where it does.
    pub(crate) product: Option<String>,
}

/// What is plugged in, by bus and port; nothing on a system that lists no devices.
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
    /// What the system has read of a device already; it is not opened.
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

    /// Devices, not hubs of the machine nor interfaces, have a port in their name: `1-2`, not `usb1` nor `1-2:1.0`.
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
