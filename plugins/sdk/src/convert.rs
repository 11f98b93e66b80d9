//! Conversion between values at the C boundary of plugins and values of `taceva-core`. Both directions reject numbers that are not finite.
//!
//! Positions are in m at the boundary and in mm in core. Forces are in N and torques in N·mm on both sides.

use std::time::Duration;

use taceva_abi::{Motion, Pose as AbiPose, Stamp as AbiStamp, Wrench as AbiWrench};
use taceva_core::{
    Deadline, NotFinite, Pose, SiPose, Speed, Stamp, Wrench, check_pose, check_wrench,
};

use crate::failure::Failure;

pub(crate) fn deadline(timeout_ns: u64) -> Deadline {
    Deadline::after(Duration::from_nanos(timeout_ns))
}

/// Converts a duration to nanoseconds. Durations above 584 years become [`u64::MAX`].
pub(crate) fn nanoseconds(time: Duration) -> u64 {
    u64::try_from(time.as_nanos()).unwrap_or(u64::MAX)
}

/// Converts the target pose and the speed of a motion that the host requests.
pub(crate) fn motion(motion: &Motion) -> Result<(Pose, Speed), Failure> {
    let AbiPose {
        x,
        y,
        z,
        qw,
        qx,
        qy,
        qz,
    } = motion.target;
    let target = SiPose {
        position_m: [x, y, z],
        quaternion: [qw, qx, qy, qz],
    };
    let target = target.to_pose().ok_or_else(|| {
        Failure::argument(format!(
            "the target is at {:?} m turned by {:?}, expected finite numbers and a unit quaternion",
            target.position_m, target.quaternion
        ))
    })?;
    let speed = Speed::from_metres_per_second(motion.speed_m_per_s)
        .map_err(|error| Failure::argument(error.to_string()))?;
    Ok((target, speed))
}

/// Converts a pose of the device for the host.
pub(crate) fn pose(pose: &Pose) -> Result<AbiPose, Failure> {
    check_pose(pose).map_err(fault)?;
    let SiPose {
        position_m: [x, y, z],
        quaternion: [qw, qx, qy, qz],
    } = pose.on_grid().into();
    Ok(AbiPose {
        x,
        y,
        z,
        qw,
        qx,
        qy,
        qz,
    })
}

/// Converts a wrench of the device for the host.
pub(crate) fn wrench(wrench: &Wrench) -> Result<AbiWrench, Failure> {
    check_wrench(wrench).map_err(fault)?;
    Ok(AbiWrench {
        force_n: wrench.force.map(|force| force.0),
        torque_n_mm: wrench.on_grid().torque.map(|torque| torque.0),
    })
}

/// Converts a time stamp of the device for the host.
pub(crate) fn stamp(stamp: &Stamp) -> Result<AbiStamp, Failure> {
    let is_time = |time_s: f64| time_s.is_finite() && time_s >= 0.0;
    let valid_s = stamp.valid_s;
    let received_s = stamp.received_s.unwrap_or(valid_s);
    if !is_time(valid_s) || !is_time(received_s) {
        return Err(Failure::device(format!(
            "the stamp is {valid_s} s, received at {received_s} s, expected finite times of at least 0 s"
        )));
    }
    Ok(AbiStamp {
        valid_ns: nanoseconds(stamp.valid()),
        received_ns: stamp.received().map_or(0, nanoseconds),
    })
}

fn fault(error: NotFinite) -> Failure {
    Failure::device(error.to_string())
}

#[cfg(test)]
mod tests {
    use taceva_abi::Status;

    use super::*;

    fn asked(spoil: impl FnOnce(&mut Motion)) -> Motion {
        let target = AbiPose {
            x: 0.001,
            y: -0.002,
            z: 0.0105,
            qw: 1.0,
            qx: 0.0,
            qy: 0.0,
            qz: 0.0,
        };
        let mut motion = Motion {
            size: 72,
            reserved: 0,
            target,
            speed_m_per_s: 0.002,
        };
        spoil(&mut motion);
        motion
    }

    #[test]
    fn what_is_asked_in_metres_arrives_in_millimetres_on_the_grid() {
        let (target, speed) = motion(&asked(|_| ())).expect("a motion");
        assert_eq!(target.position.z.0.to_bits(), 10.5_f64.to_bits());
        assert_eq!(speed, Speed::try_new(2.0).expect("above 0"));
        let back = pose(&target).expect("finite");
        assert_eq!(back, asked(|_| ()).target);
    }

    #[test]
    fn numbers_that_are_not_finite_are_the_caller_s_fault_on_the_way_in() {
        let spoils: [fn(&mut Motion); 6] = [
            |motion| motion.target.x = f64::NAN,
            |motion| motion.target.qx = f64::INFINITY,
            |motion| motion.target.qw = 0.0,
            |motion| motion.speed_m_per_s = 0.0,
            |motion| motion.speed_m_per_s = -1.0,
            |motion| motion.speed_m_per_s = f64::NAN,
        ];
        for spoil in spoils {
            let asked = asked(spoil);
            let refused = motion(&asked).expect_err("refused");
            assert_eq!(refused.status, Status::INVALID_ARGUMENT, "{asked:?}");
        }
    }

    #[test]
    fn numbers_that_are_not_finite_are_a_fault_of_the_device_on_the_way_out() {
        let mut force = Wrench::default();
        force.force[1].0 = f64::NAN;
        let mut crooked = Pose::default();
        crooked.rotation.z.0 = f64::INFINITY;
        let at = |valid_s| Stamp {
            valid_s,
            received_s: None,
        };
        let refused = [
            wrench(&force).map(drop),
            pose(&crooked).map(drop),
            stamp(&at(f64::NAN)).map(drop),
            stamp(&at(-1.0)).map(drop),
        ];
        for refused in refused {
            assert_eq!(refused.expect_err("refused").status, Status::DEVICE_FAULT);
        }
    }
}
