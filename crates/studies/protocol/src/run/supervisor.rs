//! Checks every force reading and every pose, and halts the robot if a value exceeds a limit or is unreliable. Moves nothing. Several threads may pass
//! readings.
//!
//! The supervisor is not a safety function. The site is responsible for the emergency stop, the collision sensitivity of the robot and the guards.

mod enabling;
mod observation;
mod question;
mod reaction;
mod repeats;

pub use enabling::Enabling;
pub use observation::{MotionStage, Observation};

use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};

use taceva_core::{
    Fault, Halt, Newton, NewtonMillimetre, Pose, Stamp, Wrench, check_pose, check_wrench,
};

use super::align::Look;
use super::halt_reason::Trip;
use super::way::{distance, distance_from_way};
use crate::limits::{FROZEN_READINGS, RigLimits};
use question::StandingQuestion;
use reaction::Lateness;
use repeats::Repeats;

/// Distance from target or path at which the tip counts as diverged, in mm.
const DIVERGED_MM: f64 = 0.5;
/// Distance at which the tip counts as diverged, in standard deviations of the reported pose. The greater distance applies.
const DIVERGED_NOISES: f64 = 5.0;
/// Greatest rate of force of a gel pressed at 5 mm/s or slower, in N/s.
const RATE_MAX_N_S: f64 = 200.0;
/// Least time between two readings from which a rate of force is computed, in s. In a shorter time, noise would exceed the rate.
const RATE_SPAN_S: f64 = 0.005;
/// Greatest increase of the normal force during a retreat, relative to its start, in N. It allows for the noise of a transducer.
const RETREAT_MARGIN_N: f64 = 0.05;
/// Greatest change of a pose that does not count as a motion, in mm, for a robot without pose noise.
const MOVED_MM: f64 = 1e-6;

/// A supervisor shared by several threads.
#[derive(Clone)]
pub struct SharedSupervisor(Arc<Mutex<Supervisor>>);

impl SharedSupervisor {
    /// Creates a handle to `supervisor`. Clones of the handle share the supervisor.
    pub fn new(supervisor: Supervisor) -> SharedSupervisor {
        SharedSupervisor(Arc::new(Mutex::new(supervisor)))
    }

    /// Locks the supervisor for one reading or one change of stage. Ignores poisoning, because no state change can panic midway.
    pub fn lock(&self) -> MutexGuard<'_, Supervisor> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Locks the supervisor; `None` while another thread holds the lock. For threads in simulated time, which must not wait.
    pub fn try_lock(&self) -> Option<MutexGuard<'_, Supervisor>> {
        match self.0.try_lock() {
            Ok(held) => Some(held),
            Err(TryLockError::Poisoned(poisoned)) => Some(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => None,
        }
    }
}

/// Halts a robot at a bad reading. The reason, a [`Trip`], is stored until [`release`](Supervisor::release) is called.
pub struct Supervisor {
    limits: RigLimits,
    halt: Arc<dyn Halt>,
    stage: MotionStage,
    /// Zero that is subtracted from every reading: the reading without load.
    zero: Wrench,
    /// Start and end poses of the motion in progress; `None` at rest.
    way: Option<[Pose; 2]>,
    /// Fault that the robot reported to a guard thread, if any.
    fault: Option<Fault>,
    /// Last pose read during a motion; `None` before the first.
    seen: Option<Pose>,
    /// Last force and its time in s, for the rate; `None` before the first force.
    last: Option<(Wrench, f64)>,
    /// Time of the last force, in s; before the first force, the start time of the stage.
    heard_s: f64,
    repeats: Repeats,
    tripped: Option<Trip>,
    enabling: Enabling,
    question: StandingQuestion,
    /// Delays of readings; `None` unless they are being measured.
    lateness: Option<Lateness>,
}

