//! Emulated printer with Marlin 2 at the other end of a pseudo-terminal.
//!
//! Supported: queued `G1` (with `G21 G90`), `M114` with the planned position, `M115`, `M118`, `M400`, and immediate `M410`. Not supported:
//! heating, homing, acceleration, line numbers, lost steps.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{Read, Write};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use taceva_core::Speed;

use crate::base::Base;
use crate::bench::WallBench;
use crate::error::WireError;
use crate::fault::{Arm, ArmFault, Device, FaultKind};
use crate::server::End;
use crate::terminal::ServedLine;

/// Emulated printer, unplugged on drop.
#[derive(Debug)]
pub struct Emulator {
    printer: Arc<Printer>,
    line: ServedLine,
}

/// Firmware build of an emulated printer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Firmware {
    /// Accepts a stop during a motion.
    StopsAtOnce,
    /// Executes a stop after earlier commands.
    StopsInTurn,
}

#[derive(Debug)]
struct Printer {
    bench: WallBench,
    firmware: Firmware,
    inside: Mutex<Inside>,
}

#[derive(Debug, Default)]
struct Inside {
    is_killed: bool,
    current: Option<Motion>,
    waiting: VecDeque<Motion>,
    /// Commands received while another one waits for the motions.
    lines: VecDeque<String>,
}

#[derive(Clone, Copy, Debug)]
struct Motion {
    place_mm: [f64; 3],
    speed: Speed,
}

/// Interval at which the printer reads bytes.
const LOOK: Duration = Duration::from_millis(1);
const OK: &str = "ok\n";
const KILLED: &str = "Error:Printer halted. kill() called!\n";

impl Emulator {
    /// Starts a printer over the gel of `bench`: at rest, 20 mm above it.
    ///
    /// # Errors
    /// [`WireError`] if the system provides no pseudo-terminal.
    pub fn start(bench: &WallBench, firmware: Firmware) -> Result<Emulator, WireError> {
        let printer = Arc::new(Printer {
            bench: bench.clone(),
            firmware,
            inside: Mutex::default(),
        });
        let serving = Arc::clone(&printer);
        let line = ServedLine::start("marlin", move |file, end| serve(file, &serving, end))?;
        Ok(Emulator { printer, line })
    }
}

impl Arm for Emulator {
    /// Every fault makes the firmware stop.
    fn suffer(&self, _: ArmFault) {
        let mut inside = self.printer.inside();
        self.printer.bench.stand();
        *inside = Inside {
            is_killed: true,
            ..Inside::default()
        };
    }

    fn selector(&self) -> String {
        format!("gcode/marlin:port={}", self.line.path())
    }
}

fn serve(mut file: File, printer: &Printer, end: &End) {
    let mut line = Vec::new();
    let mut bytes = [0; 256];
    let mut was_killed = false;
    let _ = file.write_all(b"start\necho:Marlin 2.1 emulated\n");
    while !end.has_come() {
        let mut answer = printer.turn();
        let is_killed = printer.inside().is_killed;
        if is_killed && !was_killed {
            answer += KILLED;
        }
        was_killed = is_killed;
        let count = file.read(&mut bytes).unwrap_or(0);
        for byte in &bytes[..count] {
            match byte {
                b'\n' => {
                    answer += &printer.take(String::from_utf8_lossy(&line).trim());
                    line.clear();
                }
                byte => line.push(*byte),
            }
        }
        if answer.is_empty() {
            std::thread::sleep(LOOK);
            continue;
        }
        let bench = &printer.bench;
        std::thread::sleep(bench.delay(Device::Robot));
        if !bench.withholds(Device::Robot) {
            let _ = file.write_all(answer.as_bytes());
        }
    }
}

impl Printer {
    fn inside(&self) -> MutexGuard<'_, Inside> {
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Ends a completed motion, begins the next, and executes commands that waited for them.
    fn turn(&self) -> String {
        let mut inside = self.inside();
        if inside.is_killed {
            return String::new();
        }
        if !self.bench.is_moving() {
            inside.current = inside.waiting.pop_front();
            if let Some(Motion { place_mm, speed }) = inside.current {
                self.bench.set_out(Base::pose(place_mm, 0.0), speed);
            }
        }
        let mut answers = String::new();
        while let Some(line) = inside.lines.front() {
            if line == "M400" && inside.current.is_some() {
                break;
            }
            let line = line.clone();
            inside.lines.pop_front();
            answers += &self.carry_out(&mut inside, &line);
        }
        answers
    }

    /// Handles a received command; commands after a waiting one are answered later.
    fn take(&self, line: &str) -> String {
        let mut inside = self.inside();
        if inside.is_killed || line.is_empty() {
            return String::new();
        }
        if line == "M410" && self.firmware == Firmware::StopsAtOnce {
            self.stop(&mut inside);
        }
        inside.lines.push_back(line.to_owned());
        drop(inside);
        self.turn()
    }

    fn stop(&self, inside: &mut Inside) {
        self.bench.stand();
        inside.current = None;
        inside.waiting.clear();
    }

    fn carry_out(&self, inside: &mut Inside, line: &str) -> String {
        let words: Vec<&str> = line.split_whitespace().collect();
        let number = |letter: char| {
            let word = words.iter().find_map(|word| word.strip_prefix(letter));
            word.and_then(|number| number.parse::<f64>().ok())
        };
        match words.first().copied().unwrap_or_default() {
            "G21" | "G90" | "M400" => OK.to_owned(),
            "M410" => {
                self.stop(inside);
                OK.to_owned()
            }
            "M114" => {
                let at = self.bench.pose().position;
                let at = Base::to_base([at.x.0, at.y.0, at.z.0]);
                let last = inside.waiting.back().or(inside.current.as_ref());
                let [x, y, mut z] = last.map_or(at, |motion| motion.place_mm);
                if self.bench.is_faulty(Device::Robot, FaultKind::NotANumber) {
                    z = f64::NAN;
                }
                format!("X:{x:.2} Y:{y:.2} Z:{z:.2} E:0.00 Count X:0 Y:0 Z:0\n{OK}")
            }
            "M115" => {
                let is = u8::from(self.firmware == Firmware::StopsAtOnce);
                format!(
                    "FIRMWARE_NAME:Marlin 2.1 emulated\nCap:EMERGENCY_PARSER:{is}\nCap:TACEVA_SIM:1\n{OK}"
                )
            }
            "M118" => format!("{}\n{OK}", line[4..].trim_start()),
            "G1" => {
                let place = [number('X'), number('Y'), number('Z')];
                let speed = number('F').and_then(|feed| Speed::try_new(feed / 60.0).ok());
                if let ([Some(x), Some(y), Some(z)], Some(speed)) = (place, speed) {
                    inside.waiting.push_back(Motion {
                        place_mm: [x, y, z],
                        speed,
                    });
                    if !self.bench.is_moving() {
                        inside.current = inside.waiting.pop_front();
                        let place = Base::pose([x, y, z], 0.0);
                        self.bench.set_out(place, speed);
                    }
                }
                OK.to_owned()
            }
            _ => format!("echo:Unknown command: \"{line}\"\n{OK}"),
        }
    }
}
