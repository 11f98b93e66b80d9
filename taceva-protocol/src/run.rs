//! Runs a plan on borrowed devices: safely, resumably, and without a clock or a file of its own.
//!
//! A press is an approach, a search for contact, its waypoints and a retreat. In contact the tip moves in segments of 15 ms; after each,
//! force and pose are read and shown to the [`Supervisor`]. A limit of the gel ends the way in and the run goes on; anything else stops it,
//! the tip leaves the gel if its signals can be trusted, and the same call resumes the run.

mod align;
mod bounds;
mod devices;
mod error;
mod event;
mod indent;
mod log;
mod retreat;
#[cfg(test)]
mod rig;
mod sample;
mod supervisor;
mod time;
mod tip;
mod trip;

pub use devices::{Devices, SpecimenChanger};
pub use error::{Left, RunError, StopCause};
pub use event::Event;
pub use log::{PressLog, PressRecord};
pub use supervisor::{MotionStage, Observation, Supervisor};
pub use time::{Cancel, Timekeeper};
pub use trip::Trip;

#[cfg(feature = "simulation")]
pub(crate) use supervisor::STALE_S;

use taceva_core::{Degree, Lighting, Millimetre, Nanometre, PressOutcome, Sensor, Specimen};

use crate::content_id::ContentId;
use crate::plan::{Plan, PlannedPress};
use crate::press::Motion;
use align::Look;
use bounds::Bounds;
use sample::{Camera, Gathered, Spot};
use tip::{DEADLINE, Pace, Step, Tip};

/// What is run.
#[derive(Clone, Copy, Debug)]
pub struct RunSpec<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// The unit that is on the rig; presses of others are left for another run.
    pub unit: &'a str,
    /// For real, or in the air.
    pub mode: Mode,
}

/// For real, or in the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    /// Presses are made and recorded.
    Acquire,
    /// Every place is visited this much above the height of travel, with the same loop and the same supervisor; nothing is recorded.
    Rehearse {
        /// Added to the clearance.
        height: Millimetre,
    },
}

/// Time, the wish to stop, and whoever shows what happens.
pub struct Controls<'a> {
    /// The clock that the stamps of the devices are of.
    pub clock: &'a mut dyn Timekeeper,
    /// Ends the run before its next motion.
    pub cancel: &'a Cancel,
    /// Told what happens.
    pub events: &'a mut dyn FnMut(&Event),
}

/// What a run did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RunReport {
    /// Presses of this unit that were finished before.
    pub resumed: usize,
    /// Presses that were made and are durable; in a rehearsal, places visited.
    pub made: usize,
    /// Of those, ended by a limit of the gel.
    pub limited: usize,
    /// Of those, without contact.
    pub without_contact: usize,
    /// Samples that were recorded.
    pub samples: usize,
}

/// Makes the presses of `spec` that `log` does not have yet, each durable before the next begins.
///
/// Sensor and transducer are started and stopped, the robot is left above the gel.
///
/// # Errors
/// [`RunError`]: what stopped it, which press must be made again, and where the tip was left.
pub fn run<'a>(
    spec: &RunSpec<'a>,
    devices: Devices<'a>,
    log: &mut dyn PressLog,
    controls: Controls<'a>,
) -> Result<RunReport, RunError> {
    let stopped = |cause| RunError {
        press: None,
        cause,
        left: Left::Clear,
    };
    let mut run = Run::new(spec, devices, controls).map_err(stopped)?;
    let done = run.all(spec, log);
    let stopping = run.stop();
    match done {
        Ok(report) => stopping.map(|()| report).map_err(stopped),
        Err(error) => Err(error),
    }
}

struct Run<'a> {
    tip: Tip<'a>,
    camera: Option<Camera<'a>>,
    lighting: Option<&'a mut dyn Lighting>,
    specimens: Option<&'a mut dyn SpecimenChanger>,
    events: &'a mut dyn FnMut(&Event),
    plan: &'a Plan,
    mounted: Option<Specimen>,
    lit: Option<String>,
}

