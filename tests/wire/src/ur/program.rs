//! The part of the vendor's script language that is understood.

/// A program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Program {
    /// Moves in a straight line to x, y, z in m and a rotation vector in rad.
    MoveLine { pose: [f64; 6], speed_m_s: f64 },
    /// Brakes.
    Stop,
    /// Anything else, which takes the place of what runs and does nothing.
    Other,
}

/// The last line of a program.
const END: &str = "\nend\n";

impl Program {
    /// The first whole program in `text`, and what is behind it.
    pub(super) fn take(text: &str) -> Option<(Program, String)> {
        let (program, rest) = text.split_once(END)?;
        Some((Program::read(program), rest.to_owned()))
    }

    fn read(program: &str) -> Program {
        if program.contains("stopl(") {
            return Program::Stop;
        }
        Program::move_line(program).unwrap_or(Program::Other)
    }

    fn move_line(program: &str) -> Option<Program> {
        let (_, call) = program.split_once("movel(p[")?;
        let (pose, rest) = call.split_once(']')?;
        let numbers: Option<Vec<f64>> = pose
            .split(',')
            .map(|number| {
                number
                    .trim()
                    .parse()
                    .ok()
                    .filter(|number: &f64| number.is_finite())
            })
            .collect();
        let &[x, y, z, rx, ry, rz] = &numbers?[..] else {
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
        assert_eq!((second, Program::take(&rest)), (Program::Stop, None));
        let (other, _) =
            Program::take("def c():\n  movel(p[nan,0,0,0,0,0], v=1)\nend\n").expect("one");
        assert_eq!(other, Program::Other);
    }
}
