//! Check of an enabling switch: its reports of a hold, and its response time.

use std::time::Duration;

use taceva_core::{DriverError, EnablingSwitch};
use taceva_drivers::MonotonicClock;

/// Interval between readings of the switch.
const LOOK: Duration = Duration::from_millis(10);

/// Statistics of an enabling switch that is read every 10 ms.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct SwitchCheck {
    /// Number of readings of the switch.
    pub looks: u32,
    /// Number of readings that reported a held switch.
    pub held: u32,
    /// Number of presses and releases detected between readings.
    pub changes: u32,
    /// Longest time for one reading of the switch, in ms. The delay within the device is not included.
    pub longest_ms: f64,
}

/// Reads `switch` until it has been held for the duration `held`, for at most the time `patience`.
pub(super) fn look_at(
    switch: &dyn EnablingSwitch,
    held: Duration,
    patience: Duration,
) -> Result<SwitchCheck, DriverError> {
    let mut check = SwitchCheck::default();
    let began_s = MonotonicClock.now_s();
    let mut held_since: Option<f64> = None;
    loop {
        let asked_s = MonotonicClock.now_s();
        let is_held = switch.is_held()?;
        let now_s = MonotonicClock.now_s();
        check.longest_ms = check.longest_ms.max((now_s - asked_s) * 1e3);
        check.changes += u32::from(check.looks > 0 && is_held != held_since.is_some());
        check.looks += 1;
        check.held += u32::from(is_held);
        held_since = match is_held {
            true => held_since.or(Some(now_s)),
            false => None,
        };
        let is_long_held = held_since.is_some_and(|since_s| now_s - since_s >= held.as_secs_f64());
        if is_long_held || now_s - began_s >= patience.as_secs_f64() {
            return Ok(check);
        }
        std::thread::sleep(LOOK);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU32, Ordering};

    use super::*;

    /// Test switch that is held from the fourth reading on, except at the seventh.
    struct Foot(AtomicU32);

    impl EnablingSwitch for Foot {
        fn is_held(&self) -> Result<bool, DriverError> {
            let look = self.0.fetch_add(1, Ordering::AcqRel);
            Ok(look >= 3 && look != 6)
        }
    }

    #[test]
    fn looks_holds_and_changes_are_counted_until_it_was_held_for_long_enough() {
        let foot = Foot(AtomicU32::new(0));
        let [held, patience] = [60, 10_000].map(Duration::from_millis);
        let check = look_at(&foot, held, patience).expect("it answers");
        // Pressed, released once and pressed again. All readings but four find it held.
        assert_eq!(
            (check.changes, check.looks - check.held),
            (3, 4),
            "{check:?}"
        );
        assert!(check.looks > 8 && check.longest_ms >= 0.0, "{check:?}");
        let never = Foot(AtomicU32::new(u32::MAX / 2));
        never.0.store(0, Ordering::Release);
        let check = look_at(&never, held, Duration::ZERO).expect("it answers");
        assert_eq!((check.looks, check.held), (1, 0));
    }
}
