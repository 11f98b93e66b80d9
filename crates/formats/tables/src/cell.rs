//! Value of a column in one row: a number, a text, bytes, or nested values.

use std::borrow::Cow;
use std::fmt::Write;

use crate::path::{indices, longest};

/// Cell of a table: the value of one column in one row.
///
/// A single-precision number is converted exactly to double precision and written in full: 0.3 as an `f32` is 0.30000001192092896. NumPy and pyarrow
/// give the same number after widening. A label rounded to 0.3 would differ from this number in the eighth digit.
///
/// ```
/// use taceva_tables::Cell;
/// let pose = Cell::Struct(vec![("x".into(), Cell::Number(2.5)), ("ft".into(), Cell::List(vec![Cell::Integer(1), Cell::Null]))]);
/// assert_eq!(pose.at("ft[0]"), Some(&Cell::Integer(1)));
/// assert_eq!(pose.text(), r#"{"x": 2.5, "ft": [1, null]}"#);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Cell {
    /// No value.
    Null,
    /// A truth value.
    Bool(bool),
    /// An integer of 8 to 64 bits, with or without sign.
    Integer(i128),
    /// Time in nanoseconds: since 1970, since midnight, or a duration. The text of the cell is in seconds, for any unit of the file.
    Time(i128),
    /// Number of double precision, including NaN and infinities.
    Number(f64),
    /// A text.
    Text(String),
    /// Bytes, such as an encoded picture.
    Bytes(Vec<u8>),
    /// Cells in order.
    List(Vec<Cell>),
    /// Cells by name, in the order of the schema.
    Struct(Vec<(String, Cell)>),
}

