//! Devices of a rig, opened for one unit of the sensor and used by a run.

use std::sync::{Arc, PoisonError};
use std::time::Duration;

use taceva_core::{
    Deadline, Device, DriverError, DriverKey, DriverSource, EnablingSwitch, ErrorKind,
    ForceTransducer, Lighting, Registry, Rig, Robot, Sensor,
};
use taceva_drivers::{Drivers, OnBench, OpenError, Selector};
use taceva_protocol::{
    Cancel, Controls, Devices, Event, Oversight, Plan, PressLog, ReferenceTouch, RigFile, RunError,
    RunReport, RunSpec, SessionSpec, Setting, SharedSupervisor, StopCause, raise, run, run_guarded,
};

use super::changers::{OfSpecimens, OpenChanger};
use super::device::Opened;
use super::guardian::Guarded;
use super::latency::written_latencies_ms;
use super::registration::{Registered, Turned};
use super::viewed_sensor::Seen;
use super::workshop::{Surroundings, Workshop};
use crate::error::AcquireError;
use crate::scene::{PlannedStudy, RigSpec, check_taught, open_switch};

/// Deadline for the first pose of a robot.
pub(super) const FIRST_POSE: Duration = Duration::from_secs(2);

/// Open devices of a rig.
pub(super) struct OpenRig {
    pub(super) sensor: Option<Box<dyn Sensor>>,
    pub(super) robot: Box<dyn Robot>,
    pub(super) force: Box<dyn ForceTransducer>,
    lighting: Option<Box<dyn Lighting>>,
    pub(super) surroundings: Surroundings,
    pub(super) force_driver: DriverKey,
    /// True for real devices. Guard threads then watch motions.
    is_real: bool,
    /// Rig file of a real rig, checked at the start of a session; `None` for other rigs.
    pub(super) rig_file: Option<Arc<RigFile>>,
    /// Enabling switch, if the rig has one.
    pub(super) switch: Option<Arc<dyn EnablingSwitch>>,
    /// Warning about late halts of the last session; `None` if no halt was late.
    pub(super) late_halts: Option<String>,
}

/// A session at a rig: environment, cancellation flag, and state from earlier units.
#[derive(Clone, Copy)]
pub(super) struct Sitting<'a> {
    pub(super) workshop: Workshop<'a>,
    pub(super) cancel: &'a Cancel,
    /// True if the operator has enabled the robot in this process.
    pub(super) is_enabled: bool,
    /// Measurements of the gel at reference places in earlier sessions of the recording.
    pub(super) touched: &'a [ReferenceTouch],
}

impl<'a> Sitting<'a> {
    /// Creates a session whose robot is not yet enabled, and which has no earlier reference touches.
    pub(super) fn new(workshop: Workshop<'a>, cancel: &'a Cancel) -> Sitting<'a> {
        Sitting {
            workshop,
            cancel,
            is_enabled: false,
            touched: &[],
        }
    }
}

