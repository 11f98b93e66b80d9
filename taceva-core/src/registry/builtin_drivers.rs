//! List of the drivers linked into the program.

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
    /// A crate that only `Cargo.toml` names is not linked, so its drivers are missing. `use the_crate as _;` links the crate.
    ///
    /// # Errors
    /// [`RegistryError`] if two drivers have one key, or the description of a driver contradicts itself.
    pub fn builtin() -> Result<Registry<D>, RegistryError> {
        let mut registry = Registry::empty();
        for builtin in inventory::iter::<Builtin<D>> {
            registry.add(builtin.factory()?)?;
        }
        Ok(registry)
    }
}

/// Adds a linked-in driver. The arguments are the device trait and a function that creates the factory.
///
/// `submit_builtin!(dyn Sensor, || Ok(Box::new(Replay::new()?)));`
#[macro_export]
macro_rules! submit_builtin {
    ($device:ty, $make:expr) => {
        $crate::inventory::submit! { $crate::Builtin::<$device>::new($make) }
    };
}
