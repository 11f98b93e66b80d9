//! The one exported symbol.

use core::ffi::{CStr, c_void};

use crate::device::Rig;
use crate::error::Error;
use crate::host::Host;
use crate::status::Status;
use crate::text::Text;

/// "TAE1", little-endian; identifies a wrong file before any call.
pub const MAGIC: u32 = 0x3145_4154;
/// Major version of the interface: equal on both sides, or the host rejects the library.
pub const ABI_MAJOR: u32 = 1;
/// Minor version of the interface; the two sides may differ.
pub const ABI_MINOR: u32 = 3;
/// The name of the one exported symbol.
pub const ENTRY_SYMBOL: &CStr = c"taceva_plugin_v1";

/// The id of the [`Factory`](crate::Factory) of sensors.
pub const SENSOR_FACTORY: &str = "taceva.sensor/1";
/// The id of the [`Factory`](crate::Factory) of robots.
pub const ROBOT_FACTORY: &str = "taceva.robot/1";
/// The id of the [`Factory`](crate::Factory) of force transducers, since minor 3: their torques are in N·mm.
pub const FORCE_FACTORY: &str = "taceva.force/2";
/// The id of the [`Factory`](crate::Factory) of lightings.
pub const LIGHTING_FACTORY: &str = "taceva.lighting/1";
/// The id of the [`Factory`](crate::Factory) of changers, since minor 2.
pub const CHANGER_FACTORY: &str = "taceva.changer/1";
/// The id of the [`EstimatorFactory`](crate::EstimatorFactory).
pub const ESTIMATOR_FACTORY: &str = "taceva.estimator/1";

/// `taceva_plugin`: what a plugin exports, as data.
///
/// A struct with a size in front grows at its end: a side reads no further than the other's `size` says.
///
/// ```
/// use taceva_abi::{ABI_MAJOR, ABI_MINOR, MAGIC, Plugin, Text};
/// // A library exports it as the static `taceva_plugin_v1`.
/// static PLUGIN: Plugin = Plugin {
///     magic: MAGIC,
///     size: size_of::<Plugin>() as u32,
///     abi_major: ABI_MAJOR,
///     abi_minor: ABI_MINOR,
///     id: Text::from("org.example.eye"),
///     version: Text::from("1.0.0"),
///     init: None,
///     deinit: None,
///     factory: None,
///     open_rig: None,
///     close_rig: None,
///     rig_extension: None,
///     needs: Text::from("usb"),
/// };
/// assert_eq!(PLUGIN.magic, MAGIC);
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Plugin {
    /// [`MAGIC`].
    pub magic: u32,
    /// The size of this struct, in bytes.
    pub size: u32,
    /// [`ABI_MAJOR`].
    pub abi_major: u32,
    /// [`ABI_MINOR`].
    pub abi_minor: u32,
    /// Reverse DNS, as in the manifest.
    pub id: Text,
    /// As in the manifest.
    pub version: Text,
    /// `[once, first]`
    pub init: Option<unsafe extern "C" fn(*const Host, *mut Error) -> Status>,
    /// `[once, last; not after a failed init]`
    pub deinit: Option<unsafe extern "C" fn()>,
    /// `[any]` The factory of a kind, or NULL.
    pub factory: Option<unsafe extern "C" fn(id: Text) -> *const c_void>,
    /// `[any]` Opens a rig: the shared objects of its devices.
    pub open_rig: Option<unsafe extern "C" fn(*mut *mut Rig, *mut Error) -> Status>,
    /// `[owner]` After the last device of the rig.
    pub close_rig: Option<unsafe extern "C" fn(*mut Rig)>,
    /// `[owner]` A table of calls on the rig, or NULL.
    pub rig_extension: Option<unsafe extern "C" fn(*mut Rig, id: Text) -> *const c_void>,
    /// Since minor 1: needs outside the plugin, one need of the manifest per line; empty if not stated.
    pub needs: Text,
}
