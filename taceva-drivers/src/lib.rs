#![doc = include_str!("../README.md")]

mod devices;
mod drivers;
mod guard;
mod pace;
mod selector;
mod sensor;
mod source;

pub use devices::{Devices, ListedArgument, ListedDevice, ListedDriver, devices};
pub use drivers::{Drivers, OpenError, open};
pub use pace::{Pace, RealPace, VirtualPace};
pub use selector::{Selector, SelectorError};
pub use sensor::replay::{Replay, ReplayFactory, ReplayOptions};
pub use source::{FolderSource, FrameSource, SourceError, Timing};
