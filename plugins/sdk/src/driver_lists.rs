//! Drivers of an initialised plugin.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use taceva_abi::{EstimatorFactory as EstimatorTable, Factory};
use taceva_core::{
    Changer, EstimatorFactory, Factory as CoreFactory, ForceTransducer, Lighting, Robot, Sensor,
};

use crate::failure::Failure;

/// Drivers of one kind. The host addresses a driver by its index.
pub(crate) type Drivers<D> = Vec<Box<dyn CoreFactory<D>>>;

/// Drivers of the plugin by kind, and the tables of functions with which a host calls them.
pub(crate) struct Loaded {
    pub(crate) sensors: Drivers<dyn Sensor>,
    pub(crate) robots: Drivers<dyn Robot>,
    pub(crate) forces: Drivers<dyn ForceTransducer>,
    pub(crate) lightings: Drivers<dyn Lighting>,
    pub(crate) changers: Drivers<dyn Changer>,
    pub(crate) estimators: Vec<Box<dyn EstimatorFactory>>,
    /// Distinct prefixes of the driver keys: each key up to its last `/`.
    pub(crate) prefixes: BTreeSet<String>,
    pub(crate) tables: Tables,
}

/// Table of functions for each kind of driver; `None` for a kind without drivers in the plugin.
pub(crate) struct Tables {
    pub(crate) sensor: Option<Factory>,
    pub(crate) robot: Option<Factory>,
    pub(crate) force: Option<Factory>,
    pub(crate) lighting: Option<Factory>,
    pub(crate) changer: Option<Factory>,
    pub(crate) estimator: Option<EstimatorTable>,
}

/// Drivers of the plugin, set once. A library contains one plugin.
static LOADED: OnceLock<Loaded> = OnceLock::new();

/// Drivers of the plugin. Fails before the plugin is initialised.
pub(crate) fn loaded() -> Result<&'static Loaded, Failure> {
    LOADED
        .get()
        .ok_or_else(|| Failure::argument("the plugin is not initialised"))
}

/// Stores `drivers` until the process ends. Ignores `drivers` if another thread has already stored equal drivers.
pub(crate) fn keep(drivers: Loaded) {
    LOADED.get_or_init(|| drivers);
}
