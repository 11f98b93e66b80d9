//! Promises of devices that deliver a sequence of items once started: frames of a sensor, or readings of a force transducer.

use std::sync::Arc;
use std::time::{Duration, Instant};

use taceva_core::{
    Deadline, DriverError, ErrorKind, ForceTransducer, FrameMut, Interrupt, Sensor, Stamp,
};

use crate::promise::{Unmet, answered, broken, expect, in_order, refused, skipped};
use crate::trial::{Alarm, Tried, was_within};

/// Number of short calls of one series, and number of late calls that show a device that blocks. The item of the other calls may have arrived before.
const SHORT_CALLS: usize = 10;
const LATE_CALLS: usize = 8;
/// Deadline of a short call.
const SHORT: Duration = Duration::from_millis(5);
/// Number of series. One series must be in time, because other programs may delay the other series.
const SERIES: usize = 3;

/// Device that delivers a sequence of items once started, such as frames.
pub(crate) trait Stream {
    /// Name of an item in messages: `frame` or `reading`.
    const ITEM: &'static str;
    /// Number of items that each promise examines.
    const COUNT: usize;

    fn begin(&mut self, deadline: Deadline) -> Result<(), DriverError>;

    fn end(&mut self) -> Result<(), DriverError>;

    /// Waits for the next item and returns its stamp.
    fn next(&mut self, deadline: Deadline) -> Result<Stamp, DriverError>;

    fn interrupter(&self) -> Option<Arc<dyn Interrupt>>;
}

impl Stream for dyn Sensor {
    const ITEM: &'static str = "frame";
    const COUNT: usize = 10;

    fn begin(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.start(deadline)
    }

    fn end(&mut self) -> Result<(), DriverError> {
        self.stop()
    }

    fn next(&mut self, deadline: Deadline) -> Result<Stamp, DriverError> {
        Ok(capture(self, deadline)?.0)
    }

    fn interrupter(&self) -> Option<Arc<dyn Interrupt>> {
        self.interrupt_handle()
    }
}

impl Stream for dyn ForceTransducer {
    const ITEM: &'static str = "reading";
    const COUNT: usize = 20;

    fn begin(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.start(deadline)
    }

    fn end(&mut self) -> Result<(), DriverError> {
        self.stop()
    }

    fn next(&mut self, deadline: Deadline) -> Result<Stamp, DriverError> {
        Ok(self.read(deadline)?.1)
    }

    fn interrupter(&self) -> Option<Arc<dyn Interrupt>> {
        self.interrupt_handle()
    }
}

/// Captures the next frame of a sensor. Returns the frame and its stamp.
pub(crate) fn capture(
    sensor: &mut dyn Sensor,
    deadline: Deadline,
) -> Result<(Stamp, Vec<u8>), DriverError> {
    let info = sensor.frame_info();
    let mut pixels = vec![0; info.byte_len().unwrap_or_default()];
    let frame = FrameMut::new(info, &mut pixels).expect("the buffer was made for the frame");
    let stamp = sensor.capture(frame, deadline)?;
    Ok((stamp, pixels))
}

/// Opens the device and starts it.
pub(crate) fn started<D: Stream + ?Sized>(tried: &Tried<'_, D>) -> Result<Box<D>, Unmet> {
    let mut device = tried.open()?;
    device.begin(tried.trial.deadline)?;
    Ok(device)
}

pub(crate) fn next<D: Stream + ?Sized>(
    tried: &Tried<'_, D>,
    device: &mut D,
) -> Result<Stamp, Unmet> {
    tried.reading(device.next(tried.trial.deadline))
}

/// The device yields [`Stream::COUNT`] items and then stops.
pub(crate) fn gives<D: Stream + ?Sized>(tried: &Tried<'_, D>) -> Result<(), Unmet> {
    let mut device = started(tried)?;
    for _ in 0..D::COUNT {
        next(tried, &mut *device)?;
    }
    Ok(device.end()?)
}

pub(crate) fn stamps<D: Stream + ?Sized>(tried: &Tried<'_, D>) -> Result<(), Unmet> {
    let mut device = started(tried)?;
    let stamps = (0..D::COUNT).map(|_| next(tried, &mut *device));
    in_order(&stamps.collect::<Result<Vec<_>, _>>()?)
}

/// A request for an item before the start either returns an item or fails. The device can then be started normally.
pub(crate) fn before_start<D: Stream + ?Sized>(tried: &Tried<'_, D>) -> Result<(), Unmet> {
    let mut device = tried.open()?;
    let doing = format!("a {} before the start", D::ITEM);
    let early = device.next(tried.trial.deadline);
    answered(&doing, early, ErrorKind::InvalidArgument)?;
    device.begin(tried.trial.deadline)?;
    next(tried, &mut *device)?;
    Ok(())
}

pub(crate) fn any_order<D: Stream + ?Sized>(tried: &Tried<'_, D>) -> Result<(), Unmet> {
    let mut device = tried.open()?;
    device.end()?;
    let mut stamps = Vec::new();
    for _ in 0..3 {
        device.begin(tried.trial.deadline)?;
        device.begin(tried.trial.deadline)?;
        stamps.push(next(tried, &mut *device)?);
        device.end()?;
        device.end()?;
        let doing = format!("a {} while stopped", D::ITEM);
        match tried.at_once(&doing, || device.next(Deadline::PASSED))? {
            Ok(stamp) => stamps.push(stamp),
            error => refused(
                &doing,
                error,
                &[ErrorKind::InvalidArgument, ErrorKind::Timeout],
            )?,
        }
    }
    in_order(&stamps)
}

