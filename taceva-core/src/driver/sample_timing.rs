//! Checks of the time stamps of a device, and of its rate against the declared rate.

use std::fmt;
use std::time::{Duration, Instant};

use super::stamp_rate::{StampRate, StampWindows};
use crate::quantity::Hertz;
use crate::stamp::Stamp;

/// Time that a sample may take before it is late, in periods of the declared rate.
const LATE_PERIODS: f64 = 10.0;
/// Time that a sample may take at any rate before it is late, s. Links and busy machines deliver many samples at once.
const LATE_LEAST_S: f64 = 0.05;
/// Number of consecutive late samples that causes [`TimingError::Late`].
const LATE_MAX: u32 = 10;
/// Greatest accepted jump of the time stamps of a device, s.
const JUMP_S: f64 = 60.0;

/// Checks the delays and stamps of the samples of one device.
///
/// A sample is late if the calls for this sample took more than ten periods of the declared rate and more than 50 ms. Ten consecutive late samples
/// are an error, and so is a stamp that jumps by more than a minute. An old stamp is accepted, because samples may wait in a queue.
/// [`with_unit_check`](SampleTiming::with_unit_check) also rejects stamps in another unit.
///
/// ```
/// use std::time::{Duration, Instant};
/// use taceva_core::{Hertz, SampleTiming, Stamp};
///
/// let mut timing = SampleTiming::of(Some(Hertz(100.0)));
/// timing.wait(Duration::from_millis(10));
/// timing.sample(Instant::now(), Stamp::at(Duration::ZERO))?;
/// let an_hour_later = Stamp::at(Duration::from_secs(3600));
/// assert!(timing.sample(Instant::now(), an_hour_later).is_err());
/// # Ok::<(), taceva_core::TimingError>(())
/// ```
#[derive(Clone, Debug)]
pub struct SampleTiming {
    /// False for a simulated device or a recording, whose samples are not checked.
    is_checked: bool,
    rate: Option<Hertz>,
    /// Duration of the calls since the last sample.
    waited: Duration,
    late: u32,
    last: Option<Last>,
    /// Check of the unit of the stamps; `None` if the check is off.
    windows: Option<StampWindows>,
}

/// Times of the accepted samples so far.
#[derive(Clone, Copy, Debug)]
struct Last {
    /// Time of arrival of the first sample.
    begun: Instant,
    stamp_s: f64,
    /// Greatest difference so far between a stamp and the time from `begun` to the arrival of its sample, s.
    ahead_s: f64,
}

impl SampleTiming {
    /// Checks for a device that declares `rate`. With `None`, delays are not checked.
    pub fn of(rate: Option<Hertz>) -> SampleTiming {
        SampleTiming {
            is_checked: true,
            rate,
            waited: Duration::ZERO,
            late: 0,
            last: None,
            windows: None,
        }
    }

    /// The same checks, and one for stamps in another unit: they advance by less than 0.5 % of the duration of the calls. For real devices.
    #[must_use]
    pub fn with_unit_check(self) -> SampleTiming {
        SampleTiming {
            windows: Some(StampWindows::default()),
            ..self
        }
    }

    /// Timing without checks, for a simulated device or a recording, whose clock is not the clock of the host.
    pub fn unchecked() -> SampleTiming {
        SampleTiming {
            is_checked: false,
            ..SampleTiming::of(None)
        }
    }

    /// Adds the duration of one call for a sample, successful or not.
    pub fn wait(&mut self, took: Duration) {
        self.waited = self.waited.saturating_add(took);
    }

    /// Checks a sample that arrived at `now`.
    ///
    /// # Errors
    /// [`TimingError`] for the tenth consecutive late sample, for a stamp that jumps, or for stamps in another unit.
    pub fn sample(&mut self, now: Instant, stamp: Stamp) -> Result<(), TimingError> {
        let took = std::mem::take(&mut self.waited);
        if !self.is_checked {
            return Ok(());
        }
        let took_s = took.as_secs_f64();
        self.check_rate(took_s)?;
        self.check_stamp(now, stamp.valid_s)?;
        let windows = self.windows.as_mut();
        match windows.and_then(|windows| windows.add(stamp.valid_s, took_s)) {
            Some(rate) => Err(TimingError::Unit { rate }),
            None => Ok(()),
        }
    }

