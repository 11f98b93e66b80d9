//! Conversion of decimals, half precision and times to cells.

use crate::cell::Cell;

/// Computes `value` / 10^`scale`, rounded once, by parsing the decimal text.
pub(crate) fn decimal(value: i128, scale: i32) -> Cell {
    let text = format!("{value}e-{scale}");
    Cell::Number(
        text.parse()
            .expect("digits and a power of ten are a number"),
    )
}

/// Number of nanoseconds in a time unit. Even a 64-bit number of days fits into 128 bits of nanoseconds.
pub(crate) fn nanoseconds_in(unit: &str) -> i128 {
    match unit {
        "ns" => 1,
        "us" => 1_000,
        "ms" => 1_000_000,
        "s" => 1_000_000_000,
        _ => 86_400_000_000_000,
    }
}

/// Converts half precision to double precision, exactly.
pub(crate) fn half(bits: u16) -> f64 {
    let sign = if bits & 0x8000 == 0 { 1.0 } else { -1.0 };
    let exponent = i32::from((bits >> 10) & 0x1f);
    let fraction = f64::from(bits & 0x3ff);
    sign * match exponent {
        0 => fraction * 2_f64.powi(-24),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1024.0 + fraction) * 2_f64.powi(exponent - 25),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_half_precision_are_exact() {
        for (bits, value) in [
            (0x3c00, 1.0),
            (0xc000, -2.0),
            (0x7bff, 65_504.0),
            (0x0001, 2_f64.powi(-24)),
            (0x3555, 0.333_251_953_125),
        ] {
            assert!((half(bits) - value).abs() < f64::MIN_POSITIVE, "{bits:x}");
        }
        assert!(half(0x7e00).is_nan());
        assert!(half(0xfc00).is_infinite());
    }

    #[test]
    fn decimals_are_the_nearest_number() {
        assert_eq!(decimal(-12_345, 2), Cell::Number(-123.45));
        assert_eq!(decimal(1, 38), Cell::Number(1e-38));
    }
}
