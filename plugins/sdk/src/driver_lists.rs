//! The drivers of a plugin once it is initialised.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use taceva_abi::{EstimatorFactory as EstimatorTable, Factory};
use taceva_core::{
    Changer, EstimatorFactory, Factory as CoreFactory, ForceTransducer, Lighting, Robot, Sensor,
};

use crate::failure::Failure;

/// The drivers of one kind, by their number.
pub(crate) type Drivers<D> = Vec<Box<dyn CoreFactory<D>>>;

/// The drivers by kind, and the tables by which a host reaches them.
pub(crate) struct Loaded {
    pub(crate) sensors: Drivers<dyn Sensor>,
    pub(crate) robots: Drivers<dyn Robot>,
    pub(crate) forces: Drivers<dyn ForceTransducer>,
    pub(crate) lightings: Drivers<dyn Lighting>,
    pub(crate) changers: Drivers<dyn Changer>,
    pub(crate) estimators: Vec<Box<dyn EstimatorFactory>>,
    /// Parts of the drivers' keys before their last `/`.
    pub(crate) prefixes: BTreeSet<String>,
    pub(crate) tables: Tables,
}

/// The table of each kind that the plugin has drivers of.
pub(crate) struct Tables {
    pub(crate) sensor: Option<Factory>,
    pub(crate) robot: Option<Factory>,
    pub(crate) force: Option<Factory>,
    pub(crate) lighting: Option<Factory>,
    pub(crate) changer: Option<Factory>,
    pub(crate) estimator: Option<EstimatorTable>,
}

/// A library holds one plugin, and loads it once.
static LOADED: OnceLock<Loaded> = OnceLock::new();

/// The drivers, once the plugin is initialised.
pub(crate) fn loaded() -> Result<&'static Loaded, Failure> {
    LOADED
        .get()
        .ok_or_else(|| Failure::argument("the plugin is not initialised"))
}

/// Keeps `drivers` for the life of the library. If two threads initialise it at once, both have loaded the same.
pub(crate) fn keep(drivers: Loaded) {
    LOADED.get_or_init(|| drivers);
}
