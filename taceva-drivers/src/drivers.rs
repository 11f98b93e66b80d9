//! The drivers of a program, and opening one of them.

use taceva_core::{
    Changer, Device, ForceTransducer, Lighting, Registry, RegistryError, Rig, Robot, Sensor,
};

use crate::open_error::OpenError;
use crate::selector::Selector;
use crate::switches::Switches;

/// The drivers of a program, a registry a kind.
#[derive(Debug)]
pub struct Drivers {
    /// Tactile sensors.
    pub sensors: Registry<dyn Sensor>,
    /// Robots.
    pub robots: Registry<dyn Robot>,
    /// Force transducers.
    pub forces: Registry<dyn ForceTransducer>,
    /// Lightings.
    pub lightings: Registry<dyn Lighting>,
    /// Changers.
    pub changers: Registry<dyn Changer>,
    /// Enabling switches.
    pub switches: Switches,
}

impl Drivers {
    /// Every driver that is linked into the program.
    ///
    /// This crate's own are always among them. A program that wants those of another crate names that crate in its code,
    /// `use taceva_sim as _;`: one that is only named in `Cargo.toml` is not linked.
    ///
    /// # Errors
    /// [`RegistryError`] if two drivers have one key, or one contradicts itself.
    pub fn builtin() -> Result<Drivers, RegistryError> {
        Ok(Drivers {
            sensors: Registry::builtin()?,
            robots: Registry::builtin()?,
            forces: Registry::builtin()?,
            lightings: Registry::builtin()?,
            changers: Registry::builtin()?,
            switches: Switches::builtin(),
        })
    }

    /// These drivers and those of the plugins of `host`, which open in the way that the user decided. No library is opened for it.
    ///
    /// # Errors
    /// [`RegistryError`] if a plugin claims a key that is taken.
    #[cfg(feature = "plugin")]
    pub fn with_plugins(
        mut self,
        host: &std::sync::Arc<taceva_host::PluginHost>,
    ) -> Result<Drivers, RegistryError> {
        for driver in host.drivers() {
            self.sensors.add(driver)?;
        }
        for driver in host.drivers() {
            self.robots.add(driver)?;
        }
        for driver in host.drivers() {
            self.forces.add(driver)?;
        }
        for driver in host.drivers() {
            self.lightings.add(driver)?;
        }
        for driver in host.drivers() {
            self.changers.add(driver)?;
        }
        Ok(self)
    }
}

/// Opens the device that `selector` asks for.
///
/// # Errors
/// [`OpenError`]: no such driver, arguments that it does not take, or a device that does not open.
pub fn open<D: Device + ?Sized>(
    registry: &Registry<D>,
    selector: &Selector,
    rig: &mut Rig,
) -> Result<Box<D>, OpenError> {
    let factory = registry.get(selector.driver())?;
    let args = factory
        .descriptor()
        .args(selector.arguments())
        .map_err(|source| OpenError::Arguments {
            selector: selector.to_string(),
            source,
        })?;
    Ok(factory.open(&args, rig)?)
}
