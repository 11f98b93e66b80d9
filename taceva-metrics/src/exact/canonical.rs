//! Serial form of an exact sum.

use std::fmt;

use super::digits::DIGITS;

/// Greatest number of digits of a stored sum. A sum in memory has four digits more, as room for any number of merges.
const READABLE_DIGITS: usize = DIGITS - 4;

/// Exact sum as a sign, the position of the lowest digit, and digits of 32 bits. Equal sums have equal forms.
///
/// # Units
/// The value is `±Σ digits[i] × 2^(32 (first + i) − 2176)`, summed over i. Neither end of `digits` is zero; the sum zero has no digits.
///
/// ```
/// use taceva_metrics::{Canonical, ExactSum};
/// let sum: ExactSum = [0.5, -0.5].into_iter().collect();
/// assert_eq!(sum.to_canonical(), Canonical::default());
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(into = "Form", try_from = "Form")
)]
pub struct Canonical {
    negative: bool,
    first: usize,
    digits: Vec<u32>,
}

impl Canonical {
    /// The form with this sign, this position of the lowest digit, and these digits.
    ///
    /// # Errors
    /// [`CanonicalError`] if the parts are not the canonical form of a number, or exceed the range of sums.
    pub fn try_new(
        negative: bool,
        first: usize,
        digits: Vec<u32>,
    ) -> Result<Canonical, CanonicalError> {
        if digits.first() == Some(&0) || digits.last() == Some(&0) {
            return Err(CanonicalError::ZeroAtTheEnd);
        }
        if digits.is_empty() && (negative || first != 0) {
            return Err(CanonicalError::Zero);
        }
        let reach = first.saturating_add(digits.len());
        if reach > READABLE_DIGITS {
            return Err(CanonicalError::Beyond { reach });
        }
        Ok(Canonical {
            negative,
            first,
            digits,
        })
    }

    /// True for a negative sum.
    pub fn is_negative(&self) -> bool {
        self.negative
    }

    /// Position of the lowest of [`digits`](Canonical::digits), in digits of 32 bits.
    pub fn first(&self) -> usize {
        self.first
    }

    /// Digits of the magnitude in base 2³², lowest first.
    pub fn digits(&self) -> &[u32] {
        &self.digits
    }

    /// Form of the magnitude `digits`, whose carries are not yet propagated.
    pub(super) fn from_digits(negative: bool, digits: &[i64]) -> Canonical {
        let mut carried = 0;
        let mut magnitude = Vec::with_capacity(digits.len() + 2);
        let mut first = 0;
        let mut push = |digit: i64| {
            let digit = u32::try_from(digit & 0xffff_ffff).expect("32 bits");
            match (magnitude.is_empty(), digit) {
                (true, 0) => first += 1,
                _ => magnitude.push(digit),
            }
        };
        for &digit in digits {
            let value = digit + carried;
            push(value);
            carried = value >> 32;
        }
        push(carried);
        while magnitude.last() == Some(&0) {
            magnitude.pop();
        }
        Canonical {
            negative,
            first,
            digits: magnitude,
        }
    }
}

/// Reason why a sign, a position and digits are not the canonical form of a sum.
///
/// ```
/// use taceva_metrics::{Canonical, CanonicalError};
/// assert_eq!(Canonical::try_new(false, 0, vec![0]), Err(CanonicalError::ZeroAtTheEnd));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CanonicalError {
    /// The lowest or the highest digit is zero.
    ZeroAtTheEnd,
    /// There are no digits, but a minus sign or a position above 0.
    Zero,
    /// The number exceeds the range of sums.
    Beyond {
        /// Position after the highest digit, in digits of 32 bits.
        reach: usize,
    },
}

impl fmt::Display for CanonicalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CanonicalError::ZeroAtTheEnd => {
                f.write_str("the first or last digit of a sum is zero, expected trimmed digits")
            }
            CanonicalError::Zero => {
                f.write_str("a sum without digits has a sign or a place, expected [\"+\", 0, []]")
            }
            CanonicalError::Beyond { reach } => write!(
                f,
                "a sum reaches digit {reach}, expected at most {READABLE_DIGITS}"
            ),
        }
    }
}

impl std::error::Error for CanonicalError {}

/// Serialized form: sign, position of the lowest digit, and digits, such as `["-", 67, [1, 2]]`.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Form(Sign, usize, Vec<u32>);

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
enum Sign {
    #[serde(rename = "+")]
    Plus,
    #[serde(rename = "-")]
    Minus,
}

#[cfg(feature = "serde")]
impl From<Canonical> for Form {
    fn from(canonical: Canonical) -> Form {
        let sign = if canonical.negative {
            Sign::Minus
        } else {
            Sign::Plus
        };
        Form(sign, canonical.first, canonical.digits)
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Form> for Canonical {
    type Error = CanonicalError;

    fn try_from(Form(sign, first, digits): Form) -> Result<Canonical, CanonicalError> {
        Canonical::try_new(matches!(sign, Sign::Minus), first, digits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::ExactSum;

    #[test]
    fn a_small_negative_sum_has_one_digit() {
        let form = [1.0, -2.0].into_iter().collect::<ExactSum>().to_canonical();
        assert!(form.is_negative());
        assert_eq!((form.first(), form.digits()), (68, &[1][..]));
    }

    #[test]
    fn forms_that_no_sum_has_are_refused() {
        let refused = |negative, first, digits: &[u32]| {
            Canonical::try_new(negative, first, digits.to_vec()).expect_err("no form")
        };
        assert_eq!(refused(false, 3, &[0, 1]), CanonicalError::ZeroAtTheEnd);
        assert_eq!(refused(false, 3, &[1, 0]), CanonicalError::ZeroAtTheEnd);
        assert_eq!(refused(true, 0, &[]), CanonicalError::Zero);
        assert_eq!(
            refused(false, 135, &[1, 1]),
            CanonicalError::Beyond { reach: 137 }
        );
    }
}
