//! Diagnosis of cameras, serial ports and HID devices: presence and permissions.

use std::fs;

use super::diagnosis::{Diagnosis, State};
use super::machine::Machine;
use super::port_driver::{PortClass, drivers_of};
use super::user::User;
use crate::text::shown;

/// Class of device files, with its diagnosis codes.
pub(super) struct PortKind {
    /// Codes of the diagnosis for usable, denied and absent files.
    codes: [&'static str; 3],
    prefixes: &'static [&'static str],
    /// Location of the device names: a system folder, and a file below the folder of each device. `None` for a class without names.
    name: Option<(&'static str, &'static str)>,
    noun: &'static str,
    if_absent: &'static str,
    class: PortClass,
}

pub(super) const KINDS: &[PortKind] = &[
    PortKind {
        codes: ["camera", "camera-denied", "camera-absent"],
        prefixes: &["video"],
        name: Some(("sys/class/video4linux", "name")),
        noun: "camera",
        if_absent: "plug in the sensor; if it is plugged in, load the kernel driver: sudo modprobe uvcvideo",
        class: PortClass::Camera,
    },
    PortKind {
        codes: ["serial", "serial-denied", "serial-absent"],
        prefixes: &["ttyACM", "ttyUSB"],
        name: None,
        noun: "serial port",
        if_absent: "plug in the robot or force transducer, if it uses a serial port",
        class: PortClass::Serial,
    },
    PortKind {
        codes: ["hid", "hid-denied", "hid-absent"],
        prefixes: &["hidraw"],
        name: Some(("sys/class/hidraw", "device/uevent")),
        noun: "HID device",
        if_absent: "plug in the scale or pedal, if the rig has one",
        class: PortClass::Hid,
    },
];

/// Examines the device files of `kind`. `keys` are the keys of available drivers.
pub(super) fn examine(
    machine: &Machine,
    user: Option<&User>,
    kind: &PortKind,
    keys: &[&str],
) -> Vec<Diagnosis> {
    let [good, denied, absent] = kind.codes;
    let names = machine.names("dev").into_iter();
    let findings: Vec<Diagnosis> = names
        .filter(|name| kind.matches(name))
        .map(|name| {
            let path = format!("/dev/{name}");
            let metadata = fs::metadata(machine.path(&path[1..])).ok();
            let remedy = user
                .zip(metadata)
                .and_then(|(user, metadata)| user.remedy(&path, &metadata));
            Diagnosis {
                code: if remedy.is_none() { good } else { denied },
                state: if remedy.is_none() {
                    State::Good
                } else {
                    State::Problem
                },
                detail: kind.title(machine, &name)
                    + &kind.opened(machine, &name, keys)
                    + &in_use(machine, &name),
                subject: path,
                remedy,
            }
        })
        .collect();
    if !findings.is_empty() {
        return findings;
    }
    vec![Diagnosis {
        code: absent,
        state: State::Absent,
        subject: format!("/dev/{}*", kind.prefixes.join("*, /dev/")),
        detail: format!("no {}", kind.noun),
        remedy: Some(kind.if_absent.to_owned()),
    }]
}

/// Text that names other programs with an open handle of the device file; empty if none is found.
fn in_use(machine: &Machine, name: &str) -> String {
    #[cfg(unix)]
    let others =
        crate::port_user::other_users(&machine.path("proc"), &machine.path(&format!("dev/{name}")));
    #[cfg(not(unix))]
    let others: Vec<String> = {
        let _ = (machine, name);
        Vec::new()
    };
    match others.is_empty() {
        true => String::new(),
        false => format!("; open in process {}", others.join(", ")),
    }
}

impl PortKind {
    fn matches(&self, name: &str) -> bool {
        self.prefixes.iter().any(|prefix| {
            name.strip_prefix(prefix).is_some_and(|number| {
                !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())
            })
        })
    }

    fn title(&self, machine: &Machine, name: &str) -> String {
        let text = self
            .name
            .and_then(|(class, file)| machine.text(&format!("{class}/{name}/{file}")))
            .unwrap_or_default();
        // A file with several lines names the device in one of them.
        let title = text
            .lines()
            .find_map(|line| line.strip_prefix("HID_NAME="))
            .or_else(|| text.lines().next().filter(|line| !line.contains('=')));
        shown(title.unwrap_or(self.noun))
    }

    /// Text that lists the selectors for this device file; empty if no driver can open it.
    fn opened(&self, machine: &Machine, name: &str, keys: &[&str]) -> String {
        let selectors: Vec<String> = drivers_of(self.class)
            .into_iter()
            .filter(|driver| keys.contains(&driver.key.as_str()) && (driver.reads)(machine, name))
            .map(|driver| format!("`{}:{}=/dev/{name}`", driver.key, driver.argument))
            .collect();
        match selectors.is_empty() {
            true => String::new(),
            false => format!("; opened by {}", selectors.join(" or ")),
        }
    }
}
