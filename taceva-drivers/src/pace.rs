//! Whose time a device that is no device runs in.

use std::sync::Arc;
use std::time::{Duration, Instant};

use taceva_core::{DriverError, Rig};

/// Time that passes, and can be waited for.
pub trait Pace: Send {
    /// The present, in s since an arbitrary start; never goes back.
    fn now_s(&self) -> f64;

    /// Returns once it is `time_s`, at once if that has passed.
    fn wait_until(&mut self, time_s: f64);

    /// Whether things happen while nobody waits, so that a caller may come too late for some.
    fn runs_by_itself(&self) -> bool;
}

/// Time that passes only while somebody waits: a recording is read as fast as it can be, and no frame is missed.
#[derive(Clone, Copy, Debug)]
pub struct VirtualPace {
    now_s: f64,
}

impl VirtualPace {
    /// Time that stands at `now_s`.
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

/// The time of the machine: devices of one rig count it from one moment.
#[derive(Clone, Debug)]
pub struct RealPace {
    epoch: Arc<Instant>,
}

impl RealPace {
    /// The time of `rig`, which begins with the first device that asks for it.
    ///
    /// # Errors
    /// None today; the signature is that of [`Rig::share`].
    pub fn of(rig: &mut Rig) -> Result<RealPace, DriverError> {
        let epoch = rig.share("time of the machine", || Ok(Instant::now()))?;
        Ok(RealPace { epoch })
    }
}

impl Pace for RealPace {
    fn now_s(&self) -> f64 {
        self.epoch.elapsed().as_secs_f64()
    }
    fn wait_until(&mut self, time_s: f64) {
        // A sleep may end early on some systems, never for long.
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
    fn real_time_is_one_for_the_devices_of_a_rig() {
        let mut rig = Rig::new();
        let mut first = RealPace::of(&mut rig).expect("a clock");
        let second = RealPace::of(&mut rig).expect("the same clock");
        let until = first.now_s() + 0.002;
        first.wait_until(until);
        assert!(second.now_s() >= until);
        first.wait_until(f64::NAN);
        first.wait_until(-1.0);
    }
}
