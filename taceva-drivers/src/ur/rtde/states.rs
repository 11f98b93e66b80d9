//! Connection of the real-time data exchange: a reader thread posts the newest state.

use std::io::{self, Read, Write};
use std::net::{Shutdown, SocketAddr, TcpStream};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use taceva_core::ErrorKind;
use thiserror::Error;

use super::message::{
    ArmState, CONTROLLER, Message, MessageError, Messages, OUTPUTS, START, VERSION, ask_controller,
    ask_outputs, ask_start, ask_version, missing_outputs,
};
use crate::link::mailbox::Ending;
use crate::link::{LinkError, Mailbox, connect, monotonic};

/// Connection that receives the states of one arm.
#[derive(Debug)]
pub(super) struct States {
    states: Arc<Mailbox<ArmState>>,
    /// Version of the controller, such as `5.11.0`; empty if unknown.
    version: String,
    stream: TcpStream,
    reader: Option<JoinHandle<()>>,
}

/// Reason why no states are received.
#[derive(Debug, Error)]
pub(super) enum StatesError {
    #[error(transparent)]
    Link(#[from] LinkError),
    #[error("{address} sent an invalid message for a data exchange: {source}")]
    Foreign {
        address: SocketAddr,
        source: MessageError,
    },
    #[error("{address} does not answer within {ANSWER:?}")]
    Silent { address: SocketAddr },
    #[error("{address} has no output {outputs}: the software of its controller is {}; update it", named(.version))]
    Missing {
        address: SocketAddr,
        outputs: String,
        version: String,
    },
    #[error("{address} refused version 2 of the data exchange, or its start")]
    Refused { address: SocketAddr },
}

impl StatesError {
    /// Kind of the `DriverError` that this failure causes.
    pub(super) fn kind(&self) -> ErrorKind {
        match self {
            StatesError::Link(error) => error.kind(),
            StatesError::Foreign { .. } => ErrorKind::Protocol,
            StatesError::Silent { .. } => ErrorKind::Timeout,
            StatesError::Missing { .. } | StatesError::Refused { .. } => ErrorKind::Unsupported,
        }
    }
}

const ANSWER: Duration = Duration::from_secs(2);

impl States {
    /// Requests states at `rate_hz` from the controller at `port` of `host`.
    pub(super) fn open(host: &str, port: u16, rate_hz: f64) -> Result<States, StatesError> {
        let (mut stream, address) = connect(host, port)?;
        let broken = |source: io::Error| LinkError::Broken { address, source };
        stream.set_read_timeout(Some(ANSWER)).map_err(broken)?;
        let mut messages = Messages::default();
        let mut ask = |kind: u8, question: Vec<u8>| -> Result<Message, StatesError> {
            stream.write_all(&question).map_err(broken)?;
            await_answer(&mut stream, address, &mut messages, kind)
        };
        ask(VERSION, ask_version())?;
        let version = match ask(CONTROLLER, ask_controller()) {
            Ok(Message::Controller(Some([major, minor, fix, _]))) => {
                format!("{major}.{minor}.{fix}")
            }
            // A server that is not a controller need not answer.
            Ok(_) | Err(StatesError::Silent { .. }) => String::new(),
            Err(error) => return Err(error),
        };
        if let Message::Types(types) = ask(OUTPUTS, ask_outputs(rate_hz))? {
            let foreign = |source| StatesError::Foreign { address, source };
            let missing = missing_outputs(&types).map_err(foreign)?;
            if !missing.is_empty() {
                let outputs = missing.join(", ");
                return Err(StatesError::Missing {
                    address,
                    outputs,
                    version,
                });
            }
        }
        ask(START, ask_start())?;
        stream.set_read_timeout(None).map_err(broken)?;
        let reading = stream.try_clone().map_err(broken)?;
        let states = Arc::new(Mailbox::default());
        let posting = Arc::clone(&states);
        let reader = std::thread::Builder::new()
            .name("ur states".to_owned())
            .spawn(move || {
                let ending = read(reading, address, messages, &posting);
                posting.end(ending);
            })
            .map_err(broken)?;
        Ok(States {
            states,
            version,
            stream,
            reader: Some(reader),
        })
    }

    /// Version of the controller; empty if unknown.
    pub(super) fn version(&self) -> &str {
        &self.version
    }

    /// Mailbox that contains the newest state.
    pub(super) fn mailbox(&self) -> &Arc<Mailbox<ArmState>> {
        &self.states
    }
}

impl Drop for States {
    fn drop(&mut self) {
        // The shutdown ends the reader thread.
        let _ = self.stream.shutdown(Shutdown::Both);
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
    }
}

/// Version as error messages name it, or a phrase for an empty `version`.
fn named(version: &str) -> &str {
    match version {
        "" => "of an unknown version",
        version => version,
    }
}

/// Waits for the answer to the request of type `kind`. Fails if the controller refuses the request.
fn await_answer(
    stream: &mut TcpStream,
    address: SocketAddr,
    messages: &mut Messages,
    kind: u8,
) -> Result<Message, StatesError> {
    let foreign = |source| StatesError::Foreign { address, source };
    let mut bytes = [0; 1024];
    loop {
        match messages.next().map_err(foreign)? {
            Some(Message::Accepted(of, false)) if of == kind => {
                return Err(StatesError::Refused { address });
            }
            Some(message) if message.answers(kind) => return Ok(message),
            Some(_) => continue,
            None => {}
        }
        match stream.read(&mut bytes) {
            Ok(0) => return Err(LinkError::Closed { address }.into()),
            Ok(count) => messages.push(&bytes[..count]),
            Err(source) => match source.kind() {
                io::ErrorKind::Interrupted => {}
                io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut => {
                    return Err(StatesError::Silent { address });
                }
                _ => return Err(LinkError::Broken { address, source }.into()),
            },
        }
    }
}

/// Posts states to `posting` until the connection ends. Returns the reason for the end.
fn read(
    mut stream: TcpStream,
    address: SocketAddr,
    mut messages: Messages,
    posting: &Mailbox<ArmState>,
) -> Ending {
    let mut bytes = [0; 4096];
    loop {
        let at = monotonic();
        let (mut count, mut newest) = (0, None);
        loop {
            match messages.next() {
                Ok(None) => break,
                Ok(Some(Message::State(state))) => {
                    count += 1;
                    newest = Some(state);
                }
                Ok(Some(_)) => {}
                Err(error) => {
                    let _ = stream.shutdown(Shutdown::Both);
                    return Ending {
                        kind: ErrorKind::Protocol,
                        why: format!(
                            "{address} sent an invalid message for a data exchange: {error}"
                        ),
                    };
                }
            }
        }
        if let Some(state) = newest {
            posting.post_last(count, state, at);
        }
        match stream.read(&mut bytes) {
            Ok(0) => return LinkError::Closed { address }.into(),
            Ok(count) => messages.push(&bytes[..count]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(source) => return LinkError::Broken { address, source }.into(),
        }
    }
}
