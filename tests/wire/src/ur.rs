//! Emulated controller of Universal Robots: the real-time data exchange (port 30004), script (port 30002) and the dashboard (port 29999).
//!
//! Supported: the outputs of a version by name (zeros for what is not simulated), `movel` to a pose, `speedl` for a time (without rotation), `stopl` with a
//! register number before it, safety stops, the speed slider, questions at the dashboard. Not supported: inputs, other script, programs
//! of the dashboard, acceleration, joints.

mod dashboard;
mod exchange;
mod outputs;
mod program;

use std::net::{Ipv4Addr, SocketAddr};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use taceva_core::{Pose, Speed};

use self::program::Program;
use crate::base::Base;
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
    dashboard: Server,
}

/// Ports that clients expect: data exchange, and script.
pub const USUAL_PORTS: [u16; 2] = [30_004, 30_002];
/// Port of the dashboard that clients expect.
pub const USUAL_DASHBOARD_PORT: u16 = 29_999;
/// A tool that points down.
const DOWN: [f64; 3] = [std::f64::consts::PI, 0.0, 0.0];
/// Maximum length of a program, bytes.
const PROGRAM_MAX: usize = 4096;

/// The controller.
#[derive(Debug)]
pub(crate) struct Controller {
    bench: WallBench,
    /// Version: major and minor.
    version: [u32; 2],
    inside: Mutex<Inside>,
}

#[derive(Debug)]
struct Inside {
    /// Fault that only a person can clear.
    fault: Option<ArmFault>,
    /// Rotation vector of the tool, which the gel ignores.
    turned: [f64; 3],
    /// Number of the last numbered stop.
    stop_number: i32,
    /// Position of the speed slider, 0 to 1, which slows every motion.
    slider: f64,
}

impl Controller {
    fn inside(&self) -> MutexGuard<'_, Inside> {
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The pose in m and as a rotation vector in rad, in the base frame.
    fn pose(&self) -> [f64; 6] {
        let position = self.bench.pose().position;
        let [x, y, z] = Base::to_base([position.x.0, position.y.0, position.z.0]);
        let [rx, ry, rz] = self.inside().turned;
        [x / 1e3, y / 1e3, z / 1e3, rx, ry, rz]
    }

    fn is_moving(&self) -> bool {
        self.bench.is_moving()
    }

    fn stop_number(&self) -> i32 {
        self.inside().stop_number
    }

    fn slider(&self) -> f64 {
        self.inside().slider
    }

    fn fault(&self) -> Option<ArmFault> {
        self.inside().fault
    }

    /// Ends a protective stop, and no emergency stop.
    fn unlock(&self) {
        let mut inside = self.inside();
        inside.fault = inside.fault.filter(|fault| *fault != ArmFault::Collision);
    }

    /// Moves at a velocity until it expires.
    fn cruise(&self, velocity_m_s: [f64; 3], lasts_s: f64) {
        let speed_mm_s = velocity_m_s.map(|side| side * 1e3);
        let [x, y, z] = speed_mm_s;
        let Ok(speed) = Speed::try_new(x.hypot(y).hypot(z)) else {
            return;
        };
        let here = self.bench.pose();
        let at = here.position;
        let base_mm = Base::to_base([at.x.0, at.y.0, at.z.0]);
        let there_mm = [0, 1, 2].map(|axis| base_mm[axis] + speed_mm_s[axis] * lasts_s);
        let target = Pose {
            rotation: here.rotation,
            ..Base::pose(there_mm, 0.0)
        };
        self.bench.set_out(target, speed);
    }

    /// Replaces the running program.
    fn run(&self, program: &Program) {
        let mut inside = self.inside();
        if inside.fault.is_some() {
            return;
        }
        self.bench.stand();
        if let Program::Stop {
            number: Some(number),
        } = *program
        {
            inside.stop_number = number;
        }
        if let Program::Cruise {
            velocity_m_s,
            lasts_s,
        } = *program
        {
            let scaled = velocity_m_s.map(|side| side * inside.slider);
            self.cruise(scaled, lasts_s);
        }
        if let Program::MoveLine {
            pose: [x, y, z, rx, ry, rz],
            speed_m_s,
        } = *program
            && let Ok(speed) = Speed::try_new(speed_m_s * 1e3 * inside.slider)
        {
            inside.turned = [rx, ry, rz];
            let yaw_rad = 0.0;
            let place = [x, y, z].map(|metres| metres * 1e3);
            self.bench.set_out(Base::pose(place, yaw_rad), speed);
        }
    }
}

impl Emulator {
    /// Starts an arm over the gel of `bench`: switched on, 20 mm above it; port 0 selects any free port. The dashboard has its usual port if
    /// both others have theirs, and otherwise any free one.
    ///
    /// # Errors
    /// [`WireError`] if it cannot listen on a port.
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
        let dashboard = match [states, script] {
            USUAL_PORTS => USUAL_DASHBOARD_PORT,
            _ => 0,
        };
        let controller = Arc::new(Controller {
            bench: bench.clone(),
            version,
            inside: Mutex::new(Inside {
                fault: None,
                turned: DOWN,
                stop_number: 0,
                slider: 1.0,
            }),
        });
        let serving = (Arc::clone(&controller), end.clone());
        let states = Server::start(host, states, &end, move |stream| {
            // A closed client ends its exchange.
            let _ = exchange::serve(stream, &serving.0, &serving.1);
        })?;
        let serving = (Arc::clone(&controller), end.clone());
        let script = Server::start(host, script, &end, move |mut stream| {
            let mut waiting = String::new();
            let mut bytes = [0; 1024];
            loop {
                match read(&mut stream, &mut bytes, &serving.1) {
                    None => continue,
                    Some(0) => return,
                    Some(count) => waiting.push_str(&String::from_utf8_lossy(&bytes[..count])),
                }
                while let Some((program, rest)) = Program::take(&waiting) {
                    waiting = rest;
                    serving.0.run(&program);
                }
                if waiting.len() > PROGRAM_MAX {
                    return;
                }
            }
        })?;
        let serving = (Arc::clone(&controller), end.clone());
        let dashboard = Server::start(host, dashboard, &end, move |stream| {
            // A closed client ends its questions.
            let _ = dashboard::serve(stream, &serving.0, &serving.1);
        })?;
        Ok(Emulator {
            controller,
            states,
            script,
            dashboard,
        })
    }

    /// Sets the speed slider, 0.01 to 1, which slows all later motions and is an output.
    pub fn set_slider(&self, slider: f64) {
        self.controller.inside().slider = slider.clamp(0.01, 1.0);
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
}

impl Arm for Emulator {
    fn suffer(&self, fault: ArmFault) {
        self.controller.inside().fault = Some(fault);
        self.controller.bench.stand();
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
