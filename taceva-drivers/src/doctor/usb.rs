//! Known sensors and gauges on the USB, whether or not the kernel has a driver for them.

use nusb::{DeviceInfo, MaybeFuture as _};

use super::diagnosis::{Diagnosis, State};
use super::machine::Machine;
use crate::name_order;
use crate::text::shown;

/// A device that is known by its numbers.
struct Known {
    vendor: u16,
    product: u16,
    title: &'static str,
    /// The start of the name of the device file that it should have.
    file: &'static str,
    remedy: &'static str,
}

const CAMERA_REMEDY: &str = "load the kernel's driver for cameras: sudo modprobe uvcvideo";
const SCALE_REMEDY: &str = "load the kernel's driver for HID devices: sudo modprobe usbhid";

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

/// A device on the USB, as it describes itself to the system.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct UsbDevice {
    /// Where it is plugged in: the bus and the numbers of the ports to it, `1-2.4`.
    pub port: String,
    /// The number of its vendor.
    pub vendor: u16,
    /// The number that its vendor gave it.
    pub product: u16,
    /// Its serial number, if it has one.
    pub serial: Option<String>,
}

impl UsbDevice {
    /// The device at `port` with the numbers of its vendor and of itself.
    pub fn new(port: impl Into<String>, vendor: u16, product: u16) -> UsbDevice {
        UsbDevice {
            port: port.into(),
            vendor,
            product,
            serial: None,
        }
    }

    /// The same device with a serial number.
    pub fn with_serial(self, serial: impl Into<String>) -> UsbDevice {
        UsbDevice {
            serial: Some(serial.into()),
            ..self
        }
    }

    /// What the system has read of a device already; it is not opened.
    fn of(device: &DeviceInfo) -> UsbDevice {
        let ports: Vec<String> = device.port_chain().iter().map(u8::to_string).collect();
        let bus = device.bus_id();
        // The system pads the numbers of buses with zeros where it lists them, and not where it names them.
        let bus = bus.trim_start_matches('0');
        UsbDevice {
            port: format!("{bus}-{}", ports.join(".")),
            vendor: device.vendor_id(),
            product: device.product_id(),
            serial: device.serial_number().map(str::to_owned),
        }
    }
}

/// What is plugged into this machine in the order of the ports, or why that is unknown.
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
        // Other systems keep devices elsewhere than in files.
        let has_file =
            !cfg!(target_os = "linux") || files.iter().any(|name| name.starts_with(known.file));
        Some(known.finding(device, has_file))
    });
    findings.collect()
}

/// A system without USB, such as a container, or one that does not list it.
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