impl Supervisor {
    /// Creates a supervisor that checks `limits` and halts a robot by `halt`.
    pub fn new(limits: RigLimits, halt: Arc<dyn Halt>) -> Supervisor {
        Supervisor {
            limits,
            halt,
            // Until the first stage is set, the zero is unknown, so any force is allowed.
            stage: MotionStage::Retreat {
                force_n: f64::INFINITY,
            },
            zero: Wrench::default(),
            way: None,
            fault: None,
            seen: None,
            last: None,
            heard_s: f64::NEG_INFINITY,
            repeats: Repeats::default(),
            tripped: None,
            enabling: Enabling::Held,
            question: StandingQuestion::default(),
            lateness: None,
        }
    }

    /// Starts the supervision of `stage` at the time `now_s`, in s. The age of signals is measured from this time. The last trip is not cleared, so
    /// the robot remains halted until a release.
    pub fn watch(&mut self, stage: MotionStage, now_s: f64) {
        self.stage = stage;
        self.heard_s = now_s;
        // In the air, the zero of the transducer may have changed, so earlier readings give no rate. The count of repeats continues across stages.
        // Otherwise a signal that froze in the air would get the full allowance in each stage. Only a zero set by the transducer itself, once a run,
        // resets it.
        match stage {
            MotionStage::Travel { .. } => self.last = None,
            MotionStage::Zeroing => {
                self.last = None;
                self.repeats.forget();
            }
            _ => {}
        }
    }

    /// Clears the trip and starts the supervision of `stage`. Call this after the robot was released from its halt.
    pub fn release(&mut self, stage: MotionStage, now_s: f64) {
        self.tripped = None;
        self.watch(stage, now_s);
    }

    /// Records that the motion of the tip has ended.
    pub fn rests(&mut self) {
        self.way = None;
    }

    /// True from the sending of a motion until the tip rests. During this time, missing readings are dangerous.
    pub fn is_under_way(&self) -> bool {
        self.way.is_some()
    }

    /// Halts the robot because a guard thread detected a fault of the robot.
    pub fn fail(&mut self, fault: Fault) {
        self.fault = Some(fault);
        self.halt();
    }

    /// Fault that the robot reported, if any.
    pub fn fault(&self) -> Option<Fault> {
        self.fault
    }

    /// Clears a fault that the operator acknowledged at the robot.
    pub fn acknowledge(&mut self) {
        self.fault = None;
    }

    /// Halts the robot because a force reading is saturated, so the true force is unknown.
    pub fn saturated(&mut self) -> Trip {
        let force_n = f64::INFINITY;
        self.trip(Trip::Saturated { force_n })
    }

    /// Halts the robot for a reason other than a reading, such as a cancellation.
    pub fn halt(&mut self) {
        // A second halt is harmless. An error of a lost link cannot be reported otherwise.
        let _ = self.halt.halt();
    }

    /// Sets the zero of the force, which is subtracted from every later reading before limits of the gel are checked.
    pub fn call_zero(&mut self, zero: Wrench) {
        self.zero = zero;
    }

    /// Zero that is subtracted from every force reading.
    pub(super) fn zero(&self) -> Wrench {
        self.zero
    }

    /// Subtracts the zero from a reading, which gives the load on the gel.
    pub fn zeroed(&self, said: &Wrench) -> Wrench {
        let axes = [0, 1, 2];
        Wrench {
            force: axes.map(|axis| Newton(said.force[axis].0 - self.zero.force[axis].0)),
            torque: axes
                .map(|axis| NewtonMillimetre(said.torque[axis].0 - self.zero.torque[axis].0)),
        }
    }

    /// True if two readings of a resting tip show a working transducer: values differ, or for a transducer with coarse steps, numbers or times
    /// differ.
    pub(super) fn is_live(&self, one: &Look, other: &Look) -> bool {
        match (one.number, other.number) {
            (Some(one), Some(other)) if one == other => false,
            _ if self.limits.signals.equality_is_frozen => one.wrench != other.wrench,
            (Some(_), Some(_)) => true,
            _ => one.wrench_s < other.wrench_s,
        }
    }

