//! What the machine says, a line each. Nothing here reads a port.

/// A line of the machine.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Line {
    /// A command was taken.
    Ok,
    /// A command was refused, by the number of the reason.
    Error(u16),
    /// It stopped and has to be looked at, by the number of the reason.
    Alarm(u16),
    /// It was reset.
    Banner,
    Status(Status),
    /// Anything else.
    Other,
}

/// What the machine does at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Status {
    pub(super) state: State,
    /// The place of the tip in the frame of the machine, in mm; not checked to be numbers.
    pub(super) place_mm: [f64; 3],
}

/// What it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    Idle,
    Running,
    /// Held, still slowing down.
    Slowing,
    /// Held, at rest.
    Held,
    Alarm,
    /// Doors, checks, homing and sleep.
    Other,
}

/// A longer line is none.
const LINE_MAX: usize = 256;

/// Cuts what comes, in pieces of any size, into lines.
#[derive(Debug, Default)]
pub(super) struct Lines {
    waiting: Vec<u8>,
    /// Whether the present line is too long, and passed over.
    is_endless: bool,
}

impl Lines {
    /// Takes bytes, and hands over the lines that end in them.
    pub(super) fn push(&mut self, bytes: &[u8], mut take: impl FnMut(Line)) {
        for byte in bytes {
            match byte {
                b'\n' => {
                    let line = std::mem::take(&mut self.waiting);
                    if !std::mem::take(&mut self.is_endless) {
                        take(Line::read(&String::from_utf8_lossy(&line)));
                    }
                }
                _ if self.waiting.len() >= LINE_MAX => self.is_endless = true,
                byte => self.waiting.push(*byte),
            }
        }
    }
}

impl Line {
    fn read(line: &str) -> Line {
        let line = line.trim();
        let number = |text: &str| text.parse().unwrap_or(0);
        if line == "ok" {
            Line::Ok
        } else if let Some(code) = line.strip_prefix("error:") {
            Line::Error(number(code))
        } else if let Some(code) = line.strip_prefix("ALARM:") {
            Line::Alarm(number(code))
        } else if line.starts_with("Grbl ") {
            Line::Banner
        } else {
            Status::read(line).map_or(Line::Other, Line::Status)
        }
    }
}

impl Status {
    /// A status such as `<Idle|MPos:1.000,2.000,-3.000|FS:0,0>`.
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
        // Further axes are none of an indenter's.
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

    fn read(text: &[u8], piece: usize) -> Vec<Line> {
        let mut lines = Lines::default();
        let mut found = Vec::new();
        for part in text.chunks(piece) {
            lines.push(part, |line| found.push(line));
        }
        found
    }

    #[test]
    fn lines_of_the_machine_are_read_however_they_are_split() {
        let text = b"\r\nGrbl 1.1h ['$' for help]\r\nok\r\nerror:20\r\n<Run|MPos:1.500,-2.000,-3.250|FS:54,0|Ov:100,100,100>\r\n<Hold:1|MPos:0,0,0>\r\n<Hold:0|MPos:0,0,0,7>\r\nALARM:3\r\n[MSG:Reset to continue]\r\n<Alarm|MPos:0,0,0>\r\n<Idle|WPos:0,0,0>\r\n";
        for piece in [1, 2, 7, text.len()] {
            let found = read(text, piece);
            let status = |state, place_mm| Line::Status(Status { state, place_mm });
            let expected = [
                Line::Other,
                Line::Banner,
                Line::Ok,
                Line::Error(20),
                status(State::Running, [1.5, -2.0, -3.25]),
                status(State::Slowing, [0.0; 3]),
                status(State::Held, [0.0; 3]),
                Line::Alarm(3),
                Line::Other,
                status(State::Alarm, [0.0; 3]),
                // Places in another frame say nothing without its origin.
                Line::Other,
            ];
            assert_eq!(found, expected, "in pieces of {piece}");
        }
    }

    #[test]
    fn endless_lines_and_noise_are_passed_over() {
        let noise = [
            &[0xff; 1000][..],
            b"\nok\n<Idle|MPos:1,2>\n<Idle|MPos:a,b,c>\n<>\n",
        ]
        .concat();
        assert_eq!(
            read(&noise, 64),
            [Line::Ok, Line::Other, Line::Other, Line::Other]
        );
    }
}
