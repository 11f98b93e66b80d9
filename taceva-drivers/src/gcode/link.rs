//! Serial link to a machine. Callers write commands, a thread reads lines, and the parser of the firmware interprets these lines.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use taceva_core::{DriverError, DriverKey, ErrorKind};
use thiserror::Error;

use super::port::{open_line, release_line};
use crate::link::mailbox::Ending;
use crate::link::{Mailbox, monotonic};
use crate::port_user::other_users;
use crate::text::shown;

/// Content of a line that the machine sent: an answer, a status, both, or neither.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Heard<S> {
    pub(super) answer: Option<Answer>,
    pub(super) status: Option<S>,
}

impl<S> Heard<S> {
    /// A line without relevant content.
    #[cfg(test)]
    pub(super) const NOTHING: Heard<S> = Heard {
        answer: None,
        status: None,
    };

    /// Content of a line that is only an answer.
    #[cfg(any(test, feature = "grbl"))]
    pub(super) fn answer(answer: Answer) -> Heard<S> {
        Heard {
            answer: Some(answer),
            status: None,
        }
    }
}

/// Answer of a machine to a command.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(
    not(feature = "marlin"),
    expect(dead_code, reason = "GRBL sends fewer kinds of answers than Marlin")
)]
pub(super) enum Answer {
    /// The command was accepted.
    Ok,
    /// The command was rejected, for this reason.
    Refused(String),
    /// The machine stopped for this reason. A person must inspect it.
    Fault(String),
    /// The command is being executed.
    Busy,
    /// Echo of a number that was sent to the machine.
    Mark(u32),
    /// The machine received a damaged line and expects the line with this number again. An `ok` follows.
    Resend(u32),
    /// Name of a capability, and true if the machine has it.
    Can(String, bool),
    /// Facts that the machine reports about itself: values by name, such as `firmware`.
    Facts(BTreeMap<String, String>),
}

/// Failure of a command.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(super) enum CommandError {
    #[error("no answer to `{command}` within {patience:?}")]
    Silent { command: String, patience: Duration },
    #[error("`{command}` was refused: {why}")]
    Refused { command: String, why: String },
    #[error("{0}: inspect the machine, then reset and home it by hand")]
    Fault(String),
    #[error("the serial port failed: {0}")]
    Broken(String),
}

impl CommandError {
    /// Kind of the failure.
    pub(super) fn kind(&self) -> ErrorKind {
        match self {
            CommandError::Silent { .. } => ErrorKind::Timeout,
            CommandError::Refused { .. } | CommandError::Fault(_) => ErrorKind::DeviceFault,
            CommandError::Broken(_) => ErrorKind::Disconnected,
        }
    }

    /// Converts the failure into an error of `driver` that occurred while it was `doing`.
    pub(super) fn met(self, driver: &DriverKey, doing: &'static str) -> DriverError {
        DriverError::new(self.kind(), driver, doing).because(self)
    }
}

/// Writing half of the serial link, shared between threads.
#[derive(Clone, Debug)]
pub(super) struct Writer {
    file: Arc<Mutex<File>>,
}

impl Writer {
    /// Sends `bytes` as a whole: no other thread can send in between.
    pub(super) fn send(&self, bytes: &[u8]) -> io::Result<()> {
        self.file().write_all(bytes)
    }

    fn file(&self) -> MutexGuard<'_, File> {
        self.file.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Link to a connected machine.
#[derive(Debug)]
pub(super) struct SerialLink<S> {
    writer: Writer,
    statuses: Arc<Mailbox<S>>,
    answers: Receiver<Answer>,
    is_over: Arc<AtomicBool>,
    reader: Option<JoinHandle<()>>,
    /// Warning that another program had the port open when the link was opened; `None` if none had.
    warning: Option<String>,
}

impl<S: Clone + Send + 'static> SerialLink<S> {
    /// Opens the serial port at `path`. `read` parses its lines.
    ///
    /// # Errors
    /// As [`open_line`]; `Internal` if no thread can be started.
    pub(super) fn open(
        driver: &DriverKey,
        path: &str,
        baud: u32,
        read: fn(&str) -> Heard<S>,
    ) -> Result<SerialLink<S>, DriverError> {
        let doing = "connect to the machine";
        let file = open_line(path, baud)
            .map_err(|error| DriverError::new(error.kind(), driver, doing).because(error))?;
        let mut link = SerialLink::new(file, read)
            .map_err(|error| DriverError::new(ErrorKind::Internal, driver, doing).because(error))?;
        link.warning = warning(path);
        Ok(link)
    }

    fn new(file: File, understand: fn(&str) -> Heard<S>) -> io::Result<SerialLink<S>> {
        let reading = file.try_clone()?;
        let statuses = Arc::new(Mailbox::default());
        let is_over = Arc::new(AtomicBool::new(false));
        let (sender, answers) = mpsc::channel();
        let (posting, over) = (Arc::clone(&statuses), Arc::clone(&is_over));
        let reader = std::thread::Builder::new()
            .name("gcode lines".to_owned())
            .spawn(move || {
                if let Err(error) = read(reading, understand, &over, &posting, &sender) {
                    posting.end(Ending {
                        kind: ErrorKind::Disconnected,
                        why: format!("the serial port failed: {error}"),
                    });
                }
            })?;
        Ok(SerialLink {
            writer: Writer {
                file: Arc::new(Mutex::new(file)),
            },
            statuses,
            answers,
            is_over,
            reader: Some(reader),
            warning: None,
        })
    }

