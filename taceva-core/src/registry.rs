//! Registries, which find drivers by key.

mod builtin;
#[cfg(feature = "inventory")]
mod builtin_drivers;
mod descriptor;
mod device_facts;
mod discovery;
mod error;
mod factory;
mod rig;

pub use builtin::Builtin;
pub use descriptor::{Descriptor, DescriptorError, DescriptorSpec, DriverSource};
pub use device_facts::{
    ChangerFacts, Facts, ForceFacts, LightingFacts, RobotFacts, SensorFacts, Workspace,
};
pub use discovery::{Access, Found};
pub use error::RegistryError;
pub use factory::Factory;
pub use rig::Rig;

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt;

use crate::driver::Device;
use crate::id::DriverKey;
use crate::suggestion::nearest;

/// Drivers for one kind of device, sorted by key. Functions take the registry as an argument, because no global registry exists.
///
/// ```
/// use taceva_core::{Registry, Sensor};
/// let sensors = Registry::<dyn Sensor>::empty();
/// let error = sensors.get("sim/digit").map(|_| ()).unwrap_err();
/// assert_eq!(error.to_string(), "`sim/digit`: unknown sensor driver, and no sensor driver is known");
/// ```
pub struct Registry<D: ?Sized> {
    factories: BTreeMap<DriverKey, Box<dyn Factory<D>>>,
}

impl<D: Device + ?Sized> Registry<D> {
    /// A registry without drivers.
    pub fn empty() -> Registry<D> {
        Registry {
            factories: BTreeMap::new(),
        }
    }

    /// Adds the driver `factory`.
    ///
    /// # Errors
    /// [`RegistryError`] if another driver has the same key, or the driver is for another kind of device. The registry is then unchanged.
    pub fn add(&mut self, factory: Box<dyn Factory<D>>) -> Result<(), RegistryError> {
        let descriptor = factory.descriptor();
        if descriptor.kind() != D::KIND {
            return Err(RegistryError::Kind {
                key: descriptor.key().clone(),
                expected: D::KIND,
                found: descriptor.kind(),
            });
        }
        match self.factories.entry(descriptor.key().clone()) {
            Entry::Vacant(place) => {
                place.insert(factory);
                Ok(())
            }
            Entry::Occupied(taken) => Err(RegistryError::Twice {
                key: taken.key().clone(),
                first: taken.get().descriptor().title().to_owned(),
                second: factory.descriptor().title().to_owned(),
            }),
        }
    }

    /// Returns the driver with the key `key`.
    ///
    /// # Errors
    /// [`RegistryError::Unknown`] with all known keys, and with the nearest key if one is similar.
    pub fn get(&self, key: &str) -> Result<&dyn Factory<D>, RegistryError> {
        self.factories
            .get(key)
            .map(AsRef::as_ref)
            .ok_or_else(|| RegistryError::Unknown {
                kind: D::KIND,
                key: key.to_owned(),
                nearest: nearest(key, self.keys().map(DriverKey::as_str)).map(str::to_owned),
                known: self.keys().cloned().collect(),
            })
    }

    /// Keys of all drivers, sorted.
    pub fn keys(&self) -> impl Iterator<Item = &DriverKey> {
        self.factories.keys()
    }

    /// Factories of all drivers, sorted by key.
    pub fn iter(&self) -> impl Iterator<Item = &dyn Factory<D>> {
        self.factories.values().map(AsRef::as_ref)
    }

    /// Number of drivers.
    pub fn len(&self) -> usize {
        self.factories.len()
    }

    /// True if the registry has no drivers.
    pub fn is_empty(&self) -> bool {
        self.factories.is_empty()
    }
}

impl<D: ?Sized> fmt::Debug for Registry<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.factories.keys()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::Args;
    use crate::driver::{DriverError, ForceTransducer, Lighting};
    use crate::error::ErrorKind;

    struct Lamp(Descriptor);

    impl Lamp {
        fn boxed(key: &'static str, title: &str) -> Box<Lamp> {
            let spec = DescriptorSpec::new(
                DriverKey::fixed(key),
                title,
                DriverSource::Simulated,
                Facts::Lighting(LightingFacts::default().with_scenes(vec!["normal".to_owned()])),
            );
            Box::new(Lamp(spec.check().expect("no contradiction")))
        }
    }

    impl<D: Device + ?Sized> Factory<D> for Lamp {
        fn descriptor(&self) -> &Descriptor {
            &self.0
        }
        fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<D>, DriverError> {
            Err(DriverError::new(
                ErrorKind::NotFound,
                self.0.key(),
                "switch it on",
            ))
        }
    }

    #[test]
    fn drivers_stand_in_the_order_of_their_keys_whatever_order_they_came_in() {
        let mut registry = Registry::<dyn Lighting>::empty();
        for key in ["sim/b", "sim/a", "room/z"] {
            registry.add(Lamp::boxed(key, "lamp")).expect("new");
        }
        assert_eq!(
            format!("{registry:?}"),
            r#"{DriverKey("room/z"), DriverKey("sim/a"), DriverKey("sim/b")}"#
        );
    }

    #[test]
    fn a_key_that_is_taken_is_refused_naming_both() {
        let mut registry = Registry::<dyn Lighting>::empty();
        registry
            .add(Lamp::boxed("sim/lamp", "the first"))
            .expect("new");
        let error = registry
            .add(Lamp::boxed("sim/lamp", "the second"))
            .expect_err("taken");
        assert_eq!(
            error.to_string(),
            "two drivers have the key `sim/lamp`: the first and the second"
        );
        assert_eq!(registry.len(), 1);
        let kept = registry.get("sim/lamp").expect("there");
        assert_eq!(kept.descriptor().title(), "the first");
    }

    #[test]
    fn a_driver_of_another_kind_is_refused() {
        let mut registry = Registry::<dyn ForceTransducer>::empty();
        let error = registry
            .add(Lamp::boxed("sim/lamp", "a lamp"))
            .expect_err("kind");
        assert_eq!(
            error.to_string(),
            "`sim/lamp` is a lighting driver, expected a force driver"
        );
    }

    #[test]
    fn an_unknown_driver_is_answered_with_the_nearest() {
        let mut registry = Registry::<dyn Lighting>::empty();
        let error = registry.get("sim/lamp").map(|_| ()).expect_err("empty");
        assert_eq!(
            error.to_string(),
            "`sim/lamp`: unknown lighting driver, and no lighting driver is known"
        );
        registry
            .add(Lamp::boxed("sim/lamp", "a lamp"))
            .expect("new");
        let message = |key| {
            registry
                .get(key)
                .map(|_| ())
                .expect_err("unknown")
                .to_string()
        };
        assert_eq!(
            message("sim/lmap"),
            "`sim/lmap`: unknown lighting driver, did you mean `sim/lamp`?"
        );
        assert_eq!(
            message("ur5"),
            "`ur5`: unknown lighting driver, expected one of `sim/lamp`"
        );
    }
}
