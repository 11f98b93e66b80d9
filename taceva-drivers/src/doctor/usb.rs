//! Known sensors and gauges on the USB, whether or not the kernel has a driver for them.

use super::finding::{Finding, State};
use super::machine::Machine;
use crate::text::shown;

/// A device that is known by its numbers.
struct Known {
    vendor: &'static str,
    product: &'static str,
    title: &'static str,
    /// The start of the name of the device file that it should have.
    file: &'static str,
    remedy: &'static str,
}

const CAMERA_REMEDY: &str = "load the kernel's driver for cameras: sudo modprobe uvcvideo";
const SCALE_REMEDY: &str = "load the kernel's driver for HID devices: sudo modprobe usbhid";

const KNOWN: &[Known] = &[
    Known {
        vendor: "2833",
        product: "0209",
        title: "DIGIT tactile sensor",
        file: "video",
        remedy: CAMERA_REMEDY,
    },
    Known {
        vendor: "0922",
        product: "8003",
        title: "Dymo scale",
        file: "hidraw",
        remedy: SCALE_REMEDY,
    },
    Known {
        vendor: "0922",
        product: "8004",
        title: "Dymo scale",
        file: "hidraw",
        remedy: SCALE_REMEDY,
    },
    Known {
        vendor: "0eb8",
        product: "f000",
        title: "Mettler PS60 scale",
        file: "hidraw",
        remedy: SCALE_REMEDY,
    },
];

const DEVICES: &str = "sys/bus/usb/devices";

pub(super) fn examine(machine: &Machine) -> Vec<Finding> {
    let files = machine.names("dev");
    let mut findings = Vec::new();
    for port in machine.names(DEVICES) {
        let text = |file: &str| machine.text(&format!("{DEVICES}/{port}/{file}"));
        let (vendor, product) = (text("idVendor"), text("idProduct"));
        let known = KNOWN.iter().find(|known| {
            vendor.as_deref() == Some(known.vendor) && product.as_deref() == Some(known.product)
        });
        let Some(known) = known else { continue };
        let serial = text("serial").map_or_else(String::new, |serial| {
            format!(", serial number {}", shown(&serial))
        });
        let has_file = files.iter().any(|name| name.starts_with(known.file));
        findings.push(Finding {
            code: if has_file {
                "usb"
            } else {
                "usb-without-driver"
            },
            state: if has_file {
                State::Good
            } else {
                State::Problem
            },
            subject: format!("USB {port}"),
            detail: format!("{}{serial}", known.title),
            remedy: (!has_file).then(|| known.remedy.to_owned()),
        });
    }
    findings
}
