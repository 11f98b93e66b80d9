//! Serves one client of the real-time data exchange.

use std::io::{self, Write};
use std::net::TcpStream;
use std::time::Duration;

use super::controller::Controller;
use super::inputs::Recipe;
use super::outputs::{NOT_FOUND, type_of};
use crate::fault::{ArmFault, Device, FaultKind};
use crate::link::Link;
use crate::server::{End, read};

/// Minimum rate of state messages, Hz. [`RATES_MAX_HZ`] are the maximum rates of a CB3 and of an e-Series controller.
const RATE_MIN_HZ: f64 = 1.0;
const RATES_MAX_HZ: [f64; 2] = [125.0, 500.0];

/// Outputs, inputs and rate that one client requested.
#[derive(Debug)]
struct Wanted {
    names: Vec<String>,
    /// Recipes of inputs, the first with the number 1.
    inputs: Vec<Recipe>,
    rate_hz: f64,
    is_started: bool,
    /// Version of the controller: major and minor.
    version: [u32; 2],
}

/// A message shorter than its own header.
const HOSTILE: &[u8] = &[0x00, 0x00, b'U'];

/// Answers and sends states until the client closes.
pub(super) fn serve(mut stream: TcpStream, controller: &Controller, end: &End) -> io::Result<()> {
    stream.set_read_timeout(Some(Duration::from_millis(1)))?;
    let bench = &controller.bench;
    let mut wanted = Wanted {
        names: Vec::new(),
        inputs: Vec::new(),
        rate_hz: 125.0,
        is_started: false,
        version: controller.version,
    };
    let mut waiting: Vec<u8> = Vec::new();
    let mut bytes = [0; 4096];
    let mut due = bench.now();
    let mut shown = controller.pose();
    let mut link = Link::new(Device::Robot, HOSTILE);
    loop {
        match read(&mut stream, &mut bytes, end) {
            None => {}
            Some(0) => return Ok(()),
            Some(count) => waiting.extend_from_slice(&bytes[..count]),
        }
        while let Some(&[high, low, kind]) = waiting.first_chunk() {
            let length = usize::from(u16::from_be_bytes([high, low])).max(3);
            if waiting.len() < length {
                break;
            }
            let frame: Vec<u8> = waiting.drain(..length).collect();
            if kind == b'U' {
                wanted.write(&frame[3..], controller);
                continue;
            }
            let answer = wanted.answer(kind, &frame[3..]);
            stream.write_all(&answer)?;
            due = bench.now();
        }
        let now = bench.now();
        link.rest_until(bench, now, |bytes| stream.write_all(bytes))?;
        if !wanted.is_started || due > now {
            continue;
        }
        due = (due + Duration::from_secs_f64(1.0 / wanted.rate_hz)).max(now);
        if !bench.is_faulty(Device::Robot, FaultKind::Frozen) {
            shown = controller.pose();
        }
        let mut pose = shown;
        if bench.is_faulty(Device::Robot, FaultKind::NotANumber) {
            pose[2] = f64::NAN;
        }
        let state = wanted.state(controller, pose);
        link.send(bench, &state, |bytes| stream.write_all(bytes))?;
    }
}

fn message(kind: u8, says: &[u8]) -> Vec<u8> {
    let length = u16::try_from(3 + says.len()).unwrap_or(u16::MAX);
    [&length.to_be_bytes()[..], &[kind], says].concat()
}

