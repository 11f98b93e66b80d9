//! Exact scores by integer arithmetic, in code independent of the kernels.
//!
//! Each residual and each term of sMAPE is rounded once, as their definitions say. These numbers are multiples of the least denormal number, so
//! they and their squares are summed as whole numbers. Rounding happens only at the end.

use std::cmp::Ordering;

use super::scores::Scores;
use crate::pair::Paired;

/// Binary exponent of the least denormal number. Every finite value is a multiple of 2 to this power.
const LEAST: i32 = -1074;

/// Reference scores of `pairs`.
pub(super) fn scores(pairs: Paired<&[f64]>) -> Scores {
    let (mut absolute, mut squared) = (Whole::default(), Whole::default());
    let (mut truth, mut truth_squared) = (Whole::default(), Whole::default());
    let mut terms = Whole::default();
    let mut rows = 0_u64;
    for pair in pairs.iter() {
        let y = Whole::of(pair.reference);
        let residual = Whole::of(pair.residual());
        squared = squared.plus(&residual.times(&residual));
        absolute = absolute.plus(&residual.magnitude());
        truth_squared = truth_squared.plus(&y.times(&y));
        truth = truth.plus(&y);
        terms = terms.plus(&Whole::of(pair.symmetric_term()));
        rows += 1;
    }
    let n = Whole::of_count(rows);
    let spread = n.times(&truth_squared).minus(&truth.times(&truth));
    let unexplained = n.times(&squared);
    Scores {
        mae: ratio(&absolute, &n, LEAST),
        r2: ratio(&spread.minus(&unexplained), &spread, 0),
        smape: ratio(&terms, &n, LEAST),
    }
}

/// Signed whole number in digits of 32 bits, lowest digit first, without leading zeros.
#[derive(Clone, Debug, Default)]
struct Whole {
    is_negative: bool,
    digits: Vec<u32>,
}

impl Whole {
    /// `value` as a whole multiple of the least denormal number.
    fn of(value: f64) -> Whole {
        let bits = value.to_bits();
        let field = bits >> 52 & 0x7ff;
        let fraction = bits & ((1 << 52) - 1);
        let (mantissa, up) = match field {
            0 => (fraction, 0),
            _ => (fraction | 1 << 52, field - 1),
        };
        let up = usize::try_from(up).expect("eleven bits");
        let mut digits = vec![0; up / 32];
        let shifted = u128::from(mantissa) << (up % 32);
        digits.extend([0, 32, 64].map(|place| low(shifted >> place)));
        Whole {
            is_negative: value < 0.0,
            digits,
        }
        .trimmed()
    }

    fn of_count(count: u64) -> Whole {
        Whole {
            is_negative: false,
            digits: vec![low(u128::from(count)), low(u128::from(count >> 32))],
        }
        .trimmed()
    }

    fn trimmed(mut self) -> Whole {
        while self.digits.last() == Some(&0) {
            self.digits.pop();
        }
        self
    }

    fn magnitude(&self) -> Whole {
        Whole {
            is_negative: false,
            digits: self.digits.clone(),
        }
    }

    fn minus(&self, other: &Whole) -> Whole {
        self.plus(&Whole {
            is_negative: !other.is_negative,
            digits: other.digits.clone(),
        })
    }

    fn plus(&self, other: &Whole) -> Whole {
        if self.is_negative == other.is_negative {
            return Whole {
                is_negative: self.is_negative,
                digits: added(&self.digits, &other.digits),
            };
        }
        let (is_negative, digits) = match compared(&self.digits, &other.digits) {
            Ordering::Less => (other.is_negative, taken(&other.digits, &self.digits)),
            _ => (self.is_negative, taken(&self.digits, &other.digits)),
        };
        Whole {
            is_negative,
            digits,
        }
        .trimmed()
    }

    fn times(&self, other: &Whole) -> Whole {
        let mut digits = vec![0_u32; self.digits.len() + other.digits.len()];
        for (place, left) in self.digits.iter().enumerate() {
            let mut carried = 0_u64;
            for (digit, right) in digits[place..].iter_mut().zip(&other.digits) {
                let product = u64::from(*left) * u64::from(*right) + u64::from(*digit) + carried;
                *digit = low(u128::from(product));
                carried = product >> 32;
            }
            digits[place + other.digits.len()] = low(u128::from(carried));
        }
        Whole {
            is_negative: self.is_negative != other.is_negative,
            digits,
        }
        .trimmed()
    }

    fn bits(&self) -> usize {
        self.digits.last().map_or(0, |top| {
            32 * self.digits.len() - top.leading_zeros() as usize
        })
    }

    fn raised(&self, places: usize) -> Vec<u32> {
        let mut digits = vec![0; places / 32];
        let mut carried = 0;
        for digit in &self.digits {
            let shifted = u64::from(*digit) << (places % 32);
            digits.push(low(u128::from(shifted)) | carried);
            carried = low(u128::from(shifted >> 32));
        }
        digits.push(carried);
        digits
    }
}

