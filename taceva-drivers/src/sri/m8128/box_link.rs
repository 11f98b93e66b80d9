//! TCP connection to an interface box. The driver writes commands, and a separate thread reads answers and force readings.

use std::io::{self, Read, Write};
use std::net::{Shutdown, SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use taceva_core::ErrorKind;
use thiserror::Error;

use super::command::Command;
use super::frame::{Message, Messages, Reading};
use crate::link::{LinkError, Mailbox, connect, monotonic};
use crate::text::shown;

/// Reason why a command to the interface box failed.
#[derive(Debug, Error)]
pub(super) enum CommandError {
    #[error(transparent)]
    Link(#[from] LinkError),
    #[error("no answer to `{}` within {patience:?}", .command.trim_end())]
    Silent { command: String, patience: Duration },
    #[error("the answer to `{}` is `{}`, expected `$OK` at the end", .command.trim_end(), shown(.answer))]
    Refused { command: String, answer: String },
}

impl CommandError {
    /// Kind of the `DriverError` that this failure causes.
    pub(super) fn kind(&self) -> ErrorKind {
        match self {
            CommandError::Link(error) => error.kind(),
            CommandError::Silent { .. } => ErrorKind::Timeout,
            CommandError::Refused { .. } => ErrorKind::Unsupported,
        }
    }
}

/// TCP link to an interface box.
#[derive(Debug)]
pub(super) struct BoxLink {
    stream: TcpStream,
    address: SocketAddr,
    readings: Arc<Mailbox<Counted>>,
    lines: Receiver<String>,
    reader: Option<JoinHandle<()>>,
}

/// Force reading, with the number of frames and bytes lost so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Counted {
    pub(super) reading: Reading,
    /// Number of frames lost since connecting, computed from gaps between frame numbers.
    pub(super) missing: u64,
    /// Number of bytes skipped since connecting because they belong to no message.
    pub(super) lost_bytes: u64,
}

/// Timeout for writing a command.
const WRITING: Duration = Duration::from_millis(500);

impl BoxLink {
    /// Connects to `port` of `host`.
    pub(super) fn open(host: &str, port: u16) -> Result<BoxLink, LinkError> {
        let (stream, address) = connect(host, port)?;
        let broken = |source: io::Error| LinkError::Broken { address, source };
        stream.set_write_timeout(Some(WRITING)).map_err(broken)?;
        let reading = stream.try_clone().map_err(broken)?;
        let readings = Arc::new(Mailbox::default());
        let posting = Arc::clone(&readings);
        let (sender, lines) = mpsc::channel();
        let reader = std::thread::Builder::new()
            .name("sri readings".to_owned())
            .spawn(move || {
                let ending = read(reading, address, &posting, &sender);
                posting.end(ending.into());
            })
            .map_err(broken)?;
        Ok(BoxLink {
            stream,
            address,
            readings,
            lines,
            reader: Some(reader),
        })
    }

    /// Mailbox that contains the newest reading.
    pub(super) fn readings(&self) -> &Arc<Mailbox<Counted>> {
        &self.readings
    }

    /// Sends `command` without waiting for an answer.
    pub(super) fn send(&mut self, command: Command) -> Result<(), LinkError> {
        let address = self.address;
        self.stream
            .write_all(command.line().as_bytes())
            .map_err(|source| LinkError::Broken { address, source })
    }

    /// Sends `command`, waits for a positive answer and returns the answer.
    pub(super) fn command(
        &mut self,
        command: Command,
        patience: Duration,
    ) -> Result<String, CommandError> {
        let began = Instant::now();
        // Discard answers to earlier commands.
        while self.lines.try_recv().is_ok() {}
        self.send(command)?;
        loop {
            let left = patience.saturating_sub(began.elapsed());
            let Ok(line) = self.lines.recv_timeout(left) else {
                return Err(CommandError::Silent {
                    command: command.line(),
                    patience,
                });
            };
            match command.answered_by(&line) {
                Some(true) => return Ok(line),
                Some(false) => {
                    return Err(CommandError::Refused {
                        command: command.line(),
                        answer: line,
                    });
                }
                None => {}
            }
        }
    }
}

impl Drop for BoxLink {
    fn drop(&mut self) {
        let _ = self.send(Command::Stop);
        // The shutdown ends the reader thread.
        let _ = self.stream.shutdown(Shutdown::Both);
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
    }
}

/// Posts readings to `posting` and answers to `lines` until the connection ends. Returns the reason for the end.
fn read(
    mut stream: TcpStream,
    address: SocketAddr,
    posting: &Mailbox<Counted>,
    lines: &Sender<String>,
) -> LinkError {
    let mut messages = Messages::default();
    let mut last: Option<u16> = None;
    let mut missing = 0;
    let mut bytes = [0; 4096];
    loop {
        match stream.read(&mut bytes) {
            Ok(0) => return LinkError::Closed { address },
            Ok(count) => messages.push(&bytes[..count]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(source) => return LinkError::Broken { address, source },
        }
        let at = monotonic();
        let (mut count, mut newest) = (0, None);
        while let Some(message) = messages.next() {
            match message {
                Message::Line(line) => {
                    // A restarted stream begins with any number.
                    last = None;
                    let _ = lines.send(line);
                }
                // A duplicate frame is ignored.
                Message::Reading(reading) if last == Some(reading.number) => {}
                Message::Reading(reading) => {
                    if let Some(last) = last {
                        missing += u64::from(reading.number.wrapping_sub(last).wrapping_sub(1));
                    }
                    last = Some(reading.number);
                    newest = Some(Counted {
                        reading,
                        missing,
                        lost_bytes: messages.lost(),
                    });
                    count += 1;
                }
            }
        }
        if let Some(newest) = newest {
            posting.post_last(count, newest, at);
        }
    }
}
