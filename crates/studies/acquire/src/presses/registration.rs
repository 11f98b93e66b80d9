//! Wrappers that convert poses and wrenches to the frame of the sensor. The rig file states the position of the robot's base, and the axes of the
//! transducer.

use std::sync::Arc;

use taceva_core::{
    Axes, Deadline, DriverError, ExpiringMotion, ForceTransducer, Guard, GuardedMotion,
    GuardedStop, Pose, Robot, RobotWatch, Speed, Stamp, Wrench,
};
use taceva_core::{Degree, Newton, NewtonMillimetre, Rotation};
use taceva_protocol::{Registration, RigRobot, SignedAxes};

use super::delegation::{delegate_force, delegate_robot};

/// A robot with poses in the frame of the sensor. The wrapped driver uses the base frame of the robot.
pub(super) struct Registered {
    registration: Registration,
    robot: Box<dyn Robot>,
}

impl Registered {
    /// Wraps `robot` with the registration in `registered`, which places its base frame relative to the sensor. A missing rotation of the tool is
    /// read from the robot within `deadline`.
    ///
    /// # Errors
    /// [`DriverError`] if the robot reports no pose.
    pub(super) fn new(
        mut robot: Box<dyn Robot>,
        registered: &RigRobot,
        deadline: Deadline,
    ) -> Result<Registered, DriverError> {
        let turned = match registered.turned_deg {
            Some(angles) => {
                let [x, y, z] = angles.map(Degree);
                Rotation { x, y, z }
            }
            None => robot.pose(deadline)?.0.rotation,
        };
        let registration = Registration::new(registered, turned);
        Ok(Registered {
            registration,
            robot,
        })
    }
}

impl Robot for Registered {
    delegate_robot!(robot);

    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let (base, stamp) = self.robot.pose(deadline)?;
        Ok((self.registration.to_sensor(&base), stamp))
    }

    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let target = self.registration.to_base(&target);
        self.robot.move_to(target, speed, deadline)
    }

    fn watch_handle(&self) -> Option<Arc<dyn RobotWatch>> {
        let watch = self.robot.watch_handle()?;
        let registration = self.registration;
        Some(Arc::new(RegisteredWatch {
            registration,
            watch,
        }))
    }
}

impl ExpiringMotion for Registered {
    fn move_expiring(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let target = self.registration.to_base(&target);
        let expiring = self.robot.expiring_motion();
        expiring
            .expect("BUG: the robot no longer reports the capability that it reported at open")
            .move_expiring(target, speed, deadline)
    }
}

impl GuardedMotion for Registered {
    fn move_guarded(
        &mut self,
        target: Pose,
        speed: Speed,
        guard: Guard,
        deadline: Deadline,
    ) -> Result<GuardedStop, DriverError> {
        let target = self.registration.to_base(&target);
        let guarded = self.robot.guarded_motion();
        let stop = guarded
            .expect("BUG: the robot no longer reports the capability that it reported at open")
            .move_guarded(target, speed, guard, deadline)?;
        Ok(match stop {
            GuardedStop::Guarded { pose, stamp } => GuardedStop::Guarded {
                pose: self.registration.to_sensor(&pose),
                stamp,
            },
            arrived @ GuardedStop::Arrived { .. } => arrived,
        })
    }
}

struct RegisteredWatch {
    registration: Registration,
    watch: Arc<dyn RobotWatch>,
}

impl RobotWatch for RegisteredWatch {
    fn pose(&self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let (base, stamp) = self.watch.pose(deadline)?;
        Ok((self.registration.to_sensor(&base), stamp))
    }
}

/// A transducer with readings in the frame of the sensor.
pub(crate) struct Turned {
    axes: SignedAxes,
    force: Box<dyn ForceTransducer>,
}

impl Turned {
    /// Wraps `force`; `axes` maps its axes to those of the sensor.
    pub(crate) fn new(force: Box<dyn ForceTransducer>, axes: SignedAxes) -> Turned {
        Turned { axes, force }
    }
}

impl ForceTransducer for Turned {
    delegate_force!(force);

