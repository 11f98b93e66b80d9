//! Commands of the box: text with the prefix `AT+`. No I/O.

use super::frame::Check;

/// Command to an interface box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Command {
    /// Set the rate of readings, Hz.
    Rate(u16),
    /// Set the rate of readings on older boxes, Hz.
    OldRate(u16),
    /// Select the kind of checksum in each frame.
    Check(Check),
    /// Send six channels in engineering units, one reading per frame, without smoothing.
    Units,
    /// Start sending readings.
    Start,
    /// Stop sending readings.
    Stop,
    /// Use the current load as the zero offset.
    Zero,
    /// Ask for the decoupling matrix, the calibration of the transducer.
    AskMatrix,
    /// Ask for the unit of the decoupling matrix.
    AskUnit,
}

impl Command {
    /// Encodes the command as a text line, with `AT+` and the line end.
    pub(super) fn line(self) -> String {
        let text = match self {
            Command::Rate(hz) => format!("SMPF={hz}"),
            Command::OldRate(hz) => format!("SMPR={hz}"),
            Command::Check(Check::Sum) => "DCKMD=SUM".to_owned(),
            Command::Check(Check::Crc32) => "DCKMD=CRC32".to_owned(),
            Command::Units => "SGDM=(A01,A02,A03,A04,A05,A06);E;1;(WMA:1)".to_owned(),
            Command::Start => "GSD".to_owned(),
            Command::Stop => "GSD=STOP".to_owned(),
            Command::Zero => "ADJZF=1;1;1;1;1;1".to_owned(),
            Command::AskMatrix => "DCPM=?".to_owned(),
            Command::AskUnit => "DCPCU=?".to_owned(),
        };
        format!("AT+{text}\r\n")
    }

    /// Name of the command, which its answer repeats after `ACK+`.
    fn word(self) -> &'static str {
        match self {
            Command::Rate(_) => "SMPF",
            Command::OldRate(_) => "SMPR",
            Command::Check(_) => "DCKMD",
            Command::Units => "SGDM",
            Command::Start | Command::Stop => "GSD",
            Command::Zero => "ADJZF",
            Command::AskMatrix => "DCPM",
            Command::AskUnit => "DCPCU",
        }
    }

    /// Value in `line`, the positive answer to this query; `None` if `line` has no value.
    pub(super) fn value_in(self, line: &str) -> Option<&str> {
        let answer = line.strip_prefix("ACK+")?.strip_prefix(self.word())?;
        let value = answer.strip_prefix('=')?.trim_end().strip_suffix("$OK")?;
        Some(value.trim()).filter(|value| !value.is_empty() && *value != "?")
    }

    /// True if `line` is a positive answer to this command, false for a negative answer, `None` for an answer to another command.
    pub(super) fn answered_by(self, line: &str) -> Option<bool> {
        let answer = line.strip_prefix("ACK+")?.strip_prefix(self.word())?;
        let is_whole_word = answer
            .chars()
            .next()
            .is_none_or(|letter| !letter.is_ascii_alphanumeric());
        is_whole_word.then(|| answer.trim_end().ends_with("$OK"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_value_of_a_query_is_between_its_word_and_the_confirmation() {
        let matrix = "(1.0,0.0);(0.0,2.5)";
        let answer = format!("ACK+DCPM={matrix}$OK");
        assert_eq!(Command::AskMatrix.value_in(&answer), Some(matrix));
        for line in ["ACK+DCPM=?$OK", "ACK+DCPM=?$ERROR", "ACK+DCPCU=MVPV$OK", ""] {
            assert_eq!(Command::AskMatrix.value_in(line), None, "{line}");
        }
        assert_eq!(Command::AskUnit.value_in("ACK+DCPCU=MVPV$OK"), Some("MVPV"));
    }

    #[test]
    fn answers_are_distinguished() {
        let rate = Command::Rate(200);
        assert_eq!(rate.line(), "AT+SMPF=200\r\n");
        assert_eq!(rate.answered_by("ACK+SMPF=200$OK"), Some(true));
        assert_eq!(rate.answered_by("ACK+SMPF=200$ERROR"), Some(false));
        assert_eq!(rate.answered_by("ACK+SMPFX=200$OK"), None);
        assert_eq!(rate.answered_by("ACK+DCKMD=SUM$OK"), None);
        assert_eq!(rate.answered_by("SMPF=200$OK"), None);
        assert_eq!(Command::Stop.answered_by("ACK+GSD=STOP$OK"), Some(true));
    }
}
