//! What every device promises that is started and then gives one item after another: sensors give frames, force transducers readings.

use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use taceva_core::{Deadline, DriverError, ErrorKind, Interrupt, Stamp};

use super::subject::{AT_ONCE, Ending, PATIENT, SOON, Subject, ensure, timed};

/// A device that is started and then gives one item after another.
pub(super) trait Streams: Sized {
    /// What it gives.
    const ITEM: &'static str;
    /// How many are asked for at once.
    const COUNT: usize;

    /// Opens the one that is checked.
    fn open(subject: &Subject) -> Result<Self, Ending>;

    fn begin(&mut self) -> Result<(), DriverError>;

    fn end(&mut self) -> Result<(), DriverError>;

    /// Waits for the next item; when it was true.
    fn next(&mut self, deadline: Deadline) -> Result<Stamp, DriverError>;

    /// What ends the wait from another thread.
    fn interrupter(&self) -> Option<Arc<dyn Interrupt>>;

    fn started(subject: &Subject) -> Result<Self, Ending> {
        let mut device = Self::open(subject)?;
        device.begin()?;
        Ok(device)
    }
}

/// [`Streams::COUNT`] items come, and it stops.
pub(super) fn gives<D: Streams>(subject: &Subject) -> Result<(), Ending> {
    let mut device = D::started(subject)?;
    for _ in 0..D::COUNT {
        device.next(PATIENT)?;
    }
    Ok(device.end()?)
}

pub(super) fn stamps<D: Streams>(subject: &Subject) -> Result<(), Ending> {
    let mut device = D::started(subject)?;
    let mut last = f64::NEG_INFINITY;
    for _ in 0..D::COUNT {
        let stamp = device.next(PATIENT)?;
        ensure(stamp.valid_s > last, || {
            let item = D::ITEM;
            format!("a {item} of {} s after one of {last} s", stamp.valid_s)
        })?;
        last = stamp.valid_s;
    }
    Ok(())
}

/// An item before the start comes or is refused; either way the device goes on.
pub(super) fn before_start<D: Streams>(subject: &Subject) -> Result<(), Ending> {
    let mut device = D::open(subject)?;
    match device.next(PATIENT) {
        Err(error) if error.kind() != ErrorKind::InvalidArgument => return Err(error.into()),
        _ => {}
    }
    device.begin()?;
    device.next(PATIENT)?;
    Ok(())
}

pub(super) fn any_order<D: Streams>(subject: &Subject) -> Result<(), Ending> {
    let mut device = D::open(subject)?;
    device.end()?;
    for _ in 0..3 {
        device.begin()?;
        device.begin()?;
        device.next(PATIENT)?;
        device.end()?;
        device.end()?;
    }
    Ok(())
}

pub(super) fn dropped<D: Streams>(subject: &Subject) -> Result<(), Ending> {
    drop(D::open(subject)?);
    drop(D::started(subject)?);
    let mut device = D::started(subject)?;
    let _ = device.next(Deadline::PASSED);
    drop(device);
    let mut device = D::started(subject)?;
    device.end()?;
    drop(device);
    drop(D::started(subject)?);
    Ok(())
}

/// Without time it ends soon, and goes on afterwards.
pub(super) fn passed_deadline<D: Streams>(subject: &Subject) -> Result<(), Ending> {
    let mut device = D::started(subject)?;
    for _ in 0..5 {
        in_time(&mut device, Duration::ZERO)?;
    }
    device.next(PATIENT)?;
    Ok(())
}

/// With little time it ends soon after.
pub(super) fn keeps_deadlines<D: Streams>(subject: &Subject) -> Result<(), Ending> {
    let mut device = D::started(subject)?;
    for _ in 0..10 {
        in_time(&mut device, Duration::from_millis(5))?;
    }
    Ok(())
}

fn in_time(device: &mut impl Streams, given: Duration) -> Result<(), Ending> {
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
pub(super) fn interrupt<D: Streams>(subject: &Subject) -> Result<(), Ending> {
    let mut device = D::started(subject)?;
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
            Ok(_) if !interrupter.is_finished() => begun = ended,
            Ok(_) => break,
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
    device.next(PATIENT)?;
    Ok(())
}
