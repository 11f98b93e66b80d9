//! Driver whose devices are objects of a Python class.

use pyo3::prelude::*;
use taceva_core::{
    Args, Changer, Descriptor, DriverError, DriverKind, Factory, ForceTransducer, Found, Lighting,
    Rig, Robot, Sensor,
};
use taceva_plugin::Made;

use super::changer::PythonChanger;
use super::failure::{Doing, device_error};
use super::force::PythonForce;
use super::lighting::PythonLighting;
use super::objects::{Object, keywords};
use super::robot::PythonRobot;
use super::sensor::PythonSensor;

/// Driver whose devices are objects of a Python class.
pub(super) struct PythonDriver {
    descriptor: Descriptor,
    class: Py<PyAny>,
}

impl PythonDriver {
    /// Driver of the Python class `class`; `None` for a kind of device that is newer than this version.
    pub(super) fn made(descriptor: Descriptor, class: Py<PyAny>) -> Option<Made> {
        let kind = descriptor.kind();
        let driver = PythonDriver { descriptor, class };
        match kind {
            DriverKind::Sensor => Some(Made::Sensor(Box::new(driver))),
            DriverKind::Robot => Some(Made::Robot(Box::new(driver))),
            DriverKind::Force => Some(Made::Force(Box::new(driver))),
            DriverKind::Lighting => Some(Made::Lighting(Box::new(driver))),
            DriverKind::Changer => Some(Made::Changer(Box::new(driver))),
            _ => None,
        }
    }

    /// Creates an object of the class from `args`.
    fn object(&self, args: &Args) -> Result<Object, DriverError> {
        const DOING: Doing = Doing::Opening("open the device");
        let key = self.descriptor.key();
        Python::attach(|py| {
            let made = keywords(py, self.descriptor.arguments(), args)
                .and_then(|given| self.class.call(py, (), Some(&given)));
            let object = made.map_err(|error| device_error(py, &error, key, DOING))?;
            Ok(Object::new(key.clone(), object))
        })
    }

    /// Devices that `discover` of the class finds, if the class has that method.
    fn found(&self) -> Result<Vec<Found>, DriverError> {
        const DOING: Doing = Doing::Working("look for devices");
        let key = self.descriptor.key();
        Python::attach(|py| {
            let found = || -> PyResult<Vec<String>> {
                match self.class.bind(py).getattr_opt("discover")? {
                    Some(discover) => discover.call0()?.extract(),
                    None => Ok(Vec::new()),
                }
            };
            let found = found().map_err(|error| device_error(py, &error, key, DOING))?;
            let title = self.descriptor.title();
            let found = found.into_iter().map(|arguments| {
                Found::new(key.clone(), title.to_owned()).with_arguments(arguments)
            });
            Ok(found.collect())
        })
    }
}

macro_rules! factories {
    ($($device:ty => $made:expr),* $(,)?) => {$(
        impl Factory<$device> for PythonDriver {
            fn descriptor(&self) -> &Descriptor {
                &self.descriptor
            }

            fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<$device>, DriverError> {
                let object = self.object(args)?;
                Ok(Box::new($made(object, &self.descriptor)?))
            }

            fn discover(&self) -> Result<Vec<Found>, DriverError> {
                self.found()
            }
        }
    )*};
}

factories! {
    dyn Sensor => PythonSensor::new,
    dyn Robot => PythonRobot::new,
    dyn ForceTransducer => PythonForce::new,
    dyn Lighting => PythonLighting::new,
    dyn Changer => PythonChanger::new,
}
