//! From a plan to a recording: every press that is not in it yet, unit after unit, each durable before the next begins.

mod devices;
mod key;
mod log;
pub(crate) mod retried;
mod schedule;
mod workshop;

use std::path::Path;

use taceva_core::Outline;
use taceva_dataset::{
    Dataset, DatasetError, Footprint, Known, Recorder, RecordingFacts, RecordingSpec, SensorFacts,
    Shape, Source,
};
use taceva_protocol::{Cancel, Controls, Event, Mode, Plan, RunSpec, run};

use crate::error::StudyError;
use crate::scene::{PlannedStudy, RigSpec};
use devices::OpenRig;
pub(crate) use key::key;
use log::RecordedPresses;
use schedule::Schedule;
pub use workshop::{Surroundings, SurroundingsOf, Upcoming, Workshop};

/// The recording of `study` at `path`, whole: begun, continued or found there. Presses that are finished advance the progress.
///
/// # Errors
/// [`StudyError::Open`] and [`StudyError::Acquisition`] if a device failed or somebody wished to stop: what was recorded stays, and the
/// same call goes on. [`StudyError::Dataset`] if it cannot be recorded, or something else was recorded there.
pub(crate) fn acquire(
    study: &PlannedStudy,
    rig: &RigSpec,
    path: &Path,
    (workshop, cancel): (Workshop<'_>, &Cancel),
) -> Result<Dataset, StudyError> {
    let plan = &study.plan;
    match Dataset::open(path) {
        Err(DatasetError::NoDataset { .. }) => {}
        closed_before => {
            // Whoever reads holds the folder, which nobody may write to meanwhile.
            drop(closed_before?);
            // A power cut may have spared the journal of what was closed; asking to go on removes it.
            match Recorder::resume(path) {
                Err(DatasetError::TargetExists { .. }) => {}
                other => drop(other?),
            }
            workshop.progress.advance(plan.presses.len() as u64);
            return Ok(Dataset::open(path)?);
        }
    }
    let mut log: Option<RecordedPresses> = None;
    for unit in &plan.units {
        let mut open = OpenRig::open(study, rig, unit, workshop)?;
        let log = match &mut log {
            Some(log) => log,
            None => {
                let spec = recording_spec(study, &open, rig.is_simulated(workshop.drivers));
                log.insert(RecordedPresses::new(Recorder::open(path, &spec)?))
            }
        };
        acquire_unit(study, (unit, &mut open, path), log, (workshop, cancel))?;
    }
    if let Some(log) = log {
        log.into_recorder().close()?;
    }
    Ok(Dataset::open(path)?)
}

/// The presses of one unit.
fn acquire_unit(
    study: &PlannedStudy,
    (unit, open, path): (&str, &mut OpenRig, &Path),
    log: &mut RecordedPresses,
    (workshop, cancel): (Workshop<'_>, &Cancel),
) -> Result<(), StudyError> {
    let (plan, progress) = (&study.plan, workshop.progress);
    if open.surroundings.begins_anew {
        log.relive(plan, unit);
    }
    let schedule = Schedule::of(plan);
    let mut retried = 0_u64;
    let mut upcoming = open.surroundings.upcoming.take();
    let mut events = |event: &Event| {
        match event {
            Event::Started { finished, .. } => progress.advance(*finished as u64),
            Event::Approaching { press, number } => {
                if let Some(upcoming) = &mut upcoming {
                    upcoming(Upcoming {
                        press: *press,
                        begins: schedule.begins(*number),
                    });
                }
            }
            Event::Finished { .. } => progress.advance(1),
            Event::FrameRetried => retried += 1,
            _ => {}
        }
        if progress.is_cancelled() {
            cancel.cancel();
        }
    };
    let spec = RunSpec {
        plan,
        unit,
        mode: Mode::Acquire,
    };
    let (devices, clock) = open.lend();
    let controls = Controls {
        clock,
        cancel,
        events: &mut events,
    };
    let failed = |source| StudyError::Acquisition {
        study: plan.name.clone(),
        source: Box::new(source),
    };
    let done = run(&spec, devices, log, controls).map(drop).map_err(failed);
    // A count that cannot be written is no reason to lose a recording.
    drop(retried::add(path, retried));
    done
}

/// What the recording of `study` is of.
fn recording_spec(study: &PlannedStudy, open: &OpenRig, is_simulated: bool) -> RecordingSpec {
    let plan = &study.plan;
    let gel = open.surroundings.gel.clone();
    RecordingSpec {
        facts: RecordingFacts {
            source: if is_simulated {
                Source::Simulated
            } else {
                Source::Recorded
            },
            clock: taceva_core::Clock::Monotonic,
            sensor: SensorFacts {
                model: plan.name.clone(),
                serial: plan.units.join(", "),
                gel: gel.unwrap_or_else(|| "unknown".to_owned()),
                opaque: plan.opaque.map_or(Known::Unknown, Known::Is),
            },
            footprint: footprint(plan),
        },
        channels: plan.truth_channels(),
    }
}

/// Where the sensor senses and how deep it is pressed, as recordings write it.
fn footprint(plan: &Plan) -> Option<Footprint> {
    let footprint = plan.footprint?;
    let of_gel = footprint.depth_max().map(|depth| depth.to_millimetres());
    let limit = plan.limits.as_ref().map(|limits| limits.depth_max.0);
    let rectangle = Footprint {
        shape: Shape::Rect,
        radius_mm: None,
        half_x_mm: None,
        half_y_mm: None,
        depth_max_mm: of_gel.or(limit),
    };
    match footprint.outline() {
        Outline::Disc { radius } => Some(Footprint {
            shape: Shape::Disc,
            radius_mm: Some(radius.to_millimetres()),
            ..rectangle
        }),
        Outline::Rectangle { half_x, half_y } => Some(Footprint {
            half_x_mm: Some(half_x.to_millimetres()),
            half_y_mm: Some(half_y.to_millimetres()),
            ..rectangle
        }),
        _ => None,
    }
}
