//! Records the missing presses of a plan, one unit after another. Each press is safely on disk before the next begins.

mod changers;
mod clock_follower;
mod content_key;
mod delegation;
mod device;
mod devices;
mod file_devices;
mod guardian;
mod latency;
mod log;
mod operator;
mod reduction;
mod registration;
mod rehearsal;
mod rig_locks;
mod schedule;
mod session;
mod settings;
mod simulation;
mod tap;
mod viewed_sensor;
mod workshop;

use std::path::Path;

use taceva_core::{DriverSource, Outline};
use taceva_dataset::{
    Dataset, DatasetError, Footprint, Known, Recorder, RecordingFacts, RecordingSpec,
    ReducedFrames, SensorFacts, SessionTable, Source, add_device_warnings, add_frame_retries,
    add_frozen_frames, add_measured_settings, zero_settings,
};
use taceva_drivers::{Drivers, Selector};
use taceva_protocol::{Cancel, Event, Mode, Plan, PressLog, RunSpec, Setting, StopCause};

use crate::error::AcquireError;
use crate::instruments;
use crate::scene::{PlannedStudy, RigSpec, StudySource};
pub(crate) use clock_follower::measured_settings;
pub(crate) use device::Opened;
use devices::{OpenRig, Sitting};
pub(crate) use file_devices::FileOpener;
pub(crate) use latency::written_latencies_ms;
use log::RecordedPresses;
use operator::{acquisition, presses_skipped, stopped, unit_is_there};
use reduction::reduction;
pub(crate) use registration::Turned;
pub use rehearsal::{AIR_MM, rehearse_scene};
pub use rig_locks::HeldRigs;
use schedule::Schedule;
use settings::of_limits;
pub(crate) use settings::{add_settings, of_rig_file, sensor_driver};
pub(crate) use tap::{TappedRig, tap_study};
pub use workshop::{Surroundings, SurroundingsOf, Upcoming, Workshop};

impl PlannedStudy {
    /// Opens the recording that the scene names. If the scene names none, opens or creates the recording at `path`, and makes its missing presses.
    /// Each finished press advances the progress.
    ///
    /// # Errors
    /// [`AcquireError::Open`] and [`AcquireError::Acquisition`] if a device fails or the run is cancelled. Finished presses are kept, and the same call resumes
    /// the run. [`AcquireError::Dataset`] if the recording cannot be written, or `path` contains another recording.
    pub fn acquire(
        &self,
        path: &Path,
        workshop: Workshop<'_>,
        cancel: &Cancel,
    ) -> Result<Dataset, AcquireError> {
        match &self.source {
            StudySource::Rig(rig) => acquire(self, rig, path, Sitting::new(workshop, cancel)),
            StudySource::Recording(path) => Ok(Dataset::open(path)?),
        }
    }

    /// True if the study makes presses with at least one real device.
    pub fn is_real(&self, drivers: &Drivers) -> bool {
        matches!(&self.source, StudySource::Rig(rig) if !rig.is_only_simulated(drivers))
    }
}