    fn check_rate(&mut self, took_s: f64) -> Result<(), TimingError> {
        let Some(rate) = self.rate.filter(|rate| rate.0 > 0.0) else {
            return Ok(());
        };
        let limit_s = (LATE_PERIODS / rate.0).max(LATE_LEAST_S);
        if took_s <= limit_s {
            self.late = 0;
            return Ok(());
        }
        self.late = self.late.saturating_add(1);
        if self.late < LATE_MAX {
            return Ok(());
        }
        Err(TimingError::Late {
            samples: self.late,
            limit_s,
            took_s,
            rate,
        })
    }

    /// Rejects a stamp more than [`JUMP_S`] before the last stamp, and a stamp that gains more than this on the clock of the host.
    fn check_stamp(&mut self, now: Instant, stamp_s: f64) -> Result<(), TimingError> {
        let begun = self.last.map_or(now, |last| last.begun);
        let ahead_s = stamp_s - now.saturating_duration_since(begun).as_secs_f64();
        let mut newest_s = ahead_s;
        if let Some(last) = self.last {
            let forward_s = ahead_s - last.ahead_s;
            let back_s = stamp_s - last.stamp_s;
            if forward_s > JUMP_S {
                return Err(TimingError::Jump { jump_s: forward_s });
            }
            if back_s < -JUMP_S {
                return Err(TimingError::Jump { jump_s: back_s });
            }
            newest_s = ahead_s.max(last.ahead_s);
        }
        self.last = Some(Last {
            begun,
            stamp_s,
            ahead_s: newest_s,
        });
        Ok(())
    }
}

/// Error of a device whose samples are late, or whose stamps jump or are in another unit.
///
/// ```
/// use taceva_core::TimingError;
/// let jump = TimingError::Jump { jump_s: -3600.0 };
/// assert!(jump.to_string().starts_with("the stamps jump by -3600.0 s: check the clock of the device"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TimingError {
    /// Consecutive samples that each took more than ten periods of the declared rate and more than 50 ms.
    Late {
        /// Number of consecutive late samples.
        samples: u32,
        /// Time that a sample may take before it is late, s: ten periods, but at least 0.05 s.
        limit_s: f64,
        /// Duration of the calls for the last sample, s.
        took_s: f64,
        /// Declared rate.
        rate: Hertz,
    },
    /// The stamps gain more than a minute on the host's clock, or jump back by more than a minute.
    Jump {
        /// Size of the jump, s; negative for a jump back in time.
        jump_s: f64,
    },
    /// Stamps that advance far more slowly than the clock of the host.
    Unit {
        /// Advance of the stamps per second of the host's clock, in s.
        rate: StampRate,
    },
}

impl fmt::Display for TimingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TimingError::Late {
                samples,
                limit_s,
                took_s,
                rate,
            } => write!(
                f,
                "{samples} samples in a row took more than {limit_s:.3} s at a declared {rate}, the last one {took_s:.3} s: check the device and the load of this machine, or declare its actual rate (argument `rate`, or `rate_hz` of a plugin)"
            ),
            TimingError::Jump { jump_s } => write!(
                f,
                "the stamps jump by {jump_s:.1} s: check the clock of the device and the unit of its stamps"
            ),
            TimingError::Unit { rate } => write!(f, "{rate}"),
        }
    }
}