    /// Begins to measure the delay of readings.
    pub(super) fn time_readings(&mut self) {
        self.lateness = Some(Lateness::default());
    }

    /// Time from an exceeded limit to a sent halt, in s: with the 99.9th percentile of the ages of readings since
    /// [`time_readings`](Supervisor::time_readings). `None` for fewer than two readings.
    pub(super) fn reaction_s(&mut self) -> Option<f64> {
        self.lateness.take()?.reaction_s()
    }

    /// True if the tip may rest at `depth_mm` under the force `wrench`.
    pub(super) fn lets_rest(&self, depth_mm: f64, wrench: &Wrench) -> bool {
        self.limits.hold(depth_mm, wrench)
    }

    /// Reason why the supervisor halted the robot; `None` without a halt.
    pub fn tripped(&self) -> Option<Trip> {
        self.tripped
    }

    /// True if the last force differs from the force before the last motion, so the signal is not frozen.
    pub fn is_fresh(&self) -> bool {
        self.repeats.count() == 0
    }

    /// Checks an observation. A bad observation halts the robot before the call returns.
    ///
    /// # Errors
    /// The [`Trip`], which is stored until the next [`release`](Supervisor::release).
    pub fn observe(&mut self, observation: &Observation, now_s: f64) -> Result<(), Trip> {
        let trip = self.tripped.or_else(|| match observation {
            Observation::Force(wrench, stamp) => self.force(wrench, stamp, None, now_s),
            Observation::Numbered(wrench, stamp, number) => {
                self.force(wrench, stamp, Some(*number), now_s)
            }
            Observation::UnderWay { pose, stamp } => self.under_way(pose, stamp, now_s),
            Observation::Pose {
                pose,
                stamp,
                target,
            } => self.pose(pose, stamp, target, now_s),
            Observation::Silence => {
                let age_s = now_s - self.heard_s;
                let is_stale = age_s > self.limits.signals.stale_s;
                is_stale.then_some(Trip::StaleForce { age_s })
            }
        });
        match trip {
            None => Ok(()),
            Some(trip) => Err(self.trip(trip)),
        }
    }

    /// Halts the robot for `trip`, and returns the first trip since the last release.
    pub(crate) fn trip(&mut self, trip: Trip) -> Trip {
        self.halt();
        *self.tripped.get_or_insert(trip)
    }

    fn force(
        &mut self,
        wrench: &Wrench,
        stamp: &Stamp,
        number: Option<u64>,
        now_s: f64,
    ) -> Option<Trip> {
        if check_wrench(wrench).is_err() || !stamp.valid_s.is_finite() {
            return Some(Trip::NotFinite);
        }
        let age_s = now_s - stamp.valid_s;
        if let Some(lateness) = &mut self.lateness {
            lateness.add(stamp.valid_s, age_s);
        }
        if age_s > self.limits.signals.stale_s {
            return Some(Trip::StaleForce { age_s });
        }
        if self.stage == MotionStage::Zeroing {
            self.heard_s = stamp.valid_s;
            return None;
        }
        let before = self.last.replace((*wrench, stamp.valid_s));
        self.heard_s = stamp.valid_s;
        let equality_is_frozen = self.limits.signals.equality_is_frozen;
        self.repeats.take(wrench, number, equality_is_frozen);
        let rate = before.and_then(|(last, last_s)| {
            let span_s = stamp.valid_s - last_s;
            let change = (wrench.force[2].0 - last.force[2].0).abs();
            (span_s >= RATE_SPAN_S).then(|| change / span_s)
        });
        self.force_trip(wrench).or(match rate {
            Some(rate_n_s) if rate_n_s > RATE_MAX_N_S => Some(Trip::ForceRate { rate_n_s }),
            _ if self.repeats.count() >= FROZEN_READINGS => Some(Trip::Frozen {
                readings: self.repeats.count(),
            }),
            _ => None,
        })
    }

