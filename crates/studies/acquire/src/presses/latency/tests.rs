//! Tests of the wrappers that correct and check time stamps.

use taceva_core::Halt;

use super::*;

/// A device without timing checks whose time stamps are `latency_ms` ms late.
fn late<D: ?Sized>(device: Box<D>, latency_ms: f64) -> Late<D> {
    let driver = DriverKey::fixed("test/device");
    Late::new(device, driver, latency_ms, SampleTiming::unchecked())
}

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

    fn lost(&self) -> Option<u64> {
        Some(2)
    }
}

/// A test robot whose guarded motion ends by contact or arrival at 7 s.
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
        let mut late = late(stops, 4.0);
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
    let mut late = late(stops, 4.0);
    let expiring = late.expiring_motion().expect("it has it");
    let speed = Speed::try_new(1.0).expect("a speed");
    let stamp = expiring.move_expiring(Pose::default(), speed, Deadline::PASSED);
    assert!((stamp.expect("it arrives").valid_s - 6.996).abs() < 1e-12);
}

#[test]
fn a_reading_that_was_stamped_on_arrival_was_true_by_the_latency_earlier() {
    let arrived: Box<dyn ForceTransducer> = Box::new(Arrived);
    let mut late = late(arrived, 4.0);
    let (_, stamp) = late.read(Deadline::PASSED).expect("a reading");
    assert!((stamp.valid_s - 6.996).abs() < 1e-12, "{stamp:?}");
    assert_eq!(stamp.received_s, Some(7.0));
    assert_eq!((late.sequence(), late.lost()), (Some(5), Some(2)));
}
