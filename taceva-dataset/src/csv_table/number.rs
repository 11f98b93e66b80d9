//! Decimal text to the nearest binary64.

/// Powers of ten that binary64 holds exactly.
const EXACT_POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// The largest integer below which binary64 holds every one.
const EXACT_INTEGERS: u64 = 1 << 53;

/// 16 digits and a point: more are beyond 2^53 unless they begin with zeros.
const PLAIN_BYTES: usize = 17;

/// The finite number in `cell`: `Some(None)` if the cell is empty, `None` if it holds something else.
pub(super) fn parse_number(cell: &str) -> Option<Option<f64>> {
    if let Some(number) = parse_plain(cell.as_bytes()) {
        return Some(Some(number));
    }
    let text = cell.trim();
    if text.is_empty() {
        return Some(None);
    }
    let number: f64 = text.parse().ok()?;
    number.is_finite().then_some(Some(number))
}

/// Digits with at most one point, where one division is exactly rounded: both operands are exact (Clinger 1990).
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
    #[expect(clippy::cast_precision_loss, reason = "at most 2^53, which is exact")]
    let magnitude = mantissa as f64 / EXACT_POWERS[places];
    Some(if negative { -magnitude } else { magnitude })
}

/// What to write instead of `cell`, where that can be guessed.
pub(crate) fn number_hint(cell: &str) -> &'static str {
    let is_numeric = cell
        .bytes()
        .all(|byte| byte.is_ascii_digit() || b"+-.,' ".contains(&byte));
    if is_numeric && cell.contains([',', '\'', ' ']) {
        "; write it without thousands separators and with a decimal point"
    } else {
        "; leave the cell empty where there is no value"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

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
        ] {
            let expected: f64 = text.parse().expect("a number");
            let found = parse_number(text).flatten().expect(text);
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
            "0x10",
            "1,5",
            "1 2",
            "--1",
            "1.2.3",
            "1_0",
        ] {
            assert_eq!(parse_number(text), None, "{text}");
        }
        assert_eq!(parse_number(""), Some(None));
        assert_eq!(parse_number("  "), Some(None));
        assert_eq!(parse_number(" 1.5\r"), Some(Some(1.5)));
    }

    proptest! {
        #[test]
        fn any_decimal_text_is_read_as_the_standard_library_reads_it(text in "-?[0-9]{0,20}\\.?[0-9]{0,20}") {
            let expected: Option<f64> = text.parse().ok();
            let found = parse_number(&text).flatten();
            prop_assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits));
        }
    }
}
