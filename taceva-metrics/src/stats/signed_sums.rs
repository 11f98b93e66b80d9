//! Exact sums of the same numbers under many patterns of signs.

use crate::exact::ExactSum;

/// Numbers in one fixed-point format, with as many 32-bit digits as the numbers need.
pub(super) struct SignedSums {
    /// Digits of the numbers in order, lowest digit first. A negative number has negative digits.
    digits: Vec<i64>,
    width: usize,
}

/// Magnitude of a sum: digits in order, highest digit first, so that lexicographic order is numerical order.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Magnitude(Vec<i64>);

impl SignedSums {
    pub(super) fn new<'a>(numbers: impl IntoIterator<Item = &'a ExactSum>) -> SignedSums {
        let numbers = numbers.into_iter().map(ExactSum::to_canonical);
        let numbers: Vec<_> = numbers.collect();
        let spans = numbers.iter().filter(|number| !number.digits().is_empty());
        let spans = spans.map(|number| (number.first(), number.first() + number.digits().len()));
        let (low, high) = spans
            .reduce(|all, one| (all.0.min(one.0), all.1.max(one.1)))
            .unwrap_or_default();
        let width = high - low;
        let mut digits = vec![0; numbers.len() * width];
        for (at, number) in numbers.iter().enumerate() {
            let sign = if number.is_negative() { -1 } else { 1 };
            let start = at * width + number.first().saturating_sub(low);
            for (place, &digit) in digits[start..].iter_mut().zip(number.digits()) {
                *place = sign * i64::from(digit);
            }
        }
        SignedSums { digits, width }
    }

    /// |Σ ± number|, with a minus sign if `is_negated` is true for the index of the number.
    pub(super) fn magnitude(&self, is_negated: impl Fn(usize) -> bool) -> Magnitude {
        // An `i64` holds the sum of 2³¹ digits.
        let mut sum = vec![0_i64; self.width];
        for (at, number) in self.digits.chunks(self.width.max(1)).enumerate() {
            let sign = 1 - 2 * i64::from(is_negated(at));
            for (place, digit) in sum.iter_mut().zip(number) {
                *place += sign * digit;
            }
        }
        if carry(&mut sum) < 0 {
            sum.iter_mut().for_each(|digit| *digit = -*digit);
            carry(&mut sum);
        }
        sum.reverse();
        Magnitude(sum)
    }
}

/// Brings every digit except the highest into 0..2³² and returns the highest, which has the sign of the number.
fn carry(digits: &mut [i64]) -> i64 {
    let Some((highest, others)) = digits.split_last_mut() else {
        return 0;
    };
    let mut carried = 0;
    for digit in others {
        let value = *digit + carried;
        *digit = value & 0xffff_ffff;
        carried = value >> 32;
    }
    *highest += carried;
    *highest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sums(numbers: &[f64]) -> SignedSums {
        let numbers: Vec<ExactSum> = numbers
            .iter()
            .map(|&number| [number].into_iter().collect())
            .collect();
        SignedSums::new(&numbers)
    }

    #[test]
    fn magnitudes_are_ordered_like_the_exact_sums() {
        let numbers = [0.1, -0.25, 3e-12, 1e5, -7.5, 0.0, -1e5];
        let sums = sums(&numbers);
        let exact = |pattern: u32| {
            let signed = numbers.iter().enumerate().map(|(at, &number)| {
                if pattern >> at & 1 == 1 {
                    -number
                } else {
                    number
                }
            });
            let mut sum: ExactSum = signed.collect();
            if sum.to_f64() < 0.0 {
                let negative = std::mem::take(&mut sum);
                sum.subtract(&negative);
            }
            sum
        };
        let magnitudes: Vec<_> = (0..128_u32)
            .map(|pattern| sums.magnitude(|at| pattern >> at & 1 == 1))
            .collect();
        for left in 0..128_u32 {
            for right in 0..128_u32 {
                let mut difference = exact(left);
                difference.subtract(&exact(right));
                let expected = difference.to_f64().total_cmp(&0.0);
                let (left, right) = (left as usize, right as usize);
                assert_eq!(
                    magnitudes[left].cmp(&magnitudes[right]),
                    expected,
                    "{left} {right}"
                );
            }
        }
    }

    #[test]
    fn a_sum_and_its_opposite_have_one_magnitude() {
        let sums = sums(&[1.0, 2.0_f64.powi(-80), -3.0]);
        for pattern in 0..8_u32 {
            let plus = sums.magnitude(|at| pattern >> at & 1 == 1);
            let minus = sums.magnitude(|at| pattern >> at & 1 == 0);
            assert_eq!(plus, minus);
        }
    }

    #[test]
    fn nothing_and_zeros_have_the_magnitude_zero() {
        let nothing = SignedSums::new(&[]).magnitude(|_| true);
        assert_eq!(nothing, sums(&[0.0, 0.0]).magnitude(|_| false));
    }
}
