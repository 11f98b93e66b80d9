//! A serial line, as a file: raw, at a speed, held alone.

use std::fs::File;
use std::io;

use rustix::fs::{Mode, OFlags, fcntl_setfl, open};
use rustix::termios::{
    ControlModes, OptionalActions, QueueSelector, SpecialCodeIndex, ioctl_tiocexcl, isatty,
    tcflush, tcgetattr, tcsetattr,
};
use taceva_core::ErrorKind;
use thiserror::Error;

use crate::text::shown;

/// Why a serial line was not opened.
#[derive(Debug, Error)]
pub(super) enum PortError {
    #[error("cannot open {}: {source}", shown(.path))]
    Open { path: String, source: io::Error },
    #[error("{} is no serial line, expected one such as /dev/ttyUSB0", shown(.path))]
    NoTerminal { path: String },
    #[error("{} cannot be set to {baud} baud: {source}", shown(.path))]
    Speed {
        path: String,
        baud: u32,
        source: io::Error,
    },
}

impl PortError {
    /// What kind of failure it is.
    pub(super) fn kind(&self) -> ErrorKind {
        match self {
            PortError::Open { source, .. } => match source.kind() {
                io::ErrorKind::PermissionDenied => ErrorKind::PermissionDenied,
                io::ErrorKind::ResourceBusy => ErrorKind::Busy,
                _ => ErrorKind::NotFound,
            },
            PortError::NoTerminal { .. } => ErrorKind::InvalidArgument,
            PortError::Speed { .. } => ErrorKind::Unsupported,
        }
    }
}

/// Opens the line at `path` with eight bits, no parity and no flow control; nobody but root can open it after that.
///
/// A read of it returns after at most a tenth of a second, with nothing if nothing came.
pub(super) fn open_line(path: &str, baud: u32) -> Result<File, PortError> {
    let refused = |source: rustix::io::Errno| PortError::Open {
        path: path.to_owned(),
        source: source.into(),
    };
    // Without waiting for a carrier, which no machine gives; after that reads and writes wait.
    let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::NONBLOCK | OFlags::CLOEXEC;
    let line = open(path, flags, Mode::empty()).map_err(refused)?;
    if !isatty(&line) {
        return Err(PortError::NoTerminal {
            path: path.to_owned(),
        });
    }
    ioctl_tiocexcl(&line).map_err(refused)?;
    fcntl_setfl(&line, OFlags::empty()).map_err(refused)?;
    let unset = |source: io::Error| PortError::Speed {
        path: path.to_owned(),
        baud,
        source,
    };
    let mut settings = tcgetattr(&line).map_err(refused)?;
    settings.make_raw();
    settings.control_modes |= ControlModes::CLOCAL | ControlModes::CREAD;
    settings.control_modes &= !(ControlModes::CSTOPB | ControlModes::CRTSCTS);
    settings.special_codes[SpecialCodeIndex::VMIN] = 0;
    settings.special_codes[SpecialCodeIndex::VTIME] = 1;
    settings
        .set_speed(baud)
        .map_err(|source| unset(source.into()))?;
    tcsetattr(&line, OptionalActions::Now, &settings).map_err(|source| unset(source.into()))?;
    tcflush(&line, QueueSelector::IOFlush).map_err(refused)?;
    Ok(File::from(line))
}
