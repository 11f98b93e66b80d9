//! A run from start to end: the order of presses, and the stop.

use taceva_core::{Lighting, Nanometre, PressOutcome, Sensor, Specimen, counted};

use super::bounds::Bounds;
use super::camera::Camera;
use super::devices::{Devices, SpecimenChanger};
use super::error::{Left, RunError, StopCause};
use super::event::Event;
use super::log::{PressLog, PressRecord};
use super::operator::{Operator, Question};
use super::oversight::Oversight;
use super::reference_touch::SessionSpec;
use super::supervisor::{SharedSupervisor, Supervisor};
use super::tip::{DEADLINE, Pace, Step, Tip};
use super::{Controls, Mode, RunReport, RunSpec};
use crate::plan::{Plan, PlannedPress};

/// A run in progress, with its borrowed devices.
pub(super) struct Run<'a> {
    pub(super) tip: Tip<'a>,
    pub(super) camera: Option<Camera<'a>>,
    pub(super) lighting: Option<&'a mut dyn Lighting>,
    pub(super) specimens: Option<&'a mut dyn SpecimenChanger>,
    pub(super) events: &'a mut dyn FnMut(&Event),
    pub(super) operator: Option<&'a mut dyn Operator>,
    pub(super) plan: &'a Plan,
    pub(super) mounted: Option<Specimen>,
    pub(super) lit: Option<String>,
    /// Sum of the weights of interruptions, by stale signals, invalid frames or a changed zero of the force.
    silences: u32,
    /// Number of repetitions of presses, after such interruptions or a released enabling switch.
    redone: u32,
    /// True for emulated devices, whose signals a busy machine delays.
    is_emulated: bool,
    /// Longest wait for the enabling switch to be held, in s.
    pub(super) patience_s: f64,
    /// Manual steps that the operator skipped.
    pub(super) skipped: Vec<Question>,
    /// True after a skipped step, until the operator confirms that hands are out of reach.
    pub(super) is_reach_unknown: bool,
    /// True if the gentle touch found both sideways pushes, along x and y, as the axes of the rig file state.
    pub(super) is_shear_known: bool,
    /// Session that has not started yet; `None` without a rig file, and after the start.
    pub(super) session: Option<SessionSpec<'a>>,
}

/// Number of interruptions of one press, by stale signals and the like, after which the run ends.
const SILENCES_OF_A_PRESS: u32 = 3;
/// Number of interruptions of all presses, by stale signals and the like, after which the run ends.
const SILENCES_OF_A_RUN: u32 = 20;
/// Weight of a whole interruption. Late signals of emulated devices weigh 1.
pub(super) const WHOLE: u32 = 10;

