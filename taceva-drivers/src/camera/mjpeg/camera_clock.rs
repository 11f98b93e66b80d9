//! Conversion of a camera server's time stamps to the monotonic clock of this machine. No I/O.

use std::time::Duration;

/// Number of pictures after which the clock offset is fixed. A later drift of the server's clock remains in the time stamps.
const PICTURES: u32 = 32;
/// Maximum change of the delay between two successive pictures, s. A greater change means a step or a restart of the server's clock.
const STEP_S: f64 = 10.0;

/// Offset of a server's clock from the monotonic clock of this machine.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CameraClock {
    /// Minimum arrival time minus server stamp over the first pictures, s; `None` before the first picture.
    behind_s: Option<f64>,
    /// Arrival time minus server stamp of the last picture, s; `None` before the first picture.
    newest_s: Option<f64>,
    pictures: u32,
    /// Picture time that was returned last, s.
    last_s: f64,
}

impl CameraClock {
    /// Time of a picture on the monotonic clock, from its server stamp `stamped_s` in seconds and its time `arrived` of arrival. `None` after a step
    /// of the server's clock.
    pub(super) fn place(&mut self, stamped_s: f64, arrived: Duration) -> Option<Duration> {
        let behind_s = arrived.as_secs_f64() - stamped_s;
        let newest_s = *self.newest_s.get_or_insert(behind_s);
        if (behind_s - newest_s).abs() > STEP_S {
            return None;
        }
        self.newest_s = Some(behind_s);
        let behind_s = match self.behind_s {
            Some(least_s) if self.pictures >= PICTURES => least_s,
            Some(least_s) => least_s.min(behind_s),
            None => behind_s,
        };
        self.behind_s = Some(behind_s);
        self.pictures = self.pictures.saturating_add(1);
        // A smaller offset must not put a picture before the last one.
        self.last_s = self.last_s.max(stamped_s + behind_s);
        Some(Duration::try_from_secs_f64(self.last_s).unwrap_or(arrived))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Time of a picture on the monotonic clock, s, from its server stamp and its arrival, both in seconds.
    fn placed(clock: &mut CameraClock, stamped_s: f64, arrived_s: f64) -> f64 {
        let arrived = Duration::from_secs_f64(arrived_s);
        let placed = clock.place(stamped_s, arrived);
        placed.expect("no step").as_secs_f64()
    }

    #[test]
    fn the_least_delay_of_the_first_pictures_places_the_clock_of_the_server() {
        let mut clock = CameraClock::default();
        for (number, delay_s) in [0.03, 0.005, 0.02, 0.01].into_iter().enumerate() {
            let taken_s = 0.04 * f64::from(u32::try_from(number).expect("small"));
            let found_s = placed(&mut clock, 5e8 + taken_s, 10.0 + taken_s + delay_s);
            let expected_s = 10.0 + taken_s + if number == 0 { 0.03 } else { 0.005 };
            assert!((found_s - expected_s).abs() < 1e-6, "{number}: {found_s}");
        }
    }

    #[test]
    fn a_drift_stays_in_the_stamps_and_no_stamp_is_before_the_last() {
        let mut clock = CameraClock::default();
        let mut last_s = 0.0;
        for number in 0..1000_u32 {
            let taken_s = 0.04 * f64::from(number);
            // The first delay is longer than a period.
            let delay_s = if number == 0 { 0.1 } else { 0.005 };
            last_s = match placed(&mut clock, 1.01 * taken_s, 10.0 + taken_s + delay_s) {
                found_s if found_s >= last_s => found_s,
                found_s => panic!("{number}: {found_s} after {last_s}"),
            };
        }
        let drifted_s = last_s - (10.005 + 0.04 * 999.0);
        assert!(
            (drifted_s - 0.01 * 0.04 * 999.0).abs() < 0.02,
            "{drifted_s}"
        );
    }

    #[test]
    fn a_clock_that_stepped_or_began_again_places_no_picture_until_it_fits_again() {
        let mut clock = CameraClock::default();
        assert!((placed(&mut clock, 500.0, 10.0) - 10.0).abs() < 1e-9);
        for stamped_s in [7.0, 530.0] {
            assert_eq!(clock.place(stamped_s, Duration::from_secs(15)), None);
        }
        assert!((placed(&mut clock, 520.0, 30.0) - 30.0).abs() < 1e-9);
    }
}
