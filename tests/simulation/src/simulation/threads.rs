//! Actions of the monitoring threads during simulated time.

use taceva_core::{Fault, Millimetre, Newton, Point, Pose, Stamp, Wrench};

use super::fault::FaultKind;
use super::guard::{Guard, Heard, Thread};
use super::world::World;
use super::world_handle::Shared;
use taceva_protocol::STALE_S;
use taceva_protocol::{Observation, Supervisor};

impl Shared {
    /// Runs the threads whose turn is due. False if they wait for the supervisor.
    pub(super) fn look_on(&self) -> bool {
        let supervisor = match &self.world().guard {
            Some(guard) => guard.supervisor.clone(),
            None => return true,
        };
        let Some(mut held) = supervisor.try_lock() else {
            return false;
        };
        loop {
            let due = {
                let mut world = self.world();
                let now_s = world.now_s;
                world.guard.as_mut().and_then(|guard| guard.due(now_s))
            };
            match due {
                Some(Thread::Reader) => self.overhear(&mut held),
                Some(Thread::Watcher) => self.watch(&mut held),
                None => return true,
            }
        }
    }

    /// Advances time, and runs the threads meanwhile.
    pub(super) fn elapse(&self, seconds: f64) {
        let mut world = self.world();
        if world.guard.is_none() {
            world.pass(seconds);
            return;
        }
        let until_s = world.now_s + seconds;
        drop(world);
        while self.step(until_s) {}
    }

    /// Advances time to the next turn of a thread, at most to `until_s`. True if time remains.
    pub(super) fn step(&self, until_s: f64) -> bool {
        let mut world = self.world();
        let next_s = world.guard.as_ref().map_or(until_s, Guard::next_s);
        let wait_s = next_s.min(until_s) - world.now_s;
        world.pass(wait_s.max(0.0));
        drop(world);
        if !self.look_on() {
            let mut world = self.world();
            let left_s = until_s - world.now_s;
            world.pass(left_s.max(0.0));
        }
        self.world().now_s < until_s
    }

    /// Reader thread: passes its readings to the supervisor and keeps them for the run.
    fn overhear(&self, held: &mut Supervisor) {
        let mut world = self.world();
        let is_moving = world.guard.as_ref().is_some_and(|guard| guard.is_moving);
        let Some((force, valid_s)) = world.overhear(is_moving) else {
            return;
        };
        let now_s = world.now_s;
        let stamp = Stamp {
            valid_s,
            received_s: Some(now_s),
        };
        let wrench = Wrench {
            force: force.map(Newton),
            ..Wrench::default()
        };
        let Some(guard) = &mut world.guard else {
            return;
        };
        let count = 1 + guard.latest.map_or(0, |heard| heard.count);
        guard.latest = Some(Heard {
            wrench,
            stamp,
            count,
        });
        let observation = match guard.is_numbered {
            true => Observation::Numbered(wrench, stamp, count),
            false => Observation::Force(wrench, stamp),
        };
        drop(world);
        // The run learns the reason for a halt from the supervisor.
        let _ = held.observe(&observation, now_s);
    }

    /// Robot thread: receives stop requests and faults, and reports the position of the moving tip.
    fn watch(&self, held: &mut Supervisor) {
        let mut world = self.world();
        let now_s = world.now_s;
        let is_wish = world.faults.strike_once(FaultKind::Cancel, now_s);
        let is_stopped = world.is_stopped();
        let enabling = world.feel(now_s);
        let reports = !is_stopped && !world.faults.strike(FaultKind::NoReports, now_s);
        let reported = reports.then(|| at(&mut world, now_s));
        let Some(guard) = &mut world.guard else {
            return;
        };
        guard.seen = reported.or(guard.seen);
        if is_wish {
            guard.cancel.cancel();
        }
        let seen = guard.seen;
        let is_old = |(_, stamp): (Pose, Stamp)| now_s - stamp.valid_s > STALE_S;
        if held.is_under_way() && seen.is_some_and(is_old) {
            world.hazard("a robot without reports", now_s);
        }
        drop(world);
        if is_wish {
            held.halt();
        }
        held.enabling(enabling);
        if is_stopped {
            held.fail(Fault::EmergencyStop);
        }
        if !held.is_under_way() {
            return;
        }
        let seen = seen.map(|(pose, stamp)| Observation::UnderWay { pose, stamp });
        for observation in seen.iter().chain([&Observation::Silence]) {
            let _ = held.observe(observation, now_s);
        }
    }
}

/// Report of the robot at `now_s`.
fn at(world: &mut World, now_s: f64) -> (Pose, Stamp) {
    let [x, y, z] = world.reported().map(Millimetre);
    let pose = Pose {
        position: Point { x, y, z },
        ..Pose::default()
    };
    let stamp = Stamp {
        valid_s: now_s,
        received_s: Some(now_s),
    };
    (pose, stamp)
}