    fn force_trip(&self, wrench: &Wrench) -> Option<Trip> {
        // Saturation applies to the raw reading, limits of the gel to the zeroed one.
        let greatest = wrench.force.map(|force| force.0.abs());
        let greatest = greatest.into_iter().fold(0.0, f64::max);
        if let Some(saturation) = self.limits.saturation
            && greatest >= saturation.0
        {
            return Some(Trip::Saturated { force_n: greatest });
        }
        let [x, y, z] = self.zeroed(wrench).force.map(|force| force.0);
        let (normal_max, shear_max) = (self.limits.normal_max.0, self.limits.shear_max.0);
        // Computes the root only near the limit; below half of it, the magnitude is at most √2/2 of it.
        let shear = if x.abs().max(y.abs()) > 0.5 * shear_max {
            x.hypot(y)
        } else {
            0.0
        };
        match self.stage {
            MotionStage::Travel { threshold_n } if z.abs() > threshold_n => {
                Some(Trip::UnexpectedContact {
                    force_n: z,
                    is_in_air: true,
                })
            }
            MotionStage::Retreat { force_n } => (z > force_n.max(normal_max) + RETREAT_MARGIN_N)
                .then_some(Trip::UnexpectedContact {
                    force_n: z,
                    is_in_air: false,
                }),
            _ if z.abs() > normal_max => Some(Trip::NormalForce {
                force_n: z,
                limit_n: normal_max,
            }),
            _ if shear > shear_max => Some(Trip::ShearForce {
                force_n: shear,
                limit_n: shear_max,
            }),
            _ => None,
        }
    }

    fn pose(&mut self, pose: &Pose, stamp: &Stamp, target: &Pose, now_s: f64) -> Option<Trip> {
        self.repeats.moved();
        self.place(pose, stamp, now_s).or_else(|| {
            let distance_mm = distance(pose, target);
            (distance_mm > self.diverged_mm()).then_some(Trip::Diverged { distance_mm })
        })
    }

    /// Checks a pose during a motion; `None` for a valid pose. A pose equal to the last one is no evidence of a motion.
    fn under_way(&mut self, pose: &Pose, stamp: &Stamp, now_s: f64) -> Option<Trip> {
        let seen = *self.seen.get_or_insert(*pose);
        if distance(pose, &seen) > MOVED_MM.max(self.limits.signals.slack_mm()) {
            self.seen = Some(*pose);
            self.repeats.moved();
        }
        self.place(pose, stamp, now_s).or_else(|| {
            let [from, to] = self.way.as_ref()?;
            let distance_mm = distance_from_way(pose, from, to);
            (distance_mm > self.diverged_mm()).then_some(Trip::Diverged { distance_mm })
        })
    }

    /// Checks that a pose is finite, fresh and not too deep; `None` for a valid pose.
    fn place(&self, pose: &Pose, stamp: &Stamp, now_s: f64) -> Option<Trip> {
        if check_pose(pose).is_err() || !stamp.valid_s.is_finite() {
            return Some(Trip::NotFinite);
        }
        let age_s = now_s - stamp.valid_s;
        if age_s > self.limits.signals.stale_s {
            return Some(Trip::StalePose { age_s });
        }
        let MotionStage::Press { height_mm } = self.stage else {
            return None;
        };
        let depth_mm = pose.position.z.0 - height_mm;
        let limit_mm = self.limits.depth_max.0;
        // The allowed overshoot includes the noise of the robot at the limit.
        let is_trespass = depth_mm > limit_mm + self.limits.overshoot.healthy_mm;
        is_trespass.then_some(Trip::Depth { depth_mm, limit_mm })
    }

    fn diverged_mm(&self) -> f64 {
        DIVERGED_MM.max(DIVERGED_NOISES * self.limits.signals.pose_noise_mm)
    }
}

#[cfg(test)]
mod tests;
