//! Manual and automatic changes of units, specimens and light on a real rig.

use std::collections::BTreeSet;
use std::sync::PoisonError;

use taceva_core::{by_count, counted};
use taceva_drivers::{Drivers, OpenError};
use taceva_protocol::{Answer, Left, Plan, Question, RigFile, RunError, StopCause};

use super::changers::bring_unit;
use super::devices::{OpenRig, Sitting};
use crate::error::AcquireError;
use crate::scene::{PlannedScene, PlannedStudy, RigSpec, StudySource, is_untaught};

/// Changes on a real rig, made by hand or by a changer.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Changes {
    specimens: Vec<String>,
    lights: usize,
    units: Vec<String>,
}

/// Items in the changers of a rig; `None` if there is no changer.
#[derive(Clone, Debug, Default)]
struct Held {
    specimens: Option<Vec<String>>,
    units: Option<Vec<String>>,
}

fn is_held(held: Option<&Vec<String>>, name: &String) -> bool {
    held.is_some_and(|held| held.contains(name))
}

impl Changes {
    /// Changes that the operator makes by hand, and changes that changers make, in `plan`. A single specimen that is always mounted needs no change
    /// by hand.
    fn of(plan: &Plan, is_lit_by_hand: bool, held: &Held) -> [Changes; 2] {
        let [mut by_hand, mut by_changer] = [Changes::default(), Changes::default()];
        for unit in &plan.units {
            let presses = plan.presses.iter().map(|planned| &planned.press);
            let of_unit = presses.filter(|press| press.unit == *unit);
            let mut mounted: Vec<_> = of_unit.clone().map(|press| press.specimen).collect();
            mounted.dedup();
            let names = mounted.iter().map(ToString::to_string);
            let (brought, handed): (Vec<_>, Vec<_>) =
                names.partition(|name| is_held(held.specimens.as_ref(), name));
            if handed.len() > 1 || held.specimens.is_some() {
                by_hand.specimens.extend(handed);
            }
            by_changer.specimens.extend(brought);
            if is_lit_by_hand {
                let mut lit: Vec<_> = of_unit.filter_map(|press| press.light.as_ref()).collect();
                lit.dedup();
                by_hand.lights += lit.len();
            }
            match is_held(held.units.as_ref(), unit) {
                true => by_changer.units.push(unit.clone()),
                false if plan.units.len() > 1 => by_hand.units.push(unit.clone()),
                false => {}
            }
        }
        [by_hand, by_changer]
    }
}

/// Formats the first few distinct `names`.
fn few(names: &[String]) -> String {
    const FEW: usize = 3;
    let distinct: BTreeSet<&String> = names.iter().collect();
    let shown = distinct.iter().take(FEW).copied();
    let shown: Vec<String> = shown
        .map(|name| taceva_core::shown(name).to_string())
        .collect();
    let more = if distinct.len() > FEW { ", …" } else { "" };
    format!("{}{more}", shown.join(", "))
}

impl PlannedScene {
    /// Rejects a scene on a real rig that needs an operator, before any device is opened. Used by unattended commands.
    ///
    /// # Errors
    /// [`AcquireError::Request`] with the number of changes.
    pub fn check_unattended(&self, drivers: &Drivers) -> Result<(), AcquireError> {
        let real = self.studies.iter().filter(|study| match &study.source {
            StudySource::Rig(rig) => !rig.is_simulated(drivers),
            StudySource::Recording(_) => false,
        });
        for study in real {
            let mut needed = study.by_hand(drivers);
            let rig = study.rig().filter(|rig| !rig.simulated);
            if let Some(robot) = rig.and_then(|rig| rig.robot.as_ref()) {
                let robot = taceva_core::shown(&robot.driver.value);
                needed.insert(0, format!("`{robot}` is enabled by hand"));
            }
            if !needed.is_empty() {
                return Err(AcquireError::Request(format!(
                    "study `{}`: this rig needs an operator: {}; run it from a terminal or with a page",
                    taceva_core::shown(&study.plan.name),
                    needed.join(", ")
                )));
            }
        }
        Ok(())
    }
}

impl PlannedStudy {
    /// Manual changes on a real rig, with their counts; empty without manual changes.
    pub fn by_hand(&self, drivers: &Drivers) -> Vec<String> {
        let held = self.held(drivers);
        let [changes, _] = Changes::of(&self.plan, self.is_lit_by_hand(drivers), &held);
        let Changes {
            specimens,
            lights,
            units,
        } = changes;
        let named = |names: &[String], changer: Option<&Vec<String>>, noun: &str, rest: &str| {
            let beside = match changer {
                Some(_) => format!(", which the changer does not hold: {}", few(names)),
                None => String::new(),
            };
            let count = names.len();
            let are = by_count(count, "is", "are");
            let counted = counted(count, noun);
            (count > 0).then(|| format!("{counted}{rest} {are} changed by hand{beside}"))
        };
        let needed = [
            named(&specimens, held.specimens.as_ref(), "specimen", ""),
            (lights > 0).then(|| {
                let are = by_count(lights, "is", "are");
                format!("{} {are} changed by hand", counted(lights, "light"))
            }),
            named(&units, held.units.as_ref(), "unit", " of the sensor"),
        ];
        needed.into_iter().flatten().collect()
    }

