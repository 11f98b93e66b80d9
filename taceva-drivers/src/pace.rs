//! Clock of a device that stands in for a real device: a replay, or a wrapper that injects faults.

use std::time::Duration;

use crate::clock::MonotonicClock;

/// Clock on which a device can wait for a given time.
pub trait Pace: Send {
    /// Current time, s since an arbitrary start. Never decreases.
    fn now_s(&self) -> f64;

    /// Waits until the time `time_s`, s; returns at once if this time has passed.
    fn wait_until(&mut self, time_s: f64);

    /// True if time passes even if no caller waits. A slow caller may then miss frames.
    fn runs_by_itself(&self) -> bool;
}

/// Virtual time, which passes only during waits. A replay then runs at full speed without missed frames.
#[derive(Clone, Copy, Debug)]
pub struct VirtualPace {
    now_s: f64,
}

impl VirtualPace {
    /// Creates a clock of virtual time that starts at `now_s`, s.
    pub const fn starting_at(now_s: f64) -> VirtualPace {
        VirtualPace { now_s }
    }
}

impl Pace for VirtualPace {
    fn now_s(&self) -> f64 {
        self.now_s
    }
    fn wait_until(&mut self, time_s: f64) {
        self.now_s = self.now_s.max(time_s);
    }
    fn runs_by_itself(&self) -> bool {
        false
    }
}

/// Real time, on the clock that stamps readings of all real devices.
#[derive(Clone, Copy, Debug, Default)]
pub struct RealPace;

impl Pace for RealPace {
    fn now_s(&self) -> f64 {
        MonotonicClock.now_s()
    }
    fn wait_until(&mut self, time_s: f64) {
        // A sleep may end early on some systems.
        while let Ok(left) = Duration::try_from_secs_f64(time_s - self.now_s()) {
            if left.is_zero() {
                return;
            }
            std::thread::sleep(left);
        }
    }
    fn runs_by_itself(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn virtual_time_passes_by_waiting_alone_and_never_goes_back() {
        let mut pace = VirtualPace::starting_at(5.0);
        pace.wait_until(1e9);
        pace.wait_until(6.0);
        assert!(pace.now_s().total_cmp(&1e9).is_eq());
    }

    #[test]
    fn real_time_is_that_of_the_machine_for_everybody() {
        let (mut first, second) = (RealPace, RealPace);
        let until = first.now_s() + 0.002;
        first.wait_until(until);
        assert!(second.now_s() >= until && MonotonicClock.now_s() >= until);
        first.wait_until(f64::NAN);
        first.wait_until(-1.0);
    }
}
