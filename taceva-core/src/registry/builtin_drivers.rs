//! List of the drivers that are linked into the program.

use super::{Builtin, Registry, RegistryError};
use crate::driver::{Changer, Device, ForceTransducer, Lighting, Robot, Sensor};

inventory::collect!(Builtin<dyn Sensor>);
inventory::collect!(Builtin<dyn Robot>);
inventory::collect!(Builtin<dyn ForceTransducer>);
inventory::collect!(Builtin<dyn Lighting>);
inventory::collect!(Builtin<dyn Changer>);

impl<D: Device + ?Sized + 'static> Registry<D>
where
    Builtin<D>: inventory::Collect,
{
    /// The linked-in drivers of this kind, sorted by key.
    ///
    /// A crate that is named in `Cargo.toml` and nowhere in the code is not linked, so its drivers are missing. `use the_crate as _;` links it.
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

/// Adds a linked-in driver: the device trait, then a `fn` that makes its factory.
///
/// `submit_builtin!(dyn Sensor, || Ok(Box::new(Replay::new()?)));`
#[macro_export]
macro_rules! submit_builtin {
    ($device:ty, $make:expr) => {
        $crate::inventory::submit! { $crate::Builtin::<$device>::new($make) }
    };
}
