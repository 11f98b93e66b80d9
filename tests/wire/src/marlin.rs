//! Emulated printer with Marlin 2 at the other end of a pseudo-terminal.
//!
//! The printer supports queued `G0` and `G1`, with `G21 G90`, some or all coordinates, and with or without blanks. It supports line numbers and
//! checksums, and asks to resend damaged lines. Other commands are `M105` without heaters, `M110`, `M114` with the planned position, `M115`, `M118`,
//! `M400` and immediate `M410`. Heating, homing, acceleration and lost steps are not supported.

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
use crate::words::Words;

/// Emulated printer, unplugged on drop.
#[derive(Debug)]
pub struct Emulator {
    printer: Arc<Printer>,
    line: ServedLine,
}

/// Firmware build of an emulated printer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Firmware {
    /// Executes a stop at once, even during a motion.
    StopsAtOnce,
    /// Executes a stop only after all commands that it received before.
    StopsInTurn,
    /// Does not know the echo command `M118`.
    WithoutEcho,
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
    /// Last feed rate, mm/min, which later motions keep; `None` before the first.
    feed: Option<f64>,
    /// Number of the last numbered line.
    last_line: i64,
    /// Number of numbered lines that will arrive damaged.
    damaged: u32,
    /// Line that will be lost; `None` if no line will be lost.
    lost: Option<String>,
    /// Commands received while an earlier command waits for all motions to end.
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

    /// Damages the next `lines` numbered lines.
    pub fn damage(&self, lines: u32) {
        self.printer.inside().damaged = lines;
    }

    /// Loses the next line that equals `line`.
    pub fn lose(&self, line: &str) {
        self.printer.inside().lost = Some(line.to_owned());
    }

    /// Restarts the count of lines, as a restart of the printer does.
    pub fn restart(&self) {
        self.printer.inside().last_line = 0;
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

    /// Ends a completed motion, begins the next, and executes commands that waited for the motions to end. Returns their answers.
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

    /// Handles a received line and returns the answers. If an earlier command still waits, the new command is stored and answered later.
    fn take(&self, line: &str) -> String {
        let mut inside = self.inside();
        if inside.is_killed || line.is_empty() {
            return String::new();
        }
        if inside.lost.take_if(|lost| lost.as_str() == line).is_some() {
            return String::new();
        }
        let is_damaged = inside.damaged > 0 && line.starts_with('N');
        inside.damaged -= u32::from(is_damaged);
        let read = match is_damaged {
            true => Err("checksum mismatch"),
            false => numbered(line, inside.last_line),
        };
        let line = match read {
            Ok(Numbered { number, command }) => {
                inside.last_line = number.unwrap_or(inside.last_line);
                command
            }
            Err(why) => {
                let last = inside.last_line;
                return format!("Error:{why}, Last Line: {last}\nResend: {}\n{OK}", last + 1);
            }
        };
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
        let code = line.split_whitespace().next().unwrap_or_default();
        match code {
            "G21" | "G90" | "M110" | "M400" => OK.to_owned(),
            "M105" => "ok T:21.00 /0.00 B:21.00 /0.00 @:0 B@:0\n".to_owned(),
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
            "M118" if self.firmware != Firmware::WithoutEcho => {
                format!("{}\n{OK}", line[4..].trim_start())
            }
            _ => match Words::read(line)
                .filter(|words| [0, 1].iter().any(|code| words.has('G', *code)))
            {
                Some(words) => {
                    self.go(inside, &words);
                    OK.to_owned()
                }
                None => format!("echo:Unknown command: \"{line}\"\n{OK}"),
            },
        }
    }

    /// Queues a motion. Coordinates and feed that the line lacks do not change.
    fn go(&self, inside: &mut Inside, words: &Words) {
        let at = self.bench.pose().position;
        let at = Base::to_base([at.x.0, at.y.0, at.z.0]);
        let last = inside.waiting.back().or(inside.current.as_ref());
        let [x, y, z] = last.map_or(at, |motion| motion.place_mm);
        let place_mm = [('X', x), ('Y', y), ('Z', z)]
            .map(|(letter, stays)| words.number(letter).unwrap_or(stays));
        inside.feed = words.number('F').or(inside.feed);
        let speed = inside
            .feed
            .and_then(|feed| Speed::try_new(feed / 60.0).ok());
        let Some(speed) = speed else {
            return;
        };
        inside.waiting.push_back(Motion { place_mm, speed });
        if !self.bench.is_moving() {
            inside.current = inside.waiting.pop_front();
            self.bench.set_out(Base::pose(place_mm, 0.0), speed);
        }
    }
}

/// Command of a line, and its number if it has one.
#[derive(Debug, PartialEq)]
struct Numbered<'a> {
    number: Option<i64>,
    command: &'a str,
}

/// Removes number and checksum from a line that follows line `last`. The error is the message of the firmware.
fn numbered(line: &str, last: i64) -> Result<Numbered<'_>, &'static str> {
    let (text, checksum) = match line.rsplit_once('*') {
        Some((text, checksum)) => (text, Some(checksum)),
        None => (line, None),
    };
    let Some(behind) = text.strip_prefix('N') else {
        return match checksum {
            Some(_) => Err("No Line Number with checksum"),
            None => Ok(Numbered {
                number: set_number(text),
                command: text,
            }),
        };
    };
    let (number, command) = behind.split_once(' ').unwrap_or((behind, ""));
    let command = command.trim();
    let set = set_number(command);
    let number: i64 = number.parse().unwrap_or(i64::MIN);
    if number != last + 1 && set.is_none() {
        return Err("Line Number is not Last Line Number+1");
    }
    let Some(checksum) = checksum else {
        return Err("No Checksum with line number");
    };
    let sum = text.bytes().fold(0, |sum, byte| sum ^ byte);
    if checksum.trim().parse::<u8>() != Ok(sum) {
        return Err("checksum mismatch");
    }
    Ok(Numbered {
        number: set.or(Some(number)),
        command,
    })
}

/// Number that `M110 N5` sets; `None` for another command.
fn set_number(command: &str) -> Option<i64> {
    command.strip_prefix("M110 N")?.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_with_a_wrong_number_or_checksum_is_asked_for_again() {
        // As printrun 2.2.0 writes them.
        for (line, last, number, command) in [
            ("N-1 M110 N-1*125", 7, Some(-1), "M110 N-1"),
            ("N0 G21*26", -1, Some(0), "G21"),
            ("N2 G1 X1 Y2 Z3 F600*49", 1, Some(2), "G1 X1 Y2 Z3 F600"),
            ("G21", 5, None, "G21"),
            ("M110 N9", 5, Some(9), "M110 N9"),
        ] {
            assert_eq!(numbered(line, last), Ok(Numbered { number, command }));
        }
        for (line, last, error) in [
            ("N2 G1 X1 Y2 Z3 F600*48", 1, "checksum mismatch"),
            ("N2 G1 X1 Y2 Z4 F600*49", 1, "checksum mismatch"),
            ("N0 G21*26", 3, "Line Number is not Last Line Number+1"),
            ("N0 G21", -1, "No Checksum with line number"),
            ("G21*26", 3, "No Line Number with checksum"),
            ("N0 G21*x", -1, "checksum mismatch"),
        ] {
            assert_eq!(numbered(line, last), Err(error), "{line}");
        }
    }
}