impl OpenRig {
    /// Opens the devices of `rig` for `unit`. The switch and the sensor are opened first.
    pub(super) fn open(
        study: &PlannedStudy,
        rig: &RigSpec,
        unit: &str,
        sitting: Sitting<'_>,
    ) -> Result<OpenRig, AcquireError> {
        let workshop = sitting.workshop;
        let failed = |source: OpenError| AcquireError::Open {
            study: study.plan.name.clone(),
            source: Box::new(source),
        };
        let Drivers {
            sensors,
            robots,
            forces,
            lightings,
            changers: _,
            switches: _,
        } = workshop.drivers;
        let rig_file = study.study.rig.as_deref();
        if let Some(rig) = rig_file {
            check_taught(rig, workshop.drivers)?;
        }
        // The switch comes first: without it, no moving device is opened.
        let switch = rig_file.map(|rig| open_switch(rig, workshop.drivers));
        let switch = switch.transpose().map_err(AcquireError::from)?.flatten();
        let opener = Opener { rig, unit };
        let mut shared = Rig::new();
        let sensor = opener.open(sensors, rig.sensor.as_ref(), &mut shared);
        let sensor = sensor.map_err(failed)?;
        let robot = opener.open(robots, rig.robot.as_ref(), &mut shared);
        let robot = robot.map_err(failed)?;
        let force = opener.open(forces, rig.force.as_ref(), &mut shared);
        let force = force.map_err(failed)?;
        let lighting = opener.open(lightings, rig.lighting.as_ref(), &mut shared);
        let lighting = lighting.map_err(failed)?;
        let (Some(robot), Some(force)) = (robot, force) else {
            let needed = "a robot and a force transducer, since its metrics need presses";
            return Err(AcquireError::Request(format!(
                "study `{}` needs {needed}",
                study.plan.name
            )));
        };
        let selector = &robot.selector;
        let is_real = robot.descriptor.source() == DriverSource::Real;
        let mut surroundings = match is_real {
            true => Surroundings::real(),
            false => (workshop.surroundings)(selector, &mut shared)
                .ok_or_else(|| failed(OpenError::Device(without_clock(selector))))?,
        };
        if let Some(rig_file) = rig_file.filter(|_| rig.changes) {
            let specimen = rig_file.changers.specimen.as_ref();
            let opened = OpenChanger::open(rig, rig_file, specimen, workshop.drivers);
            if let Some(changer) = opened.map_err(failed)? {
                let cancel = sitting.cancel.clone();
                surroundings.specimens = Some(Box::new(OfSpecimens { changer, cancel }));
            }
        }
        let [robot_latency, force_latency, sensor_latency] =
            rig_file.map_or([None; 3], written_latencies_ms);
        let is_emulated = rig_file.is_some_and(|rig| rig.simulated);
        let sensor = sensor.map(|sensor| match &surroundings.bench {
            Some(bench) if sensor.selector.bench() != selector.bench() => {
                let sensor = sensor.timely(is_emulated, |_| None);
                Box::new(OnBench::new(sensor, Arc::clone(bench)))
            }
            _ => sensor.timely(is_emulated, |facts| {
                sensor_latency.or(facts.sensor()?.latency_ms)
            }),
        });
        let sensor = match (sensor, workshop.viewer) {
            (Some(sensor), Some(viewer)) => {
                let seen = Seen::new(sensor, Arc::clone(viewer));
                Some(Box::new(seen) as Box<dyn Sensor>)
            }
            (sensor, _) => sensor,
        };
        let force_driver = force.descriptor.key().clone();
        let mut robot = robot.timely(is_emulated, |facts| {
            robot_latency.or(facts.robot()?.latency_ms)
        });
        if let Some(registered) = rig_file.and_then(|rig| rig.robot.as_ref()) {
            let deadline = Deadline::after(FIRST_POSE);
            let mapped = Registered::new(robot, registered, deadline);
            robot = Box::new(mapped.map_err(|error| failed(OpenError::Device(error)))?);
        }
        let mut force = force.timely(is_emulated, |facts| {
            force_latency.or(facts.force()?.latency_ms)
        });
        if let Some(mounted) = rig_file.and_then(|rig| rig.force.as_ref()) {
            force = Box::new(Turned::new(force, mounted.axes.value));
        }
        Ok(OpenRig {
            force_driver,
            is_real,
            rig_file: study.study.rig.clone(),
            switch,
            sensor,
            robot,
            force,
            lighting: lighting.map(|lighting| lighting.device),
            surroundings,
            late_halts: None,
        })
    }

    /// Raises the tip of a real rig while guard threads watch the robot, and then halts the robot. An operator can then reach in. Returns true if the
    /// tip moved.
    ///
    /// # Errors
    /// Errors of [`raise`](taceva_protocol::raise).
    pub(super) fn raise(&mut self, plan: &Plan, sitting: Sitting<'_>) -> Result<bool, RunError> {
        let Sitting {
            workshop, cancel, ..
        } = sitting;
        let Some(limits) = plan.limits.clone() else {
            return Ok(false);
        };
        let operator = workshop.operator;
        let mut operator =
            operator.map(|operator| operator.lock().unwrap_or_else(PoisonError::into_inner));
        let rig_file = self.rig_file.as_deref();
        let robot_name = rig_file.and_then(|rig| to_be_enabled(rig, sitting.is_enabled));
        let clock = &mut *self.surroundings.clock;
        let guarded = Guarded {
            robot: &mut *self.robot,
            force: &mut *self.force,
            driver: self.force_driver.clone(),
            limits,
            switch: self.switch.as_deref(),
            cancel,
            progress: workshop.progress,
            viewer: workshop.viewer.map(|viewer| &**viewer),
        };
        let (raised, _) = guarded.conduct(|robot, force, supervisor| {
            let controls = Controls {
                clock,
                cancel,
                events: &mut |_| {},
                operator: match &mut operator {
                    Some(operator) => Some(&mut **operator),
                    None => None,
                },
            };
            let patience_s = rig_file.map_or(0.0, RigFile::patience_s);
            raise(
                plan, robot, force, controls, supervisor, robot_name, patience_s,
            )
        });
        raised
    }

