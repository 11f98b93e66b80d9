//! Selection and opening of a HID device.

use std::ffi::CString;
use std::fmt;
use std::io;
use std::path::Path;

use hidapi::{DeviceInfo, HidApi, HidDevice, HidError};
use taceva_core::{Access, ArgSpec, Args, DriverKey, ErrorKind, Found};
use thiserror::Error;

use crate::present::access_of;
use crate::text::shown;

/// Criteria that select a HID device. A criterion of `None` matches any device.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Selection {
    /// Device file, such as `/dev/hidraw0`.
    pub(super) device: Option<String>,
    /// Vendor and product id.
    pub(super) numbers: Option<[u16; 2]>,
    pub(super) serial: Option<String>,
}

/// Failure to open a HID device.
#[derive(Debug, Error)]
pub(super) enum HidOpenError {
    #[error("`usb` is `{}`, expected two numbers of four hexadecimal digits: `0922:8003`", shown(.0))]
    Numbers(String),
    #[error("the HID devices of this machine cannot be listed: {0}")]
    List(HidError),
    #[error("no HID device matches: expected {expected}, found {found}")]
    None { expected: String, found: String },
    #[error("several HID devices match: {found}; select one by `serial=`, `usb=` or `device=`")]
    Several { found: String },
    #[error(
        "no HID device is selected: select one by `usb=`, `serial=` or `device=`; found {found}"
    )]
    Unnamed { found: String },
    #[error("{}: {source}", shown(.path))]
    Refused { path: String, source: io::Error },
    #[error("{} is not a HID device: {why}", shown(.path))]
    Foreign { path: String, why: String },
}

impl HidOpenError {
    /// Kind of the failure.
    pub(super) fn kind(&self) -> ErrorKind {
        match self {
            HidOpenError::Numbers(_)
            | HidOpenError::Several { .. }
            | HidOpenError::Unnamed { .. }
            | HidOpenError::Foreign { .. } => ErrorKind::InvalidArgument,
            HidOpenError::List(_) => ErrorKind::Internal,
            HidOpenError::None { .. } => ErrorKind::NotFound,
            HidOpenError::Refused { source, .. } => match source.kind() {
                io::ErrorKind::PermissionDenied => ErrorKind::PermissionDenied,
                io::ErrorKind::ResourceBusy => ErrorKind::Busy,
                _ => ErrorKind::NotFound,
            },
        }
    }
}

/// A connected HID device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Present {
    path: String,
    numbers: [u16; 2],
    serial: String,
    title: String,
    usages: Vec<(u16, u16)>,
}

impl fmt::Display for Present {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [vendor, product] = self.numbers;
        write!(f, "{} ({vendor:04x}:{product:04x}", shown(&self.path))?;
        if !self.serial.is_empty() {
            write!(f, ", serial {}", shown(&self.serial))?;
        }
        f.write_str(")")
    }
}

impl Present {
    /// Lists all HID devices of this machine, sorted by device file.
    pub(super) fn all() -> Result<Vec<Present>, HidOpenError> {
        let api = HidApi::new().map_err(HidOpenError::List)?;
        let mut all: Vec<Present> = Vec::new();
        for info in api.device_list() {
            let path = info.path().to_string_lossy().into_owned();
            let usage = (info.usage_page(), info.usage());
            // The list has one entry per collection of a device.
            match all.iter_mut().find(|present| present.path == path) {
                Some(present) => present.usages.push(usage),
                None => all.push(Present::of(info, path, usage)),
            }
        }
        all.sort_by(|one, other| crate::name_order::compare(&one.path, &other.path));
        Ok(all)
    }

    fn of(info: &DeviceInfo, path: String, usage: (u16, u16)) -> Present {
        Present {
            path,
            numbers: [info.vendor_id(), info.product_id()],
            serial: info.serial_number().unwrap_or_default().to_owned(),
            title: info.product_string().unwrap_or_default().to_owned(),
            usages: vec![usage],
        }
    }

    /// True if one of the device's HID collections has this usage page and usage.
    pub(super) fn has_usage(&self, usage: (u16, u16)) -> bool {
        self.usages.contains(&usage)
    }

