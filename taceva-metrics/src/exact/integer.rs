//! Natural numbers of any size, with the operations that scores need.

use std::cmp::Ordering;

/// Natural number in 64-bit limbs, lowest limb first, without leading zeros.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Natural {
    limbs: Vec<u64>,
}

impl Natural {
    /// Number with the given limbs. Leading zeros are removed.
    pub(super) fn from_limbs(mut limbs: Vec<u64>) -> Natural {
        while limbs.last() == Some(&0) {
            limbs.pop();
        }
        Natural { limbs }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.limbs.is_empty()
    }

    /// Number of bits up to the highest set bit.
    pub(super) fn bits(&self) -> usize {
        self.limbs.last().map_or(0, |top| {
            64 * self.limbs.len() - top.leading_zeros() as usize
        })
    }

    pub(super) fn plus(&self, other: &Natural) -> Natural {
        let (long, short) = if self.limbs.len() < other.limbs.len() {
            (other, self)
        } else {
            (self, other)
        };
        let mut limbs = long.limbs.clone();
        if add_to(&mut limbs, &short.limbs) {
            limbs.push(1);
        }
        Natural { limbs }
    }

    /// `self − other`; `other` must not exceed `self`.
    pub(super) fn minus(&self, other: &Natural) -> Natural {
        let mut limbs = self.limbs.clone();
        let borrow = subtract_multiple(&mut limbs, &other.limbs, 1);
        debug_assert!(!borrow, "subtracts the smaller number");
        Natural::from_limbs(limbs)
    }

    pub(super) fn times(&self, other: &Natural) -> Natural {
        let mut limbs = vec![0; self.limbs.len() + other.limbs.len()];
        for (start, &factor) in self.limbs.iter().enumerate() {
            let mut carried = 0;
            for (limb, &other) in limbs[start..].iter_mut().zip(&other.limbs) {
                let product = wide(factor) * wide(other) + wide(*limb) + carried;
                *limb = low(product);
                carried = product >> 64;
            }
            limbs[start + other.limbs.len()] = low(carried);
        }
        Natural::from_limbs(limbs)
    }

    pub(super) fn shifted_up(&self, places: usize) -> Natural {
        if self.is_zero() {
            return Natural::default();
        }
        let mut limbs = vec![0; places / 64];
        let mut carried = 0;
        for &limb in &self.limbs {
            let shifted = wide(limb) << (places % 64);
            limbs.push(low(shifted) | carried);
            carried = low(shifted >> 64);
        }
        limbs.push(carried);
        Natural::from_limbs(limbs)
    }

    /// `self` without the lowest `places` bits, and true if any of these bits was set.
    fn shifted_down(&self, places: usize) -> (Natural, bool) {
        let (whole, rest) = (places / 64, places % 64);
        let mut limbs: Vec<u64> = self.limbs.iter().skip(whole).copied().collect();
        let cut = limbs
            .first()
            .is_some_and(|lowest| lowest & ((1 << rest) - 1) != 0);
        let lost = cut || self.limbs.iter().take(whole).any(|&limb| limb != 0);
        for position in 0..limbs.len() {
            let above = limbs.get(position + 1).copied().unwrap_or_default();
            limbs[position] = low(((wide(above) << 64) | wide(limbs[position])) >> rest);
        }
        (Natural::from_limbs(limbs), lost)
    }

    /// Integer part of `self / divisor`, and true for an exact quotient. Computed bit by bit, for numbers of a few thousand bits.
    pub(super) fn divided_by(&self, divisor: &Natural) -> (Natural, bool) {
        let Some(most) = self.bits().checked_sub(divisor.bits()) else {
            return (Natural::default(), self.is_zero());
        };
        let mut rest = self.clone();
        let mut limbs = vec![0_u64; most / 64 + 1];
        for place in (0..=most).rev() {
            let part = divisor.shifted_up(place);
            if rest >= part {
                rest = rest.minus(&part);
                limbs[place / 64] |= 1 << (place % 64);
            }
        }
        (Natural::from_limbs(limbs), rest.is_zero())
    }

    /// Integer part of √self, and true for an exact root. Computed digit by digit.
    pub(super) fn root(&self) -> (Natural, bool) {
        let mut root = Natural::default();
        for place in (0..self.bits().div_ceil(2)).rev() {
            let more = root.plus(&Natural::from(1).shifted_up(place));
            if more.times(&more) <= *self {
                root = more;
            }
        }
        let is_square = root.times(&root) == *self;
        (root, is_square)
    }

    /// Leading bits, at most 64; true if a lower bit is set; and the exponent of two of the last returned bit.
    pub(super) fn leading_bits(&self) -> (u64, bool, i32) {
        let places = self.bits().saturating_sub(64);
        let (leading, lost) = self.shifted_down(places);
        let power = i32::try_from(places).expect("sums have fewer than 2^31 bits");
        (
            leading.limbs.first().copied().unwrap_or_default(),
            lost,
            power,
        )
    }

