//! An arm that reaches every target at once.

use std::sync::Arc;
use std::time::Duration;

use taceva_core::{
    Args, Deadline, Degree, Descriptor, DescriptorError, DriverError, ErrorKind, ExpiringMotion,
    Factory, Facts, Guard, GuardedMotion, GuardedStop, Halt, Millimetre, Newton, Point, Pose, Rig,
    Robot, RobotFacts, Speed, Stamp, Workspace,
};
use taceva_plugin::HaltLatch;

use super::bench::Table;
use super::{descriptor, error, way};

pub(super) struct RobotMaker(Descriptor);

impl RobotMaker {
    pub(super) fn new() -> Result<RobotMaker, DescriptorError> {
        Ok(RobotMaker(descriptor(
            "arm",
            Facts::Robot(limits()),
            way(),
        )?))
    }
}

/// Workspace of half a metre around the gel, at most 100 mm/s.
fn limits() -> RobotFacts {
    let corner = |side| Point {
        x: Millimetre(side),
        y: Millimetre(side),
        z: Millimetre(side),
    };
    RobotFacts::default()
        .with_workspace(Workspace {
            least: corner(-500.0),
            greatest: corner(500.0),
        })
        .with_speed_max(Speed::try_new(100.0).ok())
}

impl Factory<dyn Robot> for RobotMaker {
    fn descriptor(&self) -> &Descriptor {
        &self.0
    }
    fn open(&self, args: &Args, rig: &mut Rig) -> Result<Box<dyn Robot>, DriverError> {
        rig.offer_bench("test bench", Arc::new(Table));
        Ok(Box::new(Arm {
            way: args.text("way").to_owned(),
            latch: Arc::default(),
            stands: Pose::default(),
        }))
    }
}

struct Arm {
    way: String,
    latch: Arc<HaltLatch>,
    stands: Pose,
}

impl Robot for Arm {
    fn pose(&mut self, _: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let mut pose = self.stands;
        if self.way == "nan" {
            pose.rotation.y = Degree(f64::NAN);
        }
        Ok((pose, Stamp::at(Duration::from_secs(2))))
    }
    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let time = match self.way.as_str() {
            "block" => deadline.remaining(),
            "panic" => panic!("motor"),
            _ => Duration::ZERO,
        };
        self.latch
            .rest(time)
            .map_err(|halted| error(ErrorKind::Interrupted).because(halted))?;
        if self.way == "block" {
            return Err(error(ErrorKind::Timeout));
        }
        self.stands = target;
        Ok(Stamp::at(Duration::from_secs_f64(speed.mm_per_s())))
    }
    fn halt_handle(&self) -> Arc<dyn Halt> {
        self.latch.handle()
    }
    fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
        self.latch.clear();
        Ok(())
    }
    fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
        Some(self)
    }
    fn expiring_motion(&mut self) -> Option<&mut dyn ExpiringMotion> {
        (self.way == "well").then_some(self as &mut dyn ExpiringMotion)
    }
}

impl ExpiringMotion for Arm {
    fn move_expiring(&mut self, target: Pose, _: Speed, _: Deadline) -> Result<Stamp, DriverError> {
        self.stands = target;
        Ok(Stamp::at(Duration::from_secs(4)))
    }
}

impl GuardedMotion for Arm {
    fn move_guarded(
        &mut self,
        mut target: Pose,
        _: Speed,
        guard: Guard,
        _: Deadline,
    ) -> Result<GuardedStop, DriverError> {
        let stamp = Stamp::at(Duration::from_secs(3));
        if guard.force > Newton(5.0) {
            return Ok(GuardedStop::Arrived { stamp });
        }
        target.position.z.0 /= 2.0;
        Ok(GuardedStop::Guarded {
            pose: target,
            stamp,
        })
    }
}
