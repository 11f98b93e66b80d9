//! Numbers and texts in TOML notation.

use std::fmt::{self, Write};

/// Formats a float in TOML notation.
pub(super) fn written(number: f64) -> String {
    Number(number).to_string()
}

/// Float that is displayed in TOML notation: shortest round-trip digits, with a point or an exponent.
pub(super) struct Number(pub(super) f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.0)
    }
}

/// Text that is displayed as a basic TOML string.
pub(super) struct Text<'a>(pub(super) &'a str);

impl fmt::Display for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_char('"')?;
        for character in self.0.chars() {
            match character {
                '"' | '\\' => write!(f, "\\{character}")?,
                '\n' => f.write_str("\\n")?,
                '\t' => f.write_str("\\t")?,
                control if control.is_control() => write!(f, "\\u{:04X}", u32::from(control))?,
                plain => f.write_char(plain)?,
            }
        }
        f.write_char('"')
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_numbers_are_written_as_toml_reads_them() {
        assert_eq!(
            Text("a\"b\\\n\u{7f}é\u{1}").to_string(),
            r#""a\"b\\\n\u007Fé\u0001""#
        );
        for (number, expected) in [
            (60.0, "60.0"),
            (0.1, "0.1"),
            (1e-7, "1e-7"),
            (1e22, "1e22"),
            (f64::NEG_INFINITY, "-inf"),
        ] {
            assert_eq!(Number(number).to_string(), expected);
        }
    }
}
