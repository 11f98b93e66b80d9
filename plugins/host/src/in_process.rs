//! Session with a plugin in this process, which is the host for a trusted plugin, otherwise a confined child.

use std::sync::Arc;

use taceva_core::{
    Args, Changer, Descriptor, DriverError, DriverKey, ErrorKind, ForceTransducer, Found, Lighting,
    ModelError, Robot, Sensor, SimulatedBench,
};

use crate::call::{ArgList, Failure};
use crate::device::{
    PluginBench, PluginChanger, PluginDevice, PluginForce, PluginLighting, PluginRobot,
    PluginSensor, RigHandle, open,
};
use crate::estimator;
use crate::library::{Library, Place};
use crate::offer::Offer;
use crate::session::{FitRequest, Saved, SavedRegressor, Session};

/// Session in this process: one rig of a loaded library.
pub struct InProcess {
    rig: Arc<RigHandle>,
}

impl InProcess {
    /// Opens a session of `library` with its own rig.
    ///
    /// # Errors
    /// [`DriverError`] if the plugin cannot open a rig.
    pub fn open(library: &Arc<Library>) -> Result<InProcess, DriverError> {
        let rig = RigHandle::open(library)?;
        Ok(InProcess { rig })
    }

    /// Opens a sensor as a type that can lend frames.
    ///
    /// # Errors
    /// As [`Session::sensor`].
    pub fn open_sensor(
        &self,
        driver: &DriverKey,
        args: &Args,
    ) -> Result<PluginSensor, DriverError> {
        self.open_device(driver, args)
    }

    /// Opens a device of kind `D`. The library describes the device for these arguments.
    fn open_device<D: PluginDevice>(
        &self,
        driver: &DriverKey,
        args: &Args,
    ) -> Result<D, DriverError> {
        let library = self.rig.library();
        let entry = library.entry(driver, Place::Driver(D::KIND), OPENING)?;
        let list = ArgList::new(args, entry.arguments());
        let said = entry
            .describe(library.id(), args)
            .map_err(|failure| failure.of(driver, OPENING))?;
        let facts = D::facts(said.facts()).ok_or_else(|| other_kind(&said))?;
        D::new(open(&self.rig, entry, &list)?, facts)
    }
}

const OPENING: &str = "open the device";

fn other_kind(said: &Descriptor) -> DriverError {
    let why = format!(
        "with these arguments it describes itself as a {} driver",
        said.kind()
    );
    Failure::new(ErrorKind::Abi, why).of(said.key(), OPENING)
}

impl Session for InProcess {
    fn offer(&self) -> Result<Offer, DriverError> {
        let library = self.rig.library();
        let offer = library.offer();
        offer.map_err(|problem| {
            let doing = "list its offer";
            let whole = library.id().as_driver();
            DriverError::new(problem.kind(), &whole, doing).because(problem.to_string())
        })
    }

    fn describe(&self, driver: &DriverKey, args: &Args) -> Result<Descriptor, DriverError> {
        const DOING: &str = "describe the device";
        let library = self.rig.library();
        let entry = library.driver(driver, DOING)?;
        entry
            .describe(library.id(), args)
            .map_err(|failure| failure.of(driver, DOING))
    }

    fn discover(&self, driver: &DriverKey) -> Result<Vec<Found>, DriverError> {
        const DOING: &str = "look for devices";
        let entry = self.rig.library().driver(driver, DOING)?;
        let Some(texts) = entry.discover().transpose() else {
            return Ok(Vec::new());
        };
        let texts = texts.map_err(|failure| failure.of(driver, DOING))?;
        if let Some(text) = texts.iter().find(|text| text.contains(char::is_control)) {
            let why = format!(
                "{:?} has a control character, which the arguments of a device may not contain",
                crate::text::shown(text)
            );
            return Err(Failure::new(ErrorKind::Protocol, why).of(driver, DOING));
        }
        let title = match &entry.provided {
            crate::Provided::Driver { descriptor, .. } => descriptor.title(),
            crate::Provided::Estimator(estimator) => &estimator.title,
        };
        let found = texts.into_iter().map(|arguments| {
            Found::new(driver.clone(), title.to_owned()).with_arguments(arguments)
        });
        Ok(found.collect())
    }

    fn sensor(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Sensor>, DriverError> {
        Ok(Box::new(self.open_sensor(driver, args)?))
    }

    fn robot(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Robot>, DriverError> {
        Ok(Box::new(self.open_device::<PluginRobot>(driver, args)?))
    }

    fn force(
        &self,
        driver: &DriverKey,
        args: &Args,
    ) -> Result<Box<dyn ForceTransducer>, DriverError> {
        Ok(Box::new(self.open_device::<PluginForce>(driver, args)?))
    }

    fn lighting(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Lighting>, DriverError> {
        Ok(Box::new(self.open_device::<PluginLighting>(driver, args)?))
    }

    fn changer(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Changer>, DriverError> {
        Ok(Box::new(self.open_device::<PluginChanger>(driver, args)?))
    }

    fn bench(&self, name: &str) -> Option<Arc<dyn SimulatedBench>> {
        let bench = PluginBench::of(&self.rig, name)?;
        Some(Arc::new(bench))
    }

    fn fit(
        &self,
        estimator: &DriverKey,
        request: &FitRequest<'_>,
    ) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let library = self.rig.library();
        let entry = library.entry(estimator, Place::Estimator, "fit");
        let entry = entry.map_err(|_| estimator::not_there(estimator, library, "fit"))?;
        estimator::fit(library, entry, request)
    }

    fn load(
        &self,
        estimator: &DriverKey,
        saved: &Saved<'_>,
    ) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let library = self.rig.library();
        let entry = library.entry(estimator, Place::Estimator, "load");
        let entry = entry.map_err(|_| estimator::not_there(estimator, library, "load"))?;
        estimator::load(library, entry, saved)
    }
}
