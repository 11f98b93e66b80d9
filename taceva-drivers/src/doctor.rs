//! Diagnosis of the machine: usable devices, problems and remedies.
//!
//! The diagnosis opens no device, because opening a serial port may reset the connected device. It reads permissions, and names the programs of the
//! same user that have a device open.

mod diagnosis;
mod machine;
#[cfg(feature = "plugin")]
mod plugins;
pub(crate) mod port_driver;
mod ports;
mod usb;
mod user;

pub use diagnosis::{Diagnosis, State};
pub use machine::Machine;
#[cfg(feature = "plugin")]
pub use plugins::examine_plugins;
pub use usb::UsbDevice;

use crate::devices::{Devices, devices};
use crate::drivers::Drivers;

/// Examines `drivers` and `machine`. The order of the results is fixed.
pub fn examine(drivers: &Drivers, machine: &Machine) -> Vec<Diagnosis> {
    let listed = devices(drivers);
    let keys: Vec<&str> = listed
        .drivers
        .iter()
        .map(|driver| driver.key.as_str())
        .collect();
    let switches = listed.switches.iter().map(|switch| switch.key.as_str());
    let names: Vec<&str> = keys.iter().copied().chain(switches).collect();
    let mut findings = of_drivers(&listed, &names);
    let user = machine.user();
    if user.is_none() {
        findings.push(Diagnosis {
            code: "user-unknown",
            state: State::Problem,
            subject: "permissions".to_owned(),
            detail: "the user who runs the program cannot be read from /proc".to_owned(),
            remedy: Some("check by hand that you may read and write the device files".to_owned()),
        });
    }
    for kind in ports::KINDS {
        findings.extend(ports::examine(machine, user.as_ref(), kind, &keys));
    }
    findings.extend(usb::examine(machine));
    findings
}

fn of_drivers(listed: &Devices, keys: &[&str]) -> Vec<Diagnosis> {
    let mut findings = vec![Diagnosis {
        code: "drivers",
        state: State::Good,
        subject: "drivers".to_owned(),
        detail: keys.join(", "),
        remedy: None,
    }];
    findings.extend(listed.failed.iter().map(|error| Diagnosis {
        code: "driver-failed",
        state: State::Problem,
        subject: error.driver().to_string(),
        detail: error.to_string(),
        remedy: None,
    }));
    findings
}
