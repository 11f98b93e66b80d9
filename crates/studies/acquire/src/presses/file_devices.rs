//! Devices of a rig file without a scene, for setting up and checking a rig.

use std::path::Path;

use taceva_core::{
    Deadline, Descriptor, Device, DriverKind, DriverSource, ForceTransducer, Registry, Rig, Robot,
    Sensor,
};
use taceva_drivers::{Drivers, OpenError};
use taceva_protocol::{RigFile, SceneProblem, Setting};

use super::device::Opened;
use super::devices::{FIRST_POSE, Opener, written_latencies_ms};
use super::registration::{Registered, Turned};
use crate::error::AcquireError;
use crate::scene::RigSpec;

/// An open device and its descriptor.
type Described<D> = (Box<D>, Descriptor);

/// Open devices of a rig file, in the frame of the sensor.
pub(crate) struct FileDevices {
    pub(crate) robot: Option<Described<dyn Robot>>,
    pub(crate) force: Option<Described<dyn ForceTransducer>>,
    pub(crate) sensor: Option<Described<dyn Sensor>>,
}

/// Opens devices of a rig file.
pub(crate) struct FileOpener<'a> {
    rig: &'a RigFile,
    spec: RigSpec,
    drivers: &'a Drivers,
}

impl<'a> FileOpener<'a> {
    /// Creates an opener for the devices of `rig`.
    pub(crate) fn new(rig: &'a RigFile, drivers: &'a Drivers) -> FileOpener<'a> {
        let folder = Path::new(rig.name()).parent().unwrap_or(Path::new(""));
        let spec = RigSpec::of_file(rig, folder);
        FileOpener { rig, spec, drivers }
    }

    /// Opens all devices, mapped into the frame of the sensor.
    ///
    /// # Errors
    /// [`AcquireError::Scene`] for an invalid driver or argument, [`AcquireError::OpenOfRig`] if a device does not open.
    pub(crate) fn all(&self) -> Result<FileDevices, AcquireError> {
        let [_, force_latency, sensor_latency] = written_latencies_ms(self.rig);
        let sensor = self.open(&self.drivers.sensors, self.spec.sensor.as_ref())?;
        let sensor = sensor.map(|sensor| {
            let descriptor = sensor.descriptor.clone();
            let of_facts = |facts: &Descriptor| sensor_latency.or(facts.sensor()?.latency_ms);
            (sensor.timely(self.rig.simulated, of_facts), descriptor)
        });
        let robot = match (self.base_robot()?, &self.rig.robot) {
            (Some((robot, descriptor)), Some(registered)) => {
                let deadline = Deadline::after(FIRST_POSE);
                let mapped = Registered::new(robot, registered, deadline);
                let mapped = mapped
                    .map_err(|error| self.failed(DriverKind::Robot, OpenError::Device(error)))?;
                let mapped: Box<dyn Robot> = Box::new(mapped);
                Some((mapped, descriptor))
            }
            _ => None,
        };
        let mounted = self.rig.force.as_ref();
        let force = self.open(&self.drivers.forces, self.spec.force.as_ref())?;
        let force = force.zip(mounted).map(|(force, mounted)| {
            let descriptor = force.descriptor.clone();
            let of_facts = |facts: &Descriptor| force_latency.or(facts.force()?.latency_ms);
            let turned = Turned::new(
                force.timely(self.rig.simulated, of_facts),
                mounted.axes.value,
            );
            let turned: Box<dyn ForceTransducer> = Box::new(turned);
            (turned, descriptor)
        });
        Ok(FileDevices {
            robot,
            force,
            sensor,
        })
    }

    /// Opens the robot in its base frame.
    ///
    /// # Errors
    /// As [`all`](FileOpener::all).
    pub(crate) fn base_robot(&self) -> Result<Option<Described<dyn Robot>>, AcquireError> {
        let [latency_ms, ..] = written_latencies_ms(self.rig);
        let robot = self.open(&self.drivers.robots, self.spec.robot.as_ref())?;
        Ok(robot.map(|robot| {
            let descriptor = robot.descriptor.clone();
            let of_facts = |facts: &Descriptor| latency_ms.or(facts.robot()?.latency_ms);
            (robot.timely(self.rig.simulated, of_facts), descriptor)
        }))
    }

    fn open<D: Device + ?Sized>(
        &self,
        registry: &Registry<D>,
        device: Option<&Setting<String>>,
    ) -> Result<Option<Opened<D>>, AcquireError> {
        let Some(device) = device else {
            return Ok(None);
        };
        let refused = |(at, problem): (Option<usize>, SceneProblem)| {
            AcquireError::from(self.rig.error(at, problem))
        };
        let selector = self.spec.selector(registry, device, "1").map_err(refused)?;
        let factory = registry.get(selector.driver());
        let source = factory.map(|factory| factory.descriptor().source());
        if source.is_ok_and(|source| source != DriverSource::Real) {
            let problem = format!(
                "`{}` is simulated in the program: there is nothing to set up",
                taceva_core::shown(&device.value)
            );
            return Err(refused((device.at(), SceneProblem::Contradiction(problem))));
        }
        let opener = Opener {
            rig: &self.spec,
            unit: "1",
        };
        let opened = opener.open(registry, Some(device), &mut Rig::new());
        opened.map_err(|error| self.failed(D::KIND, error))
    }

    fn failed(&self, device: DriverKind, source: OpenError) -> AcquireError {
        AcquireError::OpenOfRig {
            rig: self.rig.name().to_owned(),
            device,
            source: Box::new(source),
        }
    }
}
