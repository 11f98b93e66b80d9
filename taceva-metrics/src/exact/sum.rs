//! Exact sums of binary64 numbers and of their products.

use std::fmt;

use super::canonical::Canonical;
use super::digits::{
    Binary, DIGITS, UNIT_EXPONENT, add_to, carry, high_digits, low_digit, split, visit_digits,
};
use super::rational::Dyadic;

/// Number of digits stored inline, without an allocation. Sums of one quantity rarely need more.
const WINDOW: usize = 8;

/// Position of the bit of weight 1, counted from the lowest bit of a sum.
const UNIT_POSITION: usize = 2176;
/// Greatest number of additions between propagations of carries. Each addition changes a digit by less than 2⁵³, so 1000 of them fit an `i64`.
const DEPOSITS: u32 = 1000;
/// Position of the bit of weight 2⁻¹⁰⁷⁴, the least denormal number.
const DENORMAL_POSITION: usize = UNIT_POSITION - 1074;
/// Position of the bit of weight 2⁻²¹⁴⁸, the square of the least denormal number.
const DENORMAL_SQUARE_POSITION: usize = UNIT_POSITION - 2148;

/// Exact sum of binary64 numbers, and of products of two binary64 numbers.
///
/// Adding, merging and subtracting never round; [`to_f64`](ExactSum::to_f64) rounds once. Sums of equal value compare equal, however they
/// were computed.
///
/// The sum is a fixed-point number of 32-bit digits, each in an `i64` whose upper half collects carries. An addition changes only a few neighbouring
/// digits. Eight digits around the summed values are stored inline. The full range is allocated only for sums that need more.
///
/// ```
/// use taceva_metrics::ExactSum;
/// let mut sum = ExactSum::default();
/// for value in [1e100, 1.0, -1e100] {
///     sum.add(value);
/// }
/// assert_eq!(sum.to_f64(), 1.0);
/// ```
#[derive(Clone, Default)]
pub struct ExactSum {
    window: [i64; WINDOW],
    /// Index in the whole sum of the digit in `window[0]`.
    first: u32,
    /// Additions left before the next propagation of carries; 0 in a new sum, whose first addition sets `first`.
    deposits_left: u32,
    /// All 32-bit digits of the sum, allocated if the sum needs more of them than `window` holds.
    full: Option<Box<[i64; DIGITS]>>,
}

impl ExactSum {
    /// Adds `value`.
    ///
    /// # Panics
    /// If `value` is NaN or infinite. The caller must decide the meaning of these values.
    pub fn add(&mut self, value: f64) {
        assert!(value.is_finite(), "only finite numbers have a sum");
        self.deposit(value);
    }

    /// Adds the exact product of `left` and `right`.
    ///
    /// # Panics
    /// If either is NaN or infinite.
    pub fn add_product(&mut self, left: f64, right: f64) {
        assert!(
            left.is_finite() && right.is_finite(),
            "only finite numbers have a product"
        );
        let (left, right) = (Binary::of(left), Binary::of(right));
        let product = u128::from(left.mantissa) * u128::from(right.mantissa);
        let position = left.position + right.position + DENORMAL_SQUARE_POSITION;
        let sign = left.sign * right.sign;
        self.deposit_parts(position, split(product, position).map(|part| sign * part));
    }

    /// Adds the sum `other`.
    pub fn merge(&mut self, other: &ExactSum) {
        other.for_each_digit(|index, digit| self.deposit_digits(index, [digit]));
    }

    /// Subtracts the sum `other`, exactly.
    pub fn subtract(&mut self, other: &ExactSum) {
        other.for_each_digit(|index, digit| self.deposit_digits(index, [-digit]));
    }

    /// Nearest binary64, ties to even. Overflow gives infinity, underflow a zero with the sign of the sum.
    pub fn to_f64(&self) -> f64 {
        self.to_dyadic().to_f64()
    }

    /// Canonical form, equal for all sums of equal value.
    pub fn to_canonical(&self) -> Canonical {
        let mut digits = [0; DIGITS];
        let mut top = None;
        self.for_each_digit(|index, digit| {
            digits[index] = digit;
            top = Some(index);
        });
        let Some(top) = top else {
            return Canonical::default();
        };
        // A balanced number has the sign of its highest digit.
        let negative = digits[top] < 0;
        let digits = &mut digits[..=top];
        if negative {
            digits.iter_mut().for_each(|digit| *digit = -*digit);
        }
        Canonical::from_digits(negative, digits)
    }

    /// Sum with the form `canonical`.
    pub fn from_canonical(canonical: &Canonical) -> ExactSum {
        let mut sum = ExactSum::default();
        let sign = if canonical.is_negative() { -1 } else { 1 };
        for (index, &digit) in (canonical.first()..).zip(canonical.digits()) {
            sum.deposit_digits(index, [sign * i64::from(digit)]);
        }
        sum
    }

    /// Exact value, for products and quotients of sums.
    ///
    /// ```
    /// use taceva_metrics::{Dyadic, ExactSum};
    /// let sum: ExactSum = [0.5, 1.0].into_iter().collect();
    /// assert_eq!(sum.to_dyadic().over(&Dyadic::from(2)), 0.75);
    /// ```
    pub fn to_dyadic(&self) -> Dyadic {
        Dyadic::from_canonical(&self.to_canonical())
    }

    /// Adds a finite `value`.
    #[inline]
    pub(super) fn deposit(&mut self, value: f64) {
        let Binary {
            sign,
            mantissa,
            position,
        } = Binary::of(value);
        let position = position + DENORMAL_POSITION;
        let shifted = u128::from(mantissa) << (position % 32);
        let parts = [low_digit(shifted), high_digits(shifted)];
        self.deposit_parts(position, parts.map(|part| sign * part));
    }

