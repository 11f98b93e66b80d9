//! An emulated control box of UFACTORY: commands on port 502, reports on 30001, 30002 and 30003.
//!
//! What it does: versions, enabling, modes, states, straight motions (absolute and relative, both layouts) with a queue, velocities
//! of the tip that expire, poses, errors and their clearing, the push at the end of a motion. What it does not: servo motions, velocities that turn, blending, joints, limits of speed and
//! jerk, braking ways. An unknown register is answered with "result invalid".

mod answer;
mod client;
mod controller;
mod line;
mod report;
mod session;

use std::net::{Ipv4Addr, SocketAddr};
use std::sync::Arc;
use std::time::Duration;

use self::controller::Controller;
use self::report::ReportPort;
use crate::bench::WallBench;
use crate::error::WireError;
use crate::fault::{Arm, ArmFault};
use crate::server::{End, Server};

/// An emulated arm that listens until this is dropped.
#[derive(Debug)]
pub struct Emulator {
    controller: Arc<Controller>,
    command: Server,
    reports: Vec<(Port, Server)>,
}

/// Which port of the control box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Port {
    /// Commands and their answers.
    Command,
    /// 100 reports a second with state and pose.
    Pose,
    /// 5 reports a second with errors.
    Status,
    /// 5 reports a second with everything.
    Rich,
}

/// Where it listens; 0 for any free port.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ports {
    /// An address of loopback.
    pub host: Ipv4Addr,
    /// Of commands.
    pub command: u16,
    /// Of poses; `None` for a controller that has no such port.
    pub pose: Option<u16>,
    /// Of errors; `None` for a controller that has no such port.
    pub status: Option<u16>,
    /// Of everything.
    pub rich: u16,
    /// The version of its firmware that it reports: major, minor, revision.
    pub firmware: [u32; 3],
}

impl Ports {
    /// Free ports, and a firmware of today.
    pub const ANY: Ports = Ports {
        host: Ipv4Addr::LOCALHOST,
        command: 0,
        pose: Some(0),
        status: Some(0),
        rich: 0,
        firmware: [2, 7, 0],
    };
    /// The ports that clients expect, of which 502 may be bound by few users.
    pub const USUAL: Ports = Ports {
        command: 502,
        pose: Some(30_003),
        status: Some(30_001),
        rich: 30_002,
        ..Ports::ANY
    };
}

/// How often the arm looks whether a motion has ended.
const TICK: Duration = Duration::from_millis(1);

impl Emulator {
    /// Starts an arm over the gel of `bench`: enabled, ready, 20 mm above it.
    ///
    /// # Errors
    /// [`WireError`] if a port cannot be listened on.
    pub fn start(bench: &WallBench, ports: Ports) -> Result<Emulator, WireError> {
        let end = End::default();
        let controller = Arc::new(Controller::new(bench.clone(), ports.firmware));
        let serving = (Arc::clone(&controller), end.clone());
        let command = Server::start(ports.host, ports.command, &end, move |stream| {
            session::serve(stream, &serving.0, &serving.1);
        })?;
        let wanted = [
            (Port::Pose, ports.pose, ReportPort::Pose),
            (Port::Status, ports.status, ReportPort::Status),
            (Port::Rich, Some(ports.rich), ReportPort::Rich),
        ];
        let mut reports = Vec::new();
        for (port, number, kind) in wanted {
            let Some(number) = number else {
                continue;
            };
            let serving = (Arc::clone(&controller), end.clone());
            let server = Server::start(ports.host, number, &end, move |stream| {
                report::serve(stream, kind, &serving.0, &serving.1);
            })?;
            reports.push((port, server));
        }
        let turning = (Arc::downgrade(&controller), end.clone());
        std::thread::Builder::new()
            .name("arm".to_owned())
            .spawn(move || {
                while !turning.1.has_come() {
                    let Some(controller) = turning.0.upgrade() else {
                        return;
                    };
                    controller.turn();
                    drop(controller);
                    std::thread::sleep(TICK);
                }
            })
            .map_err(WireError::Thread)?;
        Ok(Emulator {
            controller,
            command,
            reports,
        })
    }

    /// Where `port` is listened on; that of commands in the place of one that it does not have.
    pub fn address(&self, port: Port) -> SocketAddr {
        let found = self.reports.iter().find(|(kind, _)| *kind == port);
        found.map_or(self.command.address(), |(_, server)| server.address())
    }
}

impl Arm for Emulator {
    fn suffer(&self, fault: ArmFault) {
        self.controller.suffer(fault);
    }

    fn selector(&self) -> String {
        let port = |port| self.address(port).port();
        format!(
            "ufactory/xarm:host={};port={};pose_port={};status_port={}",
            self.command.address().ip(),
            port(Port::Command),
            port(Port::Pose),
            port(Port::Status),
        )
    }
}
