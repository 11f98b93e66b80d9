//! Opens and locks a serial port as a file, in raw mode with a given baud rate.

use std::fs::File;
use std::io;

use rustix::fs::{FlockOperation, Mode, OFlags, fcntl_setfl, flock, open};
use rustix::io::Errno;
use rustix::termios::{
    ControlModes, OptionalActions, QueueSelector, SpecialCodeIndex, ioctl_tiocexcl, isatty,
    tcflush, tcgetattr, tcsetattr,
};
use taceva_core::ErrorKind;
use thiserror::Error;

use crate::text::shown;

/// Failure to open a serial port.
#[derive(Debug, Error)]
pub(super) enum PortError {
    #[error("cannot open {}: {source}", shown(.path))]
    Open { path: String, source: io::Error },
    #[error("{} is not a serial port, expected a port such as /dev/ttyUSB0", shown(.path))]
    NoTerminal { path: String },
    #[error("{} cannot be set to {baud} baud: {source}", shown(.path))]
    Speed {
        path: String,
        baud: u32,
        source: io::Error,
    },
}

impl PortError {
    /// Kind of the failure.
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

/// Opens the serial port at `path` with eight bits, no parity and no flow control, and locks it. Afterwards only root can open the port, and no other process
/// can lock it.
///
/// A read returns 0 bytes after a timeout of 0.1 s.
pub(super) fn open_line(path: &str, baud: u32) -> Result<File, PortError> {
    let refused = |source: Errno| PortError::Open {
        path: path.to_owned(),
        source: source.into(),
    };
    // Do not wait for a carrier, which no machine provides. Later reads and writes block.
    let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::NONBLOCK | OFlags::CLOEXEC;
    let line = open(path, flags, Mode::empty()).map_err(refused)?;
    if !isatty(&line) {
        return Err(PortError::NoTerminal {
            path: path.to_owned(),
        });
    }
    flock(&line, FlockOperation::NonBlockingLockExclusive).map_err(|source| PortError::Open {
        path: path.to_owned(),
        // The system reports a held lock as `EWOULDBLOCK`.
        source: match source {
            Errno::WOULDBLOCK => Errno::BUSY.into(),
            other => other.into(),
        },
    })?;
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

/// Releases the lock even if this process still has open handles of the port.
pub(super) fn release_line(line: &File) {
    // A lost port has no lock.
    let _ = flock(line, FlockOperation::Unlock);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_permission_another_program_and_no_such_line_are_distinguished() {
        let kind = |source: io::ErrorKind| {
            let path = "/dev/ttyUSB0".to_owned();
            let source = source.into();
            PortError::Open { path, source }.kind()
        };
        assert_eq!(
            kind(io::ErrorKind::PermissionDenied),
            ErrorKind::PermissionDenied
        );
        assert_eq!(kind(io::ErrorKind::ResourceBusy), ErrorKind::Busy);
        assert_eq!(kind(io::ErrorKind::NotFound), ErrorKind::NotFound);
    }
}
