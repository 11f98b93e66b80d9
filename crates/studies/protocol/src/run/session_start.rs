//! Start of a session on the rig of a rig file. The operator enables the robot. The tip moves through the air and touches the gel gently. Presses begin only if
//! the measurements agree with the rig file and earlier sessions.

pub(super) mod picture;
mod signs;
mod touch;

use std::time::Duration;

use taceva_core::{Degree, Nanometre, Speed};

use super::clearance::enable;
use super::error::{Left, RunError, StopCause};
use super::log::PressLog;
use super::operator::{Answer, Operator, Question};
use super::reference_touch::{SessionRecord, SessionSpec};
use super::session::{Run, WHOLE};
use super::tip::Step;
use crate::limits::RigLimits;
use crate::plan::PlannedPress;

/// Time in which the delay of readings is measured.
const TIMED: Duration = Duration::from_secs(2);
/// Greatest overshoot that the delay of the guard may cause, as a share of the allowed depth.
const OVERSHOOT_PART: f64 = 0.3;
/// Speed of the first motion through the air, in mm/s.
const AIR_MM_S: f64 = 10.0;
/// Number of interruptions by stale signals after which the start of the session fails.
const TRIES: u32 = 3;

/// Measured reaction time of the guard on this machine, and the overshoot that it causes.
#[derive(Clone, Copy, Debug)]
struct Reaction {
    reaction_ms: f64,
    overshoot_mm: f64,
}

impl Run<'_> {
    /// Asks the operator to enable the robot before its first motions, which the text `way` describes.
    pub(super) fn enable(&mut self, way: String) -> Result<(), RunError> {
        let robot = self.session.as_ref().and_then(|session| session.robot);
        let Some(robot) = robot else {
            return Ok(());
        };
        let operator: Option<&mut dyn Operator> = match &mut self.operator {
            Some(operator) => Some(&mut **operator),
            None => None,
        };
        let supervisor = &self.tip.supervisor;
        supervisor.during_question(|| enable(robot, way, operator, self.tip.cancel))
    }

    /// Begins the session. Called once, before the press `first` and with the specimen of this press mounted.
    pub(super) fn begin(
        &mut self,
        places: &[[Nanometre; 2]],
        first: &PlannedPress,
        log: &mut dyn PressLog,
    ) -> Result<(), RunError> {
        let Some(session) = self.session.take() else {
            return Ok(());
        };
        let mut silences = 0;
        loop {
            self.hold(None)?;
            let cause = match self.try_to_begin(&session, places, first) {
                Ok(record) => {
                    self.is_shear_known = record.pushes_felt == [true; 2];
                    return log.session(&record).map_err(|error| RunError {
                        press: None,
                        cause: StopCause::Log(error),
                        left: Left::Clear,
                    });
                }
                Err(cause) => cause,
            };
            let weight = self.weight(&cause);
            // Only emulated devices get a second measurement of a slow guard.
            let is_silence = cause.is_silence() || weight < WHOLE;
            let is_release = cause.is_release();
            silences += if is_silence { weight } else { 0 };
            let error = self.abandoned(None, cause);
            let may_try = is_release || is_silence && silences < TRIES * WHOLE;
            if !may_try || error.left != Left::Clear {
                return Err(error);
            }
        }
    }

    fn try_to_begin(
        &mut self,
        session: &SessionSpec<'_>,
        places: &[[Nanometre; 2]],
        first: &PlannedPress,
    ) -> Step<SessionRecord> {
        let reaction = self.time_readings()?;
        self.pass_through_the_air(places)?;
        let record = self.touch_gently(session, first, reaction)?;
        let earlier = session.touched.iter().rev().find(|earlier| {
            earlier.unit == record.touch.unit && earlier.specimen == record.touch.specimen
        });
        if let Some(operator) = &mut self.operator {
            operator.note(&record.touch.line(earlier));
        }
        if let Some(changed) = earlier.and_then(|earlier| record.touch.changed_since(earlier)) {
            let question = Question::Resume(changed);
            if self.operator.is_none() {
                let needed = format!("a person to answer this: {question}");
                return Err(StopCause::Missing(needed));
            }
            match self.ask(&question)? {
                Answer::Done => {}
                Answer::Skip | Answer::Stop => return Err(StopCause::Cancelled),
            }
        }
        Ok(record)
    }

    /// Measures the delay of readings on this machine. Rejects a machine whose delay causes too great an overshoot.
    fn time_readings(&mut self) -> Step<Reaction> {
        let supervisor = self.tip.supervisor.clone();
        supervisor.lock().time_readings();
        let until_s = self.tip.clock.now_s() + TIMED.as_secs_f64();
        while self.tip.clock.now_s() < until_s {
            // Guard threads read meanwhile; this reading checks that they still run.
            self.tip.look()?;
            if self.tip.cancel.is_cancelled() {
                return Err(StopCause::Cancelled);
            }
        }
        let reaction_s = supervisor.lock().reaction_s();
        let limits = self.plan.limits.as_ref();
        let (Some(reaction_s), Some(limits)) = (reaction_s, limits) else {
            let nothing = "force readings and limits";
            return Err(StopCause::Missing(nothing.to_owned()));
        };
        allowed(reaction_s, limits, self.plan.contact.speed_mm_s.value)
    }

    /// Moves slowly over three of `places`, to show the operator the workspace of the robot.
    fn pass_through_the_air(&mut self, places: &[[Nanometre; 2]]) -> Step<()> {
        let usual = self.tip.pace;
        self.tip.pace.travel = slowly(usual.travel);
        let height_mm = -usual.clearance_mm;
        let passed = farthest(places).into_iter().try_for_each(|place| {
            let place = place.map(Nanometre::to_millimetres);
            self.tip.travel(place, Degree(0.0), height_mm)
        });
        self.tip.pace = usual;
        passed
    }
}