impl Cell {
    /// Text of the cell in a CSV file: numbers in the shortest form that parses back, lists as `[1, 2]`, empty for [`Cell::Null`].
    ///
    /// A [`Cell::Time`] is written in seconds with all decimals, so the text does not depend on the unit of the file.
    ///
    /// The text inside lists and structures is JSON, except for numbers that JSON cannot express (`NaN`, `inf`). Bytes are written as UTF-8 if valid, otherwise
    /// as hexadecimal digits.
    ///
    /// ```
    /// use taceva_tables::Cell;
    /// assert_eq!(Cell::Number(0.1_f32.into()).text(), "0.10000000149011612");
    /// assert_eq!(Cell::Number(1e-30).text(), "1e-30");
    /// assert_eq!(Cell::List(vec![Cell::Integer(1), Cell::Text("a".into())]).text(), r#"[1, "a"]"#);
    /// assert_eq!(Cell::Time(-1_500_000_001).text(), "-1.500000001");
    /// assert_eq!(Cell::Null.text(), "");
    /// ```
    pub fn text(&self) -> Cow<'_, str> {
        match self {
            Cell::Null => Cow::Borrowed(""),
            Cell::Text(text) => Cow::Borrowed(text),
            Cell::Bytes(bytes) => match std::str::from_utf8(bytes) {
                Ok(text) => Cow::Borrowed(text),
                Err(_) => Cow::Owned(hexadecimal(bytes)),
            },
            _ => {
                let mut text = String::new();
                self.write(&mut text);
                Cow::Owned(text)
            }
        }
    }

    /// Cell at a path inside this cell: `x`, `pose.x`, `[2]`, `ft[2,0]`; the cell itself for the empty path.
    ///
    /// [`None`] if the member does not exist, or if the path is malformed. A member whose name contains dots or brackets is found by its whole name.
    ///
    /// ```
    /// use taceva_tables::Cell;
    /// let rows = Cell::List(vec![Cell::List(vec![Cell::Integer(7)])]);
    /// assert_eq!(rows.at("[0,0]"), Some(&Cell::Integer(7)));
    /// assert_eq!(rows.at("[0][0]"), Some(&Cell::Integer(7)));
    /// assert_eq!(rows.at("[1]"), None);
    /// ```
    pub fn at(&self, path: &str) -> Option<&Cell> {
        let mut cell = self;
        let mut rest = path;
        while !rest.is_empty() {
            match cell {
                Cell::Struct(members) => {
                    let names = members.iter().map(|(name, _)| name.as_str());
                    let (member, left) = longest(rest, names)?;
                    cell = &members.get(member)?.1;
                    rest = left;
                }
                Cell::List(_) => {
                    let (numbers, left) = indices(rest)?;
                    for number in numbers {
                        let Cell::List(cells) = cell else { return None };
                        cell = cells.get(number)?;
                    }
                    rest = left;
                }
                _ => return None,
            }
        }
        Some(cell)
    }

    /// Cell at a path inside this cell. Returns [`Cell::Null`] if a cell on the path is null, and `None` if the member does not exist.
    pub(crate) fn into_inside(self, path: &str) -> Option<Cell> {
        if path.is_empty() || self == Cell::Null {
            return Some(self);
        }
        match self {
            Cell::Struct(mut members) => {
                let (member, rest) = longest(path, members.iter().map(|(name, _)| name.as_str()))?;
                members.swap_remove(member).1.into_inside(rest)
            }
            Cell::List(_) => {
                let (numbers, rest) = indices(path)?;
                let mut cell = self;
                for number in numbers {
                    cell = match cell {
                        Cell::List(mut cells) if number < cells.len() => cells.swap_remove(number),
                        Cell::Null => return Some(Cell::Null),
                        _ => return None,
                    };
                }
                cell.into_inside(rest)
            }
            _ => None,
        }
    }

    /// Approximate memory of the cell, bytes.
    pub(crate) fn bytes(&self) -> u64 {
        let inside = match self {
            Cell::Null | Cell::Bool(_) | Cell::Integer(_) | Cell::Time(_) | Cell::Number(_) => 0,
            Cell::Text(text) => text.len() as u64,
            Cell::Bytes(bytes) => bytes.len() as u64,
            Cell::List(cells) => cells.iter().map(Cell::bytes).sum(),
            Cell::Struct(members) => members
                .iter()
                .map(|(name, cell)| (name.len() + size_of::<String>()) as u64 + cell.bytes())
                .sum(),
        };
        size_of::<Cell>() as u64 + inside
    }

    fn write(&self, into: &mut String) {
        match self {
            Cell::Null => into.push_str("null"),
            Cell::Bool(value) => into.push_str(if *value { "true" } else { "false" }),
            Cell::Integer(value) => push(into, format_args!("{value}")),
            Cell::Time(nanoseconds) => write_seconds(*nanoseconds, into),
            Cell::Number(value) => write_number(*value, into),
            Cell::Text(text) => write_quoted(text, into),
            Cell::Bytes(_) => write_quoted(&self.text(), into),
            Cell::List(cells) => {
                into.push('[');
                for (at, cell) in cells.iter().enumerate() {
                    into.push_str(if at == 0 { "" } else { ", " });
                    cell.write(into);
                }
                into.push(']');
            }
            Cell::Struct(members) => {
                into.push('{');
                for (at, (name, cell)) in members.iter().enumerate() {
                    into.push_str(if at == 0 { "" } else { ", " });
                    write_quoted(name, into);
                    into.push_str(": ");
                    cell.write(into);
                }
                into.push('}');
            }
        }
    }
}

/// Writes a number with the fewest digits that parse back: in decimal notation if that is short, otherwise with an exponent.
fn write_number(value: f64, into: &mut String) {
    let size = value.abs();
    let is_plain = !value.is_finite() || value == 0.0 || (1e-5..1e17).contains(&size);
    if is_plain {
        push(into, format_args!("{value}"));
    } else {
        push(into, format_args!("{value:e}"));
    }
}

/// Writes nanoseconds as seconds, with all decimals.
fn write_seconds(nanoseconds: i128, into: &mut String) {
    const SECOND: u128 = 1_000_000_000;
    let sign = if nanoseconds < 0 { "-" } else { "" };
    let size = nanoseconds.unsigned_abs();
    let text = format!("{sign}{}.{:09}", size / SECOND, size % SECOND);
    into.push_str(text.trim_end_matches('0').trim_end_matches('.'));
}

