//! Simulated world that devices, disk and clock share. A kill may end the simulated process at any call.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::draws::Draws;
use super::fault::{FaultKind, Faults};
use super::gel::Gel;
use super::oracle::Oracle;
use super::world::World;
use taceva_protocol::Timekeeper;

/// The world, shared by devices, disk and clock.
#[derive(Clone)]
pub(super) struct Shared(Arc<Mutex<World>>);

/// Panic payload of a killed process. No code handles this payload as an error.
pub(super) struct Killed;

impl Shared {
    pub(super) fn new(gel: Gel, oracle: Oracle, faults: Faults, draws: Draws) -> Shared {
        Shared(Arc::new(Mutex::new(World::new(gel, oracle, faults, draws))))
    }

    /// Locks the world. Kills occur between calls, so that the world behind a poisoned lock is consistent.
    pub(super) fn world(&self) -> MutexGuard<'_, World> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Ends the simulated process if a kill is due. Cancels the run if a cancellation is due.
    pub(super) fn survive(&self) {
        let mut world = self.world();
        let now_s = world.now_s;
        if world.faults.strike_once(FaultKind::Kill, now_s) {
            world.oracle.killed();
            drop(world);
            // Unlike a panic it is not reported, because the program did nothing wrong.
            std::panic::resume_unwind(Box::new(Killed));
        }
        // With monitoring threads, one of them receives the request.
        if world.guard.is_none() && world.faults.strike_once(FaultKind::Cancel, now_s) {
            world.cancel.cancel();
        }
    }
}

impl Timekeeper for Shared {
    fn now_s(&self) -> f64 {
        self.look_on();
        self.world().now_s
    }

    fn rest(&mut self, rest: std::time::Duration) {
        self.elapse(rest.as_secs_f64());
        self.survive();
    }
}
