//! A plugin that was delivered, in process or in a child: the one place where the two ways meet.

use std::sync::Arc;

use crate::offer::Offer;
use taceva_core::{
    Args, Changer, Descriptor, DriverError, DriverKey, ForceTransducer, Found, Lighting,
    ModelError, Robot, Sensor, SimulatedBench,
};
pub use taceva_core::{FitRequest, Saved, SavedRegressor};

/// A loaded plugin and the devices that are opened in it together: one session a plugin and rig.
///
/// Drivers and estimators are named by their whole keys. Devices keep what they need alive: a session may be dropped before them.
pub trait Session: Send + Sync {
    /// What the library offers and needs, as a manifest would say it.
    ///
    /// # Errors
    /// [`DriverError`] where what answers is no library, or says what no manifest can.
    fn offer(&self) -> Result<Offer, DriverError>;

    /// What the library says of `driver` when it is opened with `args`; no device is touched.
    ///
    /// # Errors
    /// [`DriverError`] of kind `NotFound` for a driver that it does not have, `InvalidArgument` for arguments that contradict each other.
    fn describe(&self, driver: &DriverKey, args: &Args) -> Result<Descriptor, DriverError>;

    /// The devices of `driver` that are present.
    ///
    /// # Errors
    /// [`DriverError`] if looking itself fails.
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

    /// Opens a lighting.
    ///
    /// # Errors
    /// As [`Factory::open`](taceva_core::Factory::open).
    fn lighting(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Lighting>, DriverError>;

    /// Opens a changer.
    ///
    /// # Errors
    /// As [`Factory::open`](taceva_core::Factory::open).
    fn changer(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Changer>, DriverError>;

    /// The simulated bench that devices were opened in with `rig=name`, where the plugin is one.
    fn bench(&self, name: &str) -> Option<Arc<dyn SimulatedBench>>;

    /// Fits `estimator`.
    ///
    /// # Errors
    /// As [`Estimator::fit`](taceva_core::Estimator::fit); `NotFound` for an estimator that it does not have.
    fn fit(
        &self,
        estimator: &DriverKey,
        request: &FitRequest<'_>,
    ) -> Result<Box<dyn SavedRegressor>, ModelError>;

    /// Loads what [`SavedRegressor::save`] gave.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` for bytes that are no model of `estimator`.
    fn load(
        &self,
        estimator: &DriverKey,
        saved: &Saved<'_>,
    ) -> Result<Box<dyn SavedRegressor>, ModelError>;
}
