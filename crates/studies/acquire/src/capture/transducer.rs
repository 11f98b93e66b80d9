//! Thread that reads and zeroes a transducer.

use std::time::{Duration, Instant};

use taceva_core::{
    Deadline, DriverError, DriverKey, ErrorKind, ForceFacts, ForceTransducer, Newton,
    NewtonMillimetre, Wrench,
};

use super::device_error;
use super::streams::Counts;
use super::track::Track;

/// Deadline of one call for a reading.
const CALL: Deadline = Deadline::after(Duration::from_millis(100));
/// Time without a new reading after which the transducer counts as failed.
const PATIENCE: Duration = Duration::from_secs(2);
/// Deadline for setting the zero.
const ZEROING: Deadline = Deadline::after(Duration::from_secs(6));
/// Averaging time of the zero for a transducer without a tare.
const MEAN_OVER: Duration = Duration::from_millis(250);
/// Delay after a failed call.
const REST: Duration = Duration::from_millis(5);

/// A transducer, and the zero wrench that the host subtracts.
pub(super) struct Transducer {
    pub(super) device: Box<dyn ForceTransducer>,
    pub(super) driver: DriverKey,
    pub(super) facts: ForceFacts,
    pub(super) zero: Wrench,
}

impl Transducer {
    /// Starts the readings and zeroes the present load.
    pub(super) fn begin(&mut self) -> Result<(), DriverError> {
        self.device.start(ZEROING)?;
        self.zero = Wrench::default();
        match self.device.tare() {
            Some(tare) => tare.zero(ZEROING),
            None => {
                self.zero = self.mean()?;
                Ok(())
            }
        }
    }

    fn mean(&mut self) -> Result<Wrench, DriverError> {
        let began = Instant::now();
        let (mut sum, mut count) = ([0.0; 6], 0_u32);
        while began.elapsed() < MEAN_OVER || count == 0 {
            let (wrench, _) = self.device.read(Deadline::after(PATIENCE))?;
            let numbers = numbers(&wrench);
            sum = std::array::from_fn(|at| sum[at] + numbers[at]);
            count += 1;
        }
        Ok(wrench(sum.map(|sum| sum / f64::from(count))))
    }

    /// Period of the readings, in s; 50 Hz is assumed if no rate is stated.
    pub(super) fn period_s(&self) -> f64 {
        const UNKNOWN_S: f64 = 0.02;
        self.facts.rate.map_or(UNKNOWN_S, |rate| 1.0 / rate.0)
    }

    /// Puts readings into `track` until the capture ends. Skips repeated readings of a transducer that rarely repeats one.
    ///
    /// # Errors
    /// The error that ended the readings: a lost device, a timeout, or a frozen signal.
    pub(super) fn read(&mut self, track: &Track, counts: &Counts) -> Result<(), DriverError> {
        let mut last: Option<(Wrench, Option<u64>)> = None;
        let mut was_new = Instant::now();
        while !counts.is_over() {
            match self.device.read(CALL) {
                Ok((said, stamp)) => {
                    let number = self.device.sequence();
                    let repeats = last.is_some_and(|(wrench, before)| {
                        let same_number = before.is_some() && before == number;
                        same_number || (wrench == said && self.facts.seldom_repeats())
                    });
                    last = Some((said, number));
                    if !repeats {
                        was_new = Instant::now();
                        track.push(stamp.valid_s, self.zeroed(&said));
                    } else if was_new.elapsed() >= PATIENCE {
                        return Err(self.frozen());
                    }
                }
                Err(error) => {
                    let is_passing = matches!(
                        error.kind(),
                        // A single invalid reading, or a timeout.
                        ErrorKind::Timeout | ErrorKind::DeviceFault | ErrorKind::OutOfRange
                    );
                    match error.kind() {
                        ErrorKind::Interrupted => {}
                        _ if !is_passing => return Err(error),
                        _ if was_new.elapsed() < PATIENCE => std::thread::sleep(REST),
                        kind => {
                            let why = format!("no reading for {PATIENCE:?}; last error: {error}");
                            return Err(self.failed(kind, why));
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn zeroed(&self, said: &Wrench) -> Wrench {
        let zero = numbers(&self.zero);
        let said = numbers(said);
        wrench(std::array::from_fn(|at| said[at] - zero[at]))
    }

    fn frozen(&self) -> DriverError {
        let why = format!(
            "force has not changed for {PATIENCE:?}: signal frozen. Check the transducer, its cable and its amplifier; for a device with coarse steps set `resolution_n`"
        );
        self.failed(ErrorKind::DeviceFault, why)
    }

    fn failed(&self, kind: ErrorKind, why: String) -> DriverError {
        device_error(kind, &self.driver, "read the force", why)
    }
}

fn numbers(wrench: &Wrench) -> [f64; 6] {
    let [fx, fy, fz] = wrench.force.map(|force| force.0);
    let [tx, ty, tz] = wrench.torque.map(|torque| torque.0);
    [fx, fy, fz, tx, ty, tz]
}

fn wrench([fx, fy, fz, tx, ty, tz]: [f64; 6]) -> Wrench {
    Wrench {
        force: [fx, fy, fz].map(Newton),
        torque: [tx, ty, tz].map(NewtonMillimetre),
    }
}
