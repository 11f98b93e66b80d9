//! What hands do at a real rig beside the presses of one unit, and whether a scene needs them.

use std::sync::PoisonError;

use taceva_drivers::Drivers;
use taceva_protocol::{Answer, Cancel, Left, Plan, Question, RigFile, RunError, StopCause};

use super::devices::OpenRig;
use super::workshop::Workshop;
use crate::error::StudyError;
use crate::scene::{PlannedScene, PlannedStudy, RigSpec, StudySource};

/// What is changed by hand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Changes {
    specimens: usize,
    lights: usize,
    units: usize,
}

impl Changes {
    /// Of a plan: units come one after the other, and specimens within a unit. What is mounted at the beginning and stays is no change.
    fn of(plan: &Plan, is_lit_by_hand: bool) -> Changes {
        let (mut specimens, mut lights) = (0, 0);
        for unit in &plan.units {
            let presses = plan.presses.iter().map(|planned| &planned.press);
            let of_unit = presses.filter(|press| press.unit == *unit);
            let mut mounted: Vec<_> = of_unit.clone().map(|press| press.specimen).collect();
            mounted.dedup();
            if mounted.len() > 1 {
                specimens += mounted.len();
            }
            if is_lit_by_hand {
                let mut lit: Vec<_> = of_unit.filter_map(|press| press.light.as_ref()).collect();
                lit.dedup();
                lights += lit.len();
            }
        }
        let units = match plan.units.len() {
            0 | 1 => 0,
            units => units,
        };
        Changes {
            specimens,
            lights,
            units,
        }
    }
}

impl PlannedScene {
    /// Refuses a scene on a real rig that needs hands: for whoever cannot ask anybody, before anything is opened.
    ///
    /// # Errors
    /// [`StudyError::Request`], with how many changes there are.
    pub fn check_unattended(&self, drivers: &Drivers) -> Result<(), StudyError> {
        let real = self.studies.iter().filter(|study| match &study.source {
            StudySource::Rig(rig) => !rig.is_simulated(drivers),
            StudySource::Recording(_) => false,
        });
        for study in real {
            let mut needed = study.by_hand(drivers);
            let rig = study.rig().filter(|rig| !rig.simulated);
            if let Some(robot) = rig.and_then(|rig| rig.robot.as_ref()) {
                let robot = taceva_core::shown(&robot.driver.value);
                needed.insert(0, format!("somebody lets `{robot}` move"));
            }
            if !needed.is_empty() {
                return Err(StudyError::Request(format!(
                    "study `{}`: this rig needs a person: {}; run it from a terminal, or with a page, where somebody can be asked",
                    taceva_core::shown(&study.plan.name),
                    needed.join(", ")
                )));
            }
        }
        Ok(())
    }
}

impl PlannedStudy {
    /// What hands change on a real rig, with how often; nothing where nothing is changed.
    pub fn by_hand(&self, drivers: &Drivers) -> Vec<String> {
        let Changes {
            specimens,
            lights,
            units,
        } = Changes::of(&self.plan, self.is_lit_by_hand(drivers));
        let counted = [
            (specimens, "specimens"),
            (lights, "lights"),
            (units, "units of the sensor"),
        ];
        let needed = counted.into_iter().filter(|(count, _)| *count > 0);
        let needed = needed.map(|(count, what)| format!("{count} {what} are changed by hand"));
        needed.collect()
    }

    /// Whether no device of the rig sets its light: neither one for that, nor the sensor.
    fn is_lit_by_hand(&self, drivers: &Drivers) -> bool {
        let StudySource::Rig(rig) = &self.source else {
            return false;
        };
        rig.info(&self.study, drivers).is_ok_and(|info| {
            let own = info.sensor.as_ref().and_then(|sensor| sensor.sensor());
            info.lighting.is_none() && own.is_none_or(|own| own.scenes.is_empty())
        })
    }

    /// The rig file that it is carried out on, if one names its devices.
    pub fn rig(&self) -> Option<&RigFile> {
        self.study.rig.as_deref()
    }
}

/// Whether `unit` is under the robot: of several units of a real rig somebody says so, or skips it.
///
/// The tip is brought up before somebody is asked, for which the robot may have to be enabled, and no device is open while hands are in.
pub(super) fn unit_is_there(
    study: &PlannedStudy,
    rig: &RigSpec,
    unit: &str,
    (workshop, cancel, is_enabled): (Workshop<'_>, &Cancel, &mut bool),
) -> Result<bool, StudyError> {
    let plan = &study.plan;
    if plan.units.len() < 2 || rig.is_simulated(workshop.drivers) {
        return Ok(true);
    }
    let question = Question::Unit(unit.to_owned());
    let Some(operator) = workshop.operator else {
        return Err(acquisition(
            plan,
            StopCause::Missing(format!("somebody to {question}")),
        ));
    };
    let mut open = OpenRig::open(study, &rig.without_sensor(), unit, workshop)?;
    let raised = open.raise(plan, (cancel, workshop, *is_enabled));
    drop(open);
    *is_enabled |= raised.map_err(|source| stopped(plan, source))?;
    let mut operator = operator.lock().unwrap_or_else(PoisonError::into_inner);
    match operator.ask(&question, cancel) {
        Answer::Done => Ok(true),
        Answer::Skip => Ok(false),
        Answer::Stop => Err(acquisition(plan, StopCause::Cancelled)),
    }
}

/// A rig that stopped where nothing was in the gel.
pub(super) fn acquisition(plan: &Plan, cause: StopCause) -> StudyError {
    let error = RunError {
        press: None,
        cause,
        left: Left::Clear,
    };
    stopped(plan, error)
}

/// A run of `plan` that stopped.
pub(super) fn stopped(plan: &Plan, error: RunError) -> StudyError {
    StudyError::Acquisition {
        study: plan.name.clone(),
        source: Box::new(error),
    }
}

/// How many presses of a unit were left out by hand, if that is all that is wrong: the units after it are pressed all the same.
pub(super) fn presses_skipped(error: StudyError) -> Result<usize, StudyError> {
    match &error {
        StudyError::Acquisition { source, .. } => match source.cause {
            StopCause::Skipped { presses } => Ok(presses),
            _ => Err(error),
        },
        _ => Err(error),
    }
}
