//! Checks every reading of force and every pose, and halts the robot where one breaks a limit or cannot be trusted. It moves nothing, decides
//! nothing else, and may be shown readings by several threads.
//!
//! It is no safety function: the emergency stop, the collision sensitivity of the robot and the guards are the site's duty.

mod enabling;
mod observation;
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
use reaction::Lateness;
use repeats::Repeats;

/// Farther from where it was sent, or from the way there, the tip has gone astray, in mm.
const DIVERGED_MM: f64 = 0.5;
/// Or farther than so many standard deviations of the reported pose.
const DIVERGED_NOISES: f64 = 5.0;
/// No gel that is pressed at 5 mm/s or less makes force rise faster, in N/s.
const RATE_MAX_N_S: f64 = 200.0;
/// Two readings this near in time have no rate that noise does not make, in s.
const RATE_SPAN_S: f64 = 0.005;
/// While the tip retreats the force may be this much above that of the halt, in N: the noise of a transducer.
const RETREAT_MARGIN_N: f64 = 0.05;
/// Less than this is no motion, in mm: what a robot without noise reports at rest.
const MOVED_MM: f64 = 1e-6;

/// A supervisor that several threads show readings to.
#[derive(Clone)]
pub struct SharedSupervisor(Arc<Mutex<Supervisor>>);

impl SharedSupervisor {
    /// `supervisor`, shared by clones of this.
    pub fn new(supervisor: Supervisor) -> SharedSupervisor {
        SharedSupervisor(Arc::new(Mutex::new(supervisor)))
    }

    /// The supervisor, for one reading or one change of stage. A thread that panicked with it has left it whole: it changes in no step that
    /// can panic.
    pub fn lock(&self) -> MutexGuard<'_, Supervisor> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The supervisor, or `None` while another thread has it: a thread in simulated time cannot wait.
    pub fn try_lock(&self) -> Option<MutexGuard<'_, Supervisor>> {
        match self.0.try_lock() {
            Ok(held) => Some(held),
            Err(TryLockError::Poisoned(poisoned)) => Some(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => None,
        }
    }
}

/// Halts a robot as soon as a reading says so, and holds it halted until somebody asks for another stage.
pub struct Supervisor {
    limits: RigLimits,
    halt: Arc<dyn Halt>,
    stage: MotionStage,
    /// What the transducer says where nothing presses.
    zero: Wrench,
    /// From where to where the tip goes, while it does.
    way: Option<[Pose; 2]>,
    /// The fault that the robot reported to somebody who looked on.
    fault: Option<Fault>,
    /// Where it was seen under way last.
    seen: Option<Pose>,
    /// The last force and when it was true, for its rate.
    last: Option<(Wrench, f64)>,
    /// When the last force or, before one, the watch began.
    heard_s: f64,
    repeats: Repeats,
    tripped: Option<Trip>,
    enabling: Enabling,
    /// How late readings come, while somebody measures that.
    lateness: Option<Lateness>,
}

impl Supervisor {
    /// A supervisor with these limits over the robot that `halt` stops.
    pub fn new(limits: RigLimits, halt: Arc<dyn Halt>) -> Supervisor {
        Supervisor {
            limits,
            halt,
            // Before anybody says what the tip does, nothing is known of its zero.
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
            lateness: None,
        }
    }

    /// Begins to watch `stage` at `now_s`; until then the tip rested, and silence meant nothing. What it halted for stays: the robot is halted
    /// until somebody ends that.
    pub fn watch(&mut self, stage: MotionStage, now_s: f64) {
        self.stage = stage;
        self.heard_s = now_s;
        // In the air the zero of the transducer may have moved: what it said before gives no rate. Readings that repeat are counted on, or
        // a signal that froze in the air would have the tip go on for as long again from each stage to the next. Only a zero of the
        // transducer's own, once a run, begins anew.
        match stage {
            MotionStage::Travel { .. } => self.last = None,
            MotionStage::Zeroing => {
                self.last = None;
                self.repeats.forget();
            }
            _ => {}
        }
    }

    /// The same, once the halt of the robot was ended: what it was halted for is over.
    pub fn release(&mut self, stage: MotionStage, now_s: f64) {
        self.tripped = None;
        self.watch(stage, now_s);
    }

    /// Learns that the tip rests, wherever it is.
    pub fn rests(&mut self) {
        self.way = None;
    }

    /// Whether the tip was sent somewhere and does not rest yet: then silence is a danger.
    pub fn is_under_way(&self) -> bool {
        self.way.is_some()
    }

    /// Halts because the robot reported a fault to somebody who looked on.
    pub fn fail(&mut self, fault: Fault) {
        self.fault = Some(fault);
        self.halt();
    }

    /// The fault that the robot reported.
    pub fn fault(&self) -> Option<Fault> {
        self.fault
    }

