//! Server of all devices of a bench, as the program starts it.

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

/// Robot over the gel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RobotKind {
    /// An arm of UFACTORY.
    Xarm,
    /// An arm of Universal Robots.
    Ur,
    /// A machine with GRBL, on a pseudo-terminal.
    #[cfg(unix)]
    Grbl,
    /// A printer with Marlin, on a pseudo-terminal; its firmware accepts a stop during a motion.
    #[cfg(unix)]
    Marlin,
}

/// Device that measures the force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ForceKind {
    /// A box of SRI.
    Sri,
    /// A Net F/T box of ATI.
    Netft,
}

/// Served devices, and their addresses.
#[derive(Clone, Debug, PartialEq)]
pub struct ServeOptions {
    /// Options of the simulated gel.
    pub bench: BenchOptions,
    /// Robot over the gel.
    pub robot: RobotKind,
    /// Device that measures the force.
    pub force: ForceKind,
    /// Settings of a Net F/T box.
    pub netft: netft::Setup,
    /// Loopback address on which the servers listen.
    pub host: Ipv4Addr,
    /// True to listen on the ports that public clients expect, false to listen on any free ports.
    pub uses_usual_ports: bool,
    /// Firmware version reported by the xArm controller.
    pub firmware: [u32; 3],
    /// True if the rig file names the camera's stream of lossless pictures.
    pub is_lossless: bool,
}

impl ServeOptions {
    /// Options for an xArm, a box of SRI and a lossless camera over the gel of `bench`, on free ports.
    pub fn over(bench: BenchOptions) -> ServeOptions {
        ServeOptions {
            bench,
            robot: RobotKind::Xarm,
            force: ForceKind::Sri,
            netft: netft::Setup::PLAIN,
            host: Ipv4Addr::LOCALHOST,
            uses_usual_ports: false,
            firmware: xarm::Ports::ANY.firmware,
            is_lossless: true,
        }
    }
}

/// Emulated devices that listen until drop.
pub struct Served {
    bench: WallBench,
    arm: Arc<dyn Arm>,
    control: Control,
    text: String,
    /// Force device, kept until the end, because a dropped device is unplugged.
    _force: Box<dyn Send + Sync>,
    _camera: mjpeg::Emulator,
}

impl Served {
    /// Starts a robot, a transducer, a camera and the control port.
    ///
    /// # Errors
    /// [`WireError`] if one of them does not start.
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
                let port = usual(netft::USUAL_PORT);
                let force = netft::Emulator::set_up(&bench, host, port, 0, options.netft)?;
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

    /// The gel, with its true state.
    pub fn bench(&self) -> &WallBench {
        &self.bench
    }

    /// The robot, for injecting faults such as an emergency stop.
    pub fn arm(&self) -> &dyn Arm {
        &*self.arm
    }

    /// Address of the control port, which injects faults and returns the true state.
    pub fn control_address(&self) -> SocketAddr {
        self.control.address()
    }

    /// Text of the rig file.
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
