//! The devices of the world, behind the traits that drivers implement.

use std::sync::Arc;

use taceva_core::{
    Axes, Deadline, DriverError, DriverKey, ErrorKind, Fault, ForceTransducer, FrameInfo, FrameMut,
    Halt, Millimetre, Newton, PixelFormat, Point, Pose, Robot, Rotation, Sensor, Speed, Stamp,
    Tare, Wrench,
};

use super::world::{Sabotage, Shared, World};
use crate::run::{Observation, SharedSupervisor};

const ROBOT: DriverKey = DriverKey::fixed("faults/robot");
const FORCE: DriverKey = DriverKey::fixed("faults/force");
const SENSOR: DriverKey = DriverKey::fixed("faults/sensor");

/// A frame carries what was true when it was exposed: the time, the height of the tip and the normal force.
pub(super) const FRAME: FrameInfo = FrameInfo {
    width: 24,
    height: 1,
    format: PixelFormat::Gray8,
};

/// Moves the tip.
pub(super) struct SimulatedRobot(pub(super) Shared);

/// Stops it.
struct SimulatedHalt(Shared);

impl Halt for SimulatedHalt {
    fn halt(&self) -> Result<(), DriverError> {
        let mut world = self.0.world();
        world.link();
        if world.sabotage == Sabotage::SlowHalt {
            world.pass(0.06);
        }
        world.halted = true;
        let now_s = world.now_s;
        world.oracle.halted(now_s);
        Ok(())
    }
}

impl Robot for SimulatedRobot {
    fn pose(&mut self, _: Deadline) -> Result<(Pose, Stamp), DriverError> {
        self.0.survive();
        let mut world = self.0.world();
        world.link();
        let (tip, valid_s) = (world.reported(), world.now_s);
        world.link();
        let received_s = Some(world.now_s);
        let [x, y, z] = tip.map(Millimetre);
        let pose = Pose {
            position: Point { x, y, z },
            rotation: Rotation::default(),
        };
        Ok((
            pose,
            Stamp {
                valid_s,
                received_s,
            },
        ))
    }

    fn move_to(&mut self, target: Pose, speed: Speed, _: Deadline) -> Result<Stamp, DriverError> {
        self.0.survive();
        let mut world = self.0.world();
        world.link();
        world
            .obey("a motion")
            .map_err(|fault| faulty("move", fault))?;
        if world.halted {
            return Err(DriverError::new(ErrorKind::Interrupted, &ROBOT, "move"));
        }
        let Point { x, y, z } = target.position;
        let (to, speed_mm_s) = ([x.0, y.0, z.0], speed.mm_per_s());
        match world.guard.clone() {
            None => world.glide(to, speed_mm_s),
            Some(guard) => {
                drop(world);
                self.0.glide_under_guard(to, speed_mm_s, &guard)?;
                world = self.0.world();
            }
        }
        let valid_s = world.now_s;
        world.link();
        drop(world);
        self.0.survive();
        Ok(Stamp {
            valid_s,
            received_s: None,
        })
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::new(SimulatedHalt(self.0.clone()))
    }

    fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
        let mut world = self.0.world();
        world.link();
        let obeyed = world.obey("the end of a halt");
        obeyed.map_err(|fault| faulty("end the halt", fault))?;
        world.release();
        Ok(())
    }
}

fn faulty(doing: &'static str, fault: Fault) -> DriverError {
    DriverError::new(ErrorKind::DeviceFault, &ROBOT, doing).with_fault(fault)
}

impl Shared {
    /// Moves the tip from reading to reading, each shown to `guard` with the pose, as threads do on a real rig.
    fn glide_under_guard(
        &self,
        to: [f64; 3],
        speed_mm_s: f64,
        guard: &SharedSupervisor,
    ) -> Result<(), DriverError> {
        // One that is stuck says after the time of its motion that it arrived.
        let until_s = self.world().arrival_s(to, speed_mm_s);
        loop {
            let (seen, now_s, is_end) = {
                let mut world = self.world();
                let next = world.next_on_way(to, speed_mm_s);
                world.glide(next, speed_mm_s);
                let now_s = world.now_s;
                (overheard(&mut world), now_s, now_s >= until_s)
            };
            for observation in seen {
                let _ = guard.lock().observe(&observation, now_s);
            }
            if self.world().halted {
                return Err(DriverError::new(ErrorKind::Interrupted, &ROBOT, "move"));
            }
            if is_end {
                return Ok(());
            }
        }
    }
}

/// What both threads see now.
fn overheard(world: &mut World) -> [Observation; 2] {
    let now_s = world.now_s;
    let at = |valid_s| Stamp {
        valid_s,
        received_s: Some(now_s),
    };
    let force = match world.overhear() {
        Some((force, valid_s)) => {
            let wrench = Wrench {
                force: force.map(Newton),
                ..Wrench::default()
            };
            Observation::Force(wrench, at(valid_s))
        }
        None => Observation::Silence,
    };
    let [x, y, z] = world.reported().map(Millimetre);
    let pose = Pose {
        position: Point { x, y, z },
        ..Pose::default()
    };
    let stamp = at(now_s);
    [force, Observation::UnderWay { pose, stamp }]
}

/// Measures the force.
pub(super) struct SimulatedForce(pub(super) Shared);

impl ForceTransducer for SimulatedForce {
    fn axes(&self) -> Axes {
        Axes::FORCE
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        self.0.survive();
        let mut world = self.0.world();
        let reading = world.read_force(deadline.remaining().as_secs_f64());
        let (force, valid_s) =
            reading.ok_or_else(|| DriverError::new(ErrorKind::Timeout, &FORCE, "read"))?;
        world.link();
        let wrench = Wrench {
            force: force.map(Newton),
            ..Wrench::default()
        };
        let now_s = world.now_s;
        let stamp = Stamp {
            valid_s,
            received_s: Some(now_s),
        };
        let guard = world.guard.clone();
        drop(world);
        if let Some(guard) = guard {
            // What it halts for, the run learns from the supervisor.
            let _ = guard
                .lock()
                .observe(&Observation::Force(wrench, stamp), now_s);
        }
        Ok((wrench, stamp))
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        Some(self)
    }
}

impl Tare for SimulatedForce {
    fn zero(&mut self, _: Deadline) -> Result<(), DriverError> {
        let mut world = self.0.world();
        world.link();
        world.tare();
        Ok(())
    }
}

/// Gives frames that hold the true height and force of their exposure.
pub(super) struct SimulatedSensor(pub(super) Shared);

impl Sensor for SimulatedSensor {
    fn frame_info(&self) -> FrameInfo {
        FRAME
    }

    fn capture(
        &mut self,
        mut into: FrameMut<'_>,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        self.0.survive();
        let mut world = self.0.world();
        let exposed = world.expose(deadline.remaining().as_secs_f64());
        let valid_s = exposed
            .ok_or_else(|| DriverError::new(ErrorKind::Timeout, &SENSOR, "capture a frame"))?;
        let force = world.force(world.tip);
        let lag_s = if world.sabotage == Sabotage::OldFrames {
            0.1
        } else {
            0.0
        };
        let truth = [valid_s - lag_s, world.tip[2], force];
        for (bytes, value) in into.bytes_mut().chunks_exact_mut(8).zip(truth) {
            bytes.copy_from_slice(&value.to_le_bytes());
        }
        world.link();
        let received_s = Some(world.now_s);
        Ok(Stamp {
            valid_s,
            received_s,
        })
    }
}
