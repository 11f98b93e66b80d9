//! Emulated controller of Universal Robots: the real-time data exchange (port 30004), script (ports 30002 and 30003) and the dashboard (port 29999).
//!
//! The data exchange has the outputs of the stated version by name (zeros for values that are not simulated), registers, and the speed slider. Script
//! programs may contain `movel` to a pose, `speedl` for a time (without rotation), and `stopl` after a register number. The script of one public
//! client is also supported, and so are safety stops and questions at the dashboard. Digital and analog outputs are accepted and ignored. Other
//! inputs and programs, inputs in use by another client, the states of port 30003, programs of the dashboard, and acceleration are not supported. A
//! motion of the joints moves the tip straight, by the kinematics of a UR5.

mod controller;
mod dashboard;
mod exchange;
mod inputs;
mod joints;
mod outputs;
mod path;
mod program;
mod register_script;

use std::net::{Ipv4Addr, SocketAddr, TcpStream};
use std::sync::Arc;

use self::controller::Controller;
use self::program::Program;
use crate::bench::WallBench;
use crate::error::WireError;
use crate::fault::{Arm, ArmFault};
use crate::server::{End, Server, read};

/// Emulated arm that listens until drop.
#[derive(Debug)]
pub struct Emulator {
    controller: Arc<Controller>,
    states: Server,
    script: Server,
    /// Server of the second port for script programs, which some clients use.
    realtime: Server,
    dashboard: Server,
}

/// Ports that clients expect: for the data exchange, and for script programs.
pub const USUAL_PORTS: [u16; 2] = [30_004, 30_002];
/// Port of the dashboard that clients expect.
pub const USUAL_DASHBOARD_PORT: u16 = 29_999;
/// Second port for script programs that clients expect.
pub const USUAL_REALTIME_PORT: u16 = 30_003;
/// Maximum length of a program, bytes. The script of a public client has 42 kB.
const PROGRAM_MAX: usize = 1 << 16;

impl Emulator {
    /// Starts an arm over the gel of `bench`, switched on and 20 mm above it. `ports` are those of the data exchange and of script programs; port 0
    /// selects any free port. If both are [`USUAL_PORTS`], the other two servers also have their usual ports.
    ///
    /// # Errors
    /// [`WireError`] if the server cannot listen on a port.
    pub fn start(
        bench: &WallBench,
        host: Ipv4Addr,
        ports: [u16; 2],
    ) -> Result<Emulator, WireError> {
        Emulator::of_version(bench, host, ports, [5, 11])
    }

    /// Starts an arm with the controller of a version: major and minor, such as 3 and 15.
    ///
    /// # Errors
    /// As [`start`](Emulator::start).
    pub fn of_version(
        bench: &WallBench,
        host: Ipv4Addr,
        [states, script]: [u16; 2],
        version: [u32; 2],
    ) -> Result<Emulator, WireError> {
        let end = End::default();
        let [dashboard, realtime] = match [states, script] {
            USUAL_PORTS => [USUAL_DASHBOARD_PORT, USUAL_REALTIME_PORT],
            _ => [0, 0],
        };
        let controller = Arc::new(Controller::new(bench, version));
        let serving = (Arc::clone(&controller), end.clone());
        let states = Server::start(host, states, &end, move |stream| {
            // A closed client ends its exchange.
            let _ = exchange::serve(stream, &serving.0, &serving.1);
        })?;
        let start_script = |port: u16| {
            let serving = (Arc::clone(&controller), end.clone());
            Server::start(host, port, &end, move |stream| {
                run_programs(stream, &serving.0, &serving.1);
            })
        };
        let script = start_script(script)?;
        let realtime = start_script(realtime)?;
        let serving = (Arc::clone(&controller), end.clone());
        let dashboard = Server::start(host, dashboard, &end, move |stream| {
            // A closed client ends its questions.
            let _ = dashboard::serve(stream, &serving.0, &serving.1);
        })?;
        Ok(Emulator {
            controller,
            states,
            script,
            realtime,
            dashboard,
        })
    }

    /// Sets the speed slider, 0.01 to 1. The slider slows all later motions, and clients can read it.
    pub fn set_slider(&self, slider: f64) {
        self.controller.set_slider(slider.clamp(0.01, 1.0));
    }

    /// Address of the data exchange.
    pub fn states_address(&self) -> SocketAddr {
        self.states.address()
    }

    /// Address of the dashboard.
    pub fn dashboard_address(&self) -> SocketAddr {
        self.dashboard.address()
    }

    /// Address of the script port.
    pub fn script_address(&self) -> SocketAddr {
        self.script.address()
    }

    /// Address of the second port for script.
    pub fn realtime_address(&self) -> SocketAddr {
        self.realtime.address()
    }
}

/// Runs the programs of a client until it closes.
fn run_programs(mut stream: TcpStream, controller: &Controller, end: &End) {
    let mut waiting = String::new();
    let mut bytes = [0; 4096];
    loop {
        match read(&mut stream, &mut bytes, end) {
            None => continue,
            Some(0) => return,
            Some(count) => waiting.push_str(&String::from_utf8_lossy(&bytes[..count])),
        }
        while let Some((program, rest)) = Program::take(&waiting) {
            waiting = rest;
            controller.run(&program);
        }
        if waiting.len() > PROGRAM_MAX {
            return;
        }
    }
}

impl Arm for Emulator {
    fn suffer(&self, fault: ArmFault) {
        self.controller.suffer(fault);
    }

    fn selector(&self) -> String {
        let [states, script] = [&self.states, &self.script].map(Server::address);
        format!(
            "ur/rtde:host={};port={};script_port={}",
            states.ip(),
            states.port(),
            script.port()
        )
    }
}
