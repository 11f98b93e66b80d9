//! Emulated HID devices, which the kernel offers under `/dev/hidraw*`. They need access to `/dev/uhid`.
//!
//! A device has a report descriptor, and sends reports when a test asks for it. USB, and reports from a program to the device, are not supported.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

use crate::error::WireError;

/// Emulated device, unplugged on drop.
#[derive(Debug)]
pub struct Emulator {
    /// File of the device. Closing this file removes the device.
    uhid: File,
}

/// Name, numbers and report descriptor of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identity {
    /// Name of the device.
    pub name: &'static str,
    /// Serial number of the device.
    pub serial: &'static str,
    /// Vendor and product id.
    pub numbers: [u16; 2],
    /// Report descriptor.
    pub descriptor: &'static [u8],
}

/// A scale of the usage page of weighing devices: report 3 with status, unit, exponent and weight.
pub const SCALE: Identity = Identity {
    name: "Emulated scale",
    serial: "EMU-1",
    numbers: [0x0922, 0x8003],
    descriptor: &[
        0x05, 0x8d, 0x09, 0x20, 0xa1, 0x01, // Scale
        0x85, 0x03, // Report 3
        0x09, 0x70, 0xa1, 0x02, 0x19, 0x71, 0x29, 0x78, // one of eight states
        0x15, 0x01, 0x25, 0x08, 0x75, 0x08, 0x95, 0x01, 0x81, 0x00, 0xc0, //
        0x09, 0x50, 0xa1, 0x02, 0x19, 0x51, 0x29, 0x5c, // one of twelve units
        0x15, 0x01, 0x25, 0x0c, 0x75, 0x08, 0x95, 0x01, 0x81, 0x00, 0xc0, //
        0x09, 0x41, 0x15, 0x81, 0x25, 0x7f, 0x75, 0x08, 0x95, 0x01, 0x81, 0x02, // exponent
        0x09, 0x40, 0x15, 0x00, 0x27, 0xff, 0xff, 0x00, 0x00, // weight
        0x75, 0x10, 0x95, 0x01, 0x81, 0x02, 0xc0,
    ],
};

/// A pedal that acts as a keyboard: modifiers, an unused byte, six keys.
pub const PEDAL: Identity = Identity {
    name: "Emulated pedal",
    serial: "EMU-2",
    numbers: [0x0c45, 0x7403],
    descriptor: &[
        0x05, 0x01, 0x09, 0x06, 0xa1, 0x01, // Keyboard
        0x05, 0x07, 0x19, 0xe0, 0x29, 0xe7, // modifiers
        0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x08, 0x81, 0x02, //
        0x95, 0x01, 0x75, 0x08, 0x81, 0x01, // nothing
        0x19, 0x00, 0x29, 0x65, 0x15, 0x00, 0x25, 0x65, // keys
        0x95, 0x06, 0x75, 0x08, 0x81, 0x00, 0xc0,
    ],
};

/// Number of the event of `/dev/uhid` that creates a device; [`INPUT`] is the event of a report. The others are text sizes, bytes, and the bus number
/// of USB (`linux/uhid.h`).
const CREATE: u32 = 11;
const INPUT: u32 = 12;
const NAME: usize = 128;
const PLACE: usize = 64;
const SERIAL: usize = 64;
const DATA: usize = 4096;
const USB: u16 = 3;

impl Emulator {
    /// Plugs a device in.
    ///
    /// # Errors
    /// [`WireError`] if `/dev/uhid` is missing or may not be opened.
    pub fn start(identity: &Identity) -> Result<Emulator, WireError> {
        let path = Path::new("/dev/uhid");
        let refused = |source: io::Error| WireError::Listen {
            address: path.display().to_string(),
            source,
        };
        let mut uhid = File::options()
            .read(true)
            .write(true)
            .open(path)
            .map_err(refused)?;
        uhid.write_all(&created(identity)).map_err(refused)?;
        Ok(Emulator { uhid })
    }

    /// Sends a report, with its number first if reports are numbered.
    ///
    /// # Errors
    /// Errors of the kernel; also for a report beyond the maximum length.
    pub fn report(&mut self, report: &[u8]) -> io::Result<()> {
        let length = u16::try_from(report.len()).map_err(io::Error::other)?;
        let mut event = Vec::with_capacity(6 + DATA);
        event.extend(INPUT.to_ne_bytes());
        event.extend(length.to_ne_bytes());
        event.extend(padded(report, DATA));
        self.uhid.write_all(&event)
    }
}

fn created(identity: &Identity) -> Vec<u8> {
    let Identity {
        name,
        serial,
        numbers: [vendor, product],
        descriptor,
    } = identity;
    let length = u16::try_from(descriptor.len()).unwrap_or(0);
    let mut event = CREATE.to_ne_bytes().to_vec();
    event.extend(padded(name.as_bytes(), NAME));
    event.extend(padded(b"emulated", PLACE));
    event.extend(padded(serial.as_bytes(), SERIAL));
    event.extend(length.to_ne_bytes());
    event.extend(USB.to_ne_bytes());
    for number in [u32::from(*vendor), u32::from(*product), 1, 0] {
        event.extend(number.to_ne_bytes());
    }
    event.extend(padded(descriptor, DATA));
    event
}

/// `bytes` padded with zeros to `length`.
fn padded(bytes: &[u8], length: usize) -> Vec<u8> {
    let mut padded = bytes.to_vec();
    padded.resize(length, 0);
    padded
}
