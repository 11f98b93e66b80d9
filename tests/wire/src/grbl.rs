//! Emulated machine with GRBL 1.1 at the other end of a pseudo-terminal.
//!
//! Supported: `?`, `!`, `~`, `$I`, reset, `G53 G1` (with `G21 G90 G94`), one motion and one waiting, alarm at a reset during a motion. Not
//! supported: settings, offsets, arcs, homing, acceleration.

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

/// Emulated machine, unplugged on drop.
#[derive(Debug)]
pub struct Emulator {
    machine: Arc<Machine>,
    line: ServedLine,
}

#[derive(Debug)]
struct Machine {
    bench: WallBench,
    inside: Mutex<Inside>,
}

#[derive(Debug, Default)]
struct Inside {
    is_held: bool,
    is_alarmed: bool,
    /// Held or waiting motion.
    waiting: Option<Motion>,
    /// Motion in progress.
    current: Option<Motion>,
}

#[derive(Clone, Copy, Debug)]
struct Motion {
    place_mm: [f64; 3],
    speed: Speed,
}

/// Interval at which the machine reads bytes.
const LOOK: Duration = Duration::from_millis(1);
const RESET: u8 = 0x18;
const BANNER: &str = "\r\nGrbl 1.1h ['$' for help]\r\n";

impl Emulator {
    /// Starts a machine over the gel of `bench`: idle, 20 mm above it.
    ///
    /// # Errors
    /// [`WireError`] if the system provides no pseudo-terminal.
    pub fn start(bench: &WallBench) -> Result<Emulator, WireError> {
        let machine = Arc::new(Machine {
            bench: bench.clone(),
            inside: Mutex::default(),
        });
        let serving = Arc::clone(&machine);
        let line = ServedLine::start("grbl", move |file, end| serve(file, &serving, end))?;
        Ok(Emulator { machine, line })
    }
}

impl Arm for Emulator {
    /// Every fault puts the machine into alarm.
    fn suffer(&self, _: ArmFault) {
        let mut inside = self.machine.inside();
        self.machine.bench.stand();
        *inside = Inside {
            is_alarmed: true,
            ..Inside::default()
        };
    }

    fn selector(&self) -> String {
        format!("gcode/grbl:port={}", self.line.path())
    }
}

fn serve(mut file: File, machine: &Machine, end: &End) {
    let mut line = Vec::new();
    let mut bytes = [0; 256];
    let _ = file.write_all(BANNER.as_bytes());
    while !end.has_come() {
        machine.turn();
        let Ok(count @ 1..) = file.read(&mut bytes) else {
            std::thread::sleep(LOOK);
            continue;
        };
        for byte in &bytes[..count] {
            let answer = match byte {
                b'?' => machine.status(),
                b'!' => machine.hold(),
                b'~' => machine.go_on(),
                &RESET => {
                    line.clear();
                    machine.reset()
                }
                b'\n' => {
                    let command = String::from_utf8_lossy(&line).into_owned();
                    line.clear();
                    machine.take(&command)
                }
                b'\r' => String::new(),
                byte => {
                    line.push(*byte);
                    String::new()
                }
            };
            let bench = &machine.bench;
            std::thread::sleep(bench.delay(Device::Robot));
            if !bench.withholds(Device::Robot) {
                let _ = file.write_all(answer.as_bytes());
            }
        }
    }
}

impl Machine {
    fn inside(&self) -> MutexGuard<'_, Inside> {
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Ends a completed motion and begins the next.
    fn turn(&self) {
        let mut inside = self.inside();
        if inside.is_held || self.bench.is_moving() {
            return;
        }
        inside.current = inside.waiting.take();
        if let Some(Motion { place_mm, speed }) = inside.current {
            self.bench.set_out(Base::pose(place_mm, 0.0), speed);
        }
    }

    fn status(&self) -> String {
        self.turn();
        let inside = self.inside();
        let state = if inside.is_alarmed {
            "Alarm"
        } else if inside.is_held {
            "Hold:0"
        } else if inside.current.is_some() {
            "Run"
        } else {
            "Idle"
        };
        let position = self.bench.pose().position;
        let [x, y, mut z] = Base::to_base([position.x.0, position.y.0, position.z.0]);
        if self.bench.is_faulty(Device::Robot, FaultKind::NotANumber) {
            z = f64::NAN;
        }
        format!("<{state}|MPos:{x:.3},{y:.3},{z:.3}|FS:0,0>\r\n")
    }

    fn hold(&self) -> String {
        let mut inside = self.inside();
        if !inside.is_alarmed {
            self.bench.stand();
            inside.is_held = true;
            if let Some(current) = inside.current.take() {
                inside.waiting.get_or_insert(current);
            }
        }
        String::new()
    }

    fn go_on(&self) -> String {
        self.inside().is_held = false;
        String::new()
    }

    fn reset(&self) -> String {
        let mut inside = self.inside();
        let was_moving = inside.current.is_some();
        self.bench.stand();
        *inside = Inside {
            // A reset during a motion loses the position.
            is_alarmed: inside.is_alarmed || was_moving,
            ..Inside::default()
        };
        if was_moving {
            format!("ALARM:3\r\n{BANNER}")
        } else {
            BANNER.to_owned()
        }
    }

    fn take(&self, command: &str) -> String {
        const LOCKED: &str = "error:9\r\n";
        const UNSUPPORTED: &str = "error:20\r\n";
        const OK: &str = "ok\r\n";
        let words: Vec<&str> = command.split_whitespace().collect();
        if words.is_empty() {
            return OK.to_owned();
        }
        if words == ["$I"] {
            return format!("[VER:1.1h.20190825:]\r\n[OPT:V,15,128]\r\n{OK}");
        }
        let number = |letter: char| {
            let word = words.iter().find_map(|word| word.strip_prefix(letter));
            word.and_then(|number| number.parse::<f64>().ok())
        };
        let is_line = ["G53", "G1"].iter().all(|word| words.contains(word));
        let place = [number('X'), number('Y'), number('Z')];
        let ([Some(x), Some(y), Some(z)], Some(feed), true) = (place, number('F'), is_line) else {
            return UNSUPPORTED.to_owned();
        };
        let Ok(speed) = Speed::try_new(feed / 60.0) else {
            return UNSUPPORTED.to_owned();
        };
        let mut inside = self.inside();
        if inside.is_alarmed {
            return LOCKED.to_owned();
        }
        inside.waiting = Some(Motion {
            place_mm: [x, y, z],
            speed,
        });
        drop(inside);
        self.turn();
        OK.to_owned()
    }
}
