//! Emulated control box of UFACTORY: commands on port 502, reports on 30001, 30002 and 30003.
//!
//! The box supports queued straight motions: absolute, relative, in the tool frame, with rotation vectors, and in both message layouts. It supports
//! motions of the joints, checks of motions, and velocities of the tip that expire. It also supports queries of versions and poses, enabling, modes,
//! states, errors and their clearing, and messages at the end of a motion. Servo motions, velocities with rotation, blending, limits of jerk, and
//! braking distances are not supported. A motion of the joints moves the tip straight, by the kinematics of an xArm 6. Speeds outside the limits of
//! the rich report are changed without an error. An unknown register is answered with "result invalid".

mod answer;
mod client;
mod controller;
mod joint_motion;
mod kinematics;
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

/// Emulated arm that listens until drop.
#[derive(Debug)]
pub struct Emulator {
    controller: Arc<Controller>,
    command: Server,
    reports: Vec<(Port, Server)>,
}

/// Port of the control box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Port {
    /// Commands and answers.
    Command,
    /// 100 reports per second with state and pose.
    Pose,
    /// 5 reports per second with errors.
    Status,
    /// 5 reports per second with all fields.
    Rich,
}

/// Addresses of the ports; 0 selects any free port.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ports {
    /// Loopback address on which the servers listen.
    pub host: Ipv4Addr,
    /// Port of commands.
    pub command: u16,
    /// Port of poses; `None` for a controller without this port.
    pub pose: Option<u16>,
    /// Port of errors; `None` for a controller without this port.
    pub status: Option<u16>,
    /// Port of complete reports.
    pub rich: u16,
    /// Reported firmware version: major, minor, revision.
    pub firmware: [u32; 3],
}

impl Ports {
    /// Free ports, and a recent firmware.
    pub const ANY: Ports = Ports {
        host: Ipv4Addr::LOCALHOST,
        command: 0,
        pose: Some(0),
        status: Some(0),
        rich: 0,
        firmware: [2, 7, 0],
    };
    /// Ports that clients expect. Many systems reserve port 502 for privileged users.
    pub const USUAL: Ports = Ports {
        command: 502,
        pose: Some(30_003),
        status: Some(30_001),
        rich: 30_002,
        ..Ports::ANY
    };
}

/// Interval at which the arm checks for the end of a motion.
const TICK: Duration = Duration::from_millis(1);

impl Emulator {
    /// Starts an arm over the gel of `bench`: enabled, ready, 20 mm above it.
    ///
    /// # Errors
    /// [`WireError`] if the server cannot listen on a port.
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

    /// Address of `port`; the command port if the arm lacks `port`.
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
            "ufactory/xarm:host={};port={};pose_port={};status_port={};rich_port={}",
            self.command.address().ip(),
            port(Port::Command),
            port(Port::Pose),
            port(Port::Status),
            port(Port::Rich),
        )
    }
}
