#![doc = include_str!("../README.md")]

#[cfg(feature = "link")]
mod arguments;
#[cfg(feature = "netft")]
mod ati;
#[cfg(feature = "camera")]
mod camera;
mod clock;
mod devices;
pub mod doctor;
mod drivers;
#[cfg(all(feature = "gcode", unix))]
mod gcode;
#[cfg(all(feature = "hid", target_os = "linux"))]
mod hid;
#[cfg(feature = "link")]
mod link;
mod name_order;
mod on_bench;
mod open_error;
mod pace;
#[cfg(all(any(feature = "gcode", feature = "hid", feature = "v4l2"), unix))]
mod present;
mod selector;
mod sensor;
mod source;
#[cfg(feature = "sri")]
mod sri;
mod switches;
mod text;
#[cfg(feature = "xarm")]
mod ufactory;
#[cfg(feature = "ur")]
mod ur;
#[cfg(any(feature = "hid", feature = "netft", feature = "sri"))]
mod zero;

#[cfg(feature = "netft")]
pub use ati::NetftFactory;
#[cfg(feature = "mjpeg")]
pub use camera::MjpegFactory;
#[cfg(all(
    feature = "v4l2",
    target_os = "linux",
    target_pointer_width = "64",
    target_endian = "little"
))]
pub use camera::{V4l2Factory, v4l2_kernel as v4l2};
pub use clock::MonotonicClock;
pub use devices::{Devices, ListedArgument, ListedDevice, ListedDriver, devices};
pub use drivers::{Drivers, open};
#[cfg(all(feature = "grbl", unix))]
pub use gcode::GrblFactory;
#[cfg(all(feature = "marlin", unix))]
pub use gcode::MarlinFactory;
#[cfg(all(feature = "hid", target_os = "linux"))]
pub use hid::{Pedal, ScaleFactory};
pub use on_bench::OnBench;
pub use open_error::OpenError;
pub use pace::{Pace, RealPace, VirtualPace};
pub use selector::{Selector, SelectorError};
pub use sensor::replay::{Replay, ReplayFactory, ReplayOptions};
pub use source::{FolderSource, FrameSource, SourceError, Timing};
#[cfg(feature = "sri")]
pub use sri::M8128Factory;
pub use switches::Switches;
#[cfg(feature = "xarm")]
pub use ufactory::XarmFactory;
#[cfg(feature = "ur")]
pub use ur::UrFactory;