    /// Makes the presses of `spec`. A guard is used if the rig is real.
    ///
    /// # Errors
    /// Errors of [`run`](taceva_protocol::run).
    pub(super) fn conduct(
        &mut self,
        spec: &RunSpec<'_>,
        log: &mut dyn PressLog,
        sitting: Sitting<'_>,
        events: &mut dyn FnMut(&Event),
    ) -> Result<RunReport, RunError> {
        let Sitting {
            workshop, cancel, ..
        } = sitting;
        let operator = workshop.operator.filter(|_| self.is_real);
        let mut operator =
            operator.map(|operator| operator.lock().unwrap_or_else(PoisonError::into_inner));
        let OpenRig {
            sensor,
            robot,
            force,
            lighting,
            surroundings,
            force_driver,
            is_real,
            rig_file,
            switch,
            late_halts,
        } = self;
        let session = rig_file.as_deref().map(|rig| SessionSpec {
            rig,
            robot: to_be_enabled(rig, sitting.is_enabled),
            touched: sitting.touched,
        });
        let mut act = |robot: &mut dyn Robot,
                       force: &mut dyn ForceTransducer,
                       guard: Option<SharedSupervisor>| {
            let devices = Devices {
                robot,
                force,
                sensor: match sensor {
                    Some(sensor) => Some(&mut **sensor),
                    None => None,
                },
                lighting: match lighting {
                    Some(lighting) => Some(&mut **lighting),
                    None => None,
                },
                specimens: match &mut surroundings.specimens {
                    Some(specimens) => Some(&mut **specimens),
                    None => None,
                },
            };
            let controls = Controls {
                clock: &mut *surroundings.clock,
                cancel,
                events: &mut *events,
                operator: match &mut operator {
                    Some(operator) => Some(&mut **operator),
                    None => None,
                },
            };
            let Some(supervisor) = guard else {
                return run(spec, devices, log, controls);
            };
            let guard = Oversight::new(supervisor);
            let guard = match session.clone() {
                Some(session) => guard.with_session(session),
                None => guard,
            };
            run_guarded(spec, devices, log, controls, guard)
        };
        match spec.plan.limits.clone().filter(|_| *is_real) {
            None => act(&mut **robot, &mut **force, None),
            Some(limits) => {
                let guarded = Guarded {
                    robot: &mut **robot,
                    force: &mut **force,
                    driver: force_driver.clone(),
                    limits,
                    switch: switch.as_deref(),
                    cancel,
                    progress: workshop.progress,
                    viewer: workshop.viewer.map(|viewer| &**viewer),
                };
                let (done, late) =
                    guarded.conduct(|robot, force, guard| act(robot, force, Some(guard)));
                *late_halts = late;
                done
            }
        }
    }
}

/// Driver key of the robot of `rig` that the operator must enable; `None` if the robot is emulated or already enabled.
pub(super) fn to_be_enabled(rig: &RigFile, is_enabled: bool) -> Option<&str> {
    let robot = rig.robot.as_ref();
    let named = robot.filter(|_| !rig.simulated && !is_enabled);
    named.map(|robot| key_of(&robot.driver.value))
}

/// Opener of devices for one unit.
pub(super) struct Opener<'a> {
    pub(super) rig: &'a RigSpec,
    pub(super) unit: &'a str,
}

impl Opener<'_> {
    pub(super) fn open<D: Device + ?Sized>(
        &self,
        registry: &Registry<D>,
        device: Option<&Setting<String>>,
        shared: &mut Rig,
    ) -> Result<Option<Opened<D>>, OpenError> {
        let Some(device) = device else {
            return Ok(None);
        };
        let selector = self
            .rig
            .selector(registry, device, self.unit)
            .expect("the selector was read when the scene was planned");
        Opened::open(registry, selector, shared).map(Some)
    }
}

impl RigSpec {
    /// True if a device is simulated. Recordings are then not measurements.
    pub(super) fn is_simulated(&self, drivers: &Drivers) -> bool {
        self.sources(drivers)
            .any(|source| source == DriverSource::Simulated)
    }

    /// True if all devices are simulated. Such devices may be opened to read their facts, because this affects no real device.
    pub(crate) fn is_only_simulated(&self, drivers: &Drivers) -> bool {
        self.sources(drivers)
            .all(|source| source == DriverSource::Simulated)
    }

    /// Source of each device.
    fn sources(&self, drivers: &Drivers) -> impl Iterator<Item = DriverSource> + use<> {
        fn of<D: Device + ?Sized>(
            registry: &Registry<D>,
            device: Option<&Setting<String>>,
        ) -> Option<DriverSource> {
            let selector: Selector = device?.value.parse().ok()?;
            let factory = registry.get(selector.driver()).ok()?;
            Some(factory.descriptor().source())
        }
        [
            of(&drivers.sensors, self.sensor.as_ref()),
            of(&drivers.robots, self.robot.as_ref()),
            of(&drivers.forces, self.force.as_ref()),
            of(&drivers.lightings, self.lighting.as_ref()),
        ]
        .into_iter()
        .flatten()
    }
}

/// Driver key of a selector: the text before its arguments.
pub(super) fn key_of(selector: &str) -> &str {
    selector.split_once(':').map_or(selector, |(key, _)| key)
}

/// Error for a robot whose clock is unknown to the program.
fn without_clock(robot: &Selector) -> DriverError {
    let key: Result<DriverKey, _> = robot.driver().parse();
    let key = key.expect("the robot was opened by this key");
    let why =
        StopCause::Missing("the clock of this robot, which this program does not know".to_owned());
    DriverError::new(ErrorKind::Unsupported, &key, "conduct a run").because(why.to_string())
}