    fn axes(&self) -> Axes {
        self.axes.measured(self.force.axes())
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let (wrench, stamp) = self.force.read(deadline)?;
        let force = self.axes.to_sensor(wrench.force.map(|force| force.0));
        let torque = self.axes.to_sensor(wrench.torque.map(|torque| torque.0));
        let wrench = Wrench {
            force: force.map(Newton),
            torque: torque.map(NewtonMillimetre),
        };
        Ok((wrench, stamp))
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::{DriverKey, ErrorKind, Halt, Millimetre, Point};
    use taceva_protocol::RigFile;

    use super::*;

    /// Test robot that is always at its last target pose, in its base frame.
    struct Arm(Pose);

    struct Rests;

    impl Halt for Rests {
        fn halt(&self) -> Result<(), DriverError> {
            Ok(())
        }
    }

    impl Robot for Arm {
        fn pose(&mut self, _: Deadline) -> Result<(Pose, Stamp), DriverError> {
            Ok((self.0, Stamp::at(std::time::Duration::ZERO)))
        }

        fn move_to(&mut self, target: Pose, _: Speed, _: Deadline) -> Result<Stamp, DriverError> {
            // A target inside the table means that the wrapper did not map it.
            if target.position.z.0 < 200.0 {
                let key = DriverKey::fixed("lab/arm");
                return Err(DriverError::new(ErrorKind::OutOfRange, &key, "move"));
            }
            self.0 = target;
            Ok(Stamp::at(std::time::Duration::ZERO))
        }

        fn halt_handle(&self) -> Arc<dyn Halt> {
            Arc::new(Rests)
        }

        fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
            Ok(())
        }
    }

    /// Test transducer with six different components.
    struct Loaded;

    impl ForceTransducer for Loaded {
        fn axes(&self) -> Axes {
            Axes::SIX
        }

        fn read(&mut self, _: Deadline) -> Result<(Wrench, Stamp), DriverError> {
            let wrench = Wrench {
                force: [1.0, 2.0, 3.0].map(Newton),
                torque: [4.0, 5.0, 6.0].map(NewtonMillimetre),
            };
            Ok((wrench, Stamp::at(std::time::Duration::ZERO)))
        }
    }

    fn place([x, y, z]: [f64; 3]) -> Point {
        let [x, y, z] = [x, y, z].map(Millimetre);
        Point { x, y, z }
    }

    #[test]
    fn an_arm_of_a_rig_file_is_sent_in_its_base_frame_and_seen_in_the_sensors() {
        let text = "rig_version = 1\n[robot]\ndriver = \"lab/arm\"\ncarries = \"indenter\"\norigin_mm = [300.0, 0.0, 251.3]\naxes = [\"x\", \"-y\", \"-z\"]\n";
        let rig = RigFile::parse("lab.toml", text).expect("a rig");
        let stands = Pose {
            position: place([300.0, 0.0, 271.3]),
            rotation: Rotation {
                x: Degree(180.0),
                ..Rotation::default()
            },
        };
        let robot = rig.robot.as_ref().expect("a robot");
        let mut arm =
            Registered::new(Box::new(Arm(stands)), robot, Deadline::PASSED).expect("a pose");
        let (seen, _) = arm.pose(Deadline::PASSED).expect("a pose");
        assert_eq!(seen.position, place([0.0, 0.0, -20.0]));
        assert_eq!(seen.rotation, Rotation::default());
        let target = Pose {
            position: place([4.0, 3.0, 0.5]),
            ..Pose::default()
        };
        let speed = Speed::try_new(1.0).expect("a speed");
        arm.move_to(target, speed, Deadline::PASSED)
            .expect("it reaches that");
        assert_eq!(arm.pose(Deadline::PASSED).expect("a pose").0, target);
    }

    #[test]
    fn forces_and_torques_are_turned_into_the_frame_of_the_sensor() {
        let axes = SignedAxes::read(["x", "-y", "-z"]).expect("axes");
        let mut turned = Turned::new(Box::new(Loaded), axes);
        let (wrench, _) = turned.read(Deadline::PASSED).expect("a reading");
        assert_eq!(wrench.force, [1.0, -2.0, -3.0].map(Newton));
        assert_eq!(wrench.torque, [4.0, -5.0, -6.0].map(NewtonMillimetre));
    }
}
