//! Session of a plugin, with one interface for plugins in this process and in a child.

use std::sync::Arc;

use crate::offer::Offer;
use taceva_core::{
    Args, Changer, Descriptor, DriverError, DriverKey, ForceTransducer, Found, Lighting,
    ModelError, Robot, Sensor, SimulatedBench,
};
pub use taceva_core::{FitRequest, Saved, SavedRegressor};

/// A loaded plugin and its open devices: one session per plugin and rig.
///
/// Drivers and estimators are named by their full keys. Open devices keep their resources alive, so the session may be dropped first.
pub trait Session: Send + Sync {
    /// Lists the drivers, estimators and needs of the library, as in a manifest.
    ///
    /// # Errors
    /// [`DriverError`] if the session has no library, or its statements do not fit a manifest.
    fn offer(&self) -> Result<Offer, DriverError>;

    /// Library's description of `driver` with `args`. Accesses no device.
    ///
    /// # Errors
    /// [`DriverError`] of kind `NotFound` for an unknown driver, `InvalidArgument` for contradictory arguments.
    fn describe(&self, driver: &DriverKey, args: &Args) -> Result<Descriptor, DriverError>;

    /// Lists the connected devices of `driver`.
    ///
    /// # Errors
    /// [`DriverError`] if the search itself fails.
    fn discover(&self, driver: &DriverKey) -> Result<Vec<Found>, DriverError>;

    /// Opens a sensor.
    ///
    /// # Errors
    /// As [`Factory::open`](taceva_core::Factory::open).
    fn sensor(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Sensor>, DriverError>;

    /// Opens a robot.
    ///
    /// # Errors
    /// As [`Factory::open`](taceva_core::Factory::open).
    fn robot(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Robot>, DriverError>;

    /// Opens a force transducer.
    ///
    /// # Errors
    /// As [`Factory::open`](taceva_core::Factory::open).
    fn force(
        &self,
        driver: &DriverKey,
        args: &Args,
    ) -> Result<Box<dyn ForceTransducer>, DriverError>;

    /// Opens a lighting device.
    ///
    /// # Errors
    /// As [`Factory::open`](taceva_core::Factory::open).
    fn lighting(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Lighting>, DriverError>;

    /// Opens a changer.
    ///
    /// # Errors
    /// As [`Factory::open`](taceva_core::Factory::open).
    fn changer(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Changer>, DriverError>;

    /// Simulated bench of the devices that were opened with `rig=name`; `None` if the plugin has no such bench.
    fn bench(&self, name: &str) -> Option<Arc<dyn SimulatedBench>>;

    /// Fits `estimator`.
    ///
    /// # Errors
    /// As [`Estimator::fit`](taceva_core::Estimator::fit); `NotFound` for an unknown estimator.
    fn fit(
        &self,
        estimator: &DriverKey,
        request: &FitRequest<'_>,
    ) -> Result<Box<dyn SavedRegressor>, ModelError>;

    /// Loads a model that [`SavedRegressor::save`] saved.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` if the bytes are not a model of `estimator`.
    fn load(
        &self,
        estimator: &DriverKey,
        saved: &Saved<'_>,
    ) -> Result<Box<dyn SavedRegressor>, ModelError>;
}
