//! Numbers that look random and are the same everywhere.

use crate::paired::Paired;

/// SplitMix64 (Steele, Lea, Flood 2014), the generator of all test inputs.
///
/// ```
/// use taceva_metrics::kernels::SplitMix64;
/// assert_eq!(SplitMix64(0).word(), 0xe220_a839_7b1d_cdaf);
/// ```
#[derive(Clone, Debug)]
pub struct SplitMix64(pub u64);

impl SplitMix64 {
    /// 64 bits.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number below `bound`.
    ///
    /// # Panics
    /// If `bound` is zero.
    pub fn below(&mut self, bound: usize) -> usize {
        let bound = u64::try_from(bound).expect("a usize has at most 64 bits");
        usize::try_from(self.word() % bound).expect("it is below a usize")
    }

    /// Brings `list` into another order, each as likely.
    pub fn shuffle<T>(&mut self, list: &mut [T]) {
        for last in (1..list.len()).rev() {
            let other = self.below(last + 1);
            list.swap(last, other);
        }
    }

    /// From 0 up to 1, which is left out: a multiple of 2⁻⁵³.
    #[expect(clippy::cast_precision_loss, reason = "53 bits are left")]
    pub fn unit(&mut self) -> f64 {
        (self.word() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// About a standard normal number: twelve units, summed from the first to the last, less 6.
    pub fn bell(&mut self) -> f64 {
        (1..12).fold(self.unit(), |sum, _| sum + self.unit()) - 6.0
    }

    /// Any mantissa and sign, with an exponent from `low` to `high`.
    pub(super) fn wide(&mut self, low: i32, high: i32) -> f64 {
        let word = self.word();
        let span = u64::try_from(high - low + 1).expect("exponents in order");
        let exponent = i64::from(low) + i64::try_from(self.word() % span).expect("an exponent");
        let field = u64::try_from(exponent + 1023).expect("the exponent of a normal number");
        f64::from_bits((word & 1 << 63) | field << 52 | (word & ((1 << 52) - 1)))
    }

    /// Any denormal number.
    pub(super) fn denormal(&mut self) -> f64 {
        let fraction = self.word() & ((1 << 52) - 1);
        f64::from_bits(fraction | (self.word() & 1 << 63))
    }
}

/// The rows of `columns` in another order, the same for the same `seed`.
pub fn shuffled(columns: &Paired<Vec<f64>>, seed: u64) -> Paired<Vec<f64>> {
    let mut rows: Vec<(f64, f64)> = columns
        .as_slices()
        .iter()
        .map(|pair| (pair.estimate, pair.reference))
        .collect();
    SplitMix64(seed).shuffle(&mut rows);
    let (estimate, reference) = rows.into_iter().unzip();
    Paired {
        estimate,
        reference,
    }
}
