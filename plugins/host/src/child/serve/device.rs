//! An open device and its two threads: one answers its calls in turn, the other what is urgent.

use std::any::Any;
use std::os::fd::OwnedFd;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use taceva_core::{
    DriverError, ErrorKind, ForceTransducer, Halt, Interrupt, Lighting, Robot, Sensor,
};

use super::answer::{ForceServer, LightingServer, RobotServer, SensorServer};
use crate::child::socket::Socket;
use crate::child::wire::{Answer, Call, Failure, OpenedDevice, Urgent};

/// The sockets of a device that is being opened.
pub(super) struct Opening {
    pub(super) calls: OwnedFd,
    pub(super) urgent: OwnedFd,
}

/// A device that answers calls.
pub(super) trait Answers: Send {
    /// What is known about it now that it is open.
    fn opened(&mut self) -> OpenedDevice;

    /// Its answer to a call; `files` came beside it.
    fn answer(&mut self, call: Call, files: Vec<OwnedFd>) -> Result<Answer, Failure>;
}

/// What goes round the calls of a device.
#[derive(Clone, Default)]
pub(super) struct Round {
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

/// A kind of device that can be served.
pub(super) trait Serve {
    /// The device as one that answers calls, and what goes round them.
    fn server(self: Box<Self>) -> (Box<dyn Answers>, Round);
}

impl Serve for dyn Sensor {
    fn server(self: Box<Self>) -> (Box<dyn Answers>, Round) {
        let round = Round {
            interrupt: self.interrupt_handle(),
            halt: None,
        };
        (Box::new(SensorServer::new(self)), round)
    }
}

impl Serve for dyn Robot {
    fn server(self: Box<Self>) -> (Box<dyn Answers>, Round) {
        let round = Round {
            interrupt: None,
            halt: Some(self.halt_handle()),
        };
        (Box::new(RobotServer(self)), round)
    }
}

impl Serve for dyn ForceTransducer {
    fn server(self: Box<Self>) -> (Box<dyn Answers>, Round) {
        let round = Round {
            interrupt: self.interrupt_handle(),
            halt: None,
        };
        (Box::new(ForceServer(self)), round)
    }
}

impl Serve for dyn Lighting {
    fn server(self: Box<Self>) -> (Box<dyn Answers>, Round) {
        (Box::new(LightingServer(self)), Round::default())
    }
}

impl Opening {
    /// Serves an open device on threads of its own, and says what it is.
    pub(super) fn serve<D: Serve + ?Sized + 'static>(
        self,
        device: Box<D>,
    ) -> Result<OpenedDevice, Failure> {
        let (mut server, round) = device.server();
        let opened = guarded("open the device", || server.opened())?;
        let urgent = Socket::from(self.urgent);
        let calls = Socket::from(self.calls);
        start("taceva-urgent", move || serve_urgent(urgent, &round))?;
        start("taceva-device", move || serve_calls(calls, server))?;
        Ok(opened)
    }
}

/// Starts a thread.
pub(super) fn start(name: &str, run: impl FnOnce() + Send + 'static) -> Result<(), Failure> {
    std::thread::Builder::new()
        .name(name.to_owned())
        .spawn(run)
        .map(drop)
        .map_err(|error| Failure::new(ErrorKind::Internal, "start a thread", &error.to_string()))
}

/// Answers calls until the device is closed; whatever ends this drops the device.
fn serve_calls(mut calls: Socket, server: Box<dyn Answers>) {
    let mut server = Some(server);
    while let Ok(((sequence, call), files)) = calls.receive_with_files::<(u32, Call)>() {
        let is_last = call == Call::Close {};
        let answer = match &mut server {
            Some(open) if !is_last => {
                guarded("answer", || open.answer(call, files)).unwrap_or_else(|panicked| {
                    // What it left behind is in no state to be dropped.
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
                "the driver panicked before, and is not called any more",
            )),
        };
        let answer = answer.unwrap_or_else(|failure| Answer::Failed { failure });
        if calls.send(&(sequence, answer), &[]).is_err() || is_last {
            return;
        }
    }
}

/// Answers what is urgent until the host closes its end.
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

/// Runs code of a driver; a panic is a failure that says what it said.
pub(super) fn guarded<T>(doing: &str, run: impl FnOnce() -> T) -> Result<T, Failure> {
    // Whoever panicked is not called again.
    catch_unwind(AssertUnwindSafe(run)).map_err(|payload| {
        let said = said(&*payload);
        // Dropping what it panicked with might panic again.
        std::mem::forget(payload);
        Failure::new(ErrorKind::Panicked, doing, &said)
    })
}

fn said(payload: &(dyn Any + Send)) -> String {
    let text = payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    match text {
        Some(text) => format!("the driver panicked: {text}"),
        None => "the driver panicked".to_owned(),
    }
}
