//! Formats numbers with four significant digits.

/// Number of significant digits in printed text; reports have all digits.
const SIGNIFICANT_DIGITS: i32 = 4;

/// Formats `value` with four significant digits. Very small and large values get an exponent.
pub(crate) fn significant(value: f64) -> String {
    let scientific = format!("{value:.*e}", usize_of(SIGNIFICANT_DIGITS - 1));
    let exponent: i32 = scientific
        .rsplit('e')
        .next()
        .and_then(|exponent| exponent.parse().ok())
        .unwrap_or_default();
    match SIGNIFICANT_DIGITS - 1 - exponent {
        decimals @ 0..=7 => format!("{value:.*}", usize_of(decimals)),
        _ => scientific,
    }
}

fn usize_of(digits: i32) -> usize {
    usize::try_from(digits).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits_whatever_their_size() {
        let written = [0.0361, -12.5, 9999.6, 0.0, 0.000_123_456, 1.0e-9].map(significant);
        assert_eq!(
            written,
            [
                "0.03610",
                "-12.50",
                "1.000e4",
                "0.000",
                "0.0001235",
                "1.000e-9"
            ]
        );
    }
}
