//! Pseudo-terminals: serial lines whose other end is a program.

use std::fs::File;
use std::io;

use rustix::fs::OFlags;
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

/// The machine's end of a raw line, and the path of the other.
pub(crate) fn pseudo_terminal() -> io::Result<(File, String)> {
    let end = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
    grantpt(&end)?;
    unlockpt(&end)?;
    let path = ptsname(&end, Vec::new())?;
    let mut settings = tcgetattr(&end)?;
    settings.make_raw();
    tcsetattr(&end, OptionalActions::Now, &settings)?;
    rustix::fs::fcntl_setfl(&end, OFlags::NONBLOCK)?;
    let path = path.to_string_lossy().into_owned();
    Ok((File::from(end), path))
}
