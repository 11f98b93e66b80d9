//! An open device and its two threads: one answers calls in order, the other answers urgent messages.

use std::os::fd::OwnedFd;
use std::sync::Arc;

use taceva_core::{DriverError, ErrorKind, Halt, Interrupt};

use crate::child::kind::{Kind, Server};
use crate::child::socket::Socket;
use crate::child::thread::{guarded, start};
use crate::child::wire::{Answer, Call, Failure, OpenedDevice, Urgent};

/// Sockets of a device that is being opened.
pub(super) struct Opening {
    pub(super) calls: OwnedFd,
    pub(super) urgent: OwnedFd,
}

/// Handles for interrupts and halts, which bypass the call queue.
struct Round {
    interrupt: Option<Arc<dyn Interrupt>>,
    halt: Option<Arc<dyn Halt>>,
}

impl Round {
    fn answer(&self, urgent: Urgent) -> Option<Result<(), DriverError>> {
        match urgent {
            Urgent::Interrupt {} => {
                if let Some(handle) = &self.interrupt {
                    handle.interrupt();
                }
                None
            }
            Urgent::Halt {} => Some(self.halt.as_ref().map_or(Ok(()), |handle| handle.halt())),
        }
    }
}

impl Opening {
    /// Opens a device and serves it on its own threads. Returns the properties of the opened device.
    pub(super) fn serve<K: Kind + ?Sized>(
        self,
        open: impl FnOnce() -> Result<Box<K>, DriverError>,
    ) -> Result<OpenedDevice, Failure> {
        let open = || -> Result<_, DriverError> {
            let mut server = open()?.server();
            let round = Round {
                interrupt: server.interrupt(),
                halt: server.halt(),
            };
            let opened = server.opened();
            Ok((server, round, opened))
        };
        let (server, round, opened) =
            guarded("open the device", open)?.map_err(|error| Failure::of(&error))?;
        let urgent = Socket::from(self.urgent);
        let calls = Socket::from(self.calls);
        start("taceva-urgent", move || serve_urgent(urgent, &round))?;
        start("taceva-device", move || serve_calls(calls, server))?;
        Ok(opened)
    }
}

/// Answers calls until the device or the socket is closed. Drops the device, unless the driver panicked.
fn serve_calls(mut calls: Socket, server: Box<dyn Server>) {
    let mut server = Some(server);
    while let Ok(((sequence, call), files)) = calls.receive_with_files::<(u32, Call)>() {
        let is_last = call == Call::Close {};
        let answer = match &mut server {
            Some(open) if !is_last => {
                guarded("answer", || open.answer(call, files)).unwrap_or_else(|panicked| {
                    // After a panic the device's state is undefined, so it must not be dropped.
                    std::mem::forget(server.take());
                    Err(panicked)
                })
            }
            Some(_) => {
                let closed = server.take();
                guarded("close the device", move || drop(closed)).map(|()| Answer::Done {})
            }
            None if is_last => Ok(Answer::Done {}),
            None => Err(Failure::new(
                ErrorKind::Panicked,
                "answer",
                "the driver panicked before and is no longer called",
            )),
        };
        let answer = answer.unwrap_or_else(|failure| Answer::Failed { failure });
        if calls.send(&(sequence, answer), &[]).is_err() || is_last {
            return;
        }
    }
}

/// Answers urgent messages until the host closes the socket.
fn serve_urgent(mut socket: Socket, round: &Round) {
    while let Ok((sequence, urgent)) = socket.receive::<(u32, Urgent)>() {
        let answered = guarded("halt", || round.answer(urgent)).transpose();
        let Some(answered) = answered else {
            continue;
        };
        let done = answered.and_then(|done| done.map_err(|error| Failure::of(&error)));
        let answer = match done {
            Ok(()) => Answer::Done {},
            Err(failure) => Answer::Failed { failure },
        };
        if socket.send(&(sequence, answer), &[]).is_err() {
            return;
        }
    }
}
