//! Parser for the lines that a GRBL machine sends. Does no I/O.

use std::collections::BTreeMap;

use crate::gcode::link::{Answer, Heard};
use crate::text::shown;

/// Status of the machine at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Status {
    pub(super) state: State,
    /// Position of the tip in the machine's frame, mm; may contain NaN.
    pub(super) place_mm: [f64; 3],
}

/// State of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    Idle,
    Running,
    /// The machine decelerates after a halt.
    Slowing,
    /// The machine is at rest after a halt.
    Held,
    Alarm,
    /// Any other state: open door, check mode, homing or sleep.
    Other,
}

/// Parses one line from the machine.
pub(super) fn read(line: &str) -> Heard<Status> {
    let number = |text: &str| text.parse::<u16>().unwrap_or(0);
    if line == "ok" {
        Heard::answer(Answer::Ok)
    } else if let Some(code) = line.strip_prefix("error:") {
        let why = format!("error {}, see GRBL's list", number(code));
        Heard::answer(Answer::Refused(why))
    } else if let Some(code) = line.strip_prefix("ALARM:") {
        Heard::answer(Answer::Fault(format!("ALARM {}", number(code))))
    } else if let Some(facts) = facts(line) {
        Heard::answer(Answer::Facts(facts))
    } else {
        Heard {
            answer: None,
            status: Status::read(line),
        }
    }
}

/// Parses a version line such as `[VER:1.1h.20190825:the press]`, which ends with the owner's text. `None` for another line.
fn facts(line: &str) -> Option<BTreeMap<String, String>> {
    let version = line.strip_prefix("[VER:")?.strip_suffix(']')?;
    let (firmware, machine) = version.split_once(':').unwrap_or((version, ""));
    let stated = [("firmware", firmware), ("machine", machine)].into_iter();
    let stated = stated.filter(|(_, value)| !value.is_empty());
    Some(
        stated
            .map(|(name, value)| (name.to_owned(), shown(value)))
            .collect(),
    )
}

impl Status {
    /// Parses a status such as `<Idle|MPos:1.000,2.000,-3.000|FS:0,0>`; `None` for another line.
    fn read(line: &str) -> Option<Status> {
        let inner = line.strip_prefix('<')?.strip_suffix('>')?;
        let mut fields = inner.split('|');
        let state = match fields.next()? {
            "Idle" => State::Idle,
            "Run" | "Jog" => State::Running,
            "Hold:0" => State::Held,
            hold if hold.starts_with("Hold") => State::Slowing,
            alarm if alarm.starts_with("Alarm") => State::Alarm,
            _ => State::Other,
        };
        let place = fields.find_map(|field| field.strip_prefix("MPos:"))?;
        // Further axes do not move the indenter.
        let numbers: Option<Vec<f64>> = place
            .split(',')
            .take(3)
            .map(|number| number.parse().ok())
            .collect();
        let &[x, y, z] = &numbers?[..] else {
            return None;
        };
        Some(Status {
            state,
            place_mm: [x, y, z],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gcode::link::understood;

    #[test]
    fn lines_of_the_machine_are_read_however_they_are_split() {
        let text = b"\r\nGrbl 1.1h ['$' for help]\r\nok\r\nerror:20\r\n<Run|MPos:1.500,-2.000,-3.250|FS:54,0|Ov:100,100,100>\r\n<Hold:1|MPos:0,0,0>\r\n<Hold:0|MPos:0,0,0,7>\r\nALARM:3\r\n[MSG:Reset to continue]\r\n<Alarm|MPos:0,0,0>\r\n<Idle|WPos:0,0,0>\r\n";
        let refused = Answer::Refused("error 20, see GRBL's list".to_owned());
        let status = |state, place_mm| Heard {
            answer: None,
            status: Some(Status { state, place_mm }),
        };
        let expected = [
            Heard::NOTHING,
            Heard::NOTHING,
            Heard::answer(Answer::Ok),
            Heard::answer(refused),
            status(State::Running, [1.5, -2.0, -3.25]),
            status(State::Slowing, [0.0; 3]),
            status(State::Held, [0.0; 3]),
            Heard::answer(Answer::Fault("ALARM 3".to_owned())),
            Heard::NOTHING,
            status(State::Alarm, [0.0; 3]),
            // Positions in another frame are useless without its origin.
            Heard::NOTHING,
        ];
        for piece in [1, 2, 7, text.len()] {
            assert_eq!(
                understood(text, piece, read),
                expected,
                "in pieces of {piece}"
            );
        }
    }

    #[test]
    fn a_machine_states_its_version_and_the_text_of_its_owner() {
        let pair = |name: &str, value: &str| (name.to_owned(), value.to_owned());
        let firmware = pair("firmware", "1.1h.20190825");
        for (line, expected) in [
            ("[VER:1.1h.20190825:]", vec![firmware.clone()]),
            (
                "[VER:1.1h.20190825:the press]",
                vec![firmware, pair("machine", "the press")],
            ),
        ] {
            let facts = expected.into_iter().collect();
            assert_eq!(read(line), Heard::answer(Answer::Facts(facts)));
        }
    }

    #[test]
    fn endless_lines_and_noise_are_passed_over() {
        let noise = [
            &[0xff; 1000][..],
            b"\nok\n<Idle|MPos:1,2>\n<Idle|MPos:a,b,c>\n<>\n",
        ]
        .concat();
        let found = understood(&noise, 64, read);
        assert_eq!(found[0], Heard::answer(Answer::Ok));
        assert_eq!(found[1..], [Heard::NOTHING, Heard::NOTHING, Heard::NOTHING]);
    }
}
