//! The line to a machine: bytes and commands out, lines in, with a thread of its own that reads. What a line says is a matter of the dialect.

use std::fs::File;
use std::io::{self, Read, Write};
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

/// What a line of a machine says: one thing, the other, both, or nothing that matters.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Heard<S> {
    pub(super) answer: Option<Answer>,
    pub(super) status: Option<S>,
}

impl<S> Heard<S> {
    /// Nothing that matters.
    #[cfg(test)]
    pub(super) const NOTHING: Heard<S> = Heard {
        answer: None,
        status: None,
    };

    /// An answer alone.
    #[cfg(any(test, feature = "grbl"))]
    pub(super) fn answer(answer: Answer) -> Heard<S> {
        Heard {
            answer: Some(answer),
            status: None,
        }
    }
}

/// What a machine says of a command.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(
    not(feature = "marlin"),
    expect(dead_code, reason = "GRBL says less than others")
)]
pub(super) enum Answer {
    /// It was taken.
    Ok,
    /// It was refused, and why.
    Refused(String),
    /// The machine stopped and has to be looked at, and why.
    Fault(String),
    /// It works on it.
    Busy,
    /// A number that it was asked to repeat.
    Mark(u32),
    /// What it can do, as it says of itself.
    Can(String, bool),
}

/// Why a command had no effect.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(super) enum CommandError {
    #[error("no answer to `{command}` within {patience:?}")]
    Silent { command: String, patience: Duration },
    #[error("`{command}` was refused: {why}")]
    Refused { command: String, why: String },
    #[error("{0}: look at the machine, then reset and home it, which this program never does")]
    Fault(String),
    #[error("the line broke: {0}")]
    Broken(String),
}

impl CommandError {
    /// What kind of failure it is.
    pub(super) fn kind(&self) -> ErrorKind {
        match self {
            CommandError::Silent { .. } => ErrorKind::Timeout,
            CommandError::Refused { .. } | CommandError::Fault(_) => ErrorKind::DeviceFault,
            CommandError::Broken(_) => ErrorKind::Disconnected,
        }
    }

    /// The error of `driver` while it was `doing` something.
    pub(super) fn met(self, driver: &DriverKey, doing: &'static str) -> DriverError {
        DriverError::new(self.kind(), driver, doing).because(self)
    }
}

/// The half of the line that writes, which several may hold.
#[derive(Clone, Debug)]
pub(super) struct Writer {
    file: Arc<Mutex<File>>,
}

impl Writer {
    /// Sends bytes, none of another between them.
    pub(super) fn send(&self, bytes: &[u8]) -> io::Result<()> {
        self.file().write_all(bytes)
    }

    fn file(&self) -> MutexGuard<'_, File> {
        self.file.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A machine that is connected.
#[derive(Debug)]
pub(super) struct SerialLink<S> {
    writer: Writer,
    statuses: Arc<Mailbox<S>>,
    answers: Receiver<Answer>,
    is_over: Arc<AtomicBool>,
    reader: Option<JoinHandle<()>>,
}

impl<S: Clone + Send + 'static> SerialLink<S> {
    /// Opens the line at `path`, whose lines `read` understands.
    ///
    /// # Errors
    /// Those of [`open_line`], and `Internal` where no thread can be had.
    pub(super) fn open(
        driver: &DriverKey,
        path: &str,
        baud: u32,
        read: fn(&str) -> Heard<S>,
    ) -> Result<SerialLink<S>, DriverError> {
        let doing = "connect to the machine";
        let file = open_line(path, baud)
            .map_err(|error| DriverError::new(error.kind(), driver, doing).because(error))?;
        SerialLink::new(file, read)
            .map_err(|error| DriverError::new(ErrorKind::Internal, driver, doing).because(error))
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
                        why: format!("the line broke: {error}"),
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
        })
    }

    pub(super) fn writer(&self) -> &Writer {
        &self.writer
    }

    /// What the machine says of where it is.
    pub(super) fn statuses(&self) -> &Mailbox<S> {
        &self.statuses
    }

    /// Sends a command, whose answer is [`answer`](SerialLink::answer); answers to earlier commands that came are thrown away, but for a fault, which a
    /// machine may say once.
    pub(super) fn send(&mut self, command: &str) -> Result<(), CommandError> {
        while let Ok(answer) = self.answers.try_recv() {
            if let Answer::Fault(why) = answer {
                return Err(CommandError::Fault(why));
            }
        }
        let sent = self.writer.send(format!("{command}\n").as_bytes());
        sent.map_err(|error| CommandError::Broken(error.to_string()))
    }

    /// Throws away what came, faults too: of a machine whose state says that they are over.
    #[cfg(feature = "grbl")]
    pub(super) fn forget(&mut self) {
        while self.answers.try_recv().is_ok() {}
    }

    /// The next answer, waited for as long as `patience`; `None` if none came.
    pub(super) fn answer(&mut self, patience: Duration) -> Option<Answer> {
        self.answers.recv_timeout(patience).ok()
    }

    /// Sends a command and waits until it is taken; `other` is handed the answers that are none to it.
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
        // Whoever can still stop the machine has the line too, and does not keep it from others.
        release_line(&self.writer.file());
    }
}

/// Hands over what comes until it is over, or nothing can come any more.
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
        // Nothing within a tenth of a second is no end: a line has none.
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
        // First: whoever waits for an answer finds the status there.
        if let Some(status) = newest {
            posting.post_last(came, status, at);
        }
        for answer in said {
            let _ = answers.send(answer);
        }
    }
    Ok(())
}

/// A longer line is none.
const LINE_MAX: usize = 256;

/// Cuts what comes, in pieces of any size, into lines.
#[derive(Debug, Default)]
pub(super) struct Lines {
    waiting: Vec<u8>,
    /// Whether the present line is too long, and passed over.
    is_endless: bool,
}

impl Lines {
    /// Takes bytes, and hands over the lines that end in them, without white space around them.
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

/// What a dialect makes of `text` that comes in pieces of so many bytes.
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
