//! From a plan to a recording: every press that is not in it yet, unit after unit, each durable before the next begins.

mod by_hand;
mod changers;
mod devices;
mod guardian;
mod held;
mod key;
mod latency;
mod log;
mod of_file;
mod opened;
mod reduced;
mod registered;
mod rehearse;
pub(crate) mod retried;
mod schedule;
mod seen;
pub(crate) mod sessions;
mod simulated;
mod tap;
mod workshop;

use std::path::Path;

use taceva_core::Outline;
use taceva_dataset::{
    Dataset, DatasetError, Footprint, Known, Recorder, RecordingFacts, RecordingSpec,
    ReducedFrames, SensorFacts, Source,
};
use taceva_protocol::{Cancel, Event, Mode, Plan, PressLog, RunSpec, StopCause};

use crate::error::StudyError;
use crate::scene::{PlannedStudy, RigSpec};
use by_hand::{acquisition, presses_skipped, stopped, unit_is_there};
pub(crate) use devices::written_latencies_ms;
use devices::{OpenRig, Sitting};
pub use held::HeldRigs;
pub(crate) use key::key;
use log::RecordedPresses;
pub(crate) use of_file::{FileDevices, FileOpener};
pub(crate) use opened::Opened;
use reduced::reduction;
pub(crate) use registered::Turned;
pub use rehearse::{AIR_MM, rehearse_scene};
use schedule::Schedule;
pub use sessions::RecordedSessions;
use sessions::Sessions;
pub(crate) use tap::tap_study;
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
    let mut left = 0;
    let mut is_enabled = false;
    for unit in &plan.units {
        let by_hand = (workshop, cancel, &mut is_enabled);
        if !unit_is_there(study, rig, unit, by_hand)? {
            left += plan
                .presses
                .iter()
                .filter(|press| press.press.unit == *unit)
                .count();
            continue;
        }
        let mut open = OpenRig::open(study, rig, unit, (workshop, cancel))?;
        let log = match &mut log {
            Some(log) => log,
            None => {
                let is_emulated = study.study.rig.as_ref().is_some_and(|rig| rig.simulated);
                let is_simulated = is_emulated || rig.is_simulated(workshop.drivers);
                let spec = recording_spec(study, &open, is_simulated);
                let reduction = reduction(study, &open)?;
                let spec = match &reduction {
                    Some(reduction) => {
                        spec.with_reduced(ReducedFrames::area_averages(reduction.from()))
                    }
                    None => spec,
                };
                log.insert(RecordedPresses::new(
                    Recorder::open(path, &spec)?,
                    Sessions::of(path)?,
                    reduction,
                ))
            }
        };
        let touched = log.sessions().touched(plan);
        let sitting = Sitting {
            is_enabled,
            touched: &touched,
        };
        let whereabouts = (unit.as_str(), &mut open, path);
        let done = acquire_unit(study, whereabouts, log, (workshop, cancel, sitting));
        is_enabled = true;
        if let Err(error) = done {
            left += presses_skipped(error)?;
        }
    }
    if left > 0 {
        // What is recorded is kept open: the same call goes on with it.
        return Err(acquisition(plan, StopCause::Skipped { presses: left }));
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
    (workshop, cancel, sitting): (Workshop<'_>, &Cancel, Sitting<'_>),
) -> Result<(), StudyError> {
    let (plan, progress) = (&study.plan, workshop.progress);
    if open.surroundings.begins_anew {
        log.relive(plan, unit);
    }
    let schedule = Schedule::of(plan);
    if let Some(viewer) = workshop.viewer {
        viewer.begins(plan, unit, &|press| log.is_finished(press));
    }
    let mut retried = 0_u64;
    let mut upcoming = open.surroundings.upcoming.take();
    let mut events = |event: &Event| {
        if let Some(viewer) = workshop.viewer {
            viewer.event(event);
        }
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
    let done = open.conduct(&spec, log, (cancel, workshop, sitting), &mut events);
    let done = done.map(drop).map_err(|error| stopped(plan, error));
    // A count that cannot be written is no reason to lose a recording.
    drop(retried::add(path, retried));
    done
}

/// What the recording of `study` is of.
fn recording_spec(study: &PlannedStudy, open: &OpenRig, is_simulated: bool) -> RecordingSpec {
    let plan = &study.plan;
    let gel = open.surroundings.gel.clone();
    let source = match is_simulated {
        true => Source::Simulated,
        false => Source::Recorded,
    };
    let mut sensor = SensorFacts::new(&plan.name).with_serial(plan.units.join(", "));
    sensor.opaque = plan.opaque.map_or(Known::Unknown, Known::Is);
    if let Some(gel) = gel {
        sensor = sensor.with_gel(gel);
    }
    let mut facts = RecordingFacts::new(source, taceva_core::Clock::Monotonic, sensor);
    facts.footprint = footprint(plan);
    facts.settings = open.settings_of_sensor();
    RecordingSpec::new(facts, plan.truth_channels())
}

/// Where the sensor senses and how deep it is pressed, as recordings write it.
fn footprint(plan: &Plan) -> Option<Footprint> {
    let footprint = plan.footprint?;
    let of_gel = footprint.depth_max().map(|depth| depth.to_millimetres());
    let limit = plan.limits.as_ref().map(|limits| limits.depth_max.0);
    let written = match footprint.outline() {
        Outline::Disc { radius } => Footprint::disc(radius.to_millimetres()),
        Outline::Rectangle { half_x, half_y } => {
            Footprint::rectangle(half_x.to_millimetres(), half_y.to_millimetres())
        }
        _ => return None,
    };
    Some(match of_gel.or(limit) {
        Some(depth_max_mm) => written.with_depth_max(depth_max_mm),
        None => written,
    })
}
