//! Parser of the log of ffmpeg, whose lines have a level.

/// Line of the log, `[context] [level] text`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Said<'a> {
    /// Source of the line, such as `h264 @ 0x55…`; empty if none is stated.
    context: &'a str,
    level: &'a str,
    pub(super) text: &'a str,
}

impl<'a> Said<'a> {
    pub(super) fn parse(line: &'a str) -> Said<'a> {
        let mut said = Said {
            context: "",
            level: "",
            text: line,
        };
        while let Some((word, rest)) = said
            .text
            .strip_prefix('[')
            .and_then(|rest| rest.split_once("] "))
        {
            said.text = rest;
            match word {
                "fatal" | "error" | "warning" | "info" | "panic" | "verbose" | "debug" => {
                    said.level = word;
                    break;
                }
                _ if said.context.is_empty() => said.context = word,
                _ => {}
            }
        }
        said
    }

    /// True for an error of the clip. False for errors of the output, which concern the order of times and are irrelevant.
    pub(super) fn is_fault(&self) -> bool {
        let of_output = ["null ", "rawvideo ", "out#", "vost#"];
        matches!(self.level, "fatal" | "error" | "panic")
            && !of_output
                .iter()
                .any(|start| self.context.starts_with(start))
    }

    /// Text after `[Parsed_showinfo_0 …]`; `None` for other lines.
    pub(super) fn shown(&self) -> Option<&'a str> {
        self.context
            .starts_with("Parsed_showinfo")
            .then_some(self.text)
    }
}

/// Value after `key`, up to the next blank or comma.
pub(super) fn value<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let (_, rest) = text.split_once(key)?;
    let value = rest.trim_start().split([' ', ',']).next()?;
    (!value.is_empty()).then_some(value)
}

/// Matrix number of ITU-T H.273 for its name in ffmpeg; `None` if unspecified.
pub(super) fn matrix(name: &str) -> Option<u16> {
    Some(match name {
        "gbr" => 0,
        "bt709" => 1,
        "fcc" => 4,
        "bt470bg" => 5,
        "smpte170m" => 6,
        "smpte240m" => 7,
        "ycgco" => 8,
        "bt2020nc" => 9,
        "bt2020c" => 10,
        "unknown" | "reserved" => return None,
        // Any other name is an unsupported matrix.
        _ => u16::MAX,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_two_versions_are_understood() {
        for (line, is_fault, text) in [
            ("[info] Stream mapping:", false, "Stream mapping:"),
            (
                "[ffv1 @ 0x55d2] [error] slice CRC mismatch",
                true,
                "slice CRC mismatch",
            ),
            (
                "[vist#0:0/mpeg4 @ 0x5] [dec:mpeg4 @ 0x5] [fatal] corrupt decoded frame",
                true,
                "corrupt decoded frame",
            ),
            (
                "[null @ 0x5] [error] non monotonically increasing dts",
                false,
                "non monotonically increasing dts",
            ),
            (
                "[out#0/null @ 0x5] [error] Nothing was written",
                false,
                "Nothing was written",
            ),
            ("[error] a [strange] name", true, "a [strange] name"),
            ("[1] [2", false, "[2"),
            ("", false, ""),
        ] {
            let said = Said::parse(line);
            assert_eq!((said.is_fault(), said.text), (is_fault, text), "{line}");
        }
    }

    #[test]
    fn values_stand_behind_their_keys() {
        let shown = "n:   0 pts:     12 pts_time:0.1 duration: 1 fmt:yuv420p sar:1/1 s:64x48 i:P";
        assert_eq!(value(shown, " pts:"), Some("12"));
        assert_eq!(value(shown, " s:"), Some("64x48"));
        assert_eq!(
            value(
                "config in time_base: 1/1200000, frame_rate: 10/1",
                "time_base:"
            ),
            Some("1/1200000")
        );
        assert_eq!(value(shown, "absent:"), None);
    }
}