impl<'a> Run<'a> {
    fn new(spec: &RunSpec<'a>, devices: Devices<'a>, controls: Controls<'a>) -> Step<Run<'a>> {
        let plan = spec.plan;
        if !plan.units.iter().any(|unit| unit == spec.unit) {
            let problem = format!("unit `{}`, which it does not name", spec.unit);
            return Err(StopCause::Missing(problem));
        }
        let height = match spec.mode {
            Mode::Acquire => 0.0,
            Mode::Rehearse { height } => height.0,
        };
        let nothing =
            || StopCause::Missing("limits and a footprint: nothing in it moves".to_owned());
        let pace = Pace::of(plan).ok_or_else(nothing)?;
        let bounds = Bounds::of(plan, height).ok_or_else(nothing)?;
        let limits = plan.limits.clone().ok_or_else(nothing)?;
        let looks = plan.presses.iter().any(|press| press.frames);
        let sensor: Option<&'a mut dyn Sensor> = match (looks, devices.sensor) {
            (true, None) => return Err(StopCause::Missing("a sensor for its pictures".to_owned())),
            (true, sensor) => sensor,
            (false, _) => None,
        };
        let supervisor = Supervisor::new(limits, devices.robot.halt_handle());
        let tip = Tip::new(
            (devices.robot, devices.force),
            (controls.clock, controls.cancel),
            supervisor,
            (bounds, pace),
        );
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
            plan,
            mounted: None,
            lit: None,
        })
    }

    fn stop(&mut self) -> Step<()> {
        let camera = self.camera.as_mut().map(|camera| camera.sensor.stop());
        let force = self.tip.force.stop();
        camera.unwrap_or(Ok(()))?;
        Ok(force?)
    }

    fn all(&mut self, spec: &RunSpec<'_>, log: &mut dyn PressLog) -> Result<RunReport, RunError> {
        let of_unit = |press: &&PlannedPress| press.press.unit == spec.unit;
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
        self.tip
            .find()
            .map_err(|cause| self.abandoned(None, cause))?;
        for (position, planned) in presses.into_iter().enumerate() {
            match spec.mode {
                Mode::Rehearse { height } => {
                    let done = self.rehearse(planned, height.0);
                    done.map_err(|cause| self.abandoned(Some(planned.id), cause))?;
                    report.made += 1;
                }
                Mode::Acquire if log.is_finished(planned.id) => {}
                Mode::Acquire => {
                    (self.events)(&Event::Approaching {
                        press: planned.id,
                        number: position + 1,
                    });
                    let is_first = first_seen == Some(planned.id);
                    let record = self
                        .acquire(planned, is_first.then_some(&mut *log))
                        .map_err(|cause| self.abandoned(Some(planned.id), cause))?;
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
        Ok(report)
    }

    /// The error that ends the run, after the tip was brought to where it can be left.
    fn abandoned(&mut self, press: Option<ContentId>, cause: StopCause) -> RunError {
        if let StopCause::Tripped(trip) = cause {
            (self.events)(&Event::Halted(trip));
        }
        let left = if self.tip.abandon() {
            (self.events)(&Event::Retracted);
            Left::Clear
        } else {
            Left::InPlace
        };
        RunError { press, cause, left }
    }

    /// One press, from the height of travel and back to it. Before it, what is seen there goes to `untouched`, where somebody asks.
    fn acquire(
        &mut self,
        planned: &PlannedPress,
        untouched: Option<&mut dyn PressLog>,
    ) -> Step<PressRecord> {
        self.prepare(planned)?;
        if let (Some(log), Some(camera)) = (untouched, &mut self.camera) {
            let now_s = self.tip.clock.now_s();
            let (frame, _) = camera.frame(now_s, &self.tip, self.events)?;
            log.untouched(&frame).map_err(StopCause::Log)?;
            // The force has been silent for as long as the picture took.
            self.tip.look()?;
        }
        let mut gathered = Gathered::default();
        let outcome = match self.press(planned, &mut gathered) {
            Ok(outcome) => outcome,
            Err(cause) => PressOutcome::Limited(self.limit_of(cause)?),
        };
        self.tip.retreat()?;
        if outcome.is_limited() {
            (self.events)(&Event::Retracted);
        }
        Ok(PressRecord {
            press: planned.id,
            outcome,
            samples: gathered.samples,
        })
    }

    /// The specimen, the light and the place.
    fn prepare(&mut self, planned: &PlannedPress) -> Step<()> {
        let press = &planned.press;
        if self.mounted != Some(press.specimen) {
            match &mut self.specimens {
                Some(changer) => {
                    changer.mount(press.specimen, DEADLINE)?;
                    (self.events)(&Event::Mounted(press.specimen));
                }
                None if self.mounted.is_some() => {
                    let needed = format!("somebody who mounts a {}", press.specimen);
                    return Err(StopCause::Missing(needed));
                }
                None => {}
            }
            self.mounted = Some(press.specimen);
        }
        if self.lit != press.light
            && let Some(light) = &press.light
        {
            self.set_light(light)?;
            self.lit = Some(light.clone());
            (self.events)(&Event::Lit(light.clone()));
        }
        let place = press.place.map(Nanometre::to_millimetres);
        let turn = Degree(f64::from(press.turn_millidegrees) / 1e3);
        let height = -self.tip.pace.clearance_mm;
        self.tip.travel(place, turn, height)
    }

    fn set_light(&mut self, light: &str) -> Step<()> {
        let own = self
            .camera
            .as_mut()
            .and_then(|camera| camera.sensor.lighting());
        match (&mut self.lighting, own) {
            (Some(lighting), _) => Ok(lighting.set(light, DEADLINE)?),
            (None, Some(lighting)) => Ok(lighting.set(light, DEADLINE)?),
            (None, None) => Err(StopCause::Missing(format!(
                "a lighting that sets `{light}`"
            ))),
        }
    }

    fn rehearse(&mut self, planned: &PlannedPress, height_mm: f64) -> Step<()> {
        let press = &planned.press;
        let height = -self.tip.pace.clearance_mm - height_mm;
        let place = press.place.map(Nanometre::to_millimetres);
        let turn = Degree(f64::from(press.turn_millidegrees) / 1e3);
        self.tip.travel(place, turn, height)?;
        for waypoint in press.waypoints() {
            let target = Tip::waypoint(press.place, waypoint.shear, height, waypoint.depth);
            self.tip.approach(target)?;
        }
        (self.events)(&Event::Rehearsed(planned.id));
        Ok(())
    }

    /// What happens between the approach and the retreat.
    fn press(&mut self, planned: &PlannedPress, gathered: &mut Gathered) -> Step<PressOutcome> {
        let press = &planned.press;
        if let Motion::Rest { frames } = press.motion {
            let mut before = self.tip.settle()?;
            for number in 0..frames {
                self.sample(planned, Spot::reached(number, 0.0), before, gathered)?;
                // No rest between: the pictures come as fast as the sensor gives them.
                before = self.tip.look()?;
            }
            return Ok(PressOutcome::Complete);
        }
        let Some(contact) = self.tip.search()? else {
            return Ok(PressOutcome::NoContact);
        };
        let height_mm = contact.pose.position.z.0;
        let height = Millimetre(height_mm);
        (self.events)(&Event::Contact { height });
        match &press.motion {
            Motion::Indent(_) => self.indent(planned, height_mm, gathered),
            Motion::Touch | Motion::Rest { .. } => {
                let rested = self.tip.settle()?;
                self.sample(planned, Spot::reached(0, 0.0), rested, gathered)?;
                Ok(PressOutcome::Complete)
            }
        }
    }

    fn sample(
        &mut self,
        planned: &PlannedPress,
        spot: Spot,
        before: Look,
        gathered: &mut Gathered,
    ) -> Step<()> {
        let camera = self.camera.as_mut().filter(|_| planned.frames);
        let observed = sample::observe(before, &mut self.tip, camera, self.events)?;
        let sample = sample::sample(planned, spot, observed, &self.plan.channels);
        gathered.samples.push(sample);
        (self.events)(&Event::Sampled {
            number: gathered.samples.len() - 1,
        });
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use taceva_core::{
        Axes, Deadline, DriverError, ForceTransducer, Frame, SinkError, Stamp, Wrench,
    };

    use super::rig::{Rig, nothing, plan};
    use super::*;

    /// What was asked of the devices, in order.
    type Asked = Arc<Mutex<Vec<String>>>;

    fn note(asked: &Asked, what: &str) {
        asked.lock().expect("whole").push(what.to_owned());
    }

    struct Transducer(Rig, Asked);

    impl ForceTransducer for Transducer {
        fn axes(&self) -> Axes {
            Axes::FORCE
        }
        fn start(&mut self, _: Deadline) -> Result<(), DriverError> {
            note(&self.1, "start");
            Ok(())
        }
        fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
            self.0.read(deadline)
        }
        fn stop(&mut self) -> Result<(), DriverError> {
            note(&self.1, "stop");
            Ok(())
        }
    }

    struct Lamps(Asked);

    impl Lighting for Lamps {
        fn scenes(&self) -> &[String] {
            &[]
        }
        fn set(&mut self, scene: &str, _: Deadline) -> Result<(), DriverError> {
            note(&self.0, scene);
            Ok(())
        }
    }

    struct Nowhere;

    impl PressLog for Nowhere {
        fn is_finished(&self, _: ContentId) -> bool {
            false
        }
        fn append(&mut self, _: &PressRecord) -> Result<(), SinkError> {
            Ok(())
        }
        fn untouched(&mut self, _: &Frame) -> Result<(), SinkError> {
            Ok(())
        }
    }

    #[test]
    fn light_is_set_where_it_changes_and_the_transducer_is_stopped_at_the_end() {
        let mut plan = plan();
        plan.presses.truncate(3);
        for (planned, light) in plan.presses.iter_mut().zip(["S1", "S1", "S2"]) {
            planned.frames = false;
            planned.press.unit = "a".to_owned();
            planned.press.place = [Nanometre(0); 2];
            planned.press.specimen = Specimen::Sphere {
                radius: Nanometre(4_000_000),
            };
            planned.press.light = Some(light.to_owned());
            planned.press.motion = Motion::Rest { frames: 1 };
        }
        let spec = RunSpec {
            plan: &plan,
            unit: "a",
            mode: Mode::Acquire,
        };
        let (asked, mut rig) = (Asked::default(), Rig::new(-3.0, nothing));
        let mut force = Transducer(rig.clone(), asked.clone());
        let (mut lamps, mut clock) = (Lamps(asked.clone()), rig.clone());
        let devices = Devices {
            robot: &mut rig,
            force: &mut force,
            sensor: None,
            lighting: Some(&mut lamps),
            specimens: None,
        };
        let controls = Controls {
            clock: &mut clock,
            cancel: &Cancel::new(),
            events: &mut |_| {},
        };
        let report = run(&spec, devices, &mut Nowhere, controls).expect("nothing in the way");
        assert_eq!((report.made, report.samples), (3, 3));
        let asked = asked.lock().expect("whole");
        assert_eq!(*asked, ["start", "S1", "S2", "stop"]);
    }
}