    /// Leading 63 or 64 bits of `self / divisor`, true if they are inexact, and the exponent of the last returned bit.
    ///
    /// Both numbers must be nonzero. The code does one step of long division in base 2⁶⁴. A shift sets the top bit of the highest limb of the
    /// divisor. Another shift gives the dividend one limb more than the divisor. The quotient of the leading limbs then exceeds the true quotient by
    /// at most two (Knuth, The Art of Computer Programming 2, 4.3.1, theorem B).
    pub(super) fn leading_quotient(&self, divisor: &Natural) -> (u64, bool, i64) {
        let length = divisor.limbs.len();
        let raised = 64 * length - divisor.bits();
        let divisor = divisor.shifted_up(raised);
        let target = 64 * length + 63;
        let (mut dividend, lost) = match target.checked_sub(self.bits()) {
            Some(up) => (self.shifted_up(up), false),
            None => self.shifted_down(self.bits() - target),
        };
        let dividend = &mut dividend.limbs;
        let leading = (wide(dividend[length]) << 64) | wide(dividend[length - 1]);
        let mut quotient = low(leading / wide(divisor.limbs[length - 1]));
        let mut negative = subtract_multiple(dividend, &divisor.limbs, quotient);
        while negative {
            quotient -= 1;
            negative = !add_to(dividend, &divisor.limbs);
        }
        let inexact = lost || dividend.iter().any(|&limb| limb != 0);
        let power = signed(self.bits()) - signed(target) + signed(raised);
        (quotient, inexact, power)
    }
}

impl From<u64> for Natural {
    fn from(value: u64) -> Natural {
        Natural::from_limbs(vec![value])
    }
}

impl PartialOrd for Natural {
    fn partial_cmp(&self, other: &Natural) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Natural {
    fn cmp(&self, other: &Natural) -> Ordering {
        let length = self.limbs.len().cmp(&other.limbs.len());
        length.then_with(|| self.limbs.iter().rev().cmp(other.limbs.iter().rev()))
    }
}

/// Adds `other` to `limbs` in place. Returns true for a carry out of the top limb.
fn add_to(limbs: &mut [u64], other: &[u64]) -> bool {
    let mut carried = false;
    let padded = other.iter().copied().chain(std::iter::repeat(0));
    for (limb, other) in limbs.iter_mut().zip(padded) {
        let sum = wide(*limb) + wide(other) + u128::from(carried);
        *limb = low(sum);
        carried = sum >> 64 != 0;
    }
    carried
}

/// Subtracts `factor × other` from `limbs` in place. Returns true for a borrow from above the top limb.
fn subtract_multiple(limbs: &mut [u64], other: &[u64], factor: u64) -> bool {
    let mut carried = 0;
    let padded = other.iter().copied().chain(std::iter::repeat(0));
    for (limb, other) in limbs.iter_mut().zip(padded) {
        let taken = wide(factor) * wide(other) + carried;
        let (difference, borrow) = limb.overflowing_sub(low(taken));
        *limb = difference;
        carried = (taken >> 64) + u128::from(borrow);
    }
    carried != 0
}

fn wide(limb: u64) -> u128 {
    u128::from(limb)
}

fn low(value: u128) -> u64 {
    #[expect(clippy::cast_possible_truncation, reason = "the lower limb is wanted")]
    let limb = value as u64;
    limb
}

fn signed(bits: usize) -> i64 {
    i64::try_from(bits).expect("fewer than 2^63 bits fit in memory")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn natural(value: u128) -> Natural {
        Natural::from_limbs(vec![low(value), low(value >> 64)])
    }

    #[test]
    fn small_numbers_agree_with_the_machine_s_own() {
        let values = [
            0,
            1,
            3,
            1 << 63,
            u128::from(u64::MAX),
            1 << 64,
            0xdead_beef << 50,
        ];
        for left in values {
            for right in values {
                assert_eq!(natural(left).plus(&natural(right)), natural(left + right));
                assert_eq!(natural(left).cmp(&natural(right)), left.cmp(&right));
                if left >= right {
                    assert_eq!(natural(left).minus(&natural(right)), natural(left - right));
                }
                if let Some(product) = left.checked_mul(right) {
                    assert_eq!(natural(left).times(&natural(right)), natural(product));
                }
            }
        }
    }

    #[test]
    fn shifting_down_undoes_shifting_up_and_says_what_it_lost() {
        let value = natural(0x1234_5678_9abc_def1_0fed_cba9_8765_4321);
        for places in [0, 1, 63, 64, 65, 200] {
            let up = value.shifted_up(places);
            assert_eq!(up.bits(), value.bits() + places);
            assert_eq!(up.shifted_down(places), (value.clone(), false));
            assert!(up.shifted_down(places + 1).1);
        }
    }

    #[test]
    fn a_guess_that_is_too_high_is_corrected() {
        // Leading limbs alone give a quotient above the true one for a divisor whose lower limb is full.
        let divisor = natural((1 << 127) | u128::from(u64::MAX));
        let quotient = Natural::from(0xffff_ffff_ffff_fffe);
        let product = divisor.times(&quotient);
        let (leading, inexact, power) = product.leading_quotient(&divisor);
        let shift = u32::try_from(power.unsigned_abs()).expect("few places");
        let expected = u128::from(0xffff_ffff_ffff_fffe_u64);
        assert_eq!((u128::from(leading) << shift, inexact), (expected, false));
        let (_, inexact, _) = product.plus(&Natural::from(1)).leading_quotient(&divisor);
        assert!(inexact);
    }
}
