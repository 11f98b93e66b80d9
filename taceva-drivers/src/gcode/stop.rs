//! Halt of a machine from any thread.

use std::sync::atomic::{AtomicBool, Ordering};

use taceva_core::{DriverError, DriverKey, ErrorKind, Halt};

use super::link::Writer;

/// Halt handle: a flag in the driver that stays set until its release, and the bytes that stop the machine.
#[derive(Debug)]
pub(super) struct Stop {
    driver: DriverKey,
    is_halted: AtomicBool,
    /// True after the robot is dropped. A halt then sends nothing.
    is_gone: AtomicBool,
    writer: Writer,
    /// Bytes of a stop command that the machine executes at once in any state.
    bytes: &'static [u8],
}

impl Stop {
    /// Creates the halt handle of the machine that `writer` reaches. `bytes` stop the machine.
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

    /// Clears the flag of a halt in the driver. Sends nothing to the machine.
    pub(super) fn release(&self) {
        self.is_halted.store(false, Ordering::Release);
    }

    /// Records that the robot was dropped.
    pub(super) fn retire(&self) {
        self.is_gone.store(true, Ordering::Release);
    }

    /// Error of a halted motion.
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