/// Binary64 number nearest to `above / below` × 2^`unit`; `None` if `below` is zero or the result is not finite.
fn ratio(above: &Whole, below: &Whole, unit: i32) -> Option<f64> {
    if below.digits.is_empty() {
        return None;
    }
    if above.digits.is_empty() {
        return Some(0.0);
    }
    // Seventy bits of the quotient by long division, and a flag for a remainder.
    let up = (70 + below.bits()).saturating_sub(above.bits());
    let mut rest = Vec::new();
    let raised = above.raised(up);
    let mut quotient = 0_u128;
    let mut places_left = 32 * raised.len();
    while places_left > 0 && quotient < 1 << 70 {
        places_left -= 1;
        let place = places_left;
        let bit = raised[place / 32] >> (place % 32) & 1;
        rest = doubled(&rest, bit);
        quotient *= 2;
        if compared(&rest, &below.digits) != Ordering::Less {
            rest = taken(&rest, &below.digits);
            while rest.last() == Some(&0) {
                rest.pop();
            }
            quotient += 1;
        }
    }
    let is_left = (0..places_left).any(|place| raised[place / 32] >> (place % 32) & 1 == 1);
    let sticky = u128::from(is_left || !rest.is_empty());
    let rounded = ((quotient << 1) | sticky) as f64;
    let power = unit - 1 - i32::try_from(up).ok()? + i32::try_from(places_left).ok()?;
    // In two steps, each of which is exact unless the score is denormal.
    let half = power / 2;
    let value = rounded * 2.0_f64.powi(half) * 2.0_f64.powi(power - half);
    let signed = if above.is_negative == below.is_negative {
        value
    } else {
        -value
    };
    signed.is_finite().then_some(signed)
}

fn doubled(digits: &[u32], bit: u32) -> Vec<u32> {
    let mut carried = bit;
    let mut doubled: Vec<u32> = digits
        .iter()
        .map(|digit| {
            let next = digit << 1 | carried;
            carried = digit >> 31;
            next
        })
        .collect();
    if carried > 0 {
        doubled.push(carried);
    }
    doubled
}

fn added(left: &[u32], right: &[u32]) -> Vec<u32> {
    let mut carried = 0_u64;
    let mut sum = Vec::with_capacity(left.len().max(right.len()) + 1);
    for place in 0..left.len().max(right.len()) {
        let digit = |of: &[u32]| u64::from(of.get(place).copied().unwrap_or_default());
        let total = digit(left) + digit(right) + carried;
        sum.push(low(u128::from(total)));
        carried = total >> 32;
    }
    if carried > 0 {
        sum.push(low(u128::from(carried)));
    }
    sum
}

/// Difference `left` − `right` of two whole numbers; `right` must not exceed `left`.
fn taken(left: &[u32], right: &[u32]) -> Vec<u32> {
    let mut borrowed = 0_i64;
    left.iter()
        .enumerate()
        .map(|(place, digit)| {
            let other = right.get(place).copied().unwrap_or_default();
            let difference = i64::from(*digit) - i64::from(other) - borrowed;
            borrowed = i64::from(difference < 0);
            low(u128::from((difference + (borrowed << 32)).unsigned_abs()))
        })
        .collect()
}

fn compared(left: &[u32], right: &[u32]) -> Ordering {
    let length = |of: &[u32]| of.len() - of.iter().rev().take_while(|digit| **digit == 0).count();
    let (one, other) = (length(left), length(right));
    let digits = || left[..one].iter().rev().cmp(right[..other].iter().rev());
    one.cmp(&other).then_with(digits)
}

fn low(value: u128) -> u32 {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the lowest digit is wanted"
    )]
    let digit = value as u32;
    digit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scores_of_small_whole_numbers_are_their_fractions() {
        let pairs = Paired {
            estimate: &[1.0, 2.0, 6.0, 7.0][..],
            reference: &[1.0, 4.0, 4.0, 7.0],
        };
        let found = scores(pairs);
        assert_eq!((found.mae, found.r2), (Some(1.0), Some(1.0 - 8.0 / 18.0)));
        assert_eq!(scores(Paired::default()), Scores::default());
    }

    #[test]
    fn no_sum_is_rounded_before_the_end() {
        let large = 1e100;
        let pairs = Paired {
            estimate: &[0.0; 3][..],
            reference: &[large, 1.0, -large],
        };
        let found = scores(pairs);
        let mean = (2.0 * large) / 3.0;
        assert_eq!(found.mae, Some(mean));
        assert_eq!(
            scores(Paired {
                estimate: &[0.0, 0.0],
                reference: &[0.0, 1.0]
            })
            .r2,
            Some(-1.0)
        );
    }

    #[test]
    fn the_ends_of_the_range_are_held() {
        let least = f64::from_bits(1);
        let pairs = Paired {
            estimate: &[0.0, 0.0][..],
            reference: &[least, 3.0 * least],
        };
        let found = scores(pairs);
        assert_eq!(found.mae.map(f64::to_bits), Some(2));
        assert_eq!(found.r2, Some(-4.0));
    }
}
