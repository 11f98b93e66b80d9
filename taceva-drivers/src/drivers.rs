//! Drivers of a program, and functions that open devices.

use taceva_core::{
    Changer, Device, ForceTransducer, Lighting, Registry, RegistryError, Rig, Robot, Sensor,
};

use crate::open_error::OpenError;
use crate::selector::Selector;
use crate::switches::Switches;

/// Drivers of a program, with one registry per kind.
#[derive(Debug)]
pub struct Drivers {
    /// Drivers of tactile sensors.
    pub sensors: Registry<dyn Sensor>,
    /// Drivers of robots.
    pub robots: Registry<dyn Robot>,
    /// Drivers of force transducers.
    pub forces: Registry<dyn ForceTransducer>,
    /// Drivers of lighting devices.
    pub lightings: Registry<dyn Lighting>,
    /// Drivers of changers.
    pub changers: Registry<dyn Changer>,
    /// Drivers of enabling switches.
    pub switches: Switches,
}

impl Drivers {
    /// All drivers linked into the program.
    ///
    /// Includes the drivers of this crate. For the drivers of another crate, a program must name that crate in its code, such as `use
    /// taceva_sim as _;`. An entry in `Cargo.toml` alone does not link it.
    ///
    /// # Errors
    /// [`RegistryError`] if two drivers share a key, or a descriptor is inconsistent.
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

    /// Adds the drivers of the plugins of `host`. Loads no plugin. The user's settings decide in which process a plugin runs later.
    ///
    /// # Errors
    /// [`RegistryError`] if another driver already has the key of a plugin.
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

/// Opens the device that `selector` names, with a driver from `registry`.
///
/// # Errors
/// [`OpenError`] for an unknown driver, invalid arguments, or a device that does not open.
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
