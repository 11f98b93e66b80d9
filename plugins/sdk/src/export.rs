//! The macro that makes a library a plugin.

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
    /// Its id, reverse DNS, as in the manifest.
    const ID: &'static str;
    /// Its version, as in the manifest.
    const VERSION: &'static str;
    /// What it must reach outside itself, a need a line, as `needs` of the manifest lists them: `taceva plugin manifest --write` writes them there.
    const NEEDS: &'static str = "";

    /// What it provides.
    fn drivers() -> Vec<Driver>;
}

/// Exports the drivers of a crate of type `cdylib` as the plugin `id`; its version is that of the crate.
///
/// `needs: ["usb"],` may follow the id: what the plugin must reach outside itself, as the manifest lists it.
///
/// Each line is a kind of device and a `fn` that makes a factory, as `taceva_core::submit_builtin!` takes them too.
///
/// ```
/// # use taceva_core::{Args, Axes, Deadline, Descriptor, DescriptorError, DescriptorSpec, DriverError, DriverKey, DriverSource, Factory,
/// #     Facts, ForceFacts, ForceTransducer, Rig, Stamp, Wrench};
/// # struct Scale;
/// # impl ForceTransducer for Scale {
/// #     fn axes(&self) -> Axes { Axes::NORMAL }
/// #     fn read(&mut self, _: Deadline) -> Result<(Wrench, Stamp), DriverError> {
/// #         Ok((Wrench::default(), Stamp::at(taceva_plugin::now())))
/// #     }
/// # }
/// # struct ScaleFactory(Descriptor);
/// # impl ScaleFactory {
/// #     fn make() -> Result<Box<dyn Factory<dyn ForceTransducer>>, DescriptorError> {
/// #         let facts = Facts::Force(ForceFacts::default().with_axes(Axes::NORMAL));
/// #         let spec = DescriptorSpec::new(DriverKey::fixed("org.example.scale/scale"), "a scale", DriverSource::Real, facts);
/// #         Ok(Box::new(ScaleFactory(spec.check()?)))
/// #     }
/// # }
/// # impl Factory<dyn ForceTransducer> for ScaleFactory {
/// #     fn descriptor(&self) -> &Descriptor { &self.0 }
/// #     fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> { Ok(Box::new(Scale)) }
/// # }
/// taceva_plugin::export_plugin! {
///     id: "org.example.scale",
///     drivers: [dyn ForceTransducer => ScaleFactory::make],
/// }
/// # fn main() {}
/// ```
#[macro_export]
macro_rules! export_plugin {
    (id: $id:expr, $(needs: [$($need:literal),* $(,)?],)? drivers: [$($device:ty => $make:expr),+ $(,)?] $(,)?) => {
        const _: () = {
            #[cfg(not(panic = "unwind"))]
            ::core::compile_error!("a plugin is built with `panic = \"unwind\"`, so that a panic ends a call and not the program");

            struct Exported;

            impl $crate::Export for Exported {
                const ID: &'static str = $id;
                const VERSION: &'static str = ::core::env!("CARGO_PKG_VERSION");
                $(const NEEDS: &'static str = ::core::concat!($($need, "\n"),*);)?

                fn drivers() -> ::std::vec::Vec<$crate::Driver> {
                    ::std::vec![$(<$device as $crate::Provide>::provide($make)),+]
                }
            }

            #[unsafe(no_mangle)]
            static taceva_plugin_v1: $crate::abi::Plugin = $crate::plugin::<Exported>();
        };
    };
}