    /// Describes the device for `driver`, with the arguments that select it.
    pub(super) fn found(&self, driver: DriverKey) -> Found {
        let [vendor, product] = self.numbers;
        let usual = |letter: char| letter.is_ascii_alphanumeric() || "-_.".contains(letter);
        let arguments = match self.serial.chars().all(usual) && !self.serial.is_empty() {
            true => format!("usb={vendor:04x}:{product:04x};serial={}", self.serial),
            false => format!("usb={vendor:04x}:{product:04x}"),
        };
        let title = match self.title.is_empty() {
            true => self.path.clone(),
            false => self.title.clone(),
        };
        let access = match access_of(Path::new(&self.path), "plugdev") {
            // By default no group owns HID devices.
            Access::Denied { .. } => Access::Denied {
                remedy: format!(
                    "permit it by a udev rule: KERNEL==\"hidraw*\", ATTRS{{idVendor}}==\"{vendor:04x}\", TAG+=\"uaccess\""
                ),
            },
            access => access,
        };
        Found::new(driver, shown(&title))
            .with_arguments(arguments)
            .with_access(access)
    }
}

impl Selection {
    /// Arguments that select a device.
    pub(super) fn arguments() -> [ArgSpec; 3] {
        [
            ArgSpec::text("usb")
                .optional()
                .help("vendor and product id in hexadecimal, such as 0922:8003"),
            ArgSpec::text("serial")
                .optional()
                .help("serial number, if several devices match"),
            ArgSpec::path("device").optional().help(
                "device file, such as /dev/hidraw0; it may change when the device is plugged in again",
            ),
        ]
    }

    /// Reads the criteria from `args`.
    pub(super) fn of(args: &Args) -> Result<Selection, HidOpenError> {
        let text = |key| args.get(key).and_then(|value| value.as_text());
        Ok(Selection {
            device: text("device").map(str::to_owned),
            numbers: text("usb").map(numbers).transpose()?,
            serial: text("serial").map(str::to_owned),
        })
    }

    /// Opens the only matching device. `usage`, a usage page and a usage, restricts the search unless vendor and product are given. Without `usage`,
    /// at least one criterion is required, because otherwise any mouse would match.
    pub(super) fn open(&self, usage: Option<(u16, u16)>) -> Result<HidDevice, HidOpenError> {
        if let Some(path) = &self.device {
            return open(path);
        }
        let present = Present::all()?;
        if usage.is_none() && *self == Selection::default() {
            return Err(HidOpenError::Unnamed {
                found: listed(present.iter()),
            });
        }
        open(&self.only(&present, usage)?.path)
    }

    fn only<'a>(
        &self,
        present: &'a [Present],
        usage: Option<(u16, u16)>,
    ) -> Result<&'a Present, HidOpenError> {
        let fits = |one: &&Present| {
            let by_numbers = match (self.numbers, usage) {
                (Some(numbers), _) => one.numbers == numbers,
                (None, Some(usage)) => one.has_usage(usage),
                (None, None) => true,
            };
            by_numbers
                && self
                    .serial
                    .as_ref()
                    .is_none_or(|serial| one.serial == *serial)
        };
        let fitting: Vec<&Present> = present.iter().filter(fits).collect();
        match fitting[..] {
            [one] => Ok(one),
            [] => Err(HidOpenError::None {
                expected: self.expected(usage),
                found: listed(present.iter()),
            }),
            _ => Err(HidOpenError::Several {
                found: listed(fitting.into_iter()),
            }),
        }
    }

    fn expected(&self, usage: Option<(u16, u16)>) -> String {
        let mut expected = match (self.numbers, usage) {
            (Some([vendor, product]), _) => format!("{vendor:04x}:{product:04x}"),
            (None, Some((page, usage))) => format!("one of usage {page:02x}/{usage:02x}"),
            (None, None) => "one".to_owned(),
        };
        if let Some(serial) = &self.serial {
            expected += &format!(" with the serial number {}", shown(serial));
        }
        expected
    }
}

fn listed<'a>(present: impl Iterator<Item = &'a Present>) -> String {
    let listed: Vec<String> = present.map(ToString::to_string).collect();
    match listed.is_empty() {
        true => "none".to_owned(),
        false => listed.join(", "),
    }
}

