//! Recent readings of a transducer, interpolated at the times of frames.

use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};

use taceva_core::Wrench;
use taceva_protocol::wrench_between;

/// Age at which readings are removed, in s. Every frame arrives before its readings have this age.
const KEPT_S: f64 = 5.0;
/// Maximum gap between two readings for interpolation, as a multiple of the reading period. A gap of up to [`GAP_S`] is always allowed, because a
/// paused thread also causes gaps.
const PERIODS: f64 = 3.0;
const GAP_S: f64 = 0.02;
/// Factor by which the reading period is lengthened to allow for errors of clocks and rates.
const TOLERANCE: f64 = 1.01;

/// Readings of the transducer, ordered by time.
#[derive(Debug)]
pub(super) struct Track {
    /// Maximum gap for interpolation, in s.
    longest_s: f64,
    readings: Mutex<VecDeque<(f64, Wrench)>>,
}

/// Force at a time, or the reason why it is unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum At {
    /// The force was interpolated between two readings.
    Known(Wrench),
    /// The force is unknown, because the readings around this time are too far apart.
    Gap,
    /// The force is unknown, because no reading precedes this time.
    Before,
    /// The force is not known yet, because the next reading has not arrived.
    Early,
}

impl Track {
    /// Creates an empty track for a transducer with the period `period_s`, and frames with the exposure time `exposure_s`, if known.
    pub(super) fn new(period_s: f64, exposure_s: Option<f64>) -> Track {
        let periods_s = PERIODS * TOLERANCE * period_s;
        Track {
            longest_s: periods_s.max(GAP_S).max(exposure_s.unwrap_or(0.0)),
            readings: Mutex::default(),
        }
    }

    /// Adds a reading with the time stamp `at_s`, in s. Ignores a reading that is not later than the last reading.
    pub(super) fn push(&self, at_s: f64, wrench: Wrench) {
        let mut readings = self.readings();
        if readings.back().is_some_and(|(last_s, _)| *last_s >= at_s) {
            return;
        }
        readings.push_back((at_s, wrench));
        while readings
            .front()
            .is_some_and(|(first_s, _)| at_s - first_s > KEPT_S)
        {
            readings.pop_front();
        }
    }

    /// Last reading; `None` before the first reading.
    pub(super) fn newest(&self) -> Option<Wrench> {
        self.readings().back().map(|(_, wrench)| *wrench)
    }

    /// Force at the time `at_s`, in s.
    pub(super) fn at(&self, at_s: f64) -> At {
        let readings = self.readings();
        let after = readings.partition_point(|(time_s, _)| *time_s < at_s);
        let Some((after_s, later)) = readings.get(after) else {
            return At::Early;
        };
        let before = after.checked_sub(1).and_then(|at| readings.get(at));
        match before {
            _ if after_s.total_cmp(&at_s).is_eq() => At::Known(*later),
            Some((before_s, earlier)) if after_s - before_s <= self.longest_s => At::Known(
                wrench_between((earlier, *before_s), (later, *after_s), at_s),
            ),
            Some(_) => At::Gap,
            None => At::Before,
        }
    }

    /// Maximum gap between readings for interpolation, in s.
    pub(super) fn longest_s(&self) -> f64 {
        self.longest_s
    }

    fn readings(&self) -> MutexGuard<'_, VecDeque<(f64, Wrench)>> {
        self.readings.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::Newton;

    use super::*;

    fn pressed(normal_n: f64) -> Wrench {
        let mut wrench = Wrench::default();
        wrench.force[2] = Newton(normal_n);
        wrench
    }

    fn normal_n(at: At) -> Option<f64> {
        match at {
            At::Known(wrench) => Some(wrench.force[2].0),
            _ => None,
        }
    }

    #[test]
    fn a_force_is_known_between_readings_that_are_at_most_three_periods_apart() {
        let track = Track::new(0.01, None);
        for (at_s, force_n) in [(1.0, 0.0), (1.03, 3.0), (1.061, 3.0), (1.062, 4.0)] {
            track.push(at_s, pressed(force_n));
        }
        let known = normal_n(track.at(1.02)).expect("between two");
        assert!((known - 2.0).abs() < 1e-9, "{known}");
        assert_eq!(track.at(1.05), At::Gap);
        assert_eq!(normal_n(track.at(1.062)), Some(4.0));
        assert_eq!(track.at(0.9), At::Before);
        assert_eq!(track.at(1.07), At::Early);
    }

    #[test]
    fn a_short_pause_of_a_fast_transducer_is_no_gap_and_neither_is_one_within_an_exposure() {
        for (exposure_s, pause_s, is_known) in [
            (None, 0.019, true),
            (None, 0.021, false),
            (Some(0.04), 0.039, true),
            (Some(0.001), 0.021, false),
        ] {
            let track = Track::new(0.002, exposure_s);
            track.push(1.0, pressed(1.0));
            track.push(1.0 + pause_s, pressed(1.0));
            let found = normal_n(track.at(1.0 + 0.5 * pause_s));
            assert_eq!(found.is_some(), is_known, "{exposure_s:?} {pause_s}");
        }
    }

    #[test]
    fn a_reading_that_repeats_a_time_is_none_and_old_ones_are_forgotten() {
        let track = Track::new(0.01, None);
        track.push(1.0, pressed(1.0));
        track.push(1.0, pressed(9.0));
        assert_eq!(track.newest(), Some(pressed(1.0)));
        track.push(1.0 + KEPT_S + 0.1, pressed(2.0));
        assert_eq!(track.readings().len(), 1);
    }
}
