//! Trait that describes a crate as a plugin.

use crate::driver::Driver;

/// Id, version and drivers of a crate that is built as a plugin. [`export_plugin!`](crate::export_plugin) implements this trait.
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
    /// Id of the plugin as in the manifest, in reverse domain order: `org.example.digit`.
    const ID: &'static str;
    /// Version of the plugin, as in the manifest.
    const VERSION: &'static str;
    /// External needs of the plugin, such as a USB library, one per line, as in `needs` of the manifest. `taceva plugin manifest --write` copies the
    /// needs to the manifest.
    const NEEDS: &'static str = "";

    /// Drivers and estimators that the plugin provides.
    fn drivers() -> Vec<Driver>;
}
