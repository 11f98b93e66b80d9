//! Emulated machine with GRBL 1.1 at the other end of a pseudo-terminal.
//!
//! The machine supports the queries `?` (with the work offset in some reports), `!`, `~`, reset, `$$`, `$#`, `$G`, `$I` and `$X`. Supported lines are
//! `G53 G1` (with `G21 G90 G94`, with or without blanks), and modes alone. The machine stores one motion in progress and one waiting motion. A reset
//! during a motion causes an alarm. Changes of settings, offsets, arcs, homing and acceleration are not supported.

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
use crate::words::Words;

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
    /// Number of status reports since the last reset.
    reports: u32,
    /// Motion that waits for the motion in progress, or that a hold has interrupted.
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
const OK: &str = "ok\r\n";
const BAD_NUMBER: &str = "error:2\r\n";
const UNKNOWN_QUERY: &str = "error:3\r\n";
const LOCKED: &str = "error:9\r\n";
const UNSUPPORTED: &str = "error:20\r\n";
const NOT_IDLE: &str = "error:8\r\n";
const NO_FEED: &str = "error:22\r\n";
/// Number of status reports per report of the work offset. The first report contains the offset.
const OFFSET_EVERY: u32 = 10;
/// Settings of a machine with a travel of 400 mm and a speed of 5 m/min.
const SETTINGS: &[&str] = &[
    "$0=10",
    "$1=25",
    "$2=0",
    "$3=0",
    "$4=0",
    "$5=0",
    "$6=0",
    "$10=1",
    "$11=0.010",
    "$12=0.002",
    "$13=0",
    "$20=0",
    "$21=0",
    "$22=0",
    "$23=0",
    "$24=25.000",
    "$25=500.000",
    "$26=250",
    "$27=1.000",
    "$30=1000",
    "$31=0",
    "$32=0",
    "$100=250.000",
    "$101=250.000",
    "$102=250.000",
    "$110=5000.000",
    "$111=5000.000",
    "$112=5000.000",
    "$120=100.000",
    "$121=100.000",
    "$122=100.000",
    "$130=400.000",
    "$131=400.000",
    "$132=400.000",
];
/// Work offsets and tool offsets, which are all zero.
const OFFSETS: &[&str] = &[
    "[G54:0.000,0.000,0.000]",
    "[G55:0.000,0.000,0.000]",
    "[G56:0.000,0.000,0.000]",
    "[G57:0.000,0.000,0.000]",
    "[G58:0.000,0.000,0.000]",
    "[G59:0.000,0.000,0.000]",
    "[G28:0.000,0.000,0.000]",
    "[G30:0.000,0.000,0.000]",
    "[G92:0.000,0.000,0.000]",
    "[TLO:0.000]",
    "[PRB:0.000,0.000,0.000:0]",
];
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

    /// Ends a completed motion and begins the waiting motion.
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
        let mut inside = self.inside();
        let offset = match inside.reports % OFFSET_EVERY {
            0 => "|WCO:0.000,0.000,0.000",
            _ => "",
        };
        inside.reports = inside.reports.wrapping_add(1);
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
        format!("<{state}|MPos:{x:.3},{y:.3},{z:.3}|FS:0,0{offset}>\r\n")
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
        if let Some(query) = command.trim().strip_prefix('$') {
            return self.answer(query);
        }
        let Some(words) = Words::read(command) else {
            return BAD_NUMBER.to_owned();
        };
        // Millimetres, absolute places and feeds per minute are the only modes.
        let knows = |number: f64| {
            let known = [1, 21, 53, 54, 90, 94];
            known
                .iter()
                .any(|code| (f64::from(*code) - number).abs() < 1e-9)
        };
        if !words.all('G').all(knows) || words.number('M').is_some() {
            return UNSUPPORTED.to_owned();
        }
        let axes = ['X', 'Y', 'Z'].map(|letter| words.number(letter));
        if !words.has('G', 1) {
            return match axes {
                [None, None, None] => OK.to_owned(),
                _ => UNSUPPORTED.to_owned(),
            };
        }
        let Some(feed) = words.number('F') else {
            return NO_FEED.to_owned();
        };
        let Ok(speed) = Speed::try_new(feed / 60.0) else {
            return NO_FEED.to_owned();
        };
        let mut inside = self.inside();
        if inside.is_alarmed {
            return LOCKED.to_owned();
        }
        let at = self.bench.pose().position;
        let at = Base::to_base([at.x.0, at.y.0, at.z.0]);
        let last = inside.waiting.as_ref().or(inside.current.as_ref());
        let stays = last.map_or(at, |motion| motion.place_mm);
        let place_mm = std::array::from_fn(|axis| axes[axis].unwrap_or(stays[axis]));
        inside.waiting = Some(Motion { place_mm, speed });
        drop(inside);
        self.turn();
        OK.to_owned()
    }

    /// True in a motion or a hold, in which most queries are refused.
    fn is_busy(&self) -> bool {
        self.turn();
        let inside = self.inside();
        !inside.is_alarmed && (inside.is_held || inside.current.is_some())
    }

    /// Answer to a query or a command that begins with `$`.
    fn answer(&self, query: &str) -> String {
        let lines =
            |lines: &[&str]| -> String { lines.iter().map(|line| format!("{line}\r\n")).collect() };
        if ["$", "#", "I"].contains(&query) && self.is_busy() {
            return NOT_IDLE.to_owned();
        }
        let found = match query {
            "$" => lines(SETTINGS),
            "#" => lines(OFFSETS),
            "G" => lines(&["[GC:G1 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]"]),
            "I" => lines(&["[VER:1.1h.20190825:]", "[OPT:V,15,128]"]),
            "X" => {
                self.inside().is_alarmed = false;
                lines(&["[MSG:Caution: Unlocked]"])
            }
            _ => return UNKNOWN_QUERY.to_owned(),
        };
        found + OK
    }
}
