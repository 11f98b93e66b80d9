//! The exported symbol of a plugin.

use core::ffi::{CStr, c_void};

use crate::device::Rig;
use crate::error::Error;
use crate::host::Host;
use crate::status::Status;
use crate::text::Text;

/// Magic number "TAE1", little-endian. The host reads it before any call and rejects a library with another value.
pub const MAGIC: u32 = 0x3145_4154;
/// Major version of the interface. The host rejects a library with another major version.
pub const ABI_MAJOR: u32 = 1;
/// Minor version of the interface. Host and library may have different minor versions.
pub const ABI_MINOR: u32 = 4;
/// Name of the exported symbol.
pub const ENTRY_SYMBOL: &CStr = c"taceva_plugin_v1";

/// Id of the [`Factory`](crate::Factory) of sensors.
pub const SENSOR_FACTORY: &str = "taceva.sensor/1";
/// Id of the [`Factory`](crate::Factory) of robots.
pub const ROBOT_FACTORY: &str = "taceva.robot/1";
/// Id of the [`Factory`](crate::Factory) of force transducers, since minor 3: their torques are in N·mm.
pub const FORCE_FACTORY: &str = "taceva.force/2";
/// Id of the [`Factory`](crate::Factory) of lighting devices.
pub const LIGHTING_FACTORY: &str = "taceva.lighting/1";
/// Id of the [`Factory`](crate::Factory) of changers, since minor 2.
pub const CHANGER_FACTORY: &str = "taceva.changer/1";
/// Id of the [`EstimatorFactory`](crate::EstimatorFactory).
pub const ESTIMATOR_FACTORY: &str = "taceva.estimator/1";

/// `taceva_plugin`: the exported data of a plugin.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
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
    /// Equals [`MAGIC`].
    pub magic: u32,
    /// Size of this struct, bytes.
    pub size: u32,
    /// Equals [`ABI_MAJOR`].
    pub abi_major: u32,
    /// Equals [`ABI_MINOR`] of the headers of the plugin.
    pub abi_minor: u32,
    /// Id of the plugin, reverse DNS, as in the manifest.
    pub id: Text,
    /// Version of the plugin, as in the manifest.
    pub version: Text,
    /// `[once, first]` Initialises the plugin.
    pub init: Option<unsafe extern "C" fn(*const Host, *mut Error) -> Status>,
    /// `[once, last]` Ends the plugin. Not called after a failed `init`.
    pub deinit: Option<unsafe extern "C" fn()>,
    /// `[any]` Returns the factory of a kind, or NULL.
    pub factory: Option<unsafe extern "C" fn(id: Text) -> *const c_void>,
    /// `[any]` Opens a rig: the objects that its devices share.
    pub open_rig: Option<unsafe extern "C" fn(*mut *mut Rig, *mut Error) -> Status>,
    /// `[owner]` Closes a rig, after its last device.
    pub close_rig: Option<unsafe extern "C" fn(*mut Rig)>,
    /// `[owner]` Returns a table of calls on the rig, or NULL.
    pub rig_extension: Option<unsafe extern "C" fn(*mut Rig, id: Text) -> *const c_void>,
    /// Since minor 1: external needs of the plugin, one need of the manifest per line; empty if not stated.
    pub needs: Text,
}
