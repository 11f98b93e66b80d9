//! Drivers that are linked into the program.

use super::{DescriptorError, Factory};
#[cfg(feature = "inventory")]
use super::{Registry, RegistryError};
#[cfg(feature = "inventory")]
use crate::driver::{Device, ForceTransducer, Lighting, Robot, Sensor};

/// A driver that is linked in: how to make its factory.
///
/// With the feature `inventory`, [`submit_builtin!`](crate::submit_builtin) adds it to the list of the program. A crate that is named in
/// `Cargo.toml` and nowhere in the code is not linked, and its drivers vanish without a word: somebody must `use` it.
pub struct Builtin<D: ?Sized + 'static> {
    make: fn() -> Result<Box<dyn Factory<D>>, DescriptorError>,
}

impl<D: ?Sized + 'static> Builtin<D> {
    /// A driver whose factory `make` makes.
    pub const fn new(make: fn() -> Result<Box<dyn Factory<D>>, DescriptorError>) -> Builtin<D> {
        Builtin { make }
    }

    /// Its factory.
    ///
    /// # Errors
    /// [`DescriptorError`] if the driver contradicts itself.
    pub fn factory(&self) -> Result<Box<dyn Factory<D>>, DescriptorError> {
        (self.make)()
    }
}

#[cfg(feature = "inventory")]
mod collected {
    use super::{Builtin, ForceTransducer, Lighting, Robot, Sensor};

    inventory::collect!(Builtin<dyn Sensor>);
    inventory::collect!(Builtin<dyn Robot>);
    inventory::collect!(Builtin<dyn ForceTransducer>);
    inventory::collect!(Builtin<dyn Lighting>);
}

#[cfg(feature = "inventory")]
impl<D: Device + ?Sized + 'static> Registry<D>
where
    Builtin<D>: inventory::Collect,
{
    /// The drivers of this kind that are linked in. The list of the program has no order; the registry has.
    ///
    /// # Errors
    /// [`RegistryError`] if two have one key, or one contradicts itself.
    pub fn builtin() -> Result<Registry<D>, RegistryError> {
        let mut registry = Registry::empty();
        for builtin in inventory::iter::<Builtin<D>> {
            registry.add(builtin.factory()?)?;
        }
        Ok(registry)
    }
}

/// Adds a driver to those that are linked in: the device trait, then what makes its factory.
///
/// ```ignore
/// taceva_core::submit_builtin!(dyn Sensor, || Ok(Box::new(ReplayFactory::new()?)));
/// ```
#[cfg(feature = "inventory")]
#[macro_export]
macro_rules! submit_builtin {
    ($device:ty, $make:expr) => {
        $crate::inventory::submit! { $crate::Builtin::<$device>::new($make) }
    };
}
