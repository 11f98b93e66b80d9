//! A bench on the wire: the simulated gel of `taceva-sim` in real time, behind the sockets of devices that exist.
//!
//! A client sees a robot that moves, a transducer that streams and a camera that sends pictures, each in the protocol of a real one; what
//! it presses is one simulated gel, whose truth is known. Faults can be put on each link while it runs. Everything listens on loopback alone,
//! or is a pseudo-terminal.
//!
//! It is **not** a test of the devices: protocols here and drivers elsewhere share one reading of the documents. The clients of vendors and
//! of others, which tests start where they are installed, check the protocols independently.
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
mod rig_file;
mod server;
#[cfg(unix)]
mod terminal;

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
