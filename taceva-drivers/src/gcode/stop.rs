//! The means to stop a machine from any thread.

use std::sync::atomic::{AtomicBool, Ordering};

use taceva_core::{DriverError, DriverKey, ErrorKind, Halt};

use super::link::Writer;

/// A latch on this side, and what makes the machine stand.
#[derive(Debug)]
pub(super) struct Stop {
    driver: DriverKey,
    is_halted: AtomicBool,
    /// Set once the robot is dropped: there is nothing left to stop.
    is_gone: AtomicBool,
    writer: Writer,
    /// What the machine takes at once, whatever else it does.
    bytes: &'static [u8],
}

impl Stop {
    /// The stop of the machine behind `writer`, which stands when it is sent `bytes`.
    pub(super) fn new(driver: DriverKey, writer: Writer, bytes: &'static [u8]) -> Stop {
        Stop {
            driver,
            is_halted: AtomicBool::new(false),
            is_gone: AtomicBool::new(false),
            writer,
            bytes,
        }
    }

    pub(super) fn is_halted(&self) -> bool {
        self.is_halted.load(Ordering::Acquire)
    }

    /// Ends the latch; what is done to the machine is its driver's.
    pub(super) fn release(&self) {
        self.is_halted.store(false, Ordering::Release);
    }

    /// Says that the robot is gone.
    pub(super) fn retire(&self) {
        self.is_gone.store(true, Ordering::Release);
    }

    /// The error of a motion that was halted.
    pub(super) fn halted(&self) -> DriverError {
        DriverError::new(ErrorKind::Interrupted, &self.driver, super::limits::MOVE)
            .because("it was halted")
    }
}

impl Halt for Stop {
    fn halt(&self) -> Result<(), DriverError> {
        self.is_halted.store(true, Ordering::Release);
        if self.is_gone.load(Ordering::Acquire) {
            return Ok(());
        }
        self.writer.send(self.bytes).map_err(|error| {
            DriverError::new(ErrorKind::Disconnected, &self.driver, "stop the machine")
                .because(error)
        })
    }
}
