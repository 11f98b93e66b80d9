//! Session of the drivers that are linked into a program. A child that loads no library serves this session.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use taceva_core::{
    Args, Changer, Descriptor, Device, DriverError, DriverKey, ErrorKind, Factory, ForceTransducer,
    Found, Lighting, ModelError, Registry, RegistryError, Rig, Robot, Sensor, SimulatedBench,
};
use taceva_host::{FitRequest, Offer, Saved, SavedRegressor, Session};

/// Linked drivers of this program, and the only rig of this process.
pub(crate) struct BuiltIn {
    pub(crate) sensors: Registry<dyn Sensor>,
    pub(crate) robots: Registry<dyn Robot>,
    pub(crate) force_transducers: Registry<dyn ForceTransducer>,
    pub(crate) lightings: Registry<dyn Lighting>,
    pub(crate) changers: Registry<dyn Changer>,
    /// Function that fits an estimator.
    pub(crate) fit: fn(&DriverKey, &FitRequest<'_>) -> Made,
    /// Function that loads a model.
    pub(crate) load: fn(&DriverKey, &Saved<'_>) -> Made,
    rig: Mutex<Rig>,
}

impl BuiltIn {
    /// Collects the drivers that crates submitted.
    pub(crate) fn new() -> Result<BuiltIn, RegistryError> {
        Ok(BuiltIn {
            sensors: Registry::builtin()?,
            robots: Registry::builtin()?,
            force_transducers: Registry::builtin()?,
            lightings: Registry::builtin()?,
            changers: Registry::builtin()?,
            fit: |_, _| nothing(),
            load: |_, _| nothing(),
            rig: Mutex::new(Rig::new()),
        })
    }

    fn rig(&self) -> MutexGuard<'_, Rig> {
        self.rig.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn find<'a, D: Device + ?Sized>(
    registry: &'a Registry<D>,
    driver: &DriverKey,
) -> Result<&'a dyn Factory<D>, DriverError> {
    registry.get(driver.as_str()).map_err(|error| {
        DriverError::new(ErrorKind::NotFound, driver, "find the driver").because(error)
    })
}

impl Session for BuiltIn {
    fn offer(&self) -> Result<Offer, DriverError> {
        let whole = DriverKey::fixed("built-in");
        Err(DriverError::new(
            ErrorKind::Unsupported,
            &whole,
            "list its offer",
        ))
    }

    fn describe(&self, driver: &DriverKey, args: &Args) -> Result<Descriptor, DriverError> {
        let described = find(&self.sensors, driver)?.describe(args);
        described.map_err(|error| {
            DriverError::new(ErrorKind::InvalidArgument, driver, "describe itself").because(error)
        })
    }

    fn discover(&self, driver: &DriverKey) -> Result<Vec<Found>, DriverError> {
        find(&self.sensors, driver)?.discover()
    }

    fn sensor(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Sensor>, DriverError> {
        find(&self.sensors, driver)?.open(args, &mut self.rig())
    }

    fn robot(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Robot>, DriverError> {
        find(&self.robots, driver)?.open(args, &mut self.rig())
    }

    fn force(
        &self,
        driver: &DriverKey,
        args: &Args,
    ) -> Result<Box<dyn ForceTransducer>, DriverError> {
        find(&self.force_transducers, driver)?.open(args, &mut self.rig())
    }

    fn lighting(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Lighting>, DriverError> {
        find(&self.lightings, driver)?.open(args, &mut self.rig())
    }

    fn changer(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Changer>, DriverError> {
        find(&self.changers, driver)?.open(args, &mut self.rig())
    }

    fn bench(&self, name: &str) -> Option<Arc<dyn SimulatedBench>> {
        self.rig().bench(&format!("sim {name}"))
    }

    fn fit(
        &self,
        estimator: &DriverKey,
        request: &FitRequest<'_>,
    ) -> Result<Box<dyn SavedRegressor>, ModelError> {
        (self.fit)(estimator, request)
    }

    fn load(
        &self,
        estimator: &DriverKey,
        saved: &Saved<'_>,
    ) -> Result<Box<dyn SavedRegressor>, ModelError> {
        (self.load)(estimator, saved)
    }
}

type Made = Result<Box<dyn SavedRegressor>, ModelError>;

fn nothing() -> Made {
    let error = ModelError::new(ErrorKind::NotFound, "a bench has no estimator");
    Err(error)
}