fn numbers(text: &str) -> Result<[u16; 2], HidOpenError> {
    let number = |text: &str| {
        let is_whole = text.len() == 4 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        is_whole
            .then(|| u16::from_str_radix(text, 16).ok())
            .flatten()
    };
    text.split_once(':')
        .and_then(|(vendor, product)| Some([number(vendor)?, number(product)?]))
        .ok_or_else(|| HidOpenError::Numbers(text.to_owned()))
}

fn open(path: &str) -> Result<HidDevice, HidOpenError> {
    // The library gives only a sentence for a file that does not open. Open it again to get the system's error kind.
    let refused = |source| HidOpenError::Refused {
        path: path.to_owned(),
        source,
    };
    let foreign = |why: String| HidOpenError::Foreign {
        path: path.to_owned(),
        why,
    };
    let name = CString::new(path).map_err(|error| foreign(error.to_string()))?;
    let api = HidApi::new().map_err(HidOpenError::List)?;
    api.open_path(&name).map_err(|error| {
        let again = std::fs::File::options().read(true).write(true).open(path);
        match again {
            Err(source) => refused(source),
            Ok(_) => foreign(error.to_string()),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn present(path: &str, numbers: [u16; 2], serial: &str, usage: (u16, u16)) -> Present {
        Present {
            path: path.to_owned(),
            numbers,
            serial: serial.to_owned(),
            title: String::new(),
            usages: vec![usage, (1, 6)],
        }
    }

    const SCALE: (u16, u16) = (0x8d, 0x20);

    #[test]
    fn one_device_is_meant_or_the_error_lists_what_is_there() {
        let all = [
            present("/dev/hidraw0", [0x46d, 0xc31c], "", (1, 6)),
            present("/dev/hidraw1", [0x922, 0x8003], "A1", SCALE),
            present("/dev/hidraw2", [0x922, 0x8003], "B2", SCALE),
        ];
        let any = Selection::default();
        assert_eq!(
            any.only(&all[..2], Some(SCALE)).expect("one").path,
            "/dev/hidraw1"
        );
        let several = any.only(&all, Some(SCALE)).expect_err("two");
        assert_eq!(several.kind(), ErrorKind::InvalidArgument);
        assert!(
            several
                .to_string()
                .contains("hidraw2 (0922:8003, serial B2)"),
            "{several}"
        );
        let second = Selection {
            serial: Some("B2".to_owned()),
            ..Selection::default()
        };
        assert_eq!(
            second.only(&all, Some(SCALE)).expect("one").path,
            "/dev/hidraw2"
        );
        let absent = Selection {
            numbers: Some([0xeb8, 0xf000]),
            ..Selection::default()
        };
        let none = absent.only(&all[..1], Some(SCALE)).expect_err("none");
        assert_eq!(none.kind(), ErrorKind::NotFound);
        assert_eq!(
            none.to_string(),
            "no HID device matches: expected 0eb8:f000, found /dev/hidraw0 (046d:c31c)"
        );
    }

    #[test]
    fn numbers_are_four_digits_each() {
        assert_eq!(numbers("0922:8003").expect("good"), [0x922, 0x8003]);
        for bad in [
            "",
            "0922",
            "922:8003",
            "0922:80033",
            "+922:8003",
            "0922:800g",
            "é922:8003",
        ] {
            assert!(numbers(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn what_cannot_be_opened_is_said_by_its_kind() {
        let unnamed = Selection::default().open(None).map(drop);
        assert_eq!(
            unnamed.expect_err("any device").kind(),
            ErrorKind::InvalidArgument
        );
        assert_eq!(
            open("/dev/no-such-hidraw")
                .map(drop)
                .expect_err("none")
                .kind(),
            ErrorKind::NotFound
        );
        assert_eq!(
            open("/dev/null").map(drop).expect_err("foreign").kind(),
            ErrorKind::InvalidArgument
        );
        assert_eq!(
            open("/dev/n\0ll").map(drop).expect_err("foreign").kind(),
            ErrorKind::InvalidArgument
        );
    }
}
