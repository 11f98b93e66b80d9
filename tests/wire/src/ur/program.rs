//! Programs in the vendor's script language, as far as the emulator supports them.

use super::path::numbers;
use super::register_script::{FIRST_LINE, Setup};

/// A program that a client sent.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Program {
    /// Moves in a straight line to x, y, z in m and a rotation vector in rad.
    MoveLine { pose: [f64; 6], speed_m_s: f64 },
    /// Moves at a velocity of x, y, z in m/s for a time, then brakes.
    Cruise {
        velocity_m_s: [f64; 3],
        lasts_s: f64,
    },
    /// Stops the motion, and reports the number of this stop if it has one.
    Stop { number: Option<i32> },
    /// The script of a public client that takes commands from registers.
    Registers(Setup),
    /// Any other program: replaces the running one and does nothing.
    Other,
}

/// The last line of a program.
const END: &str = "\nend\n";

impl Program {
    /// First complete program in `text`, and the text after it.
    pub(super) fn take(text: &str) -> Option<(Program, String)> {
        let (program, rest) = text.split_once(END)?;
        Some((Program::read(program), rest.to_owned()))
    }

    fn read(program: &str) -> Program {
        if program.trim_start().starts_with(FIRST_LINE) {
            return Program::Registers(Setup::of(program));
        }
        if program.contains("speedl(") {
            return Program::cruise(program).unwrap_or(Program::Other);
        }
        if program.contains("stopl(") {
            return Program::Stop {
                number: number_of(program),
            };
        }
        Program::move_line(program).unwrap_or(Program::Other)
    }

    fn cruise(program: &str) -> Option<Program> {
        let (_, call) = program.split_once("speedl([")?;
        let (velocity, rest) = call.split_once(']')?;
        // Velocities with rotation are not supported.
        let &[x, y, z, 0.0, 0.0, 0.0] = &numbers(velocity)?[..] else {
            return None;
        };
        let (_, lasts) = rest.split_once("t=")?;
        let lasts_s: f64 = lasts[..lasts.find([',', ')'])?].trim().parse().ok()?;
        Some(Program::Cruise {
            velocity_m_s: [x, y, z],
            lasts_s: Some(lasts_s).filter(|lasts_s| (0.0..=10.0).contains(lasts_s))?,
        })
    }

    fn move_line(program: &str) -> Option<Program> {
        let (_, call) = program.split_once("movel(p[")?;
        let (pose, rest) = call.split_once(']')?;
        let &[x, y, z, rx, ry, rz] = &numbers(pose)?[..] else {
            return None;
        };
        let (_, speed) = rest.split_once("v=")?;
        let end = speed.find([',', ')'])?;
        Some(Program::MoveLine {
            pose: [x, y, z, rx, ry, rz],
            speed_m_s: speed[..end].trim().parse().ok()?,
        })
    }
}

/// Number that a program writes to [`REGISTER`]; `None` if it writes none.
fn number_of(program: &str) -> Option<i32> {
    let call = format!("write_output_integer_register({REGISTER},");
    let (_, number) = program.split_once(&call)?;
    let (number, _) = number.split_once(')')?;
    number.trim().parse().ok()
}

/// Only integer register that programs may write and clients may read.
pub(super) const REGISTER: u8 = 24;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_are_taken_one_by_one() {
        let text = "def a():\n  movel(p[0.3, 0.0, 0.25, 3.125, 0, 0], a=0.5, v=0.005)\nend\ndef b():\n  stopl(2.0)\nend\ndef";
        let (first, rest) = Program::take(text).expect("a program");
        let expected = Program::MoveLine {
            pose: [0.3, 0.0, 0.25, 3.125, 0.0, 0.0],
            speed_m_s: 0.005,
        };
        assert_eq!(first, expected);
        let (second, rest) = Program::take(&rest).expect("a program");
        let stop = Program::Stop { number: None };
        assert_eq!((second, Program::take(&rest)), (stop, None));
        let text = "def b():\n  write_output_integer_register(24, 42)\n  stopl(2.0)\nend\n";
        let stop = Program::Stop { number: Some(42) };
        assert_eq!(Program::take(text).expect("one").0, stop);
        let (other, _) =
            Program::take("def c():\n  movel(p[nan,0,0,0,0,0], v=1)\nend\n").expect("one");
        assert_eq!(other, Program::Other);
        let cruise =
            "def d():\n  speedl([0, 0.001, -0.005, 0, 0, 0], a=0.5, t=0.200)\n  stopl(2.0)\nend\n";
        let (cruise, _) = Program::take(cruise).expect("one");
        let expected = Program::Cruise {
            velocity_m_s: [0.0, 0.001, -0.005],
            lasts_s: 0.2,
        };
        assert_eq!(cruise, expected);
        let script = "def rtde_control():\n  global a = 0\n  thread b():\n    speedl(target, a=acceleration)\n  end\nend\n";
        let (script, _) = Program::take(script).expect("one");
        assert!(matches!(script, Program::Registers(_)), "{script:?}");
        let turning = "def e():\n  speedl([0, 0, 0, 0, 0, 1], a=0.5, t=0.2)\nend\n";
        assert_eq!(Program::take(turning).expect("one").0, Program::Other);
    }
}