impl<'a> Run<'a> {
    pub(super) fn new(
        spec: &RunSpec<'a>,
        devices: Devices<'a>,
        controls: Controls<'a>,
        guard: Option<Oversight<'a>>,
    ) -> Step<Run<'a>> {
        let plan = spec.plan;
        if !plan.units.iter().any(|unit| unit == spec.unit) {
            let problem = format!("unit `{}` in its list of units", spec.unit);
            return Err(StopCause::Missing(problem));
        }
        let height = match spec.mode {
            Mode::Acquire => 0.0,
            Mode::Rehearse { height } => height.0,
        };
        let nothing =
            || StopCause::Missing("limits and a footprint before anything moves".to_owned());
        let pace = Pace::of(plan).ok_or_else(nothing)?;
        let bounds = Bounds::of(plan, height).ok_or_else(nothing)?;
        let limits = plan.limits.clone().ok_or_else(nothing)?;
        let looks = plan.presses.iter().any(|press| press.frames);
        let sensor: Option<&'a mut dyn Sensor> = match (looks, devices.sensor) {
            (true, None) => return Err(StopCause::Missing("a sensor for its pictures".to_owned())),
            (true, sensor) => sensor,
            (false, _) => None,
        };
        let is_guarded = guard.is_some();
        let Oversight {
            supervisor,
            session,
            patience_s,
        } = guard.unwrap_or_else(|| {
            let supervisor = Supervisor::new(limits, devices.robot.halt_handle());
            Oversight::new(SharedSupervisor::new(supervisor))
        });
        let is_emulated = session.as_ref().is_some_and(|of| of.rig.simulated);
        let tip = Tip {
            is_guarded,
            ..Tip::new(
                devices.robot,
                devices.force,
                controls.clock,
                controls.cancel,
                supervisor,
                bounds,
                pace,
            )
        };
        tip.force.start(DEADLINE)?;
        let mut camera = sensor.map(Camera::new);
        if let Some(camera) = &mut camera {
            camera.sensor.start(DEADLINE)?;
        }
        Ok(Run {
            tip,
            camera,
            lighting: devices.lighting,
            specimens: devices.specimens,
            events: controls.events,
            operator: controls.operator,
            plan,
            mounted: None,
            lit: None,
            silences: 0,
            redone: 0,
            is_emulated,
            patience_s,
            skipped: Vec::new(),
            is_reach_unknown: false,
            is_shear_known: false,
            session,
        })
    }

    /// Weight of an interruption. Late signals of an emulated rig weigh one tenth.
    pub(super) fn weight(&self, cause: &StopCause) -> u32 {
        match self.is_emulated && cause.is_late() {
            true => 1,
            false => WHOLE,
        }
    }

    pub(super) fn stop(&mut self) -> Step<()> {
        let camera = self.camera.as_mut().map(|camera| camera.sensor.stop());
        let force = self.tip.force.stop();
        camera.unwrap_or(Ok(()))?;
        Ok(force?)
    }

    pub(super) fn all(
        &mut self,
        spec: &RunSpec<'_>,
        log: &mut dyn PressLog,
    ) -> Result<RunReport, RunError> {
        // A rehearsal visits the place of a load only once, because all cycles of a load have the same place.
        let is_made = |press: &PlannedPress| match (spec.mode, press.press.load()) {
            (Mode::Rehearse { .. }, Some(_)) => press.press.repeat == Some(0),
            _ => true,
        };
        let of_unit = |press: &&PlannedPress| press.press.unit == spec.unit && is_made(press);
        let presses: Vec<&PlannedPress> = self.plan.presses.iter().filter(of_unit).collect();
        let reference_scene = self.plan.lights.first();
        let is_seen = |press: &&&PlannedPress| {
            let light = press.press.light.as_ref();
            press.frames && (light.is_none() || light == reference_scene)
        };
        let first_seen = presses.iter().find(is_seen).map(|press| press.id);
        let mut report = RunReport::default();
        if let Mode::Acquire = spec.mode {
            report.resumed = presses
                .iter()
                .filter(|press| log.is_finished(press.id))
                .count();
        }
        (self.events)(&Event::Started {
            presses: presses.len(),
            finished: report.resumed,
        });
        let is_finished = |press: &&PlannedPress| log.is_finished(press.id);
        if self.session.is_some() && spec.mode == Mode::Acquire && presses.iter().all(is_finished) {
            // If no presses are left, the robot is not enabled.
            return Ok(report);
        }
        let clearance_mm = self.tip.pace.clearance_mm;
        let way = match spec.mode {
            Mode::Acquire => format!(
                "up to {clearance_mm} mm above the gel, slowly over a few places, down for a gentle touch, then {}",
                counted(presses.len() - report.resumed, "press")
            ),
            Mode::Rehearse { height } => format!(
                "over {}, {} mm above the height of travel, at up to {} mm/s, without a press",
                counted(presses.len(), "place"),
                height.0,
                self.tip.pace.travel.mm_per_s()
            ),
        };
        self.enable(way)?;
        self.hold(None)?;
        self.tip
            .find()
            .map_err(|cause| self.abandoned(None, cause))?;
        let places: Vec<[Nanometre; 2]> = presses.iter().map(|press| press.press.place).collect();
        for (position, planned) in presses.into_iter().enumerate() {
            match spec.mode {
                Mode::Rehearse { height } => {
                    self.rehearse_patiently(planned, height.0)?;
                    report.made += 1;
                }
                Mode::Acquire if log.is_finished(planned.id) => {}
                Mode::Acquire if self.is_skipped(planned)? => {
                    (self.events)(&Event::Skipped(planned.id));
                    report.skipped += 1;
                }
                Mode::Acquire => {
                    self.begin(&places, planned, log)?;
                    (self.events)(&Event::Approaching {
                        press: planned.id,
                        number: position + 1,
                    });
                    let is_first = first_seen == Some(planned.id);
                    let record = self.acquire_patiently(planned, is_first, log)?;
                    log.append(&record).map_err(|error| RunError {
                        press: Some(planned.id),
                        cause: StopCause::Log(error),
                        left: Left::Clear,
                    })?;
                    report.made += 1;
                    report.samples += record.samples.len();
                    report.limited += usize::from(record.outcome.is_limited());
                    report.without_contact +=
                        usize::from(record.outcome == PressOutcome::NoContact);
                    (self.events)(&Event::Finished {
                        press: planned.id,
                        outcome: record.outcome,
                    });
                }
            }
        }
        report.redone = self.redone;
        match report.skipped {
            0 => Ok(report),
            presses => Err(RunError {
                press: None,
                cause: StopCause::Skipped { presses },
                left: Left::Clear,
            }),
        }
    }

    /// Makes one press. Repeats it from the start after stale signals or a released switch, if the tip was raised above the gel. Also repeats it
    /// after a fault that the operator acknowledged.
    fn acquire_patiently(
        &mut self,
        planned: &PlannedPress,
        is_first: bool,
        log: &mut dyn PressLog,
    ) -> Result<PressRecord, RunError> {
        let (mut times, mut silences) = (0, 0);
        loop {
            self.hold(Some(planned.id))?;
            let cause = match self.acquire(planned, is_first.then_some(&mut *log)) {
                Ok(record) => return Ok(record),
                Err(cause) => cause,
            };
            let (is_silence, is_release) = (cause.is_silence(), cause.is_release());
            let mut error = self.abandoned(Some(planned.id), cause);
            if let StopCause::ZeroStep(step) = &error.cause {
                (self.events)(&Event::ZeroStepped(**step));
                let stored = log.zero_step(planned.id, &step.zero);
                if let Err(failed) = stored {
                    error.cause = StopCause::Log(failed);
                    return Err(error);
                }
            }
            if let Some(fault) = error.cause.fault() {
                self.go_on_after(fault, error)?;
                continue;
            }
            if !(is_silence || is_release) || error.left != Left::Clear {
                return Err(error);
            }
            times += 1;
            // Releases are unlimited, because the operator holds the switch again each time.
            if !is_release {
                let weight = self.weight(&error.cause);
                silences += weight;
                self.silences += weight;
                if silences >= SILENCES_OF_A_PRESS * WHOLE
                    || self.silences >= SILENCES_OF_A_RUN * WHOLE
                {
                    return Err(error);
                }
            }
            self.redone += 1;
            let press = planned.id;
            (self.events)(&Event::Redone { press, times });
        }
    }

    /// Visits one place in the air. Repeats the visit after a released switch.
    fn rehearse_patiently(
        &mut self,
        planned: &PlannedPress,
        height_mm: f64,
    ) -> Result<(), RunError> {
        loop {
            self.hold(Some(planned.id))?;
            let Err(cause) = self.rehearse(planned, height_mm) else {
                return Ok(());
            };
            let is_release = cause.is_release();
            let error = self.abandoned(Some(planned.id), cause);
            if !is_release || error.left != Left::Clear {
                return Err(error);
            }
        }
    }
}