impl std::error::Error for TimingError {}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: Duration = Duration::from_millis(10);
    const HOUR: Duration = Duration::from_secs(3600);

    fn at_100_hz() -> SampleTiming {
        SampleTiming::of(Some(Hertz(100.0)))
    }

    /// Adds to `timing` `count` samples that each take `took`, with stamps `took` apart.
    fn taken(timing: &mut SampleTiming, count: u32, took: Duration) -> Result<(), TimingError> {
        let begun = Instant::now();
        (1..=count).try_for_each(|number| {
            timing.wait(took);
            timing.sample(begun + took * number, Stamp::at(took * number))
        })
    }

    #[test]
    fn ten_late_samples_in_a_row_are_refused_and_nine_are_not() {
        let mut timing = at_100_hz();
        taken(&mut timing, 9, PERIOD * 11).expect("nine");
        taken(&mut timing, 1, PERIOD).expect("one in time");
        taken(&mut timing, 9, PERIOD * 11).expect("nine again");
        taken(&mut at_100_hz(), 50, PERIOD * 9).expect("in time");
        let refused = taken(&mut at_100_hz(), 10, PERIOD * 490).expect_err("ten");
        let refused = refused.to_string();
        assert!(refused.contains("10 samples in a row"), "{refused}");
        assert!(refused.contains("the last one 4.900 s"), "{refused}");
        assert!(refused.contains("at a declared 100 Hz"), "{refused}");
        taken(&mut SampleTiming::of(None), 50, PERIOD * 490).expect("no declared rate");
    }

    #[test]
    fn samples_of_a_fast_device_that_arrive_in_batches_are_not_late() {
        let batches = |took| {
            let mut timing = SampleTiming::of(Some(Hertz(7000.0)));
            taken(&mut timing, 50, Duration::from_millis(took))
        };
        batches(16).expect("a latency timer of 16 ms");
        batches(50).expect("the limit");
        let refused = batches(60).expect_err("late").to_string();
        assert!(refused.contains("more than 0.050 s"), "{refused}");
    }

    #[test]
    fn the_time_of_calls_without_a_sample_belongs_to_the_next_sample() {
        let mut timing = at_100_hz();
        let begun = Instant::now();
        let mut results = (0..10).map(|_| {
            (0..11).for_each(|_| timing.wait(PERIOD));
            timing.sample(begun, Stamp::at(Duration::ZERO))
        });
        assert!(results.by_ref().take(9).all(|result| result.is_ok()));
        let refused = results.next().expect("the tenth");
        assert!(
            matches!(refused, Err(TimingError::Late { samples: 10, .. })),
            "{refused:?}"
        );
    }

    #[test]
    fn stamps_that_jump_by_an_hour_are_refused_for_good_in_both_directions() {
        let begun = Instant::now();
        for (first, second) in [(Duration::ZERO, HOUR), (HOUR, Duration::ZERO)] {
            let mut timing = SampleTiming::of(None);
            timing.sample(begun, Stamp::at(first)).expect("the first");
            for number in 1..4 {
                let refused = timing.sample(begun + PERIOD * number, Stamp::at(second));
                let refused = refused.expect_err("an hour").to_string();
                assert!(refused.contains("3600.0 s"), "{refused}");
            }
        }
    }

    #[test]
    fn a_pause_is_no_jump_nor_is_a_sample_that_waited_in_a_queue_through_it() {
        let begun = Instant::now();
        let mut timing = at_100_hz();
        for (arrival, stamp) in [
            (Duration::ZERO, Duration::ZERO),
            (HOUR, PERIOD),
            (HOUR + PERIOD, PERIOD * 2),
            (HOUR + PERIOD * 2, HOUR + PERIOD * 2),
        ] {
            let arrived = timing.sample(begun + arrival, Stamp::at(stamp));
            arrived.expect("in order, and never ahead");
        }
    }

    #[test]
    fn stamps_in_microseconds_are_refused_with_their_unit_if_units_are_checked() {
        let stamped = |mut timing: SampleTiming, unit: u32| {
            let begun = Instant::now();
            (1..=100_u32).try_for_each(|number| {
                timing.wait(PERIOD);
                timing.sample(begun + PERIOD * number, Stamp::at(PERIOD * number / unit))
            })
        };
        let checked = || at_100_hz().with_unit_check();
        stamped(checked(), 1).expect("nanoseconds");
        stamped(at_100_hz(), 1000).expect("not compared");
        let refused = stamped(checked(), 1000).expect_err("microseconds");
        let refused = refused.to_string();
        for part in ["by 1.0e-3 s", "microseconds where nanoseconds are expected"] {
            assert!(refused.contains(part), "{refused}");
        }
    }

    #[test]
    fn a_device_in_another_time_is_not_checked() {
        let mut timing = SampleTiming::unchecked();
        taken(&mut timing, 20, PERIOD * 490).expect("late");
        for stamp in [HOUR, Duration::ZERO, HOUR * 2] {
            let now = Instant::now();
            timing.sample(now, Stamp::at(stamp)).expect("a jump");
        }
    }
}
