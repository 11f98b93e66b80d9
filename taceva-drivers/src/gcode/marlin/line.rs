//! Parser for the lines that a Marlin printer sends. Does no I/O.

use std::collections::BTreeMap;

use crate::gcode::link::{Answer, Heard};
use crate::text::shown;

/// Reported position of the tip, current or planned, mm; may contain NaN.
pub(super) type Place = [f64; 3];

/// Text before a number that the printer must echo.
pub(super) const MARK: &str = "taceva mark ";

/// Error texts of a printer that received a damaged line. The printer then requests the line again.
const DAMAGED: [&str; 4] = [
    "checksum mismatch",
    "No Checksum with line number",
    "No Line Number with checksum",
    "Line Number is not Last Line Number+1",
];

/// `command` with a line number and a checksum: `N3 G21*25`.
pub(super) fn numbered(number: u32, command: &str) -> String {
    let text = format!("N{number} {command}");
    let checksum = text.bytes().fold(0, |sum, byte| sum ^ byte);
    format!("{text}*{checksum}")
}

/// Key at the start of the answer to `M115`.
const FIRMWARE_NAME: &str = "FIRMWARE_NAME:";
/// Keys in the answer to `M115`, each with its name in the settings of the robot.
const FACTS: [(&str, &str); 3] = [
    ("FIRMWARE_NAME", "firmware"),
    ("MACHINE_TYPE", "machine"),
    ("UUID", "uuid"),
];

/// Parses one line from the printer.
pub(super) fn read(line: &str) -> Heard<Place> {
    // Some printers report the position after `ok` on the same line.
    if let Some(behind) = line.strip_prefix("ok")
        && (behind.is_empty() || behind.starts_with(' '))
    {
        return Heard {
            answer: Some(Answer::Ok),
            status: place(behind.trim_start()),
        };
    }
    let status = place(line);
    Heard {
        answer: match status {
            Some(_) => None,
            None => answer(line),
        },
        status,
    }
}

fn answer(line: &str) -> Option<Answer> {
    let said = line.strip_prefix("echo:").unwrap_or(line).trim();
    if let Some(number) = said.strip_prefix(MARK) {
        return number.parse().ok().map(Answer::Mark);
    }
    if said.starts_with("busy") {
        return Some(Answer::Busy);
    }
    if said.starts_with("Unknown command") {
        return Some(Answer::Refused(said.to_owned()));
    }
    if let Some(capability) = line.strip_prefix("Cap:") {
        let (name, value) = capability.split_once(':')?;
        return Some(Answer::Can(name.to_owned(), value == "1"));
    }
    if line.starts_with(FIRMWARE_NAME) {
        return Some(Answer::Facts(facts(line)));
    }
    if let Some(number) = line.strip_prefix("Resend:") {
        return number.trim().parse().ok().map(Answer::Resend);
    }
    // `Error:`, or `!!` of other firmware: the printer stopped and reports it once.
    let why = line.strip_prefix("Error:").or(line.strip_prefix("!!"))?;
    let why = why.trim();
    let is_damage = DAMAGED.iter().any(|damaged| why.starts_with(damaged));
    (!is_damage).then(|| Answer::Fault(format!("`{why}`")))
}

/// Parses an answer to `M115`, such as `FIRMWARE_NAME:Marlin 2.1.2 (Nov 27 2026) MACHINE_TYPE:Ender-3 UUID:cede2a2f`. Values may contain spaces.
fn facts(line: &str) -> BTreeMap<String, String> {
    let mut facts: BTreeMap<String, String> = BTreeMap::new();
    let mut name = None;
    for word in line.split_whitespace() {
        let keyed = word.split_once(':').filter(|(key, _)| is_key(key));
        let value = match keyed {
            Some((key, value)) => {
                let known = FACTS.iter().find(|(known, _)| *known == key);
                name = known.map(|(_, name)| *name);
                value
            }
            None => word,
        };
        if let Some(name) = name {
            let whole = facts.entry(name.to_owned()).or_default();
            if !whole.is_empty() {
                whole.push(' ');
            }
            whole.push_str(&shown(value));
        }
    }
    facts
}

fn is_key(word: &str) -> bool {
    let is_of_key = |letter: char| letter.is_ascii_uppercase() || letter == '_';
    !word.is_empty() && word.chars().all(is_of_key)
}

