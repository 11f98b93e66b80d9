//! Advance of the time stamps of a device per second of its host. This rate reveals stamps in another unit than expected.

use std::fmt;

/// Least rate of stamps that follow the clock of the host, whose own rate is 1. [`RATE_MAX`] is the greatest rate.
const RATE_MIN: f64 = 0.5;
const RATE_MAX: f64 = 2.0;
/// A measured rate belongs to a rate in [`UNITS`] if the two differ by less than this factor, about √1000.
const UNIT_FACTOR: f64 = 30.0;
/// Stamps with a lower rate are in another unit. A busy host that falls behind thousands of samples a second sees low rates above this limit.
const SMALLER_UNIT_MAX: f64 = 0.005;
/// Rates of stamps in a mistaken unit, with the mistaken and the expected unit.
const UNITS: [(f64, &str); 6] = [
    (1e-9, "seconds where nanoseconds are expected"),
    (1e-6, "milliseconds where nanoseconds are expected"),
    (1e-3, "microseconds where nanoseconds are expected"),
    (1e3, "milliseconds where seconds are expected"),
    (1e6, "microseconds where seconds are expected"),
    (1e9, "nanoseconds where seconds are expected"),
];

/// Time by which the stamps of a device advance in each second of the host's clock, in s.
///
/// ```
/// use taceva_core::StampRate;
///
/// assert!(StampRate::of(0.26, 0.25).is_of_host_clock());
/// let mistaken = StampRate::of(0.000_25, 0.25);
/// assert_eq!(mistaken.unit(), Some("microseconds where nanoseconds are expected"));
/// assert!(mistaken.to_string().starts_with("the stamps advance by 1.0e-3 s in each second"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StampRate(f64);

impl StampRate {
    /// Rate of stamps that advance by `stamps_s` while the clock of the host advances by `host_s`, both in s.
    pub fn of(stamps_s: f64, host_s: f64) -> StampRate {
        StampRate(stamps_s / host_s)
    }

    /// True for a rate from 0.5 to 2. Samples that waited in a queue change a rate of 1 by less than a factor of 2.
    pub fn is_of_host_clock(self) -> bool {
        (RATE_MIN..=RATE_MAX).contains(&self.0)
    }

    /// True for a rate that differs from 1 by at most `part`. For a measurement over several seconds, in which delays of samples hardly count.
    pub fn is_exact_to(self, part: f64) -> bool {
        (self.0 - 1.0).abs() <= part
    }

    /// Mistaken and expected unit of the stamps in words; `None` if no mistaken unit leads to this rate.
    pub fn unit(self) -> Option<&'static str> {
        let is_near = |rate: f64| self.0 > rate / UNIT_FACTOR && self.0 < rate * UNIT_FACTOR;
        let unit = UNITS.into_iter().find(|(rate, _)| is_near(*rate));
        unit.map(|(_, words)| words)
    }

    /// True for a rate so low that the stamps must be in another unit.
    fn is_of_smaller_unit(self) -> bool {
        self.0 < SMALLER_UNIT_MAX
    }
}

impl fmt::Display for StampRate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let advance = match self.is_of_host_clock() {
            true => format!("{:.3}", self.0),
            false => format!("{:.1e}", self.0),
        };
        write!(
            f,
            "the stamps advance by {advance} s in each second of this machine's clock, expected 1 s: "
        )?;
        match self.unit() {
            _ if self.is_of_host_clock() => f.write_str(
                "correct the rate from which its driver computes them, or stamp readings on arrival (`now_ns` in C, `now` in Rust and Python)",
            ),
            Some(unit) => write!(
                f,
                "they are probably {unit}; convert them, or stamp with the clock of the host (`now_ns` in C, `now` in Rust and Python)"
            ),
            None => f.write_str("check the clock of the device and the unit of its stamps"),
        }
    }
}

/// Minimum number of samples in a window, over which one rate is computed. [`WINDOW_S`] is the minimum duration of the calls, s.
const SAMPLES_MIN: u32 = 2;
const WINDOW_S: f64 = 0.2;
/// Number of consecutive rates below [`SMALLER_UNIT_MAX`] that is an error. Samples queued in a pause of the host lower one rate only.
const SLOW_MAX: u32 = 3;

/// Computes the rate of the stamps over each window of consecutive samples. The host's time is that of the calls, without pauses between them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StampWindows {
    /// Stamp at the start of the unfinished window, s; `None` before the first sample.
    begun_s: Option<f64>,
    samples: u32,
    waited_s: f64,
    /// Rate of the stamps over the last finished window.
    rate: Option<StampRate>,
    /// Number of consecutive windows with a rate below [`SMALLER_UNIT_MAX`].
    slow: u32,
}