/// Creates, resumes or opens the recording of `study` at `path`, and completes it.
fn acquire(
    study: &PlannedStudy,
    rig: &RigSpec,
    path: &Path,
    mut sitting: Sitting<'_>,
) -> Result<Dataset, AcquireError> {
    let workshop = sitting.workshop;
    let plan = &study.plan;
    match Dataset::open(path) {
        Err(DatasetError::NoDataset { .. }) => {}
        closed_before => {
            // An open dataset locks its folder against writers.
            drop(closed_before?);
            // A power cut may have left the journal of a closed recording; a resume removes it.
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
    let mut warned = Vec::new();
    for unit in &plan.units {
        if !unit_is_there(study, rig, unit, &mut sitting)? {
            left += plan
                .presses
                .iter()
                .filter(|press| press.press.unit == *unit)
                .count();
            continue;
        }
        let mut open = OpenRig::open(study, rig, unit, sitting)?;
        open.warn(workshop, &mut warned);
        let log = match &mut log {
            Some(log) => log,
            None => {
                let source = match open.robot.is_emulated() {
                    true => Source::Simulated,
                    false => origin(study, rig, workshop.drivers),
                };
                let spec = recording_spec(study, &open, source);
                let reduction = reduction(study, &open)?;
                let spec = match &reduction {
                    Some(reduction) => {
                        spec.with_reduced(ReducedFrames::area_averages(reduction.from()))
                    }
                    None => spec,
                };
                log.insert(RecordedPresses::new(
                    path,
                    Recorder::open(path, &spec)?,
                    SessionTable::of(path)?,
                    reduction,
                ))
            }
        };
        let touched = session::touches(log.sessions().rows(), plan);
        let of_unit = Sitting {
            touched: &touched,
            ..sitting
        };
        let done = acquire_unit(study, unit, &mut open, path, log, of_unit);
        open.warn(workshop, &mut warned);
        // A failure to store a warning or a drift must not lose the recording.
        drop(add_device_warnings(path, &open.warnings()));
        let mut measured = measured_settings(open.settings());
        measured.extend(zero_settings(path));
        drop(add_measured_settings(path, &measured));
        sitting.is_enabled = true;
        if let Err(error) = done {
            left += presses_skipped(error)?;
        }
    }
    if left > 0 {
        // The recording stays open: the same call resumes it.
        return Err(acquisition(plan, StopCause::Skipped { presses: left }));
    }
    if let Some(log) = log {
        log.into_recorder().close()?;
    }
    Ok(Dataset::open(path)?)
}

/// Makes the presses of one unit.
fn acquire_unit(
    study: &PlannedStudy,
    unit: &str,
    open: &mut OpenRig,
    path: &Path,
    log: &mut RecordedPresses,
    sitting: Sitting<'_>,
) -> Result<(), AcquireError> {
    let Sitting {
        workshop, cancel, ..
    } = sitting;
    let (plan, progress) = (&study.plan, workshop.progress);
    if open.surroundings.begins_anew {
        log.relive(plan, unit);
    }
    let schedule = Schedule::of(plan);
    if let Some(viewer) = workshop.viewer {
        viewer.begins(plan, unit, &|press| log.is_finished(press));
    }
    let (mut retried, mut frozen) = (0_u64, 0_u64);
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
            Event::FrameFrozen => frozen += 1,
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
    let done = open.conduct(&spec, log, sitting, &mut events);
    let done = done.map(drop).map_err(|error| stopped(plan, error));
    // A failure to store a count must not lose the recording.
    drop(add_frame_retries(path, retried));
    drop(add_frozen_frames(path, frozen));
    done
}

/// Origin of the samples of `study`. It is simulated if a device is simulated, or if the rig file states an emulation.
fn origin(study: &PlannedStudy, rig: &RigSpec, drivers: &Drivers) -> Source {
    let file = study.study.rig.as_deref();
    let changers = file.map(|file| [&file.changers.specimen, &file.changers.unit]);
    let is_simulated = |device: &Setting<String>| {
        let selector: Option<Selector> = device.value.parse().ok();
        let factory = selector.and_then(|selector| drivers.changers.get(selector.driver()).ok());
        factory.is_some_and(|factory| factory.descriptor().source() == DriverSource::Simulated)
    };
    let is_emulated = file.is_some_and(|file| file.simulated);
    let mut changers = changers.into_iter().flatten().flatten();
    match is_emulated || rig.is_simulated(drivers) || changers.any(is_simulated) {
        true => Source::Simulated,
        false => Source::Recorded,
    }
}

/// Header of the recording of `study`.
fn recording_spec(study: &PlannedStudy, open: &OpenRig, source: Source) -> RecordingSpec {
    let plan = &study.plan;
    let gel = open.surroundings.gel.clone();
    // All stages of wear press the same sensor.
    let model = plan.wear.as_ref().map_or(&plan.name, |wear| &wear.sensor);
    let pressed = plan.wear.as_ref().map(|wear| wear.presses_since_gel);
    let mut sensor = SensorFacts::new(model)
        .with_serial(plan.units.join(", "))
        .with_presses_since_gel(pressed);
    sensor.opaque = plan.opaque.map_or(Known::Unknown, Known::Is);
    if let Some(gel) = gel {
        sensor = sensor.with_gel(gel);
    }
    let mut facts = RecordingFacts::new(source, taceva_core::Clock::Monotonic, sensor);
    facts.footprint = footprint(plan);
    facts.settings = open.settings();
    let rig = study.study.rig.as_deref();
    facts
        .settings
        .extend(rig.map(of_rig_file).unwrap_or_default());
    let limits = plan.limits.as_ref().filter(|_| rig.is_some());
    facts
        .settings
        .extend(limits.map(of_limits).unwrap_or_default());
    let instruments = rig.map(instruments::of_rig).unwrap_or_default();
    facts.traceability = instruments::kept(instruments, &facts.settings);
    facts.recorded_on = instruments::day_of(source);
    RecordingSpec::new(facts, plan.truth_channels())
}

/// Footprint and greatest depth, in the format of recordings; `None` if the plan has no footprint.
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
