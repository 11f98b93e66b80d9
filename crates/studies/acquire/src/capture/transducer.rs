//! Thread that reads and zeroes a transducer.

use std::time::{Duration, Instant};

use taceva_core::{
    Deadline, DriverError, DriverKey, ErrorKind, ForceFacts, ForceTransducer, Newton,
    NewtonMillimetre, Wrench,
};

use super::device_error;
use super::streams::Counts;
use super::track::Track;

/// Deadline for each call that requests a reading.
const CALL: Deadline = Deadline::after(Duration::from_millis(100));
/// Time without a new reading after which the transducer counts as failed.
const PATIENCE: Duration = Duration::from_secs(2);
/// Deadline for setting the force zero.
const ZEROING: Deadline = Deadline::after(Duration::from_secs(6));
/// Averaging time of the force zero for a transducer without a tare function.
const MEAN_OVER: Duration = Duration::from_millis(250);
/// Delay before a failed call is retried.
const REST: Duration = Duration::from_millis(5);
/// Force above which the gel counts as pressed by a hand, in N. The load then changes continuously.
const PRESSED_N: f64 = 0.1;

/// A transducer, and the zero wrench that the host subtracts.
pub(super) struct Transducer {
    pub(super) device: Box<dyn ForceTransducer>,
    pub(super) driver: DriverKey,
    pub(super) facts: ForceFacts,
    pub(super) zero: Wrench,
}

impl Transducer {
    /// Starts the readings, and sets the force zero at the present load.
    pub(super) fn begin(&mut self) -> Result<(), DriverError> {
        self.device.start(ZEROING)?;
        self.zero = Wrench::default();
        match self.device.tare() {
            Some(tare) => tare.zero(ZEROING)?,
            None => self.zero = self.mean()?,
        }
        // Some devices know their steps from their first reading.
        self.facts.resolution = self.facts.resolution.or(self.device.resolution());
        Ok(())
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

    /// Period of the readings, in s. A rate of 50 Hz is assumed if the transducer states no rate.
    pub(super) fn period_s(&self) -> f64 {
        const UNKNOWN_S: f64 = 0.02;
        self.facts.rate.map_or(UNKNOWN_S, |rate| 1.0 / rate.0)
    }

    /// Adds readings to `track` until the capture ends. Skips a repeated reading. It has the last sequence number, or an equal value although noise
    /// or a pressing hand would have changed the value.
    ///
    /// # Errors
    /// The error that ended the stream of readings: a lost device, a timeout, or a frozen signal.
    pub(super) fn read(&mut self, track: &Track, counts: &Counts) -> Result<(), DriverError> {
        let mut last: Option<(Wrench, Option<u64>)> = None;
        let mut habit = Habit::default();
        let mut was_new = Instant::now();
        while !counts.is_over() {
            match self.device.read(CALL) {
                Ok((said, stamp)) => {
                    let number = self.device.sequence();
                    let is_equal = last.is_some_and(|(wrench, _)| wrench == said);
                    let repeats = last.is_some_and(|(_, before)| {
                        let same_number = before.is_some() && before == number;
                        let must_change = habit.is_lively() || self.is_pressed(&said);
                        same_number || (is_equal && self.facts.seldom_repeats() && must_change)
                    });
                    last = Some((said, number));
                    if !repeats {
                        habit.count(is_equal);
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

    fn is_pressed(&self, said: &Wrench) -> bool {
        let force = self.zeroed(said).force;
        force.iter().any(|force| force.0.abs() > PRESSED_N)
    }

    fn zeroed(&self, said: &Wrench) -> Wrench {
        let zero = numbers(&self.zero);
        let said = numbers(said);
        wrench(std::array::from_fn(|at| said[at] - zero[at]))
    }

    fn frozen(&self) -> DriverError {
        let why = format!(
            "force has not changed for {PATIENCE:?}, although most earlier readings differed or the gel is pressed: signal frozen. Check the transducer, its cable and its amplifier; for a device with coarse steps state them as `resolution_n` in its selector"
        );
        self.failed(ErrorKind::DeviceFault, why)
    }

    fn failed(&self, kind: ErrorKind, why: String) -> DriverError {
        device_error(kind, &self.driver, "read the force", why)
    }
}

/// Numbers of readings that differ from, or equal, the previous reading.
#[derive(Clone, Copy, Debug, Default)]
struct Habit {
    changed: u32,
    equal: u32,
}

impl Habit {
    /// Minimum number of changed readings from which noise is inferred.
    const LEAST: u32 = 10;

    fn count(&mut self, is_equal: bool) {
        let counter = match is_equal {
            true => &mut self.equal,
            false => &mut self.changed,
        };
        *counter = counter.saturating_add(1);
    }

    /// True if most readings differ from the previous reading, because of noise. A run of equal readings is then a frozen signal.
    fn is_lively(self) -> bool {
        self.changed >= Self::LEAST && self.changed > self.equal
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

#[cfg(test)]
mod waiting {
    use taceva_core::{Axes, Stamp};

    use super::*;

    /// Test transducer that counts its readings. `loads` returns their forces.
    struct Scripted<F> {
        loads: F,
        read: u32,
    }

    impl<F: FnMut(u32) -> f64 + Send> ForceTransducer for Scripted<F> {
        fn axes(&self) -> Axes {
            Axes::NORMAL
        }

        fn read(&mut self, _: Deadline) -> Result<(Wrench, Stamp), DriverError> {
            std::thread::sleep(Duration::from_millis(2));
            self.read += 1;
            let fz_n = (self.loads)(self.read);
            let stamp = Stamp::at(Duration::from_millis(2 * u64::from(self.read)));
            Ok((wrench([0.0, 0.0, fz_n, 0.0, 0.0, 0.0]), stamp))
        }
    }

    /// Reads a transducer with the forces `loads` for three seconds. Returns the error that ended the stream.
    fn read(facts: ForceFacts, loads: impl FnMut(u32) -> f64 + Send + 'static) -> Option<String> {
        let mut transducer = Transducer {
            device: Box::new(Scripted { loads, read: 0 }),
            driver: DriverKey::fixed("test/force"),
            facts,
            zero: Wrench::default(),
        };
        let counts = Counts::of(false);
        let track = Track::new(0.002, None);
        std::thread::scope(|scope| {
            let reading = scope.spawn(|| transducer.read(&track, &counts));
            let began = Instant::now();
            while !reading.is_finished() && began.elapsed() < Duration::from_secs(3) {
                std::thread::sleep(Duration::from_millis(10));
            }
            counts.end();
            let ended = reading.join().expect("no panic");
            ended.err().map(|error| error.to_string())
        })
    }

    #[test]
    fn a_transducer_at_rest_may_repeat_a_number_and_under_a_load_it_may_not() {
        let facts = ForceFacts::default();
        assert_eq!(read(facts, |_| 0.0), None, "a scale at rest");
        let loaded = read(facts, |_| 0.5).expect("pressed and equal");
        assert!(loaded.contains("`resolution_n`"), "{loaded}");
        let stepped = facts.with_resolution(Newton(0.01));
        assert_eq!(read(stepped, |_| 0.5), None, "a weight on a scale");
    }

    #[test]
    fn a_transducer_that_always_changed_is_frozen_when_it_repeats_even_at_rest() {
        let noisy = |read: u32| match read {
            0..60 => 1e-4 * f64::from(read % 7),
            _ => 0.0,
        };
        let frozen = read(ForceFacts::default(), noisy).expect("frozen");
        assert!(frozen.contains("signal frozen"), "{frozen}");
    }
}
