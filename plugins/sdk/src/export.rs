//! A crate that is a plugin.

use crate::driver::Driver;

/// A crate that is a plugin; [`export_plugin!`](crate::export_plugin) implements it.
///
/// ```
/// use taceva_plugin::{Driver, Export, plugin};
/// struct Nothing;
/// impl Export for Nothing {
///     const ID: &'static str = "org.example.nothing";
///     const VERSION: &'static str = "1.0.0";
///     fn drivers() -> Vec<Driver> {
///         Vec::new()
///     }
/// }
/// let table = plugin::<Nothing>();
/// assert_eq!(table.abi_major, taceva_plugin::abi::ABI_MAJOR);
/// ```
pub trait Export {
    /// Id of the plugin, reverse DNS, as in the manifest.
    const ID: &'static str;
    /// Version of the plugin, as in the manifest.
    const VERSION: &'static str;
    /// Needs outside the plugin, one per line, as `needs` of the manifest lists them. `taceva plugin manifest --write` writes them there.
    const NEEDS: &'static str = "";

    /// Drivers and estimators that it provides.
    fn drivers() -> Vec<Driver>;
}
