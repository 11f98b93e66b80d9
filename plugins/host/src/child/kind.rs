//! Device kinds, one file each, with the host's proxy and the child's server.
//!
//! An operation is a row of [`Call`], a method of the proxy and an arm of the server. Its result is a [`Reply`], which is converted to and
//! from an [`Answer`] and checked in one place.

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

/// Kind of device: `dyn Sensor`, `dyn Robot`, `dyn ForceTransducer`, `dyn Lighting` or `dyn Changer`.
pub(super) trait Kind: 'static {
    /// Kind of device.
    const KIND: DriverKind;

    /// Wraps an open device in the server that answers calls in the child.
    fn server(self: Box<Self>) -> Box<dyn Server>;

    /// Creates the host's proxy of the device behind `link`. Fails if another kind of device was opened.
    fn proxy(link: Link, opened: OpenedDevice) -> Result<Box<Self>, DriverError>;
}

/// Server of an open device in the child.
pub(super) trait Server: Send {
    /// Properties of the open device.
    fn opened(&mut self) -> OpenedDevice;

    /// Handle that interrupts a pending call; `None` if the device has none.
    fn interrupt(&self) -> Option<Arc<dyn Interrupt>> {
        None
    }

    /// Handle that halts the device; `None` if the device has none.
    fn halt(&self) -> Option<Arc<dyn Halt>> {
        None
    }

    /// Answers a call. `files` are the files that were sent with the call.
    fn answer(&mut self, call: Call, files: Vec<OwnedFd>) -> Result<Answer, Failure>;
}

/// Converts the result of an operation into an answer.
fn answered<R: Reply>(result: Result<R, DriverError>) -> Result<Answer, Failure> {
    result
        .map(Reply::into_answer)
        .map_err(|error| Failure::of(&error))
}

/// Converts the result of an optional operation. `None` becomes an `Unsupported` failure.
fn answered_if_able<R: Reply>(result: Option<Result<R, DriverError>>) -> Result<Answer, Failure> {
    result.map_or_else(|| Err(unsupported()), answered)
}

fn unsupported() -> Failure {
    Failure {
        kind: ErrorKind::Unsupported,
        doing: "answer a call for another kind of device".to_owned(),
        cause: None,
        fault: None,
    }
}
