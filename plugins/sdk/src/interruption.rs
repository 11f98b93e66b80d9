//! Waits that another thread can interrupt.

use std::fmt;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use taceva_core::{DriverError, Halt, Interrupt};

/// Interrupts the pending call of a device. Serves as the `interrupt_handle` of a sensor, a force transducer or a changer.
///
/// ```
/// use std::{sync::Arc, thread, time::Duration};
/// use taceva_core::Interrupt;
/// use taceva_plugin::{Interrupted, Interruption};
/// let interruption = Arc::new(Interruption::default());
/// let call = interruption.call();
/// let other = Arc::clone(&interruption);
/// thread::spawn(move || other.interrupt());
/// assert_eq!(call.rest(Duration::from_secs(60)), Err(Interrupted));
/// drop(call);
/// interruption.interrupt(); // nothing is pending, and nothing happens
/// assert_eq!(interruption.call().rest(Duration::ZERO), Ok(()));
/// ```
#[derive(Debug, Default)]
pub struct Interruption {
    pending: Mutex<Pending>,
    bell: Condvar,
}

#[derive(Debug, Default)]
struct Pending {
    calls: u32,
    is_interrupted: bool,
}

/// Error of an interrupted call.
///
/// ```
/// use taceva_core::{DriverError, DriverKey, ErrorKind};
/// use taceva_plugin::Interrupted;
/// let key = DriverKey::fixed("org.example.scale/scale");
/// let error = DriverError::new(ErrorKind::Interrupted, &key, "read the force").because(Interrupted);
/// assert!(error.to_string().contains("it was interrupted"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interrupted;

impl fmt::Display for Interrupted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("it was interrupted")
    }
}

impl std::error::Error for Interrupted {}

/// Call of a device in progress. Until this value is dropped, another thread can interrupt the call.
///
/// ```
/// use std::time::Duration;
/// use taceva_core::Interrupt;
/// use taceva_plugin::{Interrupted, Interruption};
/// let interruption = Interruption::default();
/// let call = interruption.call();
/// assert_eq!(call.rest(Duration::ZERO), Ok(()));
/// interruption.interrupt();
/// assert_eq!(call.rest(Duration::from_secs(60)), Err(Interrupted));
/// ```
#[derive(Debug)]
pub struct InterruptibleCall<'a> {
    interruption: &'a Interruption,
}

impl Interruption {
    /// Handle to return from `interrupt_handle` of a device.
    pub fn handle(self: &Arc<Interruption>) -> Option<Arc<dyn Interrupt>> {
        Some(Arc::clone(self) as Arc<dyn Interrupt>)
    }

    /// Marks the beginning of a call that another thread can interrupt. The call ends when the returned value is dropped.
    pub fn call(&self) -> InterruptibleCall<'_> {
        self.pending().calls += 1;
        InterruptibleCall { interruption: self }
    }

    fn pending(&self) -> MutexGuard<'_, Pending> {
        self.pending.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl InterruptibleCall<'_> {
    /// Waits for `time`. Returns earlier if the call is interrupted.
    ///
    /// # Errors
    /// [`Interrupted`] if the call was interrupted before or during the wait.
    pub fn rest(&self, time: Duration) -> Result<(), Interrupted> {
        let bell = &self.interruption.bell;
        let pending = self.interruption.pending();
        let (pending, _) = bell
            .wait_timeout_while(pending, time, |pending| !pending.is_interrupted)
            .unwrap_or_else(PoisonError::into_inner);
        if pending.is_interrupted {
            Err(Interrupted)
        } else {
            Ok(())
        }
    }
}

impl Drop for InterruptibleCall<'_> {
    fn drop(&mut self) {
        let mut pending = self.interruption.pending();
        pending.calls -= 1;
        if pending.calls == 0 {
            pending.is_interrupted = false;
        }
    }
}

impl Interrupt for Interruption {
    fn interrupt(&self) {
        let mut pending = self.pending();
        if pending.calls > 0 {
            pending.is_interrupted = true;
            self.bell.notify_all();
        }
    }
}

/// State of a halted robot, kept until it is cleared. Serves as the `halt_handle` of a robot that has no function for halting.
///
/// A motion in steps that waits on this latch ends within one step. A robot that moves without further commands must also be stopped.
///
/// ```
/// use std::{sync::Arc, time::Duration};
/// use taceva_plugin::{HaltLatch, Interrupted};
/// let latch = Arc::new(HaltLatch::default());
/// latch.handle().halt()?; // from any thread
/// assert_eq!(latch.rest(Duration::from_secs(60)), Err(Interrupted));
/// latch.clear();
/// assert_eq!(latch.rest(Duration::ZERO), Ok(()));
/// # Ok::<(), taceva_core::DriverError>(())
/// ```
#[derive(Debug, Default)]
pub struct HaltLatch {
    is_halted: Mutex<bool>,
    bell: Condvar,
}

impl HaltLatch {
    /// Handle to return from `halt_handle` of a robot.
    pub fn handle(self: &Arc<HaltLatch>) -> Arc<dyn Halt> {
        Arc::clone(self) as Arc<dyn Halt>
    }

    /// Waits for `time`. Returns earlier if the robot is halted.
    ///
    /// # Errors
    /// [`Interrupted`] if the robot is halted before or during the wait.
    pub fn rest(&self, time: Duration) -> Result<(), Interrupted> {
        let latch = self.latch();
        let (is_halted, _) = self
            .bell
            .wait_timeout_while(latch, time, |is_halted| !*is_halted)
            .unwrap_or_else(PoisonError::into_inner);
        if *is_halted { Err(Interrupted) } else { Ok(()) }
    }

    /// Ends the halt, so that the robot can move again. Does nothing if the robot is not halted.
    pub fn clear(&self) {
        *self.latch() = false;
    }

    fn latch(&self) -> MutexGuard<'_, bool> {
        self.is_halted
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}

impl Halt for HaltLatch {
    fn halt(&self) -> Result<(), DriverError> {
        *self.latch() = true;
        self.bell.notify_all();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interrupt_is_of_the_pending_call_and_not_of_the_next() {
        let interruption = Interruption::default();
        interruption.interrupt();
        let call = interruption.call();
        assert_eq!(call.rest(Duration::ZERO), Ok(()));
        interruption.interrupt();
        assert_eq!(call.rest(Duration::from_secs(60)), Err(Interrupted));
        drop(call);
        assert_eq!(interruption.call().rest(Duration::ZERO), Ok(()));
    }

    #[test]
    fn a_halt_stays_until_it_is_cleared() {
        let latch = Arc::new(HaltLatch::default());
        assert_eq!(latch.rest(Duration::ZERO), Ok(()));
        latch.handle().halt().expect("halts");
        assert_eq!(latch.rest(Duration::from_secs(60)), Err(Interrupted));
        latch.clear();
        assert_eq!(latch.rest(Duration::from_millis(1)), Ok(()));
    }
}