    /// Automatic changes by changers of the rig file, with their counts and drivers; empty without automatic changes.
    pub fn by_changer(&self, drivers: &Drivers) -> Vec<String> {
        let Some(rig) = self.rig() else {
            return Vec::new();
        };
        let [_, changes] = Changes::of(&self.plan, false, &self.held(drivers));
        let counted = [
            (changes.specimens.len(), "specimens", &rig.changers.specimen),
            (
                changes.units.len(),
                "units of the sensor",
                &rig.changers.unit,
            ),
        ];
        let changed = counted.into_iter().filter(|(count, ..)| *count > 0);
        let changed = changed.filter_map(|(count, what, changer)| {
            let changer = taceva_core::shown(&changer.as_ref()?.value).to_string();
            Some(format!("{count} {what} are changed by `{changer}`"))
        });
        changed.collect()
    }

    /// Items in the changers of the rig.
    fn held(&self, drivers: &Drivers) -> Held {
        let (Some(rig), StudySource::Rig(spec)) = (self.rig(), &self.source) else {
            return Held::default();
        };
        // Planning has rejected invalid changers.
        let held = |changer| spec.held_by(drivers, changer).unwrap_or_default();
        Held {
            specimens: held(rig.changers.specimen.as_ref()),
            units: held(rig.changers.unit.as_ref()),
        }
    }

    /// True if the operator sets the light, because the rig has no lighting and its sensor has no light scenes.
    fn is_lit_by_hand(&self, drivers: &Drivers) -> bool {
        let StudySource::Rig(rig) = &self.source else {
            return false;
        };
        rig.info(&self.study, drivers).is_ok_and(|info| {
            let own = info.sensor.as_ref().and_then(|sensor| sensor.sensor());
            info.lighting.is_none() && own.is_none_or(|own| own.scenes.is_empty())
        })
    }

    /// Rig file that names the study's devices, if any.
    pub fn rig(&self) -> Option<&RigFile> {
        self.study.rig.as_deref()
    }

    /// True if the study's rig file still has the origin and axes of a new file. The run is rejected in this case.
    pub fn is_untaught(&self, drivers: &Drivers) -> bool {
        self.rig().is_some_and(|rig| is_untaught(rig, drivers))
    }
}

/// Puts `unit` under the robot, by a changer that contains it, or by the operator if a real rig has several units. Returns false if the operator skips the
/// unit.
///
/// The tip is raised before the change. The operator may have to enable the robot for this. No device is open during the change.
pub(super) fn unit_is_there(
    study: &PlannedStudy,
    rig: &RigSpec,
    unit: &str,
    sitting: &mut Sitting<'_>,
) -> Result<bool, AcquireError> {
    let Sitting {
        workshop, cancel, ..
    } = *sitting;
    let plan = &study.plan;
    let drivers = workshop.drivers;
    let has_changer = is_held(study.held(drivers).units.as_ref(), &unit.to_owned());
    if !has_changer && (plan.units.len() < 2 || rig.is_simulated(drivers)) {
        return Ok(true);
    }
    let question = Question::Unit(unit.to_owned());
    if !has_changer && workshop.operator.is_none() {
        return Err(acquisition(
            plan,
            StopCause::Missing(format!("a person to {question}")),
        ));
    }
    let mut open = OpenRig::open(study, &rig.without_sensor(), unit, *sitting)?;
    let raised = open.raise(plan, *sitting);
    drop(open);
    sitting.is_enabled |= raised.map_err(|source| stopped(plan, source))?;
    let rig_file = study.rig();
    let brought = rig_file.and_then(|file| bring_unit(rig, file, unit, *sitting));
    let question = match brought {
        None => question,
        Some(Ok(())) => return Ok(true),
        Some(Err(error)) => {
            if workshop.progress.is_cancelled() || cancel.is_cancelled() {
                return Err(acquisition(plan, StopCause::Cancelled));
            }
            if workshop.operator.is_none() {
                return Err(unchanged(plan, error));
            }
            let of_changer = Box::new(question);
            let why = error.to_string();
            Question::Instead { of_changer, why }
        }
    };
    let Some(operator) = workshop.operator else {
        let needed = format!("a person to {question}");
        return Err(acquisition(plan, StopCause::Missing(needed)));
    };
    let mut operator = operator.lock().unwrap_or_else(PoisonError::into_inner);
    match operator.ask(&question, cancel) {
        Answer::Done => Ok(true),
        Answer::Skip => Ok(false),
        Answer::Stop => Err(acquisition(plan, StopCause::Cancelled)),
    }
}

/// Error for a changer that could not put a unit in place, in a run without an operator.
fn unchanged(plan: &Plan, error: OpenError) -> AcquireError {
    match error {
        OpenError::Device(error) => acquisition(plan, StopCause::Device(error)),
        error => AcquireError::Open {
            study: plan.name.clone(),
            source: Box::new(error),
        },
    }
}

/// Error for a run that stopped while the tip did not touch the gel.
pub(super) fn acquisition(plan: &Plan, cause: StopCause) -> AcquireError {
    let error = RunError {
        press: None,
        cause,
        left: Left::Clear,
    };
    stopped(plan, error)
}

/// Error for a run of `plan` that stopped.
pub(super) fn stopped(plan: &Plan, error: RunError) -> AcquireError {
    AcquireError::Acquisition {
        study: plan.name.clone(),
        source: Box::new(error),
    }
}

/// Number of skipped presses if `error` states only that presses were skipped. Returns any other error. The presses of later units can still be made.
pub(super) fn presses_skipped(error: AcquireError) -> Result<usize, AcquireError> {
    match &error {
        AcquireError::Acquisition { source, .. } => match source.cause {
            StopCause::Skipped { presses } => Ok(presses),
            _ => Err(error),
        },
        _ => Err(error),
    }
}