impl StampWindows {
    /// Adds a sample with the stamp `stamp_s`, s. The calls for the sample took `waited_s`, s. Returns the last rate once [`SLOW_MAX`] consecutive
    /// rates are below [`SMALLER_UNIT_MAX`].
    pub(super) fn add(&mut self, stamp_s: f64, waited_s: f64) -> Option<StampRate> {
        let Some(begun_s) = self.begun_s else {
            self.begun_s = Some(stamp_s);
            return None;
        };
        self.samples = self.samples.saturating_add(1);
        self.waited_s += waited_s;
        let advance_s = stamp_s - begun_s;
        // A signal that repeats its stamp is frozen, whatever its unit.
        if self.samples >= SAMPLES_MIN && self.waited_s >= WINDOW_S && advance_s > 0.0 {
            let rate = StampRate::of(advance_s, self.waited_s);
            *self = StampWindows {
                begun_s: Some(stamp_s),
                rate: Some(rate),
                slow: match rate.is_of_smaller_unit() {
                    true => self.slow.saturating_add(1),
                    false => 0,
                },
                ..StampWindows::default()
            };
        }
        self.rate.filter(|_| self.slow >= SLOW_MAX)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Windows of one device, with the stamp of its last sample.
    #[derive(Default)]
    struct Samples {
        windows: StampWindows,
        stamp_s: f64,
    }

    impl Samples {
        /// Adds `count` samples that each take `waited_s`, with stamps `step_s` apart. Returns the result for the last sample.
        fn add(&mut self, count: u32, waited_s: f64, step_s: f64) -> Option<StampRate> {
            (0..count).fold(None, |_, _| {
                self.stamp_s += step_s;
                self.windows.add(self.stamp_s, waited_s)
            })
        }
    }

    #[test]
    fn a_rate_near_a_power_of_1000_names_the_mistaken_unit_and_a_rate_near_1_names_none() {
        for (stamps_s, unit) in [
            (2.4e-9, Some("seconds where nanoseconds are expected")),
            (2.0e-6, Some("milliseconds where nanoseconds are expected")),
            (3.9e-3, Some("microseconds where nanoseconds are expected")),
            (2.2e3, Some("milliseconds where seconds are expected")),
            (1.7e6, Some("microseconds where seconds are expected")),
            (1.6e9, Some("nanoseconds where seconds are expected")),
            (0.7, None),
            (2.0, None),
            (0.0, None),
            (-3.0, None),
        ] {
            let rate = StampRate::of(stamps_s, 2.0);
            assert_eq!(rate.unit(), unit, "{rate}");
            assert!(rate.to_string().contains("stamps"), "{rate}");
        }
    }

    #[test]
    fn stamps_follow_the_clock_of_the_host_within_a_factor_of_2() {
        for (stamps_s, is_of_host) in [
            (0.3, true),
            (0.16, true),
            (0.59, true),
            (0.14, false),
            (0.61, false),
            (0.0, false),
            (-0.3, false),
            (3e-4, false),
            (f64::NAN, false),
        ] {
            let rate = StampRate::of(stamps_s, 0.3);
            assert_eq!(rate.is_of_host_clock(), is_of_host, "{rate}");
        }
    }

    #[test]
    fn a_rate_near_1_is_formatted_with_three_decimals_and_a_remedy_for_the_driver() {
        for (stamps_s, is_exact) in [(6.0, false), (4.1, false), (4.07, true), (3.93, true)] {
            let rate = StampRate::of(stamps_s, 4.0);
            assert_eq!(rate.is_exact_to(0.02), is_exact, "{rate}");
        }
        assert!(!StampRate::of(f64::NAN, 4.0).is_exact_to(0.02));
        let fast = StampRate::of(6.0, 4.0).to_string();
        assert!(fast.contains("by 1.500 s"), "{fast}");
        assert!(fast.contains("correct the rate"), "{fast}");
    }

    #[test]
    fn stamps_in_a_smaller_unit_are_refused_for_good_after_three_windows() {
        for unit in [1e-3, 1e-6, 1e-9] {
            let mut samples = Samples::default();
            let found = samples.add(15, 0.04, 0.04 * unit);
            assert_eq!(found, None, "less than three windows");
            for _ in 0..3 {
                let found = samples.add(10, 0.04, 0.04 * unit).expect("refused");
                assert!((found.0 / unit - 1.0).abs() < 1e-3, "{found}");
            }
        }
    }

    #[test]
    fn stamps_in_the_unit_of_the_interface_are_accepted_at_every_speed_and_after_pauses() {
        for (waited_s, step_s) in [
            (0.04, 0.04),
            (0.0001, 0.0001),
            // Samples from a queue come at once, and after pauses of the host the stamps leap ahead.
            (0.0, 0.04),
            (0.04, 10.0),
            // A device that lags behind, by far less than a unit.
            (0.2, 0.02),
            // A queue of 7000 readings a second, of which a busy host takes one in 15 ms.
            (0.015, 1.0 / 7000.0),
        ] {
            let found = Samples::default().add(20_000, waited_s, step_s);
            assert_eq!(found, None, "{waited_s} {step_s}");
        }
    }

    #[test]
    fn a_pause_within_a_call_and_the_queue_after_it_are_no_other_unit() {
        let mut samples = Samples::default();
        for _ in 0..10 {
            // One call that was held up for 1 s, then a thousand readings of 1 kHz from a queue, then readings in time.
            assert_eq!(samples.add(1, 1.0, 0.001), None);
            assert_eq!(samples.add(1000, 0.0, 0.001), None);
            assert_eq!(samples.add(500, 0.001, 0.001), None);
        }
    }

    #[test]
    fn a_frozen_signal_that_repeats_its_stamp_is_not_called_another_unit() {
        assert_eq!(Samples::default().add(1000, 0.04, 0.0), None);
    }
}
