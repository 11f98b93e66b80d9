//! Bench behind sockets: the simulated gel of `taceva-sim` in real time, served by emulated devices.
//!
//! A client sees a moving robot, a streaming transducer and a streaming camera, each with the protocol of a real device. All three act
//! on one simulated gel with known truth. Faults can be injected on each link at run time. Every server listens on loopback only, or is a
//! pseudo-terminal.
//!
//! The emulators are **no** test of the devices: emulators and drivers share one interpretation of the documents. Clients of
//! vendors and others, if installed, check the protocols independently.
//!
//! ```
//! use std::net::TcpStream;
//! use taceva_wire::{BenchOptions, WallBench, xarm};
//! let bench = WallBench::start(&BenchOptions::quiet(7))?;
//! let arm = xarm::Emulator::start(&bench, xarm::Ports::ANY)?;
//! assert!(TcpStream::connect(arm.address(xarm::Port::Command)).is_ok());
//! # Ok::<(), taceva_wire::WireError>(())
//! ```

mod base;
mod bench;
mod bench_server;
mod error;
mod fault;
mod link;
mod options;
mod placement;
mod rig_file;
mod server;
#[cfg(unix)]
mod terminal;
#[cfg(unix)]
mod words;

pub mod control;
#[cfg(unix)]
pub mod grbl;
#[cfg(unix)]
pub mod marlin;
pub mod mjpeg;
pub mod netft;
pub mod sri;
#[cfg(target_os = "linux")]
pub mod uhid;
pub mod ur;
pub mod xarm;

pub use base::Base;
pub use bench::{Truth, WallBench};
pub use bench_server::{ForceKind, RobotKind, ServeOptions, Served};
pub use error::WireError;
pub use fault::{Arm, ArmFault, Device, Fault, FaultKind};
pub use options::BenchOptions;
