//! Diagnosis of known USB sensors and gauges, with or without a kernel driver.

use nusb::{DeviceInfo, MaybeFuture as _};

use super::diagnosis::{Diagnosis, State};
use super::machine::Machine;
use crate::name_order;
use crate::text::shown;

/// USB device that the diagnosis identifies by vendor and product id.
struct Known {
    vendor: u16,
    product: u16,
    title: &'static str,
    /// Prefix of the device file that the kernel driver should create.
    file: &'static str,
    remedy: &'static str,
}

const CAMERA_REMEDY: &str = "load the kernel driver for cameras: sudo modprobe uvcvideo";
const SCALE_REMEDY: &str = "load the kernel driver for HID devices: sudo modprobe usbhid";

const KNOWN: &[Known] = &[
    Known {
        vendor: 0x2833,
        product: 0x0209,
        title: "DIGIT tactile sensor",
        file: "video",
        remedy: CAMERA_REMEDY,
    },
    Known {
        vendor: 0x0922,
        product: 0x8003,
        title: "Dymo scale",
        file: "hidraw",
        remedy: SCALE_REMEDY,
    },
    Known {
        vendor: 0x0922,
        product: 0x8004,
        title: "Dymo scale",
        file: "hidraw",
        remedy: SCALE_REMEDY,
    },
    Known {
        vendor: 0x0eb8,
        product: 0xf000,
        title: "Mettler PS60 scale",
        file: "hidraw",
        remedy: SCALE_REMEDY,
    },
];

/// USB device, as the operating system lists it.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct UsbDevice {
    /// Bus and port numbers, such as `1-2.4`.
    pub port: String,
    /// Vendor id.
    pub vendor: u16,
    /// Product id.
    pub product: u16,
    /// Serial number; `None` if the device has none.
    pub serial: Option<String>,
}

impl UsbDevice {
    /// Describes the device at `port` with its vendor and product id.
    pub fn new(port: impl Into<String>, vendor: u16, product: u16) -> UsbDevice {
        UsbDevice {
            port: port.into(),
            vendor,
            product,
            serial: None,
        }
    }

    /// Sets the serial number.
    pub fn with_serial(self, serial: impl Into<String>) -> UsbDevice {
        UsbDevice {
            serial: Some(serial.into()),
            ..self
        }
    }

    /// Converts the record of the operating system, without opening the device.
    fn of(device: &DeviceInfo) -> UsbDevice {
        let ports: Vec<String> = device.port_chain().iter().map(u8::to_string).collect();
        let bus = device.bus_id();
        // The system pads bus numbers with zeros in lists but not in names.
        let bus = bus.trim_start_matches('0');
        UsbDevice {
            port: format!("{bus}-{}", ports.join(".")),
            vendor: device.vendor_id(),
            product: device.product_id(),
            serial: device.serial_number().map(str::to_owned),
        }
    }
}

/// Connected USB devices, sorted by port, or the reason why they cannot be listed.
pub(super) fn plugged_in() -> Result<Vec<UsbDevice>, String> {
    let listed = nusb::list_devices().wait();
    let listed = listed.map_err(|error| error.to_string())?;
    let mut devices: Vec<UsbDevice> = listed.map(|device| UsbDevice::of(&device)).collect();
    devices.sort_by(|first, second| name_order::compare(&first.port, &second.port));
    Ok(devices)
}

pub(super) fn examine(machine: &Machine) -> Vec<Diagnosis> {
    let devices = match &machine.usb {
        Ok(devices) => devices,
        Err(why) => return vec![unknown(why)],
    };
    let files = machine.names("dev");
    let findings = devices.iter().filter_map(|device| {
        let known = KNOWN
            .iter()
            .find(|known| (known.vendor, known.product) == (device.vendor, device.product))?;
        // Other systems than Linux have no device files here.
        let has_file =
            !cfg!(target_os = "linux") || files.iter().any(|name| name.starts_with(known.file));
        Some(known.finding(device, has_file))
    });
    findings.collect()
}

/// Diagnosis for a system whose USB devices cannot be listed, such as a container. `why` is the reason.
fn unknown(why: &str) -> Diagnosis {
    Diagnosis {
        code: "usb-unknown",
        state: State::Absent,
        subject: "USB".to_owned(),
        detail: format!("its devices cannot be listed: {}", shown(why)),
        remedy: None,
    }
}

impl Known {
    fn finding(&self, device: &UsbDevice, has_file: bool) -> Diagnosis {
        let serial = device.serial.as_ref().map_or_else(String::new, |serial| {
            format!(", serial number {}", shown(serial))
        });
        let (code, state) = match has_file {
            true => ("usb", State::Good),
            false => ("usb-without-driver", State::Problem),
        };
        Diagnosis {
            code,
            state,
            subject: format!("USB {}", shown(&device.port)),
            detail: format!("{}{serial}", self.title),
            remedy: (!has_file).then(|| self.remedy.to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_that_lists_no_usb_says_why() {
        let mut machine = Machine::at("/nonexistent");
        machine.usb = Err("/sys/bus/usb/devices/ not found".to_owned());
        let [finding] = &examine(&machine)[..] else {
            panic!("one finding");
        };
        assert_eq!(finding.state, State::Absent);
        assert!(finding.detail.ends_with("not found"), "{}", finding.detail);
    }

    #[test]
    fn what_is_plugged_in_is_in_the_order_of_the_ports() {
        let Ok(devices) = plugged_in() else { return };
        let ordered = devices
            .is_sorted_by(|first, second| name_order::compare(&first.port, &second.port).is_le());
        assert!(ordered, "{devices:?}");
    }
}