    /// Adds units × 2^unit; 2^unit must be at least the square of the least denormal number.
    pub(super) fn add_units(&mut self, units: i64, unit: i32) {
        let position = usize::try_from(unit - UNIT_EXPONENT).expect("a power of two in range");
        let sign = units.signum();
        let shifted = u128::from(units.unsigned_abs()) << (position % 32);
        let parts = [shifted, shifted >> 32, shifted >> 64].map(low_digit);
        // One by one, so that a zero at an end does not widen the window.
        for (index, part) in (position / 32..).zip(parts) {
            self.deposit_parts(32 * index, [sign * part]);
        }
    }

    /// Adds the square of a finite `value`.
    #[inline]
    pub(super) fn deposit_square(&mut self, value: f64) {
        let Binary {
            mantissa, position, ..
        } = Binary::of(value);
        let square = u128::from(mantissa) * u128::from(mantissa);
        let position = 2 * position + DENORMAL_SQUARE_POSITION;
        self.deposit_parts(position, split(square, position));
    }

    /// Adds `parts` from the digit of bit `position` on, unless all are zero. Zeros would only widen the range of stored digits.
    #[inline]
    fn deposit_parts<const PARTS: usize>(&mut self, position: usize, parts: [i64; PARTS]) {
        if parts != [0; PARTS] {
            self.deposit_digits(position / 32, parts);
        }
    }

    #[inline]
    fn deposit_digits<const PARTS: usize>(&mut self, index: usize, parts: [i64; PARTS]) {
        let offset = index.wrapping_sub(self.first as usize);
        if offset > WINDOW - PARTS || self.deposits_left == 0 {
            return self.deposit_with_room(index, &parts);
        }
        self.deposits_left -= 1;
        add_to(&mut self.window[offset..offset + PARTS], &parts);
    }

    #[cold]
    #[inline(never)]
    fn deposit_with_room(&mut self, index: usize, parts: &[i64]) {
        if self.full.is_none() {
            self.make_room(index, index + parts.len());
        }
        match &mut self.full {
            Some(full) => {
                if self.deposits_left == 0 {
                    carry(&mut full[..]);
                    self.deposits_left = DEPOSITS;
                }
                add_to(&mut full[index..], parts);
            }
            None => add_to(&mut self.window[index - self.first as usize..], parts),
        }
        self.deposits_left -= 1;
    }

    /// Propagates carries and moves the inline digits to include the indices `low..high`. Allocates all digits if the inline digits are too few.
    fn make_room(&mut self, low: usize, high: usize) {
        let (digits, old_first) = self.carried_window();
        let (mut low, mut high) = (low, high);
        if let Some(lowest) = digits.iter().position(|&digit| digit != 0) {
            let highest = digits
                .iter()
                .rposition(|&digit| digit != 0)
                .unwrap_or(lowest);
            low = low.min(old_first + lowest);
            high = high.max(old_first + highest + 1);
        }
        self.deposits_left = DEPOSITS;
        if high - low > WINDOW {
            let mut full = Box::new([0; DIGITS]);
            add_to(&mut full[old_first..], &digits);
            self.full = Some(full);
            // From here on no index is within the window, for any width of a `usize`.
            self.first = u32::MAX / 2;
            return;
        }
        // One digit of room above for the growth of the sum, the rest below for smaller values.
        let spare = WINDOW - (high - low);
        let first = (low + spare.min(1))
            .saturating_sub(spare)
            .min(DIGITS - WINDOW);
        let at = |index: usize| {
            index
                .checked_sub(old_first)
                .and_then(|offset| digits.get(offset))
        };
        self.window = std::array::from_fn(|offset| at(first + offset).copied().unwrap_or_default());
        self.first = u32::try_from(first).expect("a digit's index is below 140");
    }

    /// Inline digits with propagated carries, and the index of the first of them.
    fn carried_window(&self) -> ([i64; WINDOW + 2], usize) {
        let mut digits = [0; WINDOW + 2];
        digits[..WINDOW].copy_from_slice(&self.window);
        carry(&mut digits);
        (digits, self.first as usize)
    }

    /// Calls `visit` with each nonzero digit, lowest first. Each digit is in −2³¹..2³¹.
    fn for_each_digit(&self, visit: impl FnMut(usize, i64)) {
        match &self.full {
            Some(full) => {
                let mut digits = **full;
                carry(&mut digits);
                visit_digits(0, &digits, visit);
            }
            None => {
                let (digits, first) = self.carried_window();
                visit_digits(first, &digits, visit);
            }
        }
    }
}

impl PartialEq for ExactSum {
    fn eq(&self, other: &ExactSum) -> bool {
        self.to_canonical() == other.to_canonical()
    }
}

impl Eq for ExactSum {}

impl fmt::Debug for ExactSum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ExactSum({:?})", self.to_f64())
    }
}

impl Extend<f64> for ExactSum {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, values: I) {
        values.into_iter().for_each(|value| self.add(value));
    }
}

impl FromIterator<f64> for ExactSum {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> ExactSum {
        let mut sum = ExactSum::default();
        sum.extend(values);
        sum
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for ExactSum {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.to_canonical().serialize(serializer)
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for ExactSum {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<ExactSum, D::Error> {
        Canonical::deserialize(deserializer).map(|canonical| ExactSum::from_canonical(&canonical))
    }
}