/// The speed `travel`, limited so that the operator can follow the robot with a hand at the emergency stop.
fn slowly(travel: Speed) -> Speed {
    match Speed::try_new(AIR_MM_S) {
        Ok(slow) if slow.mm_per_s() < travel.mm_per_s() => slow,
        _ => travel,
    }
}

/// Accepts a guard that halts `reaction_s` after an exceeded limit, if its overshoot is small enough.
fn allowed(reaction_s: f64, limits: &RigLimits, speed_mm_s: f64) -> Step<Reaction> {
    let overshoot_mm = speed_mm_s * reaction_s + limits.braking_mm();
    let greatest_mm = OVERSHOOT_PART * limits.depth_max.0;
    let reaction_ms = reaction_s * 1e3;
    if overshoot_mm <= greatest_mm {
        return Ok(Reaction {
            reaction_ms,
            overshoot_mm,
        });
    }
    Err(StopCause::SlowGuard {
        reaction_ms,
        overshoot_mm,
        greatest_mm,
        speed_mm_s: speed_mm_s * greatest_mm / overshoot_mm,
    })
}

/// Up to three distant places: the places of least and greatest x, and the place farthest from both.
fn farthest(places: &[[Nanometre; 2]]) -> Vec<[Nanometre; 2]> {
    let (Some(first), Some(last)) = (places.iter().min(), places.iter().max()) else {
        return Vec::new();
    };
    let distance_mm = |one: &[Nanometre; 2], other: &[Nanometre; 2]| {
        let side = |axis: usize| (one[axis].to_millimetres() - other[axis].to_millimetres()).abs();
        side(0).hypot(side(1))
    };
    let apart = |place: &[Nanometre; 2]| distance_mm(place, first).min(distance_mm(place, last));
    let third = places
        .iter()
        .max_by(|one, other| apart(one).total_cmp(&apart(other)))
        .expect("there is a first");
    let mut farthest = vec![*first, *third, *last];
    farthest.dedup();
    farthest
}

#[cfg(test)]
mod tests;
