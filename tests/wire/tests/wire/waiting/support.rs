//! Helpers of all device tests: timeouts, motions and link faults.

use std::time::{Duration, Instant};

use taceva_core::{Deadline, DriverError, Millimetre, Pose, Robot, Speed};
use taceva_wire::{Device, Fault, FaultKind, WallBench};

/// Timeout of a motion.
pub(crate) const PATIENCE: Deadline = Deadline::after(Duration::from_secs(10));
/// Timeout of a reading.
pub(crate) const MOMENT: Deadline = Deadline::after(Duration::from_secs(2));

pub(crate) fn speed(mm_per_s: f64) -> Speed {
    Speed::try_new(mm_per_s).expect("above 0")
}

/// `pose`, lower by `mm` in the base frame.
pub(crate) fn lower(pose: Pose, mm: f64) -> Pose {
    let mut lower = pose;
    lower.position.z = Millimetre(pose.position.z.0 - mm);
    lower
}

/// Injects a fault into the link of `device`.
pub(crate) fn inject(bench: &WallBench, device: Device, kind: FaultKind, lasts_ms: u64) {
    bench.inject(Fault {
        device,
        kind,
        lasts: Duration::from_millis(lasts_ms),
    });
}

/// Moves the tip by 15 mm at 1.5 mm/s and calls `happens` during the motion. Returns the error that ends the motion, and the time from the call to
/// this error.
pub(crate) fn moved(
    bench: &WallBench,
    arm: &mut dyn Robot,
    happens: impl FnOnce() + Send,
) -> (DriverError, Duration) {
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    std::thread::scope(|scope| {
        let happening = scope.spawn(move || {
            while !bench.truth().is_moving {
                std::thread::yield_now();
            }
            happens();
            Instant::now()
        });
        let error = arm
            .move_to(lower(home, 15.0), speed(1.5), PATIENCE)
            .expect_err("broken off");
        let returned = Instant::now();
        let happened = happening.join().expect("it happened");
        (error, returned.saturating_duration_since(happened))
    })
}
