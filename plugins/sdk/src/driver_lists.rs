//! Drivers of an initialised plugin.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use taceva_abi::{EstimatorFactory as EstimatorTable, Factory};
use taceva_core::{
    Changer, EstimatorFactory, Factory as CoreFactory, ForceTransducer, Lighting, Robot, Sensor,
};

use crate::failure::Failure;

/// Drivers of one kind, by number.
pub(crate) type Drivers<D> = Vec<Box<dyn CoreFactory<D>>>;

/// Drivers by kind, and the tables through which a host calls them.
pub(crate) struct Loaded {
    pub(crate) sensors: Drivers<dyn Sensor>,
    pub(crate) robots: Drivers<dyn Robot>,
    pub(crate) forces: Drivers<dyn ForceTransducer>,
    pub(crate) lightings: Drivers<dyn Lighting>,
    pub(crate) changers: Drivers<dyn Changer>,
    pub(crate) estimators: Vec<Box<dyn EstimatorFactory>>,
    /// Keys of the drivers up to their last `/`.
    pub(crate) prefixes: BTreeSet<String>,
    pub(crate) tables: Tables,
}

/// Table of each kind for which the plugin has drivers.
pub(crate) struct Tables {
    pub(crate) sensor: Option<Factory>,
    pub(crate) robot: Option<Factory>,
    pub(crate) force: Option<Factory>,
    pub(crate) lighting: Option<Factory>,
    pub(crate) changer: Option<Factory>,
    pub(crate) estimator: Option<EstimatorTable>,
}

/// A library contains one plugin and loads it once.
static LOADED: OnceLock<Loaded> = OnceLock::new();

/// Drivers of the plugin. Fails before the plugin is initialised.
pub(crate) fn loaded() -> Result<&'static Loaded, Failure> {
    LOADED
        .get()
        .ok_or_else(|| Failure::argument("the plugin is not initialised"))
}

/// Keeps `drivers` for the life of the library. Two threads that initialise it at once have loaded equal drivers.
pub(crate) fn keep(drivers: Loaded) {
    LOADED.get_or_init(|| drivers);
}
