//! All devices of a bench, served together, as the program does it.

use std::net::{Ipv4Addr, SocketAddr};
use std::path::Path;
use std::sync::Arc;

use clap::ValueEnum;

use crate::bench::WallBench;
use crate::control::Control;
use crate::error::WireError;
use crate::fault::Arm;
use crate::options::BenchOptions;
use crate::rig_file::RigFile;
use crate::{mjpeg, netft, sri, ur, xarm};

/// The robot over the gel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RobotKind {
    /// An arm of UFACTORY.
    Xarm,
    /// An arm of Universal Robots.
    Ur,
    /// A machine with GRBL, on a pseudo-terminal.
    #[cfg(unix)]
    Grbl,
    /// A printer with Marlin, on a pseudo-terminal; its firmware takes a stop while it moves.
    #[cfg(unix)]
    Marlin,
}

/// What measures the force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ForceKind {
    /// A box of SRI.
    Sri,
    /// A Net F/T box of ATI.
    Netft,
}

/// Which devices are served, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct ServeOptions {
    /// The gel.
    pub bench: BenchOptions,
    /// The robot over it.
    pub robot: RobotKind,
    /// What measures the force.
    pub force: ForceKind,
    /// An address of loopback.
    pub host: Ipv4Addr,
    /// Whether ports are those that public clients expect, and not any free ones.
    pub uses_usual_ports: bool,
    /// The version of its firmware that the controller of an xArm reports.
    pub firmware: [u32; 3],
    /// Whether the rig file names the stream that loses nothing.
    pub is_lossless: bool,
}

impl ServeOptions {
    /// An xArm, a box of SRI and a lossless camera over the gel of `bench`, on free ports.
    pub fn over(bench: BenchOptions) -> ServeOptions {
        ServeOptions {
            bench,
            robot: RobotKind::Xarm,
            force: ForceKind::Sri,
            host: Ipv4Addr::LOCALHOST,
            uses_usual_ports: false,
            firmware: xarm::Ports::ANY.firmware,
            is_lossless: true,
        }
    }
}

/// Emulated devices that listen until this is dropped.
pub struct Served {
    bench: WallBench,
    arm: Arc<dyn Arm>,
    control: Control,
    text: String,
    /// Kept until the end: a device that is dropped is unplugged.
    _force: Box<dyn Send + Sync>,
    _camera: mjpeg::Emulator,
}

impl Served {
    /// Starts a robot, a transducer, a camera and the control port.
    ///
    /// # Errors
    /// [`WireError`] if one of them cannot be started.
    pub fn start(options: &ServeOptions) -> Result<Served, WireError> {
        let bench = WallBench::start(&options.bench)?;
        let host = options.host;
        let usual = |port: u16| if options.uses_usual_ports { port } else { 0 };
        let arm: Arc<dyn Arm> = match options.robot {
            RobotKind::Xarm => {
                let ports = match options.uses_usual_ports {
                    true => xarm::Ports::USUAL,
                    false => xarm::Ports::ANY,
                };
                let firmware = options.firmware;
                let ports = xarm::Ports {
                    host,
                    firmware,
                    ..ports
                };
                Arc::new(xarm::Emulator::start(&bench, ports)?)
            }
            RobotKind::Ur => {
                let ports = ur::USUAL_PORTS.map(usual);
                Arc::new(ur::Emulator::start(&bench, host, ports)?)
            }
            #[cfg(unix)]
            RobotKind::Grbl => Arc::new(crate::grbl::Emulator::start(&bench)?),
            #[cfg(unix)]
            RobotKind::Marlin => {
                let firmware = crate::marlin::Firmware::StopsAtOnce;
                Arc::new(crate::marlin::Emulator::start(&bench, firmware)?)
            }
        };
        let (force, selector): (Box<dyn Send + Sync>, String) = match options.force {
            ForceKind::Sri => {
                let force = sri::Emulator::start(&bench, host, usual(sri::USUAL_PORT))?;
                let selector = force.selector();
                (Box::new(force), selector)
            }
            ForceKind::Netft => {
                let force = netft::Emulator::start(&bench, host, usual(netft::USUAL_PORT), 0)?;
                let selector = force.selector();
                (Box::new(force), selector)
            }
        };
        let camera = mjpeg::Emulator::start(&bench, host, 0, mjpeg::Style::Usual)?;
        let url = match options.is_lossless {
            true => camera.png_url(),
            false => camera.url(),
        };
        let control = Control::start(&bench, Some(Arc::clone(&arm)), host, 0)?;
        let text = RigFile {
            bench: &bench,
            robot: arm.selector(),
            force: selector,
            sensor: format!("camera/mjpeg:url={url}"),
            control: &control,
        }
        .text();
        Ok(Served {
            bench,
            arm,
            control,
            text,
            _force: force,
            _camera: camera,
        })
    }

    /// The gel, whose truth is known.
    pub fn bench(&self) -> &WallBench {
        &self.bench
    }

    /// The robot, as its surroundings act on it.
    pub fn arm(&self) -> &dyn Arm {
        &*self.arm
    }

    /// Where faults are injected and the truth is asked for.
    pub fn control_address(&self) -> SocketAddr {
        self.control.address()
    }

    /// The text of the rig file.
    pub fn rig_file(&self) -> &str {
        &self.text
    }

    /// Writes the rig file.
    ///
    /// # Errors
    /// [`WireError::Write`].
    pub fn write_rig_file(&self, path: &Path) -> Result<(), WireError> {
        std::fs::write(path, &self.text).map_err(|source| WireError::Write {
            path: path.to_owned(),
            source,
        })
    }
}
