//! Table of functions that the library of a plugin exports.

use taceva_abi::{ABI_MAJOR, ABI_MINOR, MAGIC, Plugin, Text};

use crate::export::Export;
use crate::{entry, rig};

/// Creates the table of functions that the library of the plugin `E` exports. See the example of [`Export`].
pub const fn plugin<E: Export>() -> Plugin {
    #[expect(clippy::cast_possible_truncation, reason = "a hundred bytes")]
    let size = size_of::<Plugin>() as u32;
    Plugin {
        magic: MAGIC,
        size,
        abi_major: ABI_MAJOR,
        abi_minor: ABI_MINOR,
        id: Text::from(E::ID),
        version: Text::from(E::VERSION),
        init: Some(entry::init::<E>),
        deinit: Some(entry::deinit),
        factory: Some(entry::factory),
        open_rig: Some(rig::open),
        close_rig: Some(rig::close),
        rig_extension: Some(rig::extension),
        needs: Text::from(E::NEEDS),
    }
}

/// Exports the drivers of a crate of type `cdylib` as a plugin with the given `id` and the version of the crate.
///
/// The optional line `needs: ["usb"],` after the id states the external needs of the plugin, as in the manifest.
///
/// Each entry of `drivers` has a kind of device and a `fn` that makes a factory, as in `taceva_core::submit_builtin!`.
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
            ::core::compile_error!("build plugins with `panic = \"unwind\"`, so a panic ends only the call and not the program");

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
