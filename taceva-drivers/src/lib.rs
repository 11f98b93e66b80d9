#![doc = include_str!("../README.md")]

#[cfg(feature = "link")]
mod arguments;
#[cfg(feature = "netft")]
pub mod ati;
mod bench_sensor;
#[cfg(feature = "camera")]
pub mod camera;
mod clock;
mod devices;
pub mod doctor;
mod drivers;
#[cfg(all(feature = "gcode", unix))]
pub mod gcode;
#[cfg(all(feature = "hid", target_os = "linux"))]
pub mod hid;
#[cfg(feature = "link")]
mod link;
mod name_order;
mod open_error;
mod pace;
mod plugin_remedy;
#[cfg(unix)]
mod port_user;
#[cfg(all(any(feature = "gcode", feature = "hid", feature = "v4l2"), unix))]
mod present;
mod selector;
mod sensor;
mod source;
#[cfg(feature = "sri")]
pub mod sri;
mod switches;
mod text;
#[cfg(feature = "xarm")]
pub mod ufactory;
#[cfg(feature = "ur")]
pub mod ur;
#[cfg(any(feature = "hid", feature = "netft", feature = "sri"))]
mod zero;

pub use bench_sensor::OnBench;
pub use clock::MonotonicClock;
pub use devices::{Devices, ListedArgument, ListedDevice, ListedDriver, ListedSwitch, devices};
pub use drivers::{Drivers, open};
pub use open_error::OpenError;
pub use pace::{Pace, RealPace, VirtualPace};
pub use plugin_remedy::plugin_remedy;
pub use selector::{Selector, SelectorError};
pub use sensor::replay::{Replay, ReplayFactory, ReplayOptions};
pub use source::{FolderSource, FrameSource, SourceError, Timing};
pub use switches::Switches;