/// Parses a position such as `X:1.00 Y:2.00 Z:-3.00 E:0.00 Count X:80 Y:160 Z:-1200`; `None` for another line.
fn place(line: &str) -> Option<Place> {
    let number = |word: Option<&str>, axis: &str| -> Option<f64> {
        word?.strip_prefix(axis)?.strip_prefix(':')?.parse().ok()
    };
    let mut words = line.split_whitespace();
    Some([
        number(words.next(), "X")?,
        number(words.next(), "Y")?,
        number(words.next(), "Z")?,
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gcode::link::understood;

    #[test]
    fn lines_of_the_printer_are_read_however_they_are_split() {
        let text = b"start\necho:Marlin 2.1.2\nFIRMWARE_NAME:Marlin 2.1.2 PROTOCOL_VERSION:1.0\nCap:EMERGENCY_PARSER:1\nCap:AUTOREPORT_POS:0\nok\nok P15 B3\nokay\nX:1.50 Y:-2.00 Z:3.25 E:0.00 Count X:120 Y:-160 Z:1300\nok X:0.0 Y:1.0 Z:2.0 E:0.0 Count: A:0 B:100 C:200\necho:busy: processing\necho:Unknown command: \"M999999\"\ntaceva mark 7\necho:taceva mark 8\nError:Printer halted. kill() called!\n T:21.3 /0.0\n";
        let firmware = [("firmware".to_owned(), "Marlin 2.1.2".to_owned())];
        let can = |name: &str, is| Heard::answer(Answer::Can(name.to_owned(), is));
        let expected = [
            Heard::NOTHING,
            Heard::NOTHING,
            Heard::answer(Answer::Facts(BTreeMap::from(firmware))),
            can("EMERGENCY_PARSER", true),
            can("AUTOREPORT_POS", false),
            Heard::answer(Answer::Ok),
            Heard::answer(Answer::Ok),
            Heard::NOTHING,
            Heard {
                answer: None,
                status: Some([1.5, -2.0, 3.25]),
            },
            Heard {
                answer: Some(Answer::Ok),
                status: Some([0.0, 1.0, 2.0]),
            },
            Heard::answer(Answer::Busy),
            Heard::answer(Answer::Refused("Unknown command: \"M999999\"".to_owned())),
            Heard::answer(Answer::Mark(7)),
            Heard::answer(Answer::Mark(8)),
            Heard::answer(Answer::Fault("`Printer halted. kill() called!`".to_owned())),
            Heard::NOTHING,
        ];
        for piece in [1, 3, 64, text.len()] {
            assert_eq!(
                understood(text, piece, read),
                expected,
                "in pieces of {piece}"
            );
        }
    }

    #[test]
    fn a_printer_states_its_firmware_its_type_and_its_number_in_one_line() {
        let line = "FIRMWARE_NAME:Marlin 2.1.2 (Nov 27 2026 10:11:12) SOURCE_CODE_URL:https://example.org/a PROTOCOL_VERSION:1.0 MACHINE_TYPE:My printer EXTRUDER_COUNT:1 UUID:cede2a2f-41a2\u{1b}";
        let facts = facts(line);
        for (name, expected) in [
            ("firmware", "Marlin 2.1.2 (Nov 27 2026 10:11:12)"),
            ("machine", "My printer"),
            ("uuid", "cede2a2f-41a2\\u{1b}"),
        ] {
            assert_eq!(facts[name], expected, "{name}");
        }
        assert_eq!(facts.len(), 3, "{facts:?}");
    }

    #[test]
    fn lines_have_the_numbers_and_checksums_of_a_public_client_and_are_asked_for_again() {
        for (number, command, expected) in [
            (0, "G21", "N0 G21*26"),
            (1, "G90", "N1 G90*17"),
            (2, "G1 X1 Y2 Z3 F600", "N2 G1 X1 Y2 Z3 F600*49"),
        ] {
            assert_eq!(numbered(number, command), expected);
        }
        assert_eq!(read("Resend: 5"), Heard::answer(Answer::Resend(5)));
    }

    #[test]
    fn torn_places_foreign_numbers_and_noise_say_nothing() {
        for line in [
            "",
            "X:1.0 Y:2.0",
            "X:1.0 Y:2.0 E:3.0",
            "X:a Y:b Z:c",
            "Cap:EMERGENCY_PARSER",
            "taceva mark -1",
            "Error:checksum mismatch, Last Line: 4",
            "Resend: -5",
            "taceva mark 99999999999",
            "\u{fffd}\u{fffd}ok",
        ] {
            assert_eq!(read(line), Heard::NOTHING, "{line}");
        }
    }
}
