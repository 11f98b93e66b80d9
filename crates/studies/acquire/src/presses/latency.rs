//! Wrappers that correct the time stamps of devices by their latency, and check rates and time stamps.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

use taceva_core::{
    Axes, Deadline, DriverError, DriverKey, ErrorKind, ExpiringMotion, ForceTransducer, FrameMut,
    Guard, GuardedMotion, GuardedStop, Pose, Robot, RobotWatch, SampleTiming, Sensor, Speed, Stamp,
    Wrench,
};
use taceva_drivers::MonotonicClock;
use taceva_protocol::RigFile;

use super::clock_follower::ClockFollower;
use super::delegation::{delegate_force, delegate_robot, delegate_sensor};

/// Latencies of robot, transducer and sensor, in ms; `None` for each latency that the rig file does not state.
pub(crate) fn written_latencies_ms(rig: &RigFile) -> [Option<f64>; 3] {
    let written = [
        rig.robot.as_ref().and_then(|robot| robot.latency_ms),
        rig.force.as_ref().and_then(|force| force.latency_ms),
        rig.sensor.as_ref().and_then(|sensor| sensor.latency_ms),
    ];
    written.map(|latency| latency.map(|latency| latency.value))
}

/// A device whose time stamps are later than the observation by a known latency. The timing of its samples is checked.
pub(crate) struct Late<D: ?Sized> {
    latency_s: f64,
    driver: DriverKey,
    timing: SampleTiming,
    /// Estimator of the clock drift in the frame stamps of a real sensor. `None` for other devices.
    follower: Option<ClockFollower>,
    device: Box<D>,
}

impl<D: ?Sized> Late<D> {
    /// Wraps `device` of `driver`, whose time stamps are `latency_ms` ms late.
    pub(super) fn new(
        device: Box<D>,
        driver: DriverKey,
        latency_ms: f64,
        timing: SampleTiming,
    ) -> Late<D> {
        Late {
            latency_s: latency_ms * 1e-3,
            driver,
            timing,
            follower: None,
            device,
        }
    }

    /// Removes the clock drift that `follower` determines from the stamps of frames.
    pub(super) fn with_follower(self, follower: Option<ClockFollower>) -> Late<D> {
        Late { follower, ..self }
    }

    fn true_stamp(&self, stamp: Stamp) -> Stamp {
        true_stamp(stamp, self.latency_s)
    }

    /// Checks the rate and the time stamp of a sample that was requested at `asked`.
    fn checked<T>(
        &mut self,
        doing: &'static str,
        asked: Instant,
        taken: Result<T, DriverError>,
        stamp: impl FnOnce(&T) -> Stamp,
    ) -> Result<T, DriverError> {
        self.timing.wait(asked.elapsed());
        let sample = taken?;
        let kept = self.timing.sample(Instant::now(), stamp(&sample));
        kept.map_err(|error| {
            DriverError::new(ErrorKind::DeviceFault, &self.driver, doing).because(error)
        })?;
        Ok(sample)
    }
}

fn true_stamp(stamp: Stamp, latency_s: f64) -> Stamp {
    if latency_s <= 0.0 {
        return stamp;
    }
    Stamp {
        valid_s: stamp.valid_s - latency_s,
        // The original stamp is the arrival time if the device states no other.
        received_s: stamp.received_s.or(Some(stamp.valid_s)),
    }
}

impl ForceTransducer for Late<dyn ForceTransducer> {
    delegate_force!(device);

    fn axes(&self) -> Axes {
        self.device.axes()
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let asked = Instant::now();
        let taken = self.device.read(deadline);
        let (wrench, stamp) = self.checked("read the force", asked, taken, |(_, stamp)| *stamp)?;
        Ok((wrench, self.true_stamp(stamp)))
    }
}

impl Robot for Late<dyn Robot> {
    delegate_robot!(device);

    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let (pose, stamp) = self.device.pose(deadline)?;
        Ok((pose, self.true_stamp(stamp)))
    }

    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let stamp = self.device.move_to(target, speed, deadline)?;
        Ok(self.true_stamp(stamp))
    }

    fn watch_handle(&self) -> Option<Arc<dyn RobotWatch>> {
        let watch = self.device.watch_handle()?;
        let latency_s = self.latency_s;
        Some(Arc::new(LateWatch { latency_s, watch }))
    }
}

impl ExpiringMotion for Late<dyn Robot> {
    fn move_expiring(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let expiring = self.device.expiring_motion();
        let stamp = expiring
            .expect("BUG: the robot no longer reports the capability that it reported at open")
            .move_expiring(target, speed, deadline)?;
        Ok(self.true_stamp(stamp))
    }
}

impl GuardedMotion for Late<dyn Robot> {
    fn move_guarded(
        &mut self,
        target: Pose,
        speed: Speed,
        guard: Guard,
        deadline: Deadline,
    ) -> Result<GuardedStop, DriverError> {
        let latency_s = self.latency_s;
        let guarded = self.device.guarded_motion();
        let stop = guarded
            .expect("BUG: the robot no longer reports the capability that it reported at open")
            .move_guarded(target, speed, guard, deadline)?;
        Ok(match stop {
            GuardedStop::Guarded { pose, stamp } => GuardedStop::Guarded {
                pose,
                stamp: true_stamp(stamp, latency_s),
            },
            GuardedStop::Arrived { stamp } => GuardedStop::Arrived {
                stamp: true_stamp(stamp, latency_s),
            },
        })
    }
}

struct LateWatch {
    latency_s: f64,
    watch: Arc<dyn RobotWatch>,
}

impl RobotWatch for LateWatch {
    fn pose(&self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let (pose, stamp) = self.watch.pose(deadline)?;
        Ok((pose, true_stamp(stamp, self.latency_s)))
    }
}

impl Sensor for Late<dyn Sensor> {
    delegate_sensor!(device);

    fn capture(&mut self, into: FrameMut<'_>, deadline: Deadline) -> Result<Stamp, DriverError> {
        let asked = Instant::now();
        let taken = self.device.capture(into, deadline);
        let stamp = self.checked("capture a frame", asked, taken, |stamp| *stamp)?;
        let followed = match &mut self.follower {
            Some(follower) if !self.device.is_stamped_by_host() => {
                follower.follow(stamp, MonotonicClock.now_s())
            }
            _ => stamp,
        };
        Ok(self.true_stamp(followed))
    }

    fn settings(&self) -> BTreeMap<String, String> {
        let mut settings = self.device.settings();
        let follower = self.follower.as_ref();
        settings.extend(follower.map(ClockFollower::settings).unwrap_or_default());
        settings
    }
}

/// Converts the wrapper to a boxed device.
pub(crate) trait IntoDevice<D: ?Sized> {
    fn boxed(self) -> Box<D>;
}

impl IntoDevice<dyn ForceTransducer> for Late<dyn ForceTransducer> {
    fn boxed(self) -> Box<dyn ForceTransducer> {
        Box::new(self)
    }
}

impl IntoDevice<dyn Robot> for Late<dyn Robot> {
    fn boxed(self) -> Box<dyn Robot> {
        Box::new(self)
    }
}

impl IntoDevice<dyn Sensor> for Late<dyn Sensor> {
    fn boxed(self) -> Box<dyn Sensor> {
        Box::new(self)
    }
}

#[cfg(test)]
mod tests;
