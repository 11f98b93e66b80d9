//! Invariants of a run, checked against the true state of the simulated world instead of device reports.

use std::fmt;

use taceva_protocol::{RigLimits, SEGMENT_S};

/// Longest allowed time from a hazard until a halt reaches the robot, s.
pub const HALT_WITHIN_S: f64 = 0.05;

/// Violation of an invariant.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Violation {
    /// The depth exceeds the limit by more than the stated overshoot.
    TooDeep {
        /// Depth, mm below the true first contact.
        depth_mm: f64,
        /// Largest allowed depth, mm.
        bound_mm: f64,
    },
    /// The force exceeds the limit by more than the stated overshoot.
    TooHard {
        /// True force, N.
        force_n: f64,
        /// Largest allowed force, N.
        bound_n: f64,
    },
    /// The halt was late or missing.
    LateHalt {
        /// Delay since the hazard, s.
        after_s: f64,
        /// Hazard that required the halt.
        hazard: &'static str,
    },
    /// The robot received this forbidden request: after a reported emergency stop, or while nobody held the enabling switch.
    Defied(&'static str),
    /// An acknowledged press is missing.
    Lost(String),
    /// A press is recorded twice.
    Doubled(String),
    /// A recorded press was not planned, or differs from the plan.
    Invented(String),
    /// A sample differs from the truth.
    Untrue(String),
    /// The study did not finish.
    Unfinished(String),
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Violation::TooDeep { depth_mm, bound_mm } => {
                write!(
                    f,
                    "pressed {depth_mm:.4} mm deep, at most {bound_mm:.4} mm was stated"
                )
            }
            Violation::TooHard { force_n, bound_n } => {
                write!(
                    f,
                    "pressed with {force_n:.4} N, at most {bound_n:.4} N was stated"
                )
            }
            Violation::LateHalt { after_s, hazard } => {
                write!(f, "no halt within {:.1} ms of {hazard}", after_s * 1e3)
            }
            Violation::Defied(asked) => {
                write!(f, "forbidden request: {asked}")
            }
            Violation::Lost(what) => write!(f, "acknowledged but missing: {what}"),
            Violation::Doubled(what) => write!(f, "recorded twice: {what}"),
            Violation::Invented(what) => write!(f, "recorded but not planned: {what}"),
            Violation::Untrue(what) => write!(f, "a sample differs from the truth: {what}"),
            Violation::Unfinished(what) => write!(f, "never finished: {what}"),
        }
    }
}

/// Number of checks of each invariant, and extreme values. A count of 0 means that the oracle checked nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Checks {
    /// Number of motions whose depth and force were compared with the limits.
    pub motions: u64,
    /// Number of halts that followed a hazard.
    pub halts: u64,
    /// Longest delay of a halt, s. The extra delay that long segments cause is subtracted.
    pub slowest_halt_s: f64,
    /// Greatest ratio of the true force to the allowed force.
    pub greatest_force: f64,
    /// Greatest true depth, mm.
    pub greatest_depth_mm: f64,
    /// Number of samples compared with the truth.
    pub samples: u64,
    /// Number of presses that a silent transducer interrupted and that the same process repeated.
    pub redone: u64,
}

impl Checks {
    /// Adds the checks of another run.
    pub fn join(&mut self, other: &Checks) {
        self.motions += other.motions;
        self.halts += other.halts;
        self.slowest_halt_s = self.slowest_halt_s.max(other.slowest_halt_s);
        self.greatest_force = self.greatest_force.max(other.greatest_force);
        self.greatest_depth_mm = self.greatest_depth_mm.max(other.greatest_depth_mm);
        self.samples += other.samples;
        self.redone += other.redone;
    }
}

/// Hazard: a transducer without readings.
pub(super) const SILENCE: &str = "a silent transducer";
/// Hazard: a force beyond the limit.
pub(super) const TOO_HARD: &str = "a force beyond the limit";

/// Hazard: a robot that moves while nobody holds the enabling switch.
pub(super) const UNHELD: &str = "an enabling switch that nobody holds";

/// Limits of the rig, and the overshoot beyond these limits that the plan states.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stated {
    pub(super) depth_max_mm: f64,
    pub(super) normal_max_n: f64,
    pub(super) healthy_mm: f64,
    pub(super) frozen_mm: f64,
    /// Depth of the true contact when the run detects contact, mm: one search step, and the indentation at the threshold force with noise.
    pub(super) late_contact_mm: f64,
    pub(super) stiffness_n_mm: f64,
    pub(super) noise_n: f64,
    /// Extra time until an exceeded limit is detected, s, because a segment of motion takes longer than [`SEGMENT_S`].
    pub(super) late_look_s: f64,
}

impl Stated {
    pub(super) fn new(
        limits: &RigLimits,
        stiffness_n_mm: f64,
        noise_n: f64,
        step_mm: f64,
        threshold_n: f64,
    ) -> Stated {
        Stated {
            depth_max_mm: limits.depth_max.0,
            normal_max_n: limits.normal_max.0,
            healthy_mm: limits.overshoot.healthy_mm,
            frozen_mm: limits.overshoot.frozen_mm,
            late_contact_mm: step_mm + (threshold_n + NOISE_SPAN * noise_n) / stiffness_n_mm,
            stiffness_n_mm,
            noise_n,
            late_look_s: 0.0,
        }
    }

    /// Returns the same limits for motions in contact, in segments of `segment_mm` at `speed_mm_s`. A long segment delays the detection of an
    /// exceeded limit.
    pub(super) fn at_speed(self, speed_mm_s: f64, segment_mm: f64) -> Stated {
        Stated {
            late_look_s: (segment_mm / speed_mm_s - SEGMENT_S).max(0.0),
            ..self
        }
    }
}

