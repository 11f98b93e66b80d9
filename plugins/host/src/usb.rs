//! Devices on USB that a manifest names, seen without opening any and without running code of a plugin.

use std::fs;
use std::path::Path;

use crate::manifest::UsbId;

/// A device that is plugged in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct UsbDevice {
    pub(crate) id: UsbId,
    /// What it calls itself, where it does.
    pub(crate) product: Option<String>,
}

/// What is plugged in, as the kernel lists it below `root`, `/sys/bus/usb/devices` on Linux; in the order of its names.
pub(crate) fn plugged_in(root: &Path) -> Vec<UsbDevice> {
    let Ok(entries) = fs::read_dir(root) else {
        return Vec::new();
    };
    let mut folders: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    folders.sort();
    let number = |folder: &Path, name: &str| {
        let text = fs::read_to_string(folder.join(name)).ok()?;
        u16::from_str_radix(text.trim(), 16).ok()
    };
    let devices = folders.iter().filter_map(|folder| {
        let vendor = number(folder, "idVendor")?;
        let product = number(folder, "idProduct")?;
        let name = fs::read_to_string(folder.join("product")).ok();
        Some(UsbDevice {
            id: UsbId { vendor, product },
            product: name.map(|name| crate::shown::shown(name.trim())),
        })
    });
    devices.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_are_read_as_the_kernel_writes_them() {
        let root = tempfile::tempdir().expect("a folder");
        let device = root.path().join("1-2");
        fs::create_dir(&device).expect("made");
        fs::create_dir(root.path().join("1-0:1.0")).expect("made");
        for (name, text) in [
            ("idVendor", "2833\n"),
            ("idProduct", "0209\n"),
            ("product", "DIGIT\n"),
        ] {
            fs::write(device.join(name), text).expect("written");
        }
        let [found] = &plugged_in(root.path())[..] else {
            panic!("one device");
        };
        let id = UsbId {
            vendor: 0x2833,
            product: 0x0209,
        };
        assert_eq!((found.id, found.product.as_deref()), (id, Some("DIGIT")));
        assert!(plugged_in(Path::new("/nonexistent")).is_empty());
    }
}
