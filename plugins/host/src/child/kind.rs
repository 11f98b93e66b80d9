//! Kinds of device on both sides of the socket, a file each: the proxy that the host holds, and the server by which the child answers it.
//!
//! An operation is a row of [`Call`], a method of the proxy and an arm of the server; what it answers is a [`Reply`],
//! which is turned into an [`Answer`], recognised and checked in one place.

mod changer;
mod force;
mod lighting;
mod robot;
mod sensor;

use std::os::fd::OwnedFd;
use std::sync::Arc;

use taceva_core::{DriverError, DriverKind, ErrorKind, Halt, Interrupt};

use super::link::Link;
use super::reply::Reply;
use super::wire::{Answer, Call, Failure, OpenedDevice};

/// A kind of device: `dyn Sensor`, `dyn Robot`, `dyn ForceTransducer`, `dyn Lighting` or `dyn Changer`.
pub(super) trait Kind: 'static {
    /// Its name.
    const KIND: DriverKind;

    /// What answers calls to an open device in the child.
    fn server(self: Box<Self>) -> Box<dyn Server>;

    /// What the host holds of the device behind `link`; an error if something else was opened.
    fn proxy(link: Link, opened: OpenedDevice) -> Result<Box<Self>, DriverError>;
}

/// An open device in the child.
pub(super) trait Server: Send {
    /// What is known about it now that it is open.
    fn opened(&mut self) -> OpenedDevice;

    /// What ends a pending call.
    fn interrupt(&self) -> Option<Arc<dyn Interrupt>> {
        None
    }

    /// What stops it.
    fn halt(&self) -> Option<Arc<dyn Halt>> {
        None
    }

    /// Its answer to a call; `files` came beside it.
    fn answer(&mut self, call: Call, files: Vec<OwnedFd>) -> Result<Answer, Failure>;
}

/// The answer that the result of an operation is.
fn answered<R: Reply>(result: Result<R, DriverError>) -> Result<Answer, Failure> {
    result
        .map(Reply::into_answer)
        .map_err(|error| Failure::of(&error))
}

/// The answer of an ability that a device may lack.
fn answered_if_able<R: Reply>(result: Option<Result<R, DriverError>>) -> Result<Answer, Failure> {
    result.map_or_else(|| Err(unsupported()), answered)
}

fn unsupported() -> Failure {
    Failure {
        kind: ErrorKind::Unsupported,
        doing: "answer a call of another kind of device".to_owned(),
        cause: None,
        fault: None,
    }
}
