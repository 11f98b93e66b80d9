//! The line to a machine: bytes and commands out, lines in, with a thread of its own that reads.

use std::fs::File;
use std::io::{self, Read, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use taceva_core::ErrorKind;
use thiserror::Error;

use super::line::{Line, Lines, Status};
use crate::link::mailbox::Ending;
use crate::link::{Mailbox, monotonic};

/// Why a command had no effect.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(super) enum CommandError {
    #[error("no answer to `{command}` within {patience:?}")]
    Silent { command: String, patience: Duration },
    #[error("`{command}` was refused with error {code}, see GRBL's list")]
    Refused { command: String, code: u16 },
    #[error(
        "ALARM {code}: look at the machine, then reset and home it, which this program never does"
    )]
    Alarm { code: u16 },
    #[error("the line broke: {0}")]
    Broken(String),
}

impl CommandError {
    /// What kind of failure it is.
    pub(super) fn kind(&self) -> ErrorKind {
        match self {
            CommandError::Silent { .. } => ErrorKind::Timeout,
            CommandError::Refused { .. } | CommandError::Alarm { .. } => ErrorKind::DeviceFault,
            CommandError::Broken(_) => ErrorKind::Disconnected,
        }
    }
}

/// The half of the line that writes, which several may hold.
#[derive(Clone, Debug)]
pub(super) struct Writer {
    file: Arc<Mutex<File>>,
}

impl Writer {
    /// Sends one of the bytes that the machine takes at once, whatever else it does.
    pub(super) fn send_byte(&self, byte: u8) -> io::Result<()> {
        self.file().write_all(&[byte])
    }

    fn file(&self) -> MutexGuard<'_, File> {
        self.file.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Bytes that the machine takes at once.
pub(super) const ASK_STATUS: u8 = b'?';
pub(super) const HOLD: u8 = b'!';
pub(super) const RESET: u8 = 0x18;

/// A machine that is connected.
#[derive(Debug)]
pub(super) struct GrblLink {
    writer: Writer,
    statuses: Arc<Mailbox<Status>>,
    answers: Receiver<Line>,
    is_over: Arc<AtomicBool>,
    reader: Option<JoinHandle<()>>,
}

impl GrblLink {
    /// The machine at the other end of `file`, a line that was opened.
    pub(super) fn new(file: File) -> io::Result<GrblLink> {
        let reading = file.try_clone()?;
        let statuses = Arc::new(Mailbox::default());
        let is_over = Arc::new(AtomicBool::new(false));
        let (sender, answers) = mpsc::channel();
        let (posting, over) = (Arc::clone(&statuses), Arc::clone(&is_over));
        let reader = std::thread::Builder::new()
            .name("grbl lines".to_owned())
            .spawn(move || {
                if let Err(error) = read(reading, &over, &posting, &sender) {
                    posting.end(Ending {
                        kind: ErrorKind::Disconnected,
                        why: format!("the line broke: {error}"),
                    });
                }
            })?;
        Ok(GrblLink {
            writer: Writer {
                file: Arc::new(Mutex::new(file)),
            },
            statuses,
            answers,
            is_over,
            reader: Some(reader),
        })
    }

    pub(super) fn writer(&self) -> &Writer {
        &self.writer
    }

    /// The answers to [`ASK_STATUS`].
    pub(super) fn statuses(&self) -> &Mailbox<Status> {
        &self.statuses
    }

    /// Sends a command and waits until it is taken.
    pub(super) fn command(
        &mut self,
        command: &str,
        patience: Duration,
    ) -> Result<(), CommandError> {
        let began = Instant::now();
        // Answers to earlier commands say nothing of this one.
        while self.answers.try_recv().is_ok() {}
        let line = format!("{command}\n");
        self.writer
            .file()
            .write_all(line.as_bytes())
            .map_err(|error| CommandError::Broken(error.to_string()))?;
        loop {
            let left = patience.saturating_sub(began.elapsed());
            match self.answers.recv_timeout(left) {
                Ok(Line::Ok) => return Ok(()),
                Ok(Line::Error(code)) => {
                    let command = command.to_owned();
                    return Err(CommandError::Refused { command, code });
                }
                Ok(Line::Alarm(code)) => return Err(CommandError::Alarm { code }),
                Ok(_) => {}
                Err(_) => {
                    let command = command.to_owned();
                    return Err(CommandError::Silent { command, patience });
                }
            }
        }
    }
}

impl Drop for GrblLink {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Release);
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
    }
}

/// Hands over what comes until it is over, or nothing can come any more.
fn read(
    mut file: File,
    is_over: &AtomicBool,
    posting: &Mailbox<Status>,
    answers: &Sender<Line>,
) -> io::Result<()> {
    let mut lines = Lines::default();
    let mut bytes = [0; 1024];
    while !is_over.load(Ordering::Acquire) {
        // Nothing within a tenth of a second is no end: a line has none.
        let count = match file.read(&mut bytes) {
            Ok(count) => count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(error),
        };
        let at = monotonic();
        let (mut came, mut newest) = (0, None);
        lines.push(&bytes[..count], |line| match line {
            Line::Status(status) => {
                came += 1;
                newest = Some(status);
            }
            answer => {
                let _ = answers.send(answer);
            }
        });
        if let Some(status) = newest {
            posting.post_last(came, status, at);
        }
    }
    Ok(())
}
