//! Checks of a device's declared rate and of its time stamps.

use std::time::{Duration, Instant};

use taceva_core::Hertz;

/// Number of periods of the declared rate after which a sample is late.
const LATE: u32 = 10;
/// Number of consecutive late samples that is an error of the device.
const LATE_MAX: u32 = 10;
/// Maximum drift of stamps against the clock of this machine between two samples.
const JUMP: Duration = Duration::from_secs(60);

/// Delays and stamps of the samples of one device.
#[derive(Debug)]
pub(super) struct Pace {
    rate: Option<Hertz>,
    /// True for a device of a simulated bench, which has its own clock.
    is_simulated: bool,
    late: u32,
    last: Option<(Instant, Duration)>,
}

impl Pace {
    pub(super) fn new(rate: Option<Hertz>, is_simulated: bool) -> Pace {
        Pace {
            rate,
            is_simulated,
            late: 0,
            last: None,
        }
    }

    /// Checks a sample requested at `asked` and received at `now`, with `stamp` on the clock of the device.
    ///
    /// # Errors
    /// Message about a late device or a jump of its stamps.
    pub(super) fn take(
        &mut self,
        asked: Instant,
        now: Instant,
        stamp: Duration,
    ) -> Result<(), String> {
        if self.is_simulated {
            return Ok(());
        }
        self.check_rate(now.saturating_duration_since(asked))?;
        if let Some((at, before)) = self.last {
            let passed = now.saturating_duration_since(at).as_secs_f64();
            let stamped = stamp.as_secs_f64() - before.as_secs_f64();
            if (stamped - passed).abs() > JUMP.as_secs_f64() {
                return Err(format!(
                    "its stamps jump by {stamped:.1} s between two samples received {passed:.3} s apart: check the clock of the device"
                ));
            }
        }
        self.last = Some((now, stamp));
        Ok(())
    }

    fn check_rate(&mut self, took: Duration) -> Result<(), String> {
        let Some(rate) = self.rate.filter(|rate| rate.0 > 0.0) else {
            return Ok(());
        };
        let most = f64::from(LATE) / rate.0;
        if took.as_secs_f64() <= most {
            self.late = 0;
            return Ok(());
        }
        self.late += 1;
        if self.late < LATE_MAX {
            return Ok(());
        }
        Err(format!(
            "{} samples in a row took more than {most:.3} s, the last one {:.3} s, at a declared {} Hz: check the device and the load of this machine, or declare its actual rate (`rate_hz`)",
            self.late,
            took.as_secs_f64(),
            rate.0
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: Duration = Duration::from_millis(10);

    /// Takes samples that last `took` each, with stamps at the same distance.
    fn taken(pace: &mut Pace, count: u32, took: Duration) -> Result<(), String> {
        let begun = Instant::now();
        (0..count).try_for_each(|number| {
            let asked = begun + took * number;
            pace.take(asked, asked + took, took * number)
        })
    }

    #[test]
    fn ten_late_samples_in_a_row_are_refused_and_nine_are_not() {
        let mut pace = Pace::new(Some(Hertz(100.0)), false);
        taken(&mut pace, 9, PERIOD * 11).expect("nine");
        taken(&mut Pace::new(Some(Hertz(100.0)), false), 50, PERIOD * 9).expect("in time");
        let refused = taken(&mut Pace::new(Some(Hertz(100.0)), false), 10, PERIOD * 490);
        let refused = refused.expect_err("ten");
        assert!(refused.contains("10 samples in a row"), "{refused}");
        assert!(refused.contains("at a declared 100 Hz"), "{refused}");
        taken(&mut Pace::new(Some(Hertz(100.0)), true), 50, PERIOD * 490).expect("simulated");
    }

    #[test]
    fn stamps_that_jump_by_an_hour_are_refused_for_good_in_both_directions() {
        let hour = Duration::from_secs(3600);
        let begun = Instant::now();
        for (first, second) in [(Duration::ZERO, hour), (hour, Duration::ZERO)] {
            let mut pace = Pace::new(None, false);
            pace.take(begun, begun, first).expect("the first");
            for number in 1..4 {
                let now = begun + PERIOD * number;
                let refused = pace.take(now, now, second).expect_err("an hour");
                assert!(refused.contains("3600.0 s"), "{refused}");
            }
        }
        let mut pace = Pace::new(None, false);
        pace.take(begun, begun, Duration::ZERO).expect("the first");
        pace.take(begun + hour, begun + hour, hour)
            .expect("a pause");
    }
}
