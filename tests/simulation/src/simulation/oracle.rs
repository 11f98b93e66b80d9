//! The invariants of a run, checked against the truth of the simulated world and not against what the devices report.

use std::fmt;

use taceva_protocol::{RigLimits, SEGMENT_S};

/// A halt must reach the robot within this, in s.
pub const HALT_WITHIN_S: f64 = 0.05;

/// Something that must never happen.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Violation {
    /// Deeper than the limit and the stated overshoot.
    TooDeep {
        /// How deep, in mm below the true first contact.
        depth_mm: f64,
        /// The most that is allowed.
        bound_mm: f64,
    },
    /// More force than the limit and the stated overshoot.
    TooHard {
        /// How hard, in N of true force.
        force_n: f64,
        /// The most that is allowed.
        bound_n: f64,
    },
    /// The halt came too late, or not at all.
    LateHalt {
        /// How late, in s.
        after_s: f64,
        /// What had happened.
        hazard: &'static str,
    },
    /// After an emergency stop was reported, or while nobody held the enabling switch, the robot was asked for this.
    Defied(&'static str),
    /// A press that was acknowledged is gone.
    Lost(String),
    /// A press is recorded twice.
    Doubled(String),
    /// A press was recorded that nobody planned, or one that was not what was planned.
    Invented(String),
    /// A sample does not say what was true.
    Untrue(String),
    /// The study never came to its end.
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
                write!(f, "asked for {asked}, which nobody may")
            }
            Violation::Lost(what) => write!(f, "acknowledged and lost: {what}"),
            Violation::Doubled(what) => write!(f, "recorded twice: {what}"),
            Violation::Invented(what) => write!(f, "recorded and never planned so: {what}"),
            Violation::Untrue(what) => write!(f, "a sample says what was not: {what}"),
            Violation::Unfinished(what) => write!(f, "never finished: {what}"),
        }
    }
}

/// How often each thing that must hold was looked at, so that an oracle that checked nothing is noticed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Checks {
    /// Motions whose depth and force were compared with the limits.
    pub motions: u64,
    /// Halts that followed a hazard.
    pub halts: u64,
    /// The slowest of them, in s, without what a longer segment delays the look at its end.
    pub slowest_halt_s: f64,
    /// The greatest true force, as a part of the greatest that was stated.
    pub greatest_force: f64,
    /// Samples compared with the truth.
    pub samples: u64,
    /// Presses that silence broke off and that were made again in the same process.
    pub redone: u64,
}

impl Checks {
    /// Joins those of another run.
    pub fn join(&mut self, other: &Checks) {
        self.motions += other.motions;
        self.halts += other.halts;
        self.slowest_halt_s = self.slowest_halt_s.max(other.slowest_halt_s);
        self.greatest_force = self.greatest_force.max(other.greatest_force);
        self.samples += other.samples;
        self.redone += other.redone;
    }
}

/// The hazard of a transducer that gives no reading.
pub(super) const SILENCE: &str = "a silent transducer";
/// The hazard of a gel that is pressed too hard.
pub(super) const TOO_HARD: &str = "a force beyond the limit";

/// The hazard of a robot that moves while nobody holds the enabling switch.
pub(super) const UNHELD: &str = "an enabling switch that nobody holds";

/// What the oracle knows of the rig: its limits and the overshoot that is stated for them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stated {
    pub(super) depth_max_mm: f64,
    pub(super) normal_max_n: f64,
    pub(super) healthy_mm: f64,
    pub(super) frozen_mm: f64,
    /// How much later than true contact the first contact is declared, in mm: a step, and the threshold with its noise.
    pub(super) late_contact_mm: f64,
    pub(super) stiffness_n_mm: f64,
    pub(super) noise_n: f64,
    /// How much later than within a segment of [`SEGMENT_S`] a limit is seen that is passed in a longer one, in s.
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

    /// The same for segments at this speed in contact, which noise may have made longer.
    pub(super) fn at_speed(self, speed_mm_s: f64, segment_mm: f64) -> Stated {
        Stated {
            late_look_s: (segment_mm / speed_mm_s - SEGMENT_S).max(0.0),
            ..self
        }
    }
}

