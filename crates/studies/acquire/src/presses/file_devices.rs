//! Opens devices of a rig file without a scene, for setup and checks of a rig.

use std::path::Path;

use taceva_core::{
    Deadline, Descriptor, Device, DriverKind, DriverSource, ForceTransducer, Registry, Rig, Robot,
    Sensor,
};
use taceva_drivers::{Drivers, OpenError};
use taceva_protocol::{RigFile, SceneProblem, Setting};

use super::device::Opened;
use super::devices::{FIRST_POSE, Opener};
use super::latency::written_latencies_ms;
use super::registration::{Registered, Turned};
use crate::error::AcquireError;
use crate::scene::{Refused, RigSpec, check_changers};

/// An open device and its descriptor.
type Described<D> = (Box<D>, Descriptor);

/// Opener of the devices in a rig file.
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

    /// Checks driver and arguments of every device. Opens nothing.
    ///
    /// # Errors
    /// [`AcquireError::Scene`] for an invalid driver or argument, with its line.
    pub(crate) fn check(&self) -> Result<(), AcquireError> {
        self.check_device(&self.drivers.sensors, self.spec.sensor.as_ref())?;
        self.check_device(&self.drivers.robots, self.spec.robot.as_ref())?;
        self.check_device(&self.drivers.forces, self.spec.force.as_ref())?;
        check_changers(self.rig, self.drivers)?;
        let light = self.rig.changers.light.as_ref();
        let described = self.spec.describe(&self.drivers.lightings, light, "1");
        described.map(drop).map_err(|refused| self.refused(refused))
    }

    /// Opens the changer `device`, and returns the names of its items; `None` without a `device`. Nothing moves.
    ///
    /// # Errors
    /// [`AcquireError::OpenOfRig`] if the device does not open.
    pub(crate) fn held(
        &self,
        device: Option<&Setting<String>>,
    ) -> Result<Option<Vec<String>>, AcquireError> {
        let opened = self.opened(&self.drivers.changers, device)?;
        Ok(opened.map(|opened| opened.device.holds().to_vec()))
    }

    /// Opens the lighting `device`, and returns the names of its scenes; `None` without a `device`. The light does not change.
    ///
    /// # Errors
    /// Errors of [`held`](FileOpener::held).
    pub(crate) fn scenes(
        &self,
        device: Option<&Setting<String>>,
    ) -> Result<Option<Vec<String>>, AcquireError> {
        let opened = self.opened(&self.drivers.lightings, device)?;
        Ok(opened.map(|opened| opened.device.scenes().to_vec()))
    }

    /// Opens the sensor; `None` without a sensor.
    ///
    /// # Errors
    /// Errors of [`check`](FileOpener::check). [`AcquireError::OpenOfRig`] if the device does not open.
    pub(crate) fn sensor(&self) -> Result<Option<Described<dyn Sensor>>, AcquireError> {
        let [_, _, latency_ms] = written_latencies_ms(self.rig);
        let sensor = self.open(&self.drivers.sensors, self.spec.sensor.as_ref())?;
        Ok(sensor.map(|sensor| {
            let descriptor = sensor.descriptor.clone();
            let of_facts = |facts: &Descriptor| latency_ms.or(facts.sensor()?.latency_ms);
            (sensor.timely(self.rig.simulated, of_facts), descriptor)
        }))
    }

    /// Opens the force transducer, with readings in the frame of the sensor; `None` without a transducer.
    ///
    /// # Errors
    /// Errors of [`sensor`](FileOpener::sensor).
    pub(crate) fn force(&self) -> Result<Option<Described<dyn ForceTransducer>>, AcquireError> {
        let [_, latency_ms, _] = written_latencies_ms(self.rig);
        let mounted = self.rig.force.as_ref();
        let force = self.open(&self.drivers.forces, self.spec.force.as_ref())?;
        Ok(force.zip(mounted).map(|(force, mounted)| {
            let descriptor = force.descriptor.clone();
            let of_facts = |facts: &Descriptor| latency_ms.or(facts.force()?.latency_ms);
            let turned = Turned::new(
                force.timely(self.rig.simulated, of_facts),
                mounted.axes.value,
            );
            let turned: Box<dyn ForceTransducer> = Box::new(turned);
            (turned, descriptor)
        }))
    }

    /// Opens the robot, with poses in the frame of the sensor; `None` without a robot.
    ///
    /// # Errors
    /// Errors of [`sensor`](FileOpener::sensor).
    pub(crate) fn robot(&self) -> Result<Option<Described<dyn Robot>>, AcquireError> {
        let (Some((robot, descriptor)), Some(registered)) = (self.base_robot()?, &self.rig.robot)
        else {
            return Ok(None);
        };
        let mapped = Registered::new(robot, registered, Deadline::after(FIRST_POSE));
        let mapped =
            mapped.map_err(|error| self.failed(DriverKind::Robot, OpenError::Device(error)))?;
        let mapped: Box<dyn Robot> = Box::new(mapped);
        Ok(Some((mapped, descriptor)))
    }

    /// Opens the robot, with poses in its base frame; `None` without a robot.
    ///
    /// # Errors
    /// Errors of [`sensor`](FileOpener::sensor).
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
        self.check_device(registry, device)?;
        self.opened(registry, device)
    }

    /// Opens a device whose selector was already checked; `None` without a device.
    fn opened<D: Device + ?Sized>(
        &self,
        registry: &Registry<D>,
        device: Option<&Setting<String>>,
    ) -> Result<Option<Opened<D>>, AcquireError> {
        let opener = Opener {
            rig: &self.spec,
            unit: "1",
        };
        let opened = opener.open(registry, device, &mut Rig::new());
        opened.map_err(|error| self.failed(D::KIND, error))
    }

    fn check_device<D: Device + ?Sized>(
        &self,
        registry: &Registry<D>,
        device: Option<&Setting<String>>,
    ) -> Result<(), AcquireError> {
        let described = self.spec.describe(registry, device, "1");
        let described = described.map_err(|refused| self.refused(refused))?;
        match device.zip(described) {
            Some((device, described)) if described.source() != DriverSource::Real => {
                let problem = format!(
                    "`{}` is simulated in the program: there is nothing to set up",
                    taceva_core::shown(&device.value)
                );
                let problem = SceneProblem::Contradiction(problem);
                Err(self.refused((device.at(), problem)))
            }
            _ => Ok(()),
        }
    }

    fn refused(&self, refused: Refused) -> AcquireError {
        let (at, problem) = refused;
        AcquireError::from(self.rig.error(at, problem))
    }

    fn failed(&self, device: DriverKind, source: OpenError) -> AcquireError {
        AcquireError::OpenOfRig {
            rig: self.rig.name().to_owned(),
            device,
            source: Box::new(source),
        }
    }
}
