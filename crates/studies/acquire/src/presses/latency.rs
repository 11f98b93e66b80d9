//! Wrappers that correct the stamps of devices by their latency.

use std::collections::BTreeMap;
use std::sync::Arc;

use taceva_core::{
    Axes, Deadline, DriverError, ExpiringMotion, ForceTransducer, FrameInfo, FrameMut, Guard,
    GuardedMotion, GuardedStop, Halt, Interrupt, Lighting, Pose, Robot, RobotWatch, Sensor, Speed,
    Stamp, Tare, Wrench,
};

/// A device whose stamps are later than the observation by a known latency.
pub(crate) struct Late<D: ?Sized> {
    latency_s: f64,
    device: Box<D>,
}

impl<D: ?Sized> Late<D> {
    /// Wraps `device`, whose stamps are `latency_ms` late.
    pub(super) fn new(device: Box<D>, latency_ms: f64) -> Late<D> {
        let latency_s = latency_ms * 1e-3;
        Late { latency_s, device }
    }

    fn true_stamp(&self, stamp: Stamp) -> Stamp {
        true_stamp(stamp, self.latency_s)
    }
}

fn true_stamp(stamp: Stamp, latency_s: f64) -> Stamp {
    Stamp {
        valid_s: stamp.valid_s - latency_s,
        // The old stamp is the time of arrival, if the device gives no other.
        received_s: stamp.received_s.or(Some(stamp.valid_s)),
    }
}

impl ForceTransducer for Late<dyn ForceTransducer> {
    fn axes(&self) -> Axes {
        self.device.axes()
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.device.start(deadline)
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let (wrench, stamp) = self.device.read(deadline)?;
        Ok((wrench, self.true_stamp(stamp)))
    }

    fn sequence(&self) -> Option<u64> {
        self.device.sequence()
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.device.stop()
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.device.interrupt_handle()
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        self.device.tare()
    }
}

impl Robot for Late<dyn Robot> {
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

    fn halt_handle(&self) -> Arc<dyn Halt> {
        self.device.halt_handle()
    }

    fn watch_handle(&self) -> Option<Arc<dyn RobotWatch>> {
        let watch = self.device.watch_handle()?;
        let latency_s = self.latency_s;
        Some(Arc::new(LateWatch { latency_s, watch }))
    }

    fn halt(&mut self) -> Result<(), DriverError> {
        self.device.halt()
    }

    fn clear_halt(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.device.clear_halt(deadline)
    }

    fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
        match self.device.guarded_motion().is_some() {
            true => Some(self),
            false => None,
        }
    }

    fn expiring_motion(&mut self) -> Option<&mut dyn ExpiringMotion> {
        match self.device.expiring_motion().is_some() {
            true => Some(self),
            false => None,
        }
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
            .expect("this is lent only where the robot has it, which does not change")
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
            .expect("this is lent only where the robot has it, which does not change")
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
    fn frame_info(&self) -> FrameInfo {
        self.device.frame_info()
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.device.start(deadline)
    }

    fn capture(&mut self, into: FrameMut<'_>, deadline: Deadline) -> Result<Stamp, DriverError> {
        let stamp = self.device.capture(into, deadline)?;
        Ok(self.true_stamp(stamp))
    }

    fn sequence(&self) -> Option<u64> {
        self.device.sequence()
    }

    fn sent(&self) -> Option<&[u8]> {
        self.device.sent()
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.device.stop()
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        self.device.interrupt_handle()
    }

    fn settings(&self) -> BTreeMap<String, String> {
        self.device.settings()
    }

    fn lighting(&mut self) -> Option<&mut dyn Lighting> {
        self.device.lighting()
    }
}

/// Conversion of the wrapper to a boxed device.
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
mod tests {
    use super::*;

    struct Arrived;

    impl ForceTransducer for Arrived {
        fn axes(&self) -> Axes {
            Axes::FORCE
        }

