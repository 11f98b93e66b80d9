//! The devices of a rig, opened for one unit of the sensor and lent to a run.

use std::sync::Arc;

use taceva_core::{
    Device, DriverError, DriverKey, DriverSource, ErrorKind, ForceTransducer, Lighting, Registry,
    Rig, Robot, Sensor,
};
use taceva_drivers::{Drivers, OnBench, OpenError, Selector, open};
use taceva_protocol::{Devices, Setting, StopCause, Timekeeper};

use super::workshop::{Surroundings, Workshop};
use crate::error::StudyError;
use crate::scene::{PlannedStudy, RigSpec};

/// Devices that are open.
pub(super) struct OpenRig {
    sensor: Option<Box<dyn Sensor>>,
    robot: Box<dyn Robot>,
    force: Box<dyn ForceTransducer>,
    lighting: Option<Box<dyn Lighting>>,
    pub(super) surroundings: Surroundings,
}

impl OpenRig {
    /// Opens the devices of `rig` for `unit`, the sensor first.
    pub(super) fn open(
        study: &PlannedStudy,
        rig: &RigSpec,
        unit: &str,
        workshop: Workshop<'_>,
    ) -> Result<OpenRig, StudyError> {
        let failed = |source: OpenError| StudyError::Open {
            study: study.plan.name.clone(),
            source: Box::new(source),
        };
        let Drivers {
            sensors,
            robots,
            forces,
            lightings,
        } = workshop.drivers;
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
        let (Some((robot, selector)), Some((force, _))) = (robot, force) else {
            let needed = "a robot and a force transducer: what it measures is pressed";
            return Err(StudyError::Request(format!(
                "study `{}` needs {needed}",
                study.plan.name
            )));
        };
        let surroundings = (workshop.surroundings)(&selector, &mut shared)
            .ok_or_else(|| failed(OpenError::Device(without_clock(&selector))))?;
        let sensor = sensor.map(|(sensor, own)| match &surroundings.bench {
            Some(bench) if own.bench() != selector.bench() => {
                Box::new(OnBench::new(sensor, Arc::clone(bench)))
            }
            _ => sensor,
        });
        Ok(OpenRig {
            sensor,
            robot,
            force,
            lighting: lighting.map(|(lighting, _)| lighting),
            surroundings,
        })
    }

    /// The devices and the clock, lent for one run.
    pub(super) fn lend(&mut self) -> (Devices<'_>, &mut dyn Timekeeper) {
        let devices = Devices {
            robot: &mut *self.robot,
            force: &mut *self.force,
            sensor: match &mut self.sensor {
                Some(sensor) => Some(&mut **sensor),
                None => None,
            },
            lighting: match &mut self.lighting {
                Some(lighting) => Some(&mut **lighting),
                None => None,
            },
            specimens: match &mut self.surroundings.specimens {
                Some(specimens) => Some(&mut **specimens),
                None => None,
            },
        };
        (devices, &mut *self.surroundings.clock)
    }
}

/// Opens devices for one unit.
struct Opener<'a> {
    rig: &'a RigSpec,
    unit: &'a str,
}

impl Opener<'_> {
    fn open<D: Device + ?Sized>(
        &self,
        registry: &Registry<D>,
        device: Option<&Setting<String>>,
        shared: &mut Rig,
    ) -> Result<Option<(Box<D>, Selector)>, OpenError> {
        let Some(device) = device else {
            return Ok(None);
        };
        let selector = self
            .rig
            .selector(registry, device, self.unit)
            .expect("the selector was read when the scene was planned");
        let opened = open(registry, &selector, shared)?;
        Ok(Some((opened, selector)))
    }
}

impl RigSpec {
    /// Whether a device of it is simulated: then nothing that it records was measured.
    pub(super) fn is_simulated(&self, drivers: &Drivers) -> bool {
        self.sources(drivers)
            .any(|source| source == DriverSource::Simulated)
    }

    /// Whether every device of it is simulated: then it may be opened just to be asked for facts.
    pub(super) fn is_only_simulated(&self, drivers: &Drivers) -> bool {
        self.sources(drivers)
            .all(|source| source == DriverSource::Simulated)
    }

    /// What each of its devices is.
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

/// A rig cannot run without the clock of its stamps.
fn without_clock(robot: &Selector) -> DriverError {
    let key: Result<DriverKey, _> = robot.driver().parse();
    let key = key.expect("it was opened by this key");
    let why =
        StopCause::Missing("the clock of this robot, which this program does not know".to_owned());
    DriverError::new(ErrorKind::Unsupported, &key, "conduct a run").because(why.to_string())
}
