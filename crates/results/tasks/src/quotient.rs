//! Sums of quotients of counts, rounded once.

use taceva_metrics::{Dyadic, Fraction};

/// 2⁶⁴, the number of values of a 64-bit limb.
const LIMB: f64 = 18_446_744_073_709_551_616.0;

/// Quotient of two counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quotient {
    /// Dividend.
    pub(crate) above: u128,
    /// Divisor, above 0.
    pub(crate) below: u64,
}

/// `number` as an exact number.
pub(crate) fn exact(number: u128) -> Dyadic {
    let limb = |part: u128| Dyadic::from(u64::try_from(part).expect("64 bits"));
    let high = &limb(number >> 64) * &Dyadic::from_f64(LIMB);
    &high + &limb(number & u128::from(u64::MAX))
}

/// `above` / `below`, rounded once; `below` is above 0.
pub(crate) fn ratio(above: u128, below: u128) -> f64 {
    exact(above).over(&exact(below))
}

/// Sum of `terms` divided by `by`, rounded once; `by` is above 0.
///
/// Each term is truncated to a multiple of 2⁻¹²⁸, which gives two bounds of the sum. If both round to one number, that number is the result.
/// Otherwise the sum is computed as one fraction, whose size grows with the number of terms.
pub(crate) fn sum_over(terms: impl Iterator<Item = Quotient> + Clone, by: u64) -> f64 {
    let [mut units, mut upper, mut lower] = [0_u128; 3];
    let mut cut = 0;
    for Quotient { above, below } in terms.clone() {
        let below = u128::from(below);
        let rest = (above % below) << 64;
        let last = (rest % below) << 64;
        units += above / below;
        upper += rest / below;
        lower += last / below;
        cut += u64::from(last % below > 0);
    }
    let limb = Dyadic::from_f64(LIMB);
    let [units, upper, lower] = [units, upper, lower].map(exact);
    let least = &(&(&(&units * &limb) + &upper) * &limb) + &lower;
    let below = &(&Dyadic::from(by) * &limb) * &limb;
    let bounds = [
        least.over(&below),
        (&least + &Dyadic::from(cut)).over(&below),
    ];
    if bounds[0].to_bits() == bounds[1].to_bits() {
        return bounds[0];
    }
    let add =
        |sum: Fraction, term: Quotient| sum.plus(&Fraction::of(exact(term.above), term.below));
    terms.fold(Fraction::zero(), add).divided(by).to_f64()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(terms: &[[u64; 2]], by: u64) -> f64 {
        let term = |&[above, below]: &[u64; 2]| Quotient {
            above: u128::from(above),
            below,
        };
        sum_over(terms.iter().map(term), by)
    }

    #[test]
    fn a_sum_of_quotients_is_rounded_once() {
        // 1/2 + 2/3 + 4/5 = 59/30.
        let found = sum(&[[1, 2], [2, 3], [4, 5]], 3);
        assert_eq!(found.to_bits(), (59.0_f64 / 90.0).to_bits());
        // Thirds that make a whole.
        assert_eq!(sum(&[[1, 3], [2, 3]], 1).to_bits(), 1.0_f64.to_bits());
        assert_eq!(sum(&[], 7).to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn a_sum_between_two_numbers_is_decided_by_the_fraction() {
        // Half of the last place of 1 as two inexact terms: a tie, which goes to the even number, 1.
        const HALF_PLACE: u64 = 3 << 53;
        let found = sum(&[[1, 1], [1, HALF_PLACE], [2, HALF_PLACE]], 1);
        assert_eq!(found.to_bits(), 1.0_f64.to_bits());
        // The least more, and the next number is nearer.
        let found = sum(
            &[[1, 1], [1, HALF_PLACE], [2, HALF_PLACE], [1, u64::MAX]],
            1,
        );
        assert_eq!(found.to_bits(), 1.0_f64.next_up().to_bits());
    }

    #[test]
    fn counts_of_more_than_64_bits_keep_their_digits() {
        let number = (5_u128 << 100) + 3;
        assert_eq!(ratio(number, number).to_bits(), 1.0_f64.to_bits());
        assert_eq!(ratio(number - 3, 1 << 100).to_bits(), 5.0_f64.to_bits());
    }
}
