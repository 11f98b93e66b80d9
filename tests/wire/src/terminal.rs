//! Pseudo-terminals: serial lines with a program at the other end.

use std::fs::File;
use std::io;
use std::thread::JoinHandle;

use rustix::fs::OFlags;
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

use crate::error::WireError;
use crate::server::End;

/// Opens a pseudo-terminal in raw mode. Returns the emulated device's end, and the path of the host's end.
fn pseudo_terminal() -> io::Result<(File, String)> {
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

/// A serial line served by an emulated machine, unplugged on drop.
#[derive(Debug)]
pub(crate) struct ServedLine {
    path: String,
    /// Flag that ends the thread of the emulated machine.
    end: End,
    thread: Option<JoinHandle<()>>,
    /// Host's end of the line. The open file keeps the line alive while no host uses it.
    _line: File,
}

impl ServedLine {
    /// Runs `serve` at the emulated machine's end, in a thread called `name`, until this value is dropped.
    ///
    /// # Errors
    /// [`WireError`] if the system provides no pseudo-terminal or no thread.
    pub(crate) fn start(
        name: &str,
        serve: impl FnOnce(File, &End) + Send + 'static,
    ) -> Result<ServedLine, WireError> {
        let refused = |source: io::Error| WireError::Listen {
            address: "a pseudo-terminal".to_owned(),
            source,
        };
        let (file, path) = pseudo_terminal().map_err(refused)?;
        let line = File::options().read(true).write(true).open(&path);
        let line = line.map_err(refused)?;
        let end = End::default();
        let serving = end.clone();
        let thread = std::thread::Builder::new()
            .name(name.to_owned())
            .spawn(move || serve(file, &serving))
            .map_err(WireError::Thread)?;
        Ok(ServedLine {
            path,
            end,
            thread: Some(thread),
            _line: line,
        })
    }

    /// Path at which the host opens the line.
    pub(crate) fn path(&self) -> &str {
        &self.path
    }
}

impl Drop for ServedLine {
    fn drop(&mut self) {
        self.end.come();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