/// Greatest noise, as a multiple of half its range. Uniform noise never exceeds half its range.
const NOISE_SPAN: f64 = 1.0;

/// State at the end of a motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ended {
    /// Depth below the surface at the contact, mm.
    pub(super) depth_mm: f64,
    /// True force, N.
    pub(super) force_n: f64,
    /// True if the indentation grew during the motion.
    pub(super) is_inward: bool,
    /// True if the last force reading before the end repeated an old force.
    pub(super) is_frozen: bool,
}

/// Observer of the simulated world that checks the invariants.
#[derive(Clone, Debug)]
pub(super) struct Oracle {
    stated: Stated,
    hazard: Option<(&'static str, f64)>,
    /// True if the true force exceeded the limit while the readings were old or missing.
    overlooked: bool,
    pub(super) violations: Vec<Violation>,
    pub(super) checks: Checks,
}

impl Oracle {
    pub(super) fn new(stated: Stated) -> Oracle {
        Oracle {
            stated,
            hazard: None,
            overlooked: false,
            violations: Vec::new(),
            checks: Checks::default(),
        }
    }

    /// Checks the end of a motion.
    ///
    /// Depth and force are compared with the limits plus the stated overshoot. Only an inward motion is checked. A tip that retreats may still be
    /// beyond a limit, which is not a second violation.
    pub(super) fn moved(&mut self, ended: Ended) {
        let Ended {
            depth_mm, force_n, ..
        } = ended;
        let stated = &self.stated;
        let overshoot_mm = if ended.is_frozen {
            stated.frozen_mm
        } else {
            stated.healthy_mm
        };
        let bound_mm = stated.depth_max_mm + stated.late_contact_mm + overshoot_mm;
        let bound_n = stated.normal_max_n
            + NOISE_SPAN * stated.noise_n
            + stated.stiffness_n_mm * overshoot_mm;
        if !ended.is_inward {
            return;
        }
        self.checks.motions += 1;
        self.checks.greatest_force = self.checks.greatest_force.max(force_n / bound_n);
        self.checks.greatest_depth_mm = self.checks.greatest_depth_mm.max(depth_mm);
        if depth_mm > bound_mm {
            self.violations
                .push(Violation::TooDeep { depth_mm, bound_mm });
        }
        if force_n > bound_n {
            self.violations
                .push(Violation::TooHard { force_n, bound_n });
        }
    }

    /// Requires a halt of the robot from `since_s` on, which may be in the future.
    pub(super) fn hazard(&mut self, hazard: &'static str, since_s: f64) {
        self.hazard.get_or_insert((hazard, since_s));
    }

    /// Ends the hazard of an unheld enabling switch, because the switch is held or the robot does not move.
    pub(super) fn is_held(&mut self) {
        self.hazard.take_if(|(hazard, _)| *hazard == UNHELD);
    }

    /// Records that the true force exceeded the limit while the transducer repeated an old force.
    pub(super) fn overlooked(&mut self) {
        self.overlooked = true;
    }

    /// Records that the transducer gives no force or an old force. An exceeded force limit is then no hazard, because no supervisor can see it.
    pub(super) fn blinded(&mut self) {
        let unseen = self.hazard.take_if(|(hazard, _)| *hazard == TOO_HARD);
        self.overlooked |= unseen.is_some();
    }

    /// Records that readings have returned. A gap shorter than the age of a stale reading is not a hazard.
    pub(super) fn heard(&mut self) {
        self.hazard.take_if(|(hazard, _)| *hazard == SILENCE);
    }

    /// Records that the transducer shows the true force of the resting tip. Returns true if the force limit was exceeded unseen before; a halt is
    /// then required.
    pub(super) fn sighted(&mut self) -> bool {
        std::mem::take(&mut self.overlooked)
    }

    /// Records the forbidden request `asked` as a violation.
    pub(super) fn defied(&mut self, asked: &'static str) {
        self.violations.push(Violation::Defied(asked));
    }

    /// Records that a halt reached the robot.
    pub(super) fn halted(&mut self, now_s: f64) {
        self.overlooked = false;
        if let Some((hazard, since_s)) = self.hazard.take() {
            let after_s = now_s - since_s;
            self.checks.halts += 1;
            if after_s < 0.0 {
                // The halt came before it was required.
                return;
            }
            let within_s = self.within_s(hazard);
            let answered_s = after_s - (within_s - HALT_WITHIN_S);
            self.checks.slowest_halt_s = self.checks.slowest_halt_s.max(answered_s);
            if after_s > within_s {
                self.violations
                    .push(Violation::LateHalt { after_s, hazard });
            }
        }
    }

    /// Advances time to `now_s`. A hazard that has lacked a halt for too long becomes a violation.
    pub(super) fn passed(&mut self, now_s: f64) {
        if let Some((hazard, since_s)) = self.hazard
            && now_s - since_s > self.within_s(hazard)
        {
            self.hazard = None;
            let after_s = now_s - since_s;
            self.violations
                .push(Violation::LateHalt { after_s, hazard });
        }
    }

    /// Longest time from `hazard` to the halt, s.
    fn within_s(&self, hazard: &str) -> f64 {
        match hazard {
            TOO_HARD => HALT_WITHIN_S + self.stated.late_look_s,
            _ => HALT_WITHIN_S,
        }
    }

    /// Ends all hazards, because the process was killed and cannot react. The tip rests at the end of its segment.
    pub(super) fn killed(&mut self) {
        self.hazard = None;
        self.overlooked = false;
    }
}
