//! Devices of the simulated world. They implement the device traits of the drivers.

use std::sync::Arc;

use taceva_core::{
    Axes, Deadline, DriverError, DriverKey, ErrorKind, Fault, ForceTransducer, FrameInfo, FrameMut,
    Halt, Millimetre, Newton, PixelFormat, Point, Pose, Robot, Rotation, Sensor, Speed, Stamp,
    Tare, Wrench,
};

use super::guard::Guard;
use super::world::Sabotage;
use super::world_handle::Shared;

const ROBOT: DriverKey = DriverKey::fixed("faults/robot");
const FORCE: DriverKey = DriverKey::fixed("faults/force");
const SENSOR: DriverKey = DriverKey::fixed("faults/sensor");

/// Size and format of the frames. A frame encodes the true time, tip height and normal force at its exposure.
pub(super) const FRAME: FrameInfo = FrameInfo {
    width: 24,
    height: 1,
    format: PixelFormat::Gray8,
};

/// Robot that moves the tip.
pub(super) struct SimulatedRobot(pub(super) Shared);

/// Halt handle of the robot.
struct SimulatedHalt(Shared);

impl Halt for SimulatedHalt {
    fn halt(&self) -> Result<(), DriverError> {
        let mut world = self.0.world();
        world.link();
        // A halted robot already stands still: a guard that halts again loses no time.
        if world.sabotage == Sabotage::SlowHalt && !world.halted {
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
        self.0.look_on();
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
        self.0.look_on();
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
        if world.guard.is_some() {
            world.set_out();
            drop(world);
            self.0.is_moving(true);
            let moved = self.0.glide_under_guard(to, speed_mm_s);
            self.0.is_moving(false);
            self.0.world().oracle.is_held();
            moved?;
            world = self.0.world();
        } else {
            world.glide(to, speed_mm_s);
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
    /// Records that a motion starts or ends.
    fn is_moving(&self, is_moving: bool) {
        if let Some(guard) = &mut self.world().guard {
            guard.is_moving = is_moving;
        }
    }

    /// Moves the tip while threads monitor it, which may halt it anywhere.
    fn glide_under_guard(&self, to: [f64; 3], speed_mm_s: f64) -> Result<(), DriverError> {
        // A stuck robot reports arrival after the time of its motion.
        let (began_s, until_s) = {
            let world = self.world();
            (world.now_s, world.arrival_s(to, speed_mm_s))
        };
        loop {
            let mut world = self.world();
            world.is_let_move(began_s);
            let next_s = world.guard.as_ref().map_or(until_s, Guard::next_s);
            let at_s = next_s.clamp(world.now_s, until_s.max(world.now_s));
            let is_end = at_s >= until_s - INSTANT_S;
            let next = match is_end {
                true => world.on_way(to, speed_mm_s, until_s + INSTANT_S),
                false => world.on_way(to, speed_mm_s, at_s),
            };
            if is_end || at_s > world.now_s {
                world.glide(next, speed_mm_s);
                // A path below the resolution of binary64 takes its time all the same.
                let left_s = at_s - world.now_s;
                world.pass(left_s.max(0.0));
            }
            drop(world);
            self.look_on();
            let mut world = self.world();
            if world.is_stopped() {
                let stopped = world.obey("a motion");
                return stopped.map_err(|fault| faulty("move", fault));
            }
            if world.halted {
                return Err(DriverError::new(ErrorKind::Interrupted, &ROBOT, "move"));
            }
            if is_end {
                return Ok(());
            }
        }
    }
}

/// Times that differ by less than this are equal, s, because binary64 rounds them.
const INSTANT_S: f64 = 1e-9;

/// Force transducer of the simulated world.
pub(super) struct SimulatedForce {
    shared: Shared,
    /// Number of readings of the reader thread when [`take`](SimulatedForce::take) last returned one.
    taken: u64,
}

impl SimulatedForce {
    pub(super) fn new(shared: Shared) -> SimulatedForce {
        SimulatedForce { shared, taken: 0 }
    }

    /// Returns the newest reading of the reader thread, for a run with monitoring threads. Waits at most `deadline_s`, s; `None` if no new reading
    /// arrives.
    fn take(&mut self, deadline_s: f64) -> Option<(Wrench, Stamp)> {
        let began_s = self.shared.world().now_s;
        let until_s = began_s + deadline_s;
        loop {
            self.shared.look_on();
            let latest = {
                let world = self.shared.world();
                world.guard.as_ref().and_then(|guard| guard.latest)
            };
            if let Some(heard) = latest.filter(|heard| heard.count > self.taken) {
                self.taken = heard.count;
                return Some((heard.wrench, heard.stamp));
            }
            let mut world = self.shared.world();
            if world.now_s >= until_s {
                world.missed(began_s);
                return None;
            }
            drop(world);
            self.shared.step(until_s);
        }
    }
}

impl ForceTransducer for SimulatedForce {
    fn axes(&self) -> Axes {
        Axes::FORCE
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        self.shared.survive();
        let deadline_s = deadline.remaining().as_secs_f64();
        let silent = || DriverError::new(ErrorKind::Timeout, &FORCE, "read");
        if self.shared.world().guard.is_some() {
            return self.take(deadline_s).ok_or_else(silent);
        }
        let mut world = self.shared.world();
        let (force, valid_s) = world.read_force(deadline_s).ok_or_else(silent)?;
        world.link();
        let wrench = Wrench {
            force: force.map(Newton),
            ..Wrench::default()
        };
        let received_s = Some(world.now_s);
        Ok((
            wrench,
            Stamp {
                valid_s,
                received_s,
            },
        ))
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        Some(self)
    }
}

impl Tare for SimulatedForce {
    fn zero(&mut self, _: Deadline) -> Result<(), DriverError> {
        let mut world = self.shared.world();
        world.link();
        world.tare();
        Ok(())
    }
}

/// Sensor whose frames encode the true height and force at their exposure.
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
        self.0.look_on();
        let (wait_s, exposed) = self.0.world().expose(deadline.remaining().as_secs_f64());
        self.0.elapse(wait_s);
        let mut world = self.0.world();
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