impl Wanted {
    fn answer(&mut self, kind: u8, says: &[u8]) -> Vec<u8> {
        match (kind, says) {
            (b'V', [0, version]) => message(b'V', &[u8::from((1..=2).contains(version))]),
            // Version of the controller, and a build.
            (b'v', _) => {
                let [major, minor] = self.version;
                let numbers = [major, minor, 0, 108_249];
                let says: Vec<u8> = numbers.into_iter().flat_map(u32::to_be_bytes).collect();
                message(b'v', &says)
            }
            (b'O', says) if says.len() >= 8 => {
                let (rate, names) = says.split_at(8);
                let rate_hz = rate.try_into().map_or(125.0, f64::from_be_bytes);
                let most_hz = RATES_MAX_HZ[usize::from(self.version[0] >= 5)];
                self.rate_hz = rate_hz.clamp(RATE_MIN_HZ, most_hz);
                let names = String::from_utf8_lossy(names);
                self.names = names.split(',').map(str::to_owned).collect();
                let types = self.names.iter().map(|name| type_of(name, self.version));
                let types: Vec<&str> = types.collect();
                // A recipe with an unknown output is rejected with the number 0.
                let is_known = !types.contains(&NOT_FOUND);
                if !is_known {
                    self.names.clear();
                }
                message(
                    b'O',
                    &[&[u8::from(is_known)], types.join(",").as_bytes()].concat(),
                )
            }
            (b'I', names) => {
                let (recipe, types) = Recipe::read(&String::from_utf8_lossy(names));
                // A recipe with an unknown input is rejected with the number 0.
                let number = match u8::try_from(self.inputs.len() + 1) {
                    Ok(number) if recipe.is_some() => number,
                    _ => 0,
                };
                self.inputs.extend(recipe.filter(|_| number > 0));
                message(b'I', &[&[number], types.as_bytes()].concat())
            }
            (b'S', _) => {
                self.is_started = !self.names.is_empty();
                message(b'S', &[u8::from(self.is_started)])
            }
            (b'P', _) => {
                self.is_started = false;
                message(b'P', &[1])
            }
            // Other messages are rejected.
            (kind, _) => message(kind, &[0]),
        }
    }

    /// Writes the values of a message, which begins with the number of its recipe.
    fn write(&self, says: &[u8], controller: &Controller) {
        let Some((number, values)) = says.split_first() else {
            return;
        };
        let recipe = usize::from(*number).checked_sub(1);
        if let Some(recipe) = recipe.and_then(|at| self.inputs.get(at)) {
            controller.write(recipe, values);
        }
    }

    fn state(&self, controller: &Controller, pose: [f64; 6]) -> Vec<u8> {
        const RUNNING: u32 = 7;
        const STOPPED: u32 = 1;
        const PLAYING: u32 = 2;
        const NORMAL: u32 = 1;
        const PROTECTIVE_STOPPED: u32 = 1 << 2;
        const EMERGENCY_STOPPED: u32 = 1 << 7 | 1 << 6;
        const POWER_ON: u32 = 1;
        const PROGRAM_RUNNING: u32 = 2;
        let is_running = controller.is_running();
        let mut says = vec![1];
        for name in &self.names {
            let word = match name.as_str() {
                "robot_mode" => RUNNING,
                "safety_status_bits" => match controller.fault() {
                    None => NORMAL,
                    Some(ArmFault::EmergencyStop) => EMERGENCY_STOPPED,
                    Some(ArmFault::Collision) => PROTECTIVE_STOPPED,
                },
                "safety_mode" => NORMAL,
                "runtime_state" if is_running => PLAYING,
                "runtime_state" => STOPPED,
                "robot_status_bits" => match controller.fault() {
                    Some(ArmFault::EmergencyStop) => 0,
                    _ if is_running => POWER_ON | PROGRAM_RUNNING,
                    _ => POWER_ON,
                },
                name => {
                    let number = name.strip_prefix("output_int_register_");
                    let number = number.and_then(|number| number.parse().ok());
                    number.map_or(0, |number| {
                        controller.output_register(number).cast_unsigned()
                    })
                }
            };
            match (name.as_str(), type_of(name, self.version)) {
                ("timestamp", _) => {
                    says.extend(controller.bench.now().as_secs_f64().to_be_bytes());
                }
                ("actual_TCP_pose" | "target_TCP_pose", _) => {
                    says.extend(pose.into_iter().flat_map(f64::to_be_bytes));
                }
                ("speed_scaling" | "target_speed_fraction", _) => {
                    says.extend(controller.slider().to_be_bytes());
                }
                (_, "BOOL") => says.push(0),
                (_, "VECTOR6D") => says.extend([0; 48]),
                (_, "VECTOR3D" | "VECTOR6INT32") => says.extend([0; 24]),
                (_, "INT32" | "UINT32") => says.extend(word.to_be_bytes()),
                _ => says.extend([0; 8]),
            }
        }
        message(b'U', &says)
    }
}