    /// Warning that another program had the port open when the link was opened; `None` if none had.
    pub(super) fn warning(&self) -> Option<String> {
        self.warning.clone()
    }

    pub(super) fn writer(&self) -> &Writer {
        &self.writer
    }

    /// Mailbox of the machine's status reports.
    pub(super) fn statuses(&self) -> &Mailbox<S> {
        &self.statuses
    }

    /// Sends a command; [`answer`](SerialLink::answer) receives its answer. Discards answers to earlier commands. A fault among these is returned as
    /// an error, because a machine may report a fault only once.
    pub(super) fn send(&mut self, command: &str) -> Result<(), CommandError> {
        while let Ok(answer) = self.answers.try_recv() {
            if let Answer::Fault(why) = answer {
                return Err(CommandError::Fault(why));
            }
        }
        let sent = self.writer.send(format!("{command}\n").as_bytes());
        sent.map_err(|error| CommandError::Broken(error.to_string()))
    }

    /// Discards received answers, including faults. Callers use this if the state of the machine shows that these answers are outdated.
    #[cfg(feature = "grbl")]
    pub(super) fn forget(&mut self) {
        while self.answers.try_recv().is_ok() {}
    }

    /// Waits up to `patience` for the next answer; `None` if none arrives.
    pub(super) fn answer(&mut self, patience: Duration) -> Option<Answer> {
        self.answers.recv_timeout(patience).ok()
    }

    /// Sends a command and waits until it is accepted. Passes unrelated answers to `other`.
    pub(super) fn command(
        &mut self,
        command: &str,
        patience: Duration,
        mut other: impl FnMut(Answer),
    ) -> Result<(), CommandError> {
        let began = Instant::now();
        self.send(command)?;
        loop {
            let left = patience.saturating_sub(began.elapsed());
            match self.answer(left) {
                Some(Answer::Ok) => return Ok(()),
                Some(Answer::Refused(why)) => {
                    let command = command.to_owned();
                    return Err(CommandError::Refused { command, why });
                }
                Some(Answer::Fault(why)) => return Err(CommandError::Fault(why)),
                Some(answer) => other(answer),
                None => {
                    let command = command.to_owned();
                    return Err(CommandError::Silent { command, patience });
                }
            }
        }
    }
}

impl<S> Drop for SerialLink<S> {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Release);
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
        // Stop handles keep the port open, so release the lock for other programs.
        release_line(&self.writer.file());
    }
}

/// Warning about other programs that have the port at `path` open; `None` if there are none.
fn warning(path: &str) -> Option<String> {
    let others = other_users(Path::new("/proc"), Path::new(path));
    (!others.is_empty()).then(|| {
        format!(
            "the serial port {} is also open in process {}, which may take answers of the machine away: end that program",
            shown(path),
            others.join(", ")
        )
    })
}

/// Reads lines from the port, posts statuses to `posting` and sends answers to `answers`. Ends once `is_over` is set or the port fails.
fn read<S: Clone>(
    mut file: File,
    understand: fn(&str) -> Heard<S>,
    is_over: &AtomicBool,
    posting: &Mailbox<S>,
    answers: &Sender<Answer>,
) -> io::Result<()> {
    let mut lines = Lines::default();
    let mut bytes = [0; 1024];
    while !is_over.load(Ordering::Acquire) {
        // A read of 0 bytes is a timeout of 0.1 s: a serial port has no end.
        let count = match file.read(&mut bytes) {
            Ok(count) => count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(error),
        };
        let at = monotonic();
        let (mut came, mut newest, mut said) = (0, None, Vec::new());
        lines.push(&bytes[..count], |line| {
            let Heard { answer, status } = understand(line);
            if let Some(status) = status {
                came += 1;
                newest = Some(status);
            }
            said.extend(answer);
        });
        // Post the status first, so that it is available once the answer arrives.
        if let Some(status) = newest {
            posting.post_last(came, status, at);
        }
        for answer in said {
            let _ = answers.send(answer);
        }
    }
    Ok(())
}

/// Maximum length of a line, bytes; longer lines are dropped. The longest lines are the facts of a printer about itself.
const LINE_MAX: usize = 512;

/// Splitter of received bytes into lines. The bytes arrive in pieces of any size.
#[derive(Debug, Default)]
pub(super) struct Lines {
    waiting: Vec<u8>,
    /// True if the current line exceeds the maximum length and will be dropped.
    is_endless: bool,
}

impl Lines {
    /// Appends bytes and passes each completed line, trimmed, to `take`.
    pub(super) fn push(&mut self, bytes: &[u8], mut take: impl FnMut(&str)) {
        for byte in bytes {
            match byte {
                b'\n' => {
                    let line = std::mem::take(&mut self.waiting);
                    if !std::mem::take(&mut self.is_endless) {
                        take(String::from_utf8_lossy(&line).trim());
                    }
                }
                _ if self.waiting.len() >= LINE_MAX => self.is_endless = true,
                byte => self.waiting.push(*byte),
            }
        }
    }
}

/// Parses the lines of `text`, received in pieces of `piece` bytes.
#[cfg(test)]
pub(super) fn understood<S>(
    text: &[u8],
    piece: usize,
    understand: fn(&str) -> Heard<S>,
) -> Vec<Heard<S>> {
    let mut lines = Lines::default();
    let mut found = Vec::new();
    for part in text.chunks(piece) {
        lines.push(part, |line| found.push(understand(line)));
    }
    found
}
