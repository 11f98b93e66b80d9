//! What every call that waits promises, of whichever kind its device is: it keeps its deadline, and ends when it is interrupted.

use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use taceva_core::{Deadline, DriverError, ErrorKind, ForceTransducer, Interrupt, Sensor};

use super::subject::{AT_ONCE, Ending, PATIENT, SOON, ensure, timed};
use crate::device::PluginSensor;

/// A device with a call that waits for the next that it has to say.
pub(super) trait Waits {
    /// Waits for it.
    fn next(&mut self, deadline: Deadline) -> Result<(), DriverError>;

    /// What ends the wait from another thread.
    fn interrupter(&self) -> Option<Arc<dyn Interrupt>>;
}

impl Waits for PluginSensor {
    fn next(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        super::sensor::capture(self, deadline).map(drop)
    }

    fn interrupter(&self) -> Option<Arc<dyn Interrupt>> {
        self.interrupt_handle()
    }
}

impl Waits for Box<dyn ForceTransducer> {
    fn next(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.read(deadline).map(drop)
    }

    fn interrupter(&self) -> Option<Arc<dyn Interrupt>> {
        self.interrupt_handle()
    }
}

/// Without time it ends soon, and goes on afterwards.
pub(super) fn passed_deadline(device: &mut impl Waits) -> Result<(), Ending> {
    for _ in 0..5 {
        in_time(device, Duration::ZERO)?;
    }
    Ok(device.next(PATIENT)?)
}

/// With little time it ends soon after.
pub(super) fn keeps_deadlines(device: &mut impl Waits) -> Result<(), Ending> {
    for _ in 0..10 {
        in_time(device, Duration::from_millis(5))?;
    }
    Ok(())
}

fn in_time(device: &mut impl Waits, given: Duration) -> Result<(), Ending> {
    let (waited, took) = timed(|| device.next(Deadline::after(given)));
    ensure(took < given + SOON, || {
        format!("{given:?} were given, and it took {took:?}")
    })?;
    match waited {
        Err(error) if error.kind() != ErrorKind::Timeout => Err(error.into()),
        _ => Ok(()),
    }
}

/// Interrupted from another thread it ends within 50 ms, and goes on afterwards.
pub(super) fn interrupt(device: &mut impl Waits) -> Result<(), Ending> {
    let interrupt = device.interrupter();
    let interrupt =
        interrupt.ok_or_else(|| Ending::Skipped("it cannot be interrupted".to_owned()))?;
    let interrupter = thread::spawn(move || {
        thread::sleep(Duration::from_millis(20));
        let now = Instant::now();
        interrupt.interrupt();
        now
    });
    let long = Deadline::after(Duration::from_secs(3));
    let mut begun = Instant::now();
    loop {
        let waited = device.next(long);
        let ended = Instant::now();
        match waited {
            // What came by itself: whether the interrupt met this call or none, the next must work.
            Ok(()) if !interrupter.is_finished() => begun = ended,
            Ok(()) => break,
            Err(error) if error.kind() == ErrorKind::Interrupted => {
                let at = interrupter
                    .join()
                    .map_err(|_| Ending::Broken("the check panicked".to_owned()))?;
                let late = ended.saturating_duration_since(at.max(begun));
                ensure(late < AT_ONCE, || {
                    format!("it took {late:?}, expected at most {AT_ONCE:?}")
                })?;
                break;
            }
            Err(error) => return Err(error.into()),
        }
    }
    Ok(device.next(PATIENT)?)
}
