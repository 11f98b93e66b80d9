//! Lengths in whole nanometres, which compare exactly. In floating point, `0.40 − 0.35 ≤ 0.05` is false.

use std::fmt;
use std::str::FromStr;

/// A length in whole nanometres. This type gets no further field: one number determines a length.
///
/// ```
/// use taceva_core::Nanometre;
/// let level: Nanometre = "0.35".parse()?;
/// assert_eq!(level, Nanometre(350_000));
/// assert_eq!(level.to_string(), "0.35 mm");
/// # Ok::<(), taceva_core::NanometreError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Nanometre(pub i64);

/// Nanometres in a millimetre.
const PER_MILLIMETRE: f64 = 1e6;
/// Greatest magnitude, nm: whole numbers up to this limit (9000 km) are exact in binary64.
const GREATEST: i64 = 1 << 53;

impl Nanometre {
    /// Length nearest to `millimetres`, ties to even; `None` for NaN or a magnitude above 2⁵³ nm.
    ///
    /// The product with 10⁶ is rounded to binary64 first. Decimals of up to six places give the exact length.
    pub fn from_millimetres(millimetres: f64) -> Option<Nanometre> {
        let nanometres = (millimetres * PER_MILLIMETRE).round_ties_even();
        #[expect(
            clippy::cast_possible_truncation,
            reason = "2^53 is exact, and whole numbers up to it are exact in i64"
        )]
        (nanometres.abs() <= GREATEST as f64).then_some(Nanometre(nanometres as i64))
    }

    /// Length in mm, correctly rounded for lengths up to 2⁵³ nm.
    pub fn to_millimetres(self) -> f64 {
        self.to_f64() / PER_MILLIMETRE
    }

    /// Number of nanometres as a floating-point number, exact up to 2⁵³.
    pub fn to_f64(self) -> f64 {
        self.0 as f64
    }
}

impl FromStr for Nanometre {
    type Err = NanometreError;

    /// Parses a decimal number of millimetres, such as `0.35` or `-1.2e-3`. The exact value is rounded to the nearest nanometre, ties to even.
    fn from_str(text: &str) -> Result<Nanometre, NanometreError> {
        parse(text).ok_or_else(|| NanometreError {
            text: text.to_owned(),
        })
    }
}

fn parse(text: &str) -> Option<Nanometre> {
    let (negative, unsigned) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (unsigned, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: Vec<u8> = whole.bytes().chain(fraction.bytes()).collect();
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    // In nanometres, the first `kept` digits stand before the decimal point.
    let kept = i64::try_from(whole.len()).ok()? + i64::from(exponent) + 6;
    let digit = |place: i64| {
        usize::try_from(place)
            .ok()
            .and_then(|at| digits.get(at))
            .map_or(0, |digit| i64::from(digit - b'0'))
    };
    let mut nanometres = 0_i64;
    for place in 0..kept {
        // Leading zeros never overflow; a number beyond the range ends the loop.
        nanometres = nanometres.checked_mul(10)?.checked_add(digit(place))?;
        if nanometres > GREATEST {
            return None;
        }
        if nanometres == 0 && place > 400 {
            return Some(Nanometre(0));
        }
    }
    let rest = usize::try_from(kept.max(0)).unwrap_or(usize::MAX);
    let below = if kept < 0 { 0 } else { digit(kept) };
    let beyond = digits
        .iter()
        .skip(rest.saturating_add(1))
        .any(|digit| *digit != b'0');
    let up = below > 5 || (below == 5 && (beyond || nanometres % 2 == 1));
    let nanometres = nanometres + i64::from(up);
    Some(Nanometre(if negative { -nanometres } else { nanometres }))
}

impl fmt::Display for Nanometre {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} mm", self.to_millimetres())
    }
}

/// Error for text that is not a length in mm.
///
/// ```
/// use taceva_core::Nanometre;
/// let error = "1 mm".parse::<Nanometre>().unwrap_err();
/// assert_eq!(error.to_string(), "`1 mm` is not a length, expected millimetres such as 0.35");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NanometreError {
    text: String,
}

impl fmt::Display for NanometreError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "`{}` is not a length, expected millimetres such as 0.35",
            self.text
        )
    }
}

impl std::error::Error for NanometreError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_of_six_places_are_whole_nanometres_by_either_way() {
        for nanometres in (0..2_000_000).step_by(173) {
            let text = format!("{}.{:06}", nanometres / 1_000_000, nanometres % 1_000_000);
            assert_eq!(text.parse(), Ok(Nanometre(nanometres)), "{text}");
            let value: f64 = text.parse().expect("a number");
            assert_eq!(
                Nanometre::from_millimetres(value),
                Some(Nanometre(nanometres))
            );
        }
    }

    #[test]
    fn what_lies_below_a_nanometre_is_rounded_half_to_even() {
        let parsed = |text: &str| text.parse::<Nanometre>().map(|length| length.0);
        assert_eq!(parsed("0.3500001"), Ok(350_000));
        assert_eq!(parsed("0.0000005"), Ok(0));
        assert_eq!(parsed("0.0000015"), Ok(2));
        assert_eq!(parsed("0.00000050001"), Ok(1));
        assert_eq!(parsed("-1.5e-6"), Ok(-2));
        assert_eq!(parsed("5e-400"), Ok(0));
        assert_eq!(parsed("0e2000000000"), Ok(0));
        assert_eq!(Nanometre::from_millimetres(1.5e-6), Some(Nanometre(2)));
    }

    #[test]
    fn what_is_no_length_is_refused() {
        for text in [
            "", ".", "-", "1,5", "nan", "inf", "1e99", "0x1", "1 mm", "1e", "१",
        ] {
            assert!(text.parse::<Nanometre>().is_err(), "{text}");
        }
        assert_eq!(Nanometre::from_millimetres(f64::NAN), None);
        assert_eq!(Nanometre::from_millimetres(1e12), None);
    }
}
