//! Connection for commands and queries to the controller. A separate thread reads the answers.

use std::io::{self, Read, Write};
use std::net::{Shutdown, SocketAddr, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use taceva_core::ErrorKind;
use thiserror::Error;

use super::command::Command;
use super::firmware::Firmware;
use super::frame::{FrameError, Replies, Reply};
use crate::link::{LinkError, connect};

/// Reason why a command or query to the controller failed.
#[derive(Debug, Error)]
pub(super) enum ExchangeError {
    #[error(transparent)]
    Link(#[from] LinkError),
    #[error("{address} sent an invalid answer for an xArm: {source}")]
    Foreign {
        address: SocketAddr,
        source: FrameError,
    },
    #[error("no answer to {command} within {patience:?}")]
    Silent {
        command: &'static str,
        patience: Duration,
    },
    #[error("the answer to {command} is too short: {length} bytes")]
    Short {
        command: &'static str,
        length: usize,
    },
    #[error("the connection to {address} has ended")]
    Over { address: SocketAddr },
}

impl ExchangeError {
    /// Kind of the `DriverError` that this failure causes.
    pub(super) fn kind(&self) -> ErrorKind {
        match self {
            ExchangeError::Link(error) => error.kind(),
            ExchangeError::Foreign { .. } | ExchangeError::Short { .. } => ErrorKind::Protocol,
            ExchangeError::Silent { .. } => ErrorKind::Timeout,
            ExchangeError::Over { .. } => ErrorKind::Disconnected,
        }
    }
}

/// Shared writing half of a connection.
#[derive(Clone, Debug)]
pub(super) struct Writer {
    stream: Arc<Mutex<TcpStream>>,
    /// True after the reader has ended. The socket may still accept bytes for a while.
    is_over: Arc<AtomicBool>,
    address: SocketAddr,
}

impl Writer {
    /// Sends a command with the transaction number `transaction`. Does not wait for an answer.
    pub(super) fn send(
        &self,
        command: Command,
        firmware: Firmware,
        transaction: u16,
    ) -> Result<(), LinkError> {
        let address = self.address;
        if self.is_over.load(Ordering::Acquire) {
            return Err(LinkError::Closed { address });
        }
        let frame = command.request(firmware).encode(transaction);
        self.stream()
            .write_all(&frame)
            .map_err(|source| LinkError::Broken { address, source })
    }

    fn stream(&self) -> MutexGuard<'_, TcpStream> {
        self.stream.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Connection to the controller, with at most one pending query.
#[derive(Debug)]
pub(super) struct Exchange {
    writer: Writer,
    replies: Receiver<Result<Reply, ExchangeError>>,
    reader: Option<JoinHandle<()>>,
    transaction: u16,
    firmware: Firmware,
}

/// Timeout for writing a command.
const WRITING: Duration = Duration::from_millis(100);

impl Exchange {
    /// Connects to `port` of `host`. Commands are encoded for `firmware`.
    pub(super) fn open(
        host: &str,
        port: u16,
        firmware: Firmware,
    ) -> Result<Exchange, ExchangeError> {
        let (stream, address) = connect(host, port)?;
        let broken = |source: io::Error| LinkError::Broken { address, source };
        stream.set_write_timeout(Some(WRITING)).map_err(broken)?;
        let reading = stream.try_clone().map_err(broken)?;
        let (sender, replies) = mpsc::channel();
        let is_over = Arc::new(AtomicBool::new(false));
        let over = Arc::clone(&is_over);
        let reader = std::thread::Builder::new()
            .name("xarm answers".to_owned())
            .spawn(move || {
                read(reading, address, |reply| {
                    if reply.is_err() {
                        over.store(true, Ordering::Release);
                    }
                    sender.send(reply).is_ok()
                });
            })
            .map_err(broken)?;
        Ok(Exchange {
            writer: Writer {
                stream: Arc::new(Mutex::new(stream)),
                is_over,
                address,
            },
            replies,
            reader: Some(reader),
            transaction: 0,
            firmware,
        })
    }

    /// Sets the firmware for which commands are encoded.
    pub(super) fn set_firmware(&mut self, firmware: Firmware) {
        self.firmware = firmware;
    }

    /// Firmware for which commands are encoded.
    pub(super) fn firmware(&self) -> Firmware {
        self.firmware
    }

    /// Writing half of the connection. It can send while another caller waits for an answer.
    pub(super) fn writer(&self) -> Writer {
        self.writer.clone()
    }

    /// Sends `command` and waits for the answer. Skips answers to earlier commands.
    pub(super) fn ask(
        &mut self,
        command: Command,
        patience: Duration,
    ) -> Result<Reply, ExchangeError> {
        let began = Instant::now();
        self.transaction = self.transaction % TRANSACTION_MAX + 1;
        self.writer.send(command, self.firmware, self.transaction)?;
        loop {
            let left = patience.saturating_sub(began.elapsed());
            match self.replies.recv_timeout(left) {
                Ok(Ok(reply)) if reply.transaction == self.transaction => return Ok(reply),
                Ok(Ok(_)) => {}
                Ok(Err(error)) => return Err(error),
                Err(RecvTimeoutError::Timeout) => {
                    return Err(ExchangeError::Silent {
                        command: command.name(),
                        patience,
                    });
                }
                Err(RecvTimeoutError::Disconnected) => {
                    let address = self.writer.address;
                    return Err(ExchangeError::Over { address });
                }
            }
        }
    }

    /// Same as [`ask`](Exchange::ask), but extracts a value from the answer with `read`.
    pub(super) fn ask_for<T>(
        &mut self,
        command: Command,
        patience: Duration,
        read: fn(&Reply) -> Option<T>,
    ) -> Result<T, ExchangeError> {
        let reply = self.ask(command, patience)?;
        read(&reply).ok_or(ExchangeError::Short {
            command: command.name(),
            length: reply.parameters.len(),
        })
    }
}

/// Last transaction number; the next number is 1. [`UNANSWERED`] is reserved for commands whose answer is not awaited.
const TRANSACTION_MAX: u16 = u16::MAX - 1;
/// Transaction number of commands whose answer is not awaited.
pub(super) const UNANSWERED: u16 = u16::MAX;

impl Drop for Exchange {
    fn drop(&mut self) {
        // The shutdown ends the reader thread.
        let _ = self.writer.stream().shutdown(Shutdown::Both);
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
    }
}

/// Passes every answer to `hand_over`, then the reason for the end of the connection. Returns early if `hand_over` returns false.
fn read(
    mut stream: TcpStream,
    address: SocketAddr,
    mut hand_over: impl FnMut(Result<Reply, ExchangeError>) -> bool,
) {
    let mut replies = Replies::default();
    let mut bytes = [0; 4096];
    loop {
        let count = match stream.read(&mut bytes) {
            Ok(0) => {
                hand_over(Err(LinkError::Closed { address }.into()));
                return;
            }
            Ok(count) => count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(source) => {
                hand_over(Err(LinkError::Broken { address, source }.into()));
                return;
            }
        };
        replies.push(&bytes[..count]);
        loop {
            match replies.next() {
                Ok(None) => break,
                Ok(Some(reply)) => {
                    if !hand_over(Ok(reply)) {
                        return;
                    }
                }
                Err(source) => {
                    // Later bytes cannot be decoded.
                    let _ = stream.shutdown(Shutdown::Both);
                    hand_over(Err(ExchangeError::Foreign { address, source }));
                    return;
                }
            }
        }
    }
}
