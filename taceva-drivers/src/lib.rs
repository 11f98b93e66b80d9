#![doc = include_str!("../README.md")]

mod clock;
pub mod conformance;
mod devices;
pub mod doctor;
mod drivers;
pub mod fault;
mod guard;
mod name_order;
mod on_bench;
mod pace;
mod random;
mod selector;
mod sensor;
mod source;
mod text;

pub use clock::MonotonicClock;
pub use devices::{Devices, ListedArgument, ListedDevice, ListedDriver, devices};
pub use drivers::{Drivers, OpenError, open};
pub use on_bench::OnBench;
pub use pace::{Pace, RealPace, VirtualPace};
pub use selector::{Selector, SelectorError};
pub use sensor::replay::{Replay, ReplayFactory, ReplayOptions};
pub use source::{FolderSource, FrameSource, SourceError, Timing};