        fn read(&mut self, _: Deadline) -> Result<(Wrench, Stamp), DriverError> {
            let stamp = Stamp {
                valid_s: 7.0,
                received_s: None,
            };
            Ok((Wrench::default(), stamp))
        }

        fn sequence(&self) -> Option<u64> {
            Some(5)
        }
    }

    /// A robot whose guarded motion ends by contact or arrival, at 7 s.
    struct Stops {
        is_felt: bool,
    }

    const AT_SEVEN: Stamp = Stamp {
        valid_s: 7.0,
        received_s: None,
    };

    impl Halt for Stops {
        fn halt(&self) -> Result<(), DriverError> {
            Ok(())
        }
    }

    impl Robot for Stops {
        fn pose(&mut self, _: Deadline) -> Result<(Pose, Stamp), DriverError> {
            Ok((Pose::default(), AT_SEVEN))
        }

        fn move_to(&mut self, _: Pose, _: Speed, _: Deadline) -> Result<Stamp, DriverError> {
            Ok(AT_SEVEN)
        }

        fn halt_handle(&self) -> Arc<dyn Halt> {
            Arc::new(Stops { is_felt: false })
        }

        fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
            Ok(())
        }

        fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
            Some(self)
        }

        fn expiring_motion(&mut self) -> Option<&mut dyn ExpiringMotion> {
            Some(self)
        }
    }

    impl ExpiringMotion for Stops {
        fn move_expiring(&mut self, _: Pose, _: Speed, _: Deadline) -> Result<Stamp, DriverError> {
            Ok(AT_SEVEN)
        }
    }

    impl GuardedMotion for Stops {
        fn move_guarded(
            &mut self,
            pose: Pose,
            _: Speed,
            _: Guard,
            _: Deadline,
        ) -> Result<GuardedStop, DriverError> {
            let stamp = AT_SEVEN;
            Ok(match self.is_felt {
                true => GuardedStop::Guarded { pose, stamp },
                false => GuardedStop::Arrived { stamp },
            })
        }
    }

    #[test]
    fn the_stamps_of_a_guarded_motion_lose_the_latency_however_it_ends() {
        for is_felt in [true, false] {
            let stops: Box<dyn Robot> = Box::new(Stops { is_felt });
            let mut late = Late::new(stops, 4.0);
            let guarded = late.guarded_motion().expect("it has it");
            let guard = Guard::at(taceva_core::Newton(0.5));
            let speed = Speed::try_new(1.0).expect("a speed");
            let stop = guarded.move_guarded(Pose::default(), speed, guard, Deadline::PASSED);
            let (GuardedStop::Guarded { stamp, .. } | GuardedStop::Arrived { stamp }) =
                stop.expect("it stops");
            assert!((stamp.valid_s - 6.996).abs() < 1e-12, "{stamp:?}");
            assert_eq!(stamp.received_s, Some(7.0));
        }
    }

    #[test]
    fn the_stamp_of_an_expiring_motion_loses_the_latency() {
        let stops: Box<dyn Robot> = Box::new(Stops { is_felt: false });
        let mut late = Late::new(stops, 4.0);
        let expiring = late.expiring_motion().expect("it has it");
        let speed = Speed::try_new(1.0).expect("a speed");
        let stamp = expiring.move_expiring(Pose::default(), speed, Deadline::PASSED);
        assert!((stamp.expect("it arrives").valid_s - 6.996).abs() < 1e-12);
    }

    #[test]
    fn a_reading_that_was_stamped_on_arrival_was_true_by_the_latency_earlier() {
        let arrived: Box<dyn ForceTransducer> = Box::new(Arrived);
        let mut late = Late::new(arrived, 4.0);
        let (_, stamp) = late.read(Deadline::PASSED).expect("a reading");
        assert!((stamp.valid_s - 6.996).abs() < 1e-12, "{stamp:?}");
        assert_eq!(stamp.received_s, Some(7.0));
        assert_eq!(late.sequence(), Some(5));
    }
}
