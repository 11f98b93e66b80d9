//! Converts decimal text to the nearest binary64.

use std::ops::Range;

use crate::unit_suffix::UnitSuffix;
use taceva_core::{MAGNITUDE_MAX, SourceUnit, is_scorable};

/// Powers of ten that binary64 represents exactly.
const EXACT_POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Limit up to which binary64 represents every integer exactly.
const EXACT_INTEGERS: u64 = 1 << 53;

/// Maximum length of a plain cell, bytes: 16 digits and a point. Longer numbers exceed 2^53 unless they begin with zeros.
const PLAIN_BYTES: usize = 17;

/// Maximum length of a cell that is parsed in one step, bytes, without its sign.
const WINDOW: usize = 8;

/// Parses the number in a cell of `text`: `Some(None)` if the cell is empty, `None` if the cell contains something else.
pub(super) fn parse_number(text: &str, cell: Range<usize>) -> Option<Option<f64>> {
    if let Some(number) = parse_short(text.as_bytes(), cell.clone()) {
        return Some(Some(number));
    }
    let cell = &text[cell];
    if let Some(number) = parse_plain(cell.as_bytes()) {
        return Some(Some(number));
    }
    let text = cell.trim();
    if text.is_empty() {
        return Some(None);
    }
    let number: f64 = text.parse().ok()?;
    is_scorable(number).then_some(Some(number))
}

/// Decimal text with the decimal point moved `places` to the right, parsed and rounded once.
pub(super) fn parse_shifted(cell: &str, places: i32) -> Option<f64> {
    let (mantissa, exponent) = match cell.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (cell, 0),
    };
    let exponent = exponent.checked_add(places)?;
    format!("{mantissa}e{exponent}").parse().ok()
}

/// Parses digits with at most one point by one division. The result is correctly rounded because both operands are exact (Clinger 1990).
fn parse_plain(cell: &[u8]) -> Option<f64> {
    let (negative, digits) = match cell.split_first()? {
        (b'-', rest) => (true, rest),
        _ => (false, cell),
    };
    if digits.len() > PLAIN_BYTES {
        return None;
    }
    let mut mantissa: u64 = 0;
    let mut point = None;
    for (position, byte) in digits.iter().enumerate() {
        match byte {
            b'0'..=b'9' => mantissa = mantissa * 10 + u64::from(byte - b'0'),
            b'.' if point.is_none() => point = Some(position),
            _ => return None,
        }
    }
    if digits.len() == usize::from(point.is_some()) {
        return None;
    }
    if mantissa > EXACT_INTEGERS {
        return None;
    }
    let places = point.map_or(0, |position| digits.len() - position - 1);
    let magnitude = mantissa as f64 / EXACT_POWERS[places];
    Some(if negative { -magnitude } else { magnitude })
}

/// Parses a sign and up to eight bytes like [`parse_plain`], but all bytes in one step, to avoid unpredictable branches.
///
/// The eight bytes that are read end at the end of the cell, so that the last digit is in the highest byte.
fn parse_short(text: &[u8], cell: Range<usize>) -> Option<f64> {
    let negative = *text.get(cell.start)? == b'-';
    let length = cell.len().checked_sub(usize::from(negative))?;
    let window = text.get(cell.end.checked_sub(WINDOW)?..cell.end)?;
    if length == 0 || length > WINDOW {
        return None;
    }
    let window = u64::from_le_bytes(window.try_into().expect("a window of eight bytes"));
    let before = 8 * (WINDOW - length);
    // Clears the bytes before the cell. A zero byte is the digit 0, never a point.
    let bytes = (window ^ repeated(b'0')) >> before << before;
    let points = zero_bytes(bytes ^ repeated(b'0' ^ b'.'));
    let (digits, places) = if points == 0 {
        (bytes, 0)
    } else if length == 1 {
        return None;
    } else {
        let point = points.trailing_zeros() as usize / 8;
        // Shifts the digits before the point up by one byte, over the point.
        let ahead = (1 << (8 * point)) - 1;
        let kept = bytes & !(ahead << 8 | 0xff);
        (kept | (bytes & ahead) << 8, WINDOW - 1 - point)
    };
    let beyond_nine = ((digits & repeated(0x7f)) + repeated(0x7f - 9)) | digits;
    if beyond_nine & repeated(0x80) != 0 {
        return None;
    }
    let magnitude = eight_digits(digits) as f64 / EXACT_POWERS[places];
    Some(f64::from_bits(
        magnitude.to_bits() | u64::from(negative) << 63,
    ))
}

const fn repeated(byte: u8) -> u64 {
    u64::from_le_bytes([byte; WINDOW])
}

/// Sets the high bit of each byte that is zero. Exact, because no carry crosses a byte boundary.
fn zero_bytes(bytes: u64) -> u64 {
    const LOW_BITS: u64 = repeated(0x7f);
    !(((bytes & LOW_BITS) + LOW_BITS) | bytes | LOW_BITS)
}

/// Number from eight decimal digits, one per byte, the first in the lowest byte. Adjacent digits are combined into pairs, fours and eight.
fn eight_digits(digits: u64) -> u64 {
    let pairs = digits.wrapping_mul((10 << 8) + 1) >> 8 & 0x00ff_00ff_00ff_00ff;
    let fours = pairs.wrapping_mul((100 << 16) + 1) >> 16 & 0x0000_ffff_0000_ffff;
    fours.wrapping_mul((10_000 << 32) + 1) >> 32
}

