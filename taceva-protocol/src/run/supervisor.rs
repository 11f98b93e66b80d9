//! Watches every reading and knows one word: halt. It moves nothing, decides nothing else, and can be fed from a thread of its own.
//!
//! It is no safety function: the emergency stop, the collision sensitivity of the robot and the guards are the site's duty.

use std::sync::Arc;

use taceva_core::{Halt, Pose, Stamp, Wrench, check_pose, check_wrench};

use super::trip::Trip;
use crate::limits::{FROZEN_READINGS, RigLimits};

/// A reading older than this says nothing about now, in s: three periods of a transducer of 60 Hz.
pub(crate) const STALE_S: f64 = 0.05;
/// Farther from its target the tip is not where it was sent, in mm.
const DIVERGED_MM: f64 = 0.5;
/// No gel that is pressed at 5 mm/s or less makes force rise faster, in N/s.
const RATE_MAX_N_S: f64 = 200.0;
/// Two readings this near in time have no rate that noise does not make, in s.
const RATE_SPAN_S: f64 = 0.005;
/// While the tip retreats the force may be this much above that of the halt, in N: the noise of a transducer.
const RETREAT_MARGIN_N: f64 = 0.05;

/// A reading that the supervisor checks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Observation {
    /// The force transducer said this.
    Force(Wrench, Stamp),
    /// The robot said this, after it was sent to `target`.
    Pose {
        /// Where it is.
        pose: Pose,
        /// When that was true.
        stamp: Stamp,
        /// Where it should be.
        target: Pose,
    },
    /// No reading; time passed.
    Silence,
}

/// In which part of a press the tip is: what is allowed depends on it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MotionStage {
    /// In the air: force above `threshold_n` is a collision.
    Travel {
        /// The force that counts as contact.
        threshold_n: f64,
    },
    /// On the way to the first contact.
    Search,
    /// In contact since the tip was at `height_mm`.
    Press {
        /// The height of the first contact in the sensor's frame.
        height_mm: f64,
    },
    /// On the way back, where the force must not rise above `force_n`.
    Retreat {
        /// The force at which the retreat began.
        force_n: f64,
    },
}

/// Halts a robot as soon as a reading says so, and holds it halted until somebody asks for another stage.
pub struct Supervisor {
    limits: RigLimits,
    halt: Arc<dyn Halt>,
    stage: MotionStage,
    last: Option<(Wrench, f64)>,
    /// When the last force or, before one, the watch began.
    heard_s: f64,
    equal: u32,
    moved: bool,
    tripped: Option<Trip>,
}

impl Supervisor {
    /// A supervisor with these limits over the robot that `halt` stops.
    pub fn new(limits: RigLimits, halt: Arc<dyn Halt>) -> Supervisor {
        Supervisor {
            limits,
            halt,
            stage: MotionStage::Search,
            last: None,
            heard_s: f64::NEG_INFINITY,
            equal: 0,
            moved: false,
            tripped: None,
        }
    }

    /// Begins to watch `stage` at `now_s`; until then the tip rested, and silence meant nothing. A halt is forgotten.
    pub fn watch(&mut self, stage: MotionStage, now_s: f64) {
        self.stage = stage;
        self.heard_s = now_s;
        self.tripped = None;
        // In the air the zero of the transducer may have moved; from the search on a frozen signal must not slip through.
        if let MotionStage::Travel { .. } = stage {
            self.last = None;
            self.equal = 0;
        }
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
        self.equal == 0
    }

    /// Takes a reading; if it must not go on, the robot is halted before this returns.
    ///
    /// # Errors
    /// The [`Trip`], which holds until the next [`watch`](Supervisor::watch).
    pub fn observe(&mut self, observation: &Observation, now_s: f64) -> Result<(), Trip> {
        let trip = self.tripped.or_else(|| match observation {
            Observation::Force(wrench, stamp) => self.force(wrench, stamp, now_s),
            Observation::Pose {
                pose,
                stamp,
                target,
            } => self.pose(pose, stamp, target, now_s),
            Observation::Silence => {
                let age_s = now_s - self.heard_s;
                (age_s > STALE_S).then_some(Trip::StaleForce { age_s })
            }
        });
        match trip {
            None => Ok(()),
            Some(trip) => Err(self.trip(trip)),
        }
    }

