//! The table that a library exports.

use taceva_abi::{ABI_MAJOR, ABI_MINOR, MAGIC, Plugin, Text};

use crate::export::Export;
use crate::{entry, rig};

/// The table that a library exports for `E`; the example of [`Export`] uses it.
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