    /// Forgets a fault that a person acknowledged at the robot.
    pub fn acknowledge(&mut self) {
        self.fault = None;
    }

    /// Halts because a reading was clipped: how great the force is, nobody knows.
    pub fn saturated(&mut self) -> Trip {
        let force_n = f64::INFINITY;
        self.trip(Trip::Saturated { force_n })
    }

    /// Halts for a reason that is no reading, such as a wish to stop.
    pub fn halt(&mut self) {
        // Halting twice is halting once; a link that is gone leaves nothing else to be said.
        let _ = self.halt.halt();
    }

    /// Takes `zero` off every later force before it is compared with a limit of the gel.
    pub fn call_zero(&mut self, zero: Wrench) {
        self.zero = zero;
    }

    /// What is taken off every force.
    pub(super) fn zero(&self) -> Wrench {
        self.zero
    }

    /// What presses on the gel by what the transducer said.
    pub fn zeroed(&self, said: &Wrench) -> Wrench {
        let axes = [0, 1, 2];
        Wrench {
            force: axes.map(|axis| Newton(said.force[axis].0 - self.zero.force[axis].0)),
            torque: axes
                .map(|axis| NewtonMillimetre(said.torque[axis].0 - self.zero.torque[axis].0)),
        }
    }

    /// Whether two looks at a tip that rests differ as those at a live transducer do.
    pub(super) fn is_live(&self, one: &Look, other: &Look) -> bool {
        match (one.number, other.number) {
            (Some(one), Some(other)) if one == other => false,
            _ if self.limits.signals.equality_is_frozen => one.wrench != other.wrench,
            (Some(_), Some(_)) => true,
            _ => one.wrench_s < other.wrench_s,
        }
    }

    /// Begins to measure how late readings come.
    pub(super) fn time_readings(&mut self) {
        self.lateness = Some(Lateness::default());
    }

    /// From a limit that is passed to a halt that is sent, in s, by the readings since
    /// [`time_readings`](Supervisor::time_readings): 999 of 1,000 come sooner. `None` of fewer than two readings.
    pub(super) fn reaction_s(&mut self) -> Option<f64> {
        self.lateness.take()?.reaction_s()
    }

    /// Whether the tip may rest at this depth under this force.
    pub(super) fn lets_rest(&self, depth_mm: f64, wrench: &Wrench) -> bool {
        self.limits.hold(depth_mm, wrench)
    }

    /// What it halted for, if it did.
    pub fn tripped(&self) -> Option<Trip> {
        self.tripped
    }

    /// Whether the last reading of force differs from that before the last motion: at rest, only such a reading is news.
    pub fn is_fresh(&self) -> bool {
        self.repeats.count() == 0
    }

    /// Takes a reading; if it must not go on, the robot is halted before this returns.
    ///
    /// # Errors
    /// The [`Trip`], which holds until the next [`release`](Supervisor::release).
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

    /// Halts for a reason that only the driver knew, such as a clipped reading.
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
        // What the transducer can measure is a matter of what it says; what the gel bears, of what presses on it.
        let greatest = wrench.force.map(|force| force.0.abs());
        let greatest = greatest.into_iter().fold(0.0, f64::max);
        if let Some(saturation) = self.limits.saturation
            && greatest >= saturation.0
        {
            return Some(Trip::Saturated { force_n: greatest });
        }
        let [x, y, z] = self.zeroed(wrench).force.map(|force| force.0);
        let (normal_max, shear_max) = (self.limits.normal_max.0, self.limits.shear_max.0);
        // A root is taken where it can matter: √2/2 of the limit is within it.
        let shear = if x.abs().max(y.abs()) > 0.5 * shear_max {
            x.hypot(y)
        } else {
            0.0
        };
        match self.stage {
            MotionStage::Travel { threshold_n } if z.abs() > threshold_n => {
                Some(Trip::UnexpectedContact { force_n: z })
            }
            MotionStage::Retreat { force_n } => (z > force_n.max(normal_max) + RETREAT_MARGIN_N)
                .then_some(Trip::UnexpectedContact { force_n: z }),
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

    /// A tip that moves is on its way; one that rests under a watch of its own is no news for its force.
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

    /// Whether a pose is a place, is news, and is not too deep.
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
        // A tip that reaches the limit itself does what it was allowed; the robot's own noise is not a trespass.
        let is_trespass = depth_mm > limit_mm + self.limits.overshoot.healthy_mm;
        is_trespass.then_some(Trip::Depth { depth_mm, limit_mm })
    }

    fn diverged_mm(&self) -> f64 {
        DIVERGED_MM.max(DIVERGED_NOISES * self.limits.signals.pose_noise_mm)
    }
}

#[cfg(test)]
mod tests;