/// Dropping a device releases its resources, if the device is new, started, or stopped. A further device can then be opened.
pub(crate) fn dropped<D: Stream + ?Sized>(tried: &Tried<'_, D>) -> Result<(), Unmet> {
    drop(tried.open()?);
    drop(started(tried)?);
    let mut device = started(tried)?;
    let _ = device.next(Deadline::PASSED);
    drop(device);
    let mut device = started(tried)?;
    device.end()?;
    drop(device);
    next(tried, &mut *started(tried)?)?;
    Ok(())
}

/// A wait whose deadline has passed ends at once. The device works afterwards.
pub(crate) fn passed_deadline<D: Stream + ?Sized>(tried: &Tried<'_, D>) -> Result<(), Unmet> {
    let mut device = started(tried)?;
    for _ in 0..5 {
        wait(tried, &mut *device, Duration::ZERO)?;
    }
    next(tried, &mut *device)?;
    Ok(())
}

/// A wait with a short deadline ends at most `Trial::at_once` after the deadline. In one of several series, only a few waits end more than
/// `Trial::overrun` after it. The device works afterwards.
pub(crate) fn keeps_deadlines<D: Stream + ?Sized>(tried: &Tried<'_, D>) -> Result<(), Unmet> {
    let most = SHORT + tried.trial.overrun;
    let mut shortest = Duration::MAX;
    for _ in 0..SERIES {
        // After ten late items in a row the host returns an error, so each series opens the device again.
        let mut device = started(tried)?;
        let (mut calls, mut late) = (0, 0);
        while calls < SHORT_CALLS && late < LATE_CALLS {
            let took = wait(tried, &mut *device, SHORT)?;
            calls += 1;
            if took > most {
                late += 1;
                shortest = shortest.min(took);
            }
        }
        if late < LATE_CALLS {
            next(tried, &mut *device)?;
            return Ok(());
        }
    }
    Err(broken(format!(
        "a {} in {SHORT:?} took {shortest:.1?} or longer in {LATE_CALLS} of {SHORT_CALLS} calls, expected at most {most:?}: let the call return `timeout` at its deadline",
        D::ITEM
    )))
}

/// Waits for the next item, at most for the duration `given`. Returns the duration of the call, whether an item came or not.
fn wait<D: Stream + ?Sized>(
    tried: &Tried<'_, D>,
    device: &mut D,
    given: Duration,
) -> Result<Duration, Unmet> {
    let doing = format!("a {} in {given:?}", D::ITEM);
    let within = match given {
        Duration::ZERO => Deadline::PASSED,
        given => Deadline::after(given),
    };
    let begun = Instant::now();
    let waited = tried.in_time(&doing, given, || device.next(within))?;
    let took = begun.elapsed();
    match waited {
        Err(error) if error.kind() == ErrorKind::EndOfStream => tried.reading(Err(error)),
        waited => answered(&doing, waited, ErrorKind::Timeout).map(|()| took),
    }
}

/// An interrupt from another thread ends a wait within `Trial::acts_within`. The device works afterwards.
pub(crate) fn interrupt<D: Stream + ?Sized>(tried: &Tried<'_, D>) -> Result<(), Unmet> {
    let mut device = started(tried)?;
    let alarm = Alarm::set(device.interrupter())?;
    let long = Deadline::after(Duration::from_secs(3));
    let mut begun = Instant::now();
    loop {
        let waited = device.next(long);
        let ended = Instant::now();
        let rang = match waited {
            // An interrupt before this call has no effect on it.
            Ok(_) => alarm
                .rang()
                .map(|rang| if rang < begun { ended } else { rang }),
            Err(error) if error.kind() == ErrorKind::Interrupted => Some(alarm.wait()?),
            Err(error) => return tried.reading(Err(error)),
        };
        // An item before the interrupt: the next call must work even if the interrupt reached this one.
        let Some(rang) = rang else {
            begun = ended;
            continue;
        };
        let late = ended.saturating_duration_since(rang.max(begun));
        was_within("the wait after an interrupt", late, tried.trial.acts_within)?;
        break;
    }
    next(tried, &mut *device)?;
    Ok(())
}

/// A simulated device delivers equal items in two runs with equal arguments.
pub(crate) fn repeats<D: Stream + ?Sized, T: PartialEq>(
    tried: &Tried<'_, D>,
    item: fn(&mut D, Deadline) -> Result<T, DriverError>,
) -> Result<(), Unmet> {
    tried.is_simulated()?;
    let items = || -> Result<Vec<T>, Unmet> {
        let mut device = started(tried)?;
        let deadline = tried.trial.deadline;
        let items = (0..D::COUNT).map(|_| tried.reading(item(&mut device, deadline)));
        items.collect()
    };
    let (first, second) = (items()?, items()?);
    expect(first == second, || {
        "two runs give different data".to_owned()
    })
}

/// Passes if the device has the `ability` and the driver declares it. Skips the promise if neither holds; fails otherwise.
pub(crate) fn as_declared(ability: &str, declared: bool, has: bool) -> Result<(), Unmet> {
    match (has, declared) {
        (true, true) => Ok(()),
        (false, false) => Err(skipped(format!("it does not {ability}"))),
        (false, true) => Err(broken(format!(
            "it declares that it can {ability}, but it cannot"
        ))),
        (true, false) => Err(broken(format!("it can {ability}, but does not declare it"))),
    }
}