/// Finite number in `cell`, converted to the stored unit; `None` if the cell is empty. Returns an error message for other cells. If the factor is a power of
/// ten, the decimal point is moved before parsing.
pub(crate) fn number_in_unit(cell: &str, unit: &SourceUnit) -> Result<Option<f64>, String> {
    let Some(number) = number(cell)? else {
        return Ok(None);
    };
    let shift = unit.decimal_shift().filter(|shift| *shift != 0);
    let shifted = shift.and_then(|shift| parse_shifted(cell, shift));
    let converted = shifted.unwrap_or_else(|| unit.convert(number));
    match is_scorable(converted) {
        true => Ok(Some(converted)),
        false => Err("too large for its unit".to_owned()),
    }
}

/// Finite number in `cell`; `None` if the cell is empty. Returns an error message for other cells.
pub(crate) fn number(cell: &str) -> Result<Option<f64>, String> {
    parse_number(cell, 0..cell.len()).ok_or_else(|| not_a_number(cell))
}

/// Reason why `cell` contains no usable number, with a hint if one is known.
pub(crate) fn not_a_number(cell: &str) -> String {
    match cell.parse::<f64>() {
        Ok(number) if number.is_finite() => {
            format!("is too large a number, expected a magnitude up to {MAGNITUDE_MAX:.3e}")
        }
        _ => format!("is not a finite number{}", number_hint(cell)),
    }
}

fn number_hint(cell: &str) -> &'static str {
    let is_numeric = cell
        .bytes()
        .all(|byte| byte.is_ascii_digit() || b"+-.,' ".contains(&byte));
    let is_truth = cell.eq_ignore_ascii_case("true") || cell.eq_ignore_ascii_case("false");
    if is_truth {
        "; read true and false as a class, by [classes] of the map"
    } else if cell.matches(':').count() == 2 {
        "; [time] of a map reads times as text: ISO 8601 (2024-10-27 02:59:59.5) or times of day (02:59:59.5)"
    } else if is_numeric && cell.contains([',', '\'', ' ']) {
        "; write it without thousands separators and with a decimal point, or set `decimal` and `thousands` of the table in the map"
    } else if UnitSuffix::of(&format!("cell {cell}")).is_some() {
        "; if the line below the header holds units, set `units_row = true` of the table in the map"
    } else {
        "; leave the cell empty where there is no value"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Parses `cell`, and checks that the result does not depend on the position of the cell in the text.
    fn read(cell: &str) -> Option<Option<f64>> {
        let found = parse_number(cell, 0..cell.len());
        for before in ["7", "12.5,-8,9.", "1.5\n-1234567.25,", "µ,µ,µ,µ,µ,µ,-"] {
            let text = format!("{before}{cell},3");
            let again = parse_number(&text, before.len()..before.len() + cell.len());
            assert_eq!(bits(again), bits(found), "`{cell}` in `{text}`");
        }
        found
    }

    fn bits(found: Option<Option<f64>>) -> Option<Option<u64>> {
        found.map(|number| number.map(f64::to_bits))
    }

    #[test]
    fn plain_decimals_are_the_nearest_binary64() {
        for text in [
            "0",
            "-0",
            "0.1",
            "-0.1",
            "123456.789",
            "9007199254740992",
            "9007199254740993",
            "0.16186123299558358",
            "4.940656458412465e-324",
            "1e22",
            "2.2e307",
            "-1e200",
            "1.",
            ".5",
            "000.5",
            "1761756168.688207",
            "999999999999999999",
            "9999999999999999999",
            "18446744073709551616",
            "+2.5",
            "0.0000000000000000001",
            "0.00000000000000000000001",
            "9007199254740.993",
            "1234567890123456",
            "-.123456789012345",
            "123456789012345.",
        ] {
            let expected: f64 = text.parse().expect("a number");
            let found = read(text).flatten().expect(text);
            assert_eq!(found.to_bits(), expected.to_bits(), "{text}");
        }
    }

    #[test]
    fn what_is_no_finite_number_is_refused() {
        for text in [
            "-",
            ".",
            "nan",
            "inf",
            "-Infinity",
            "1e400",
            "1e308",
            "-2.3e307",
            "0x10",
            "1,5",
            "1 2",
            "--1",
            "1.2.3",
            "1_0",
            "1.2-3",
            "12:3",
            "1/2",
            "1µ2",
            "\u{b0}1",
        ] {
            assert_eq!(read(text), None, "{text}");
        }
        assert_eq!(read(""), Some(None));
        assert_eq!(read("  "), Some(None));
        assert_eq!(read(" 1.5\r"), Some(Some(1.5)));
    }

    #[test]
    fn a_moved_point_is_rounded_once() {
        for (cell, places, expected) in [
            ("1212.4", -3, 1.2124),
            ("-1236.5", -3, -1.2365),
            ("0.0024", 3, 2.4),
            ("1.5e3", -6, 0.0015),
            ("5", 1, 50.0),
            ("1e-320", -3, 1e-323),
        ] {
            let found = parse_shifted(cell, places).map(f64::to_bits);
            assert_eq!(found, Some(f64::to_bits(expected)), "{cell}");
        }
        assert_eq!(parse_shifted("1e2147483647", 1), None);
    }

    proptest! {
        #[test]
        fn any_decimal_text_is_read_as_the_standard_library_reads_it(text in "-?[0-9]{0,20}\\.?[0-9]{0,20}") {
            let expected: Option<f64> = text.parse().ok();
            let found = read(&text).flatten();
            prop_assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits));
        }

        #[test]
        fn any_short_text_is_read_as_the_standard_library_reads_it(text in "[-+.0-9eµ: /]{0,17}") {
            let text = text.trim();
            let expected: Option<f64> = text.parse().ok().filter(|number: &f64| is_scorable(*number));
            let found = read(text).flatten();
            prop_assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits));
        }
    }
}
