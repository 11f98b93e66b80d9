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
    /// Registry of the linked-in drivers for this kind of device.
    ///
    /// Rust does not link a crate that is only named in `Cargo.toml`, so its drivers are missing. `use the_crate as _;` links the crate.
    ///
    /// # Errors
    /// [`RegistryError`] if two drivers have the same key, or entries in the description of a driver contradict each other.
    pub fn builtin() -> Result<Registry<D>, RegistryError> {
        let mut registry = Registry::empty();
        for builtin in inventory::iter::<Builtin<D>> {
            registry.add(builtin.factory()?)?;
        }
        Ok(registry)
    }
}

/// Registers a driver that is linked into the program. The arguments are the device trait and a function that creates the factory.
///
/// `submit_builtin!(dyn Sensor, || Ok(Box::new(Replay::new()?)));`
#[macro_export]
macro_rules! submit_builtin {
    ($device:ty, $make:expr) => {
        $crate::inventory::submit! { $crate::Builtin::<$device>::new($make) }
    };
}