/// Noise is uniform within its span, so that none of it is beyond.
const NOISE_SPAN: f64 = 1.0;

/// Where a motion ended.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ended {
    /// How far below the surface where it was touched.
    pub(super) depth_mm: f64,
    /// True force.
    pub(super) force_n: f64,
    /// Whether the gel was more indented at its end.
    pub(super) is_inward: bool,
    /// Whether the last reading before it showed an old force.
    pub(super) is_frozen: bool,
}

/// Watches the world.
#[derive(Clone, Debug)]
pub(super) struct Oracle {
    stated: Stated,
    hazard: Option<(&'static str, f64)>,
    /// Whether the limit of force was passed while the transducer did not show it.
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

    /// A motion ended.
    ///
    /// What is stated is how far the tip goes on beyond a limit, so that it is at the end of a motion inward that it can be passed. From
    /// there the tip comes out step by step, still beyond the limit for a while, which is not a second violation.
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
        if depth_mm > bound_mm {
            self.violations
                .push(Violation::TooDeep { depth_mm, bound_mm });
        }
        if force_n > bound_n {
            self.violations
                .push(Violation::TooHard { force_n, bound_n });
        }
    }

    /// From `since_s` on, which may lie ahead, the robot must be halted.
    pub(super) fn hazard(&mut self, hazard: &'static str, since_s: f64) {
        self.hazard.get_or_insert((hazard, since_s));
    }

    /// Somebody holds the enabling switch, or the robot does not move.
    pub(super) fn is_held(&mut self) {
        self.hazard.take_if(|(hazard, _)| *hazard == UNHELD);
    }

    /// The limit of force was passed while the transducer showed an old force.
    pub(super) fn overlooked(&mut self) {
        self.overlooked = true;
    }

    /// The transducer gives no force or an old one, and no supervisor can react to a force that it does not show. How far the
    /// tip may go meanwhile is bounded all the same, and missing readings are a hazard of their own.
    pub(super) fn blinded(&mut self) {
        let unseen = self.hazard.take_if(|(hazard, _)| *hazard == TOO_HARD);
        self.overlooked |= unseen.is_some();
    }

    /// The transducer gives readings again; a gap shorter than a stale reading is no hazard.
    pub(super) fn heard(&mut self) {
        self.hazard.take_if(|(hazard, _)| *hazard == SILENCE);
    }

    /// The transducer shows the true force of the resting tip. Whether the limit was passed unseen, which must be answered from now on.
    pub(super) fn sighted(&mut self) -> bool {
        std::mem::take(&mut self.overlooked)
    }

    /// A call was refused because of an emergency stop, and `asked` was asked for all the same.
    pub(super) fn defied(&mut self, asked: &'static str) {
        self.violations.push(Violation::Defied(asked));
    }

    /// A halt reached the robot.
    pub(super) fn halted(&mut self, now_s: f64) {
        self.overlooked = false;
        if let Some((hazard, since_s)) = self.hazard.take() {
            let after_s = now_s - since_s;
            self.checks.halts += 1;
            if after_s < 0.0 {
                // Halted before it had to be.
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

    /// Time passed; a hazard that is old and unanswered is a violation.
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

    /// How long after `hazard` the robot must be halted, in s.
    fn within_s(&self, hazard: &str) -> f64 {
        match hazard {
            TOO_HARD => HALT_WITHIN_S + self.stated.late_look_s,
            _ => HALT_WITHIN_S,
        }
    }

    /// The process was killed: nothing can react any more, and the tip rests at the end of its segment.
    pub(super) fn killed(&mut self) {
        self.hazard = None;
        self.overlooked = false;
    }
}