    /// Halts for a reason that only the driver knew, such as a clipped reading.
    pub(crate) fn trip(&mut self, trip: Trip) -> Trip {
        // Halting twice is halting once; a link that is gone leaves nothing else to be said.
        let _ = self.halt.halt();
        *self.tripped.get_or_insert(trip)
    }

    fn force(&mut self, wrench: &Wrench, stamp: &Stamp, now_s: f64) -> Option<Trip> {
        if check_wrench(wrench).is_err() || !stamp.valid_s.is_finite() {
            return Some(Trip::NotFinite);
        }
        let age_s = now_s - stamp.valid_s;
        if age_s > STALE_S {
            return Some(Trip::StaleForce { age_s });
        }
        let before = self.last.replace((*wrench, stamp.valid_s));
        self.heard_s = stamp.valid_s;
        // A signal counts as frozen only against motion: at rest, equal readings are news from a quiet gel.
        let is_equal = before.is_some_and(|(last, _)| last == *wrench);
        self.equal = match (is_equal, std::mem::take(&mut self.moved)) {
            (true, true) => self.equal + 1,
            (true, false) => self.equal,
            (false, _) => 0,
        };
        let rate = before.and_then(|(last, last_s)| {
            let span_s = stamp.valid_s - last_s;
            let change = (wrench.force[2].0 - last.force[2].0).abs();
            (span_s >= RATE_SPAN_S).then(|| change / span_s)
        });
        self.force_trip(wrench).or(match rate {
            Some(rate_n_s) if rate_n_s > RATE_MAX_N_S => Some(Trip::ForceRate { rate_n_s }),
            _ if self.equal >= FROZEN_READINGS => Some(Trip::Frozen {
                readings: self.equal,
            }),
            _ => None,
        })
    }

    fn force_trip(&self, wrench: &Wrench) -> Option<Trip> {
        let [x, y, z] = wrench.force.map(|force| force.0);
        let greatest = x.abs().max(y.abs()).max(z.abs());
        if let Some(saturation) = self.limits.saturation
            && greatest >= saturation.0
        {
            return Some(Trip::Saturated { force_n: greatest });
        }
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
        self.moved = true;
        if check_pose(pose).is_err() || !stamp.valid_s.is_finite() {
            return Some(Trip::NotFinite);
        }
        let age_s = now_s - stamp.valid_s;
        if age_s > STALE_S {
            return Some(Trip::StalePose { age_s });
        }
        if let MotionStage::Press { height_mm } = self.stage {
            let depth_mm = pose.position.z.0 - height_mm;
            let limit_mm = self.limits.depth_max.0;
            // A tip that reaches the limit itself does what it was allowed; the robot's own noise is not a trespass.
            if depth_mm > limit_mm + self.limits.overshoot.healthy_mm {
                return Some(Trip::Depth { depth_mm, limit_mm });
            }
        }
        let distance_mm = distance(pose, target);
        (distance_mm > DIVERGED_MM).then_some(Trip::Diverged { distance_mm })
    }
}

/// How far two tips are apart, in mm.
pub(crate) fn distance(one: &Pose, other: &Pose) -> f64 {
    let (one, other) = (&one.position, &other.position);
    let [x, y] = [one.x.0 - other.x.0, one.y.0 - other.y.0];
    let z = one.z.0 - other.z.0;
    // Most ways are straight down: then nothing is left of the roots.
    if x == 0.0 && y == 0.0 {
        return z.abs();
    }
    x.hypot(y).hypot(z)
}

#[cfg(test)]
mod tests;
