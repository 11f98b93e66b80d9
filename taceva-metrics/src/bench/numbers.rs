//! Random numbers of cases, in the sequence that the golden vectors use.

use taceva_core::random::SplitMix64;

/// Random numbers of one case. Whole numbers are remainders of 64-bit numbers, as in the generator of the golden vectors. Below 2³² their bias is
/// below 2⁻³².
#[derive(Debug)]
pub(super) struct Numbers(SplitMix64);

impl Numbers {
    pub(super) fn new(seed: u64) -> Numbers {
        Numbers(SplitMix64::new(seed))
    }

    /// Random whole number from 0 to below `bound`.
    pub(super) fn below(&mut self, bound: u64) -> u64 {
        self.0.next_u64() % bound
    }

    /// Shuffles `list`.
    pub(super) fn shuffle<T>(&mut self, list: &mut [T]) {
        for last in (1..list.len()).rev() {
            let other = self.below(last as u64 + 1);
            list.swap(
                last,
                usize::try_from(other).expect("a position in the list"),
            );
        }
    }

    /// Random number u with 0 ≤ u < 1, a multiple of 2⁻⁵³.
    pub(super) fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    /// Approximately standard normal random number: the sum of twelve numbers from [`Numbers::unit`], minus 6.
    pub(super) fn bell(&mut self) -> f64 {
        (1..12).fold(self.unit(), |sum, _| sum + self.unit()) - 6.0
    }

    /// Random number with any mantissa and sign, and a binary exponent from `low` to `high`.
    pub(super) fn wide(&mut self, low: i32, high: i32) -> f64 {
        let word = self.0.next_u64();
        let span = u64::try_from(high - low + 1).expect("exponents in order");
        let exponent = i64::from(low) + i64::try_from(self.below(span)).expect("an exponent");
        let field = u64::try_from(exponent + 1023).expect("the exponent of a normal number");
        f64::from_bits((word & 1 << 63) | field << 52 | (word & ((1 << 52) - 1)))
    }

    /// Denormal number with random bits.
    pub(super) fn denormal(&mut self) -> f64 {
        let fraction = self.0.next_u64() & ((1 << 52) - 1);
        f64::from_bits(fraction | (self.0.next_u64() & 1 << 63))
    }
}