/// Writes a quoted JSON text.
fn write_quoted(text: &str, into: &mut String) {
    into.push('"');
    for letter in text.chars() {
        match letter {
            '"' => into.push_str("\\\""),
            '\\' => into.push_str("\\\\"),
            '\n' => into.push_str("\\n"),
            '\r' => into.push_str("\\r"),
            '\t' => into.push_str("\\t"),
            letter if u32::from(letter) < 0x20 => {
                push(into, format_args!("\\u{:04x}", u32::from(letter)));
            }
            letter => into.push(letter),
        }
    }
    into.push('"');
}

fn hexadecimal(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len() * 2);
    for byte in bytes {
        push(&mut text, format_args!("{byte:02x}"));
    }
    text
}

fn push(into: &mut String, text: std::fmt::Arguments<'_>) {
    into.write_fmt(text).expect("a string takes any text");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_reads_back_from_its_text() {
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        for _ in 0..20_000 {
            bits ^= bits << 13;
            bits ^= bits >> 7;
            bits ^= bits << 17;
            let number = f64::from_bits(bits);
            let back: f64 = Cell::Number(number).text().parse().expect("a number");
            assert!(
                back.to_bits() == number.to_bits() || number.is_nan(),
                "{number:e}"
            );
        }
        for (number, text) in [
            (0.0, "0"),
            (-0.0, "-0"),
            (2.0, "2"),
            (1e17, "1e17"),
            (123_456.5, "123456.5"),
            (1e-5, "0.00001"),
        ] {
            assert_eq!(Cell::Number(number).text(), text);
        }
        for (nanoseconds, text) in [
            (0, "0"),
            (1_700_000_000_123_456_789, "1700000000.123456789"),
            (86_400_000_000_000, "86400"),
            (-1, "-0.000000001"),
            (1_500_000_000, "1.5"),
        ] {
            assert_eq!(Cell::Time(nanoseconds).text(), text);
        }
        assert_eq!(Cell::Number(f64::NAN).text(), "NaN");
        assert_eq!(Cell::Number(f64::NEG_INFINITY).text(), "-inf");
    }

    #[test]
    fn texts_in_a_list_are_json() {
        let list = Cell::List(vec![Cell::Text("a\"b\\\n\u{1}é".to_owned())]);
        let back: serde_json::Value = serde_json::from_str(&list.text()).expect("JSON");
        assert_eq!(back[0].as_str(), Some("a\"b\\\n\u{1}é"));
    }

    #[test]
    fn members_with_dots_are_found_by_their_whole_name() {
        let inner = Cell::Struct(vec![("b".to_owned(), Cell::Integer(1))]);
        let cell = Cell::Struct(vec![
            ("a".to_owned(), inner),
            ("a.b".to_owned(), Cell::Integer(2)),
        ]);
        assert_eq!(cell.at("a.b"), Some(&Cell::Integer(2)));
        assert_eq!(cell.at("a.c"), None);
        assert_eq!(cell.at("a[0]"), None);
        assert_eq!(cell.at(""), Some(&cell));
    }

    #[test]
    fn places_that_are_written_otherwise_lead_nowhere() {
        let cell = Cell::List(vec![Cell::List(vec![Cell::Integer(1), Cell::Integer(2)])]);
        assert_eq!(cell.at("[0,1]"), Some(&Cell::Integer(2)));
        for path in [
            "[",
            "[]",
            "[0",
            "[0,",
            "[0,]",
            "[-1]",
            "[0]x",
            "0",
            "[0 ]",
            "[+0]",
            "[99999999999999999999]",
            "[0,1,0]",
            ",0]",
            "[0],1]",
            "[0]]",
        ] {
            assert_eq!(cell.at(path), None, "{path}");
        }
    }
}
