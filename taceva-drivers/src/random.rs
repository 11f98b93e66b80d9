//! Random numbers that depend on what they are for, not on what was drawn before.

/// The number at `index` of the stream that `seed` and `purpose` name: SplitMix64's output function over a mixed counter.
///
/// # Reference
/// Steele, Lea and Flood, "Fast splittable pseudorandom number generators" (2014), figure 16; constants of `mix64` variant 13 by Stafford.
pub(crate) fn draw(seed: u64, purpose: u64, index: u64) -> u64 {
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    let stream = mix(seed.wrapping_add(GOLDEN)).wrapping_add(mix(purpose.wrapping_mul(GOLDEN)));
    mix(stream.wrapping_add(index.wrapping_add(1).wrapping_mul(GOLDEN)))
}

const fn mix(state: u64) -> u64 {
    let state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    state ^ (state >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_of_neighbouring_draws_are_unlike_each_other() {
        let mut ones = 0;
        for index in 0..1_000 {
            ones += (draw(1, 2, index) ^ draw(1, 2, index + 1)).count_ones();
            ones += (draw(1, 2, index) ^ draw(2, 2, index)).count_ones();
            ones += (draw(1, 2, index) ^ draw(1, 3, index)).count_ones();
        }
        // 3,000 words of 64 fair bits: mean 96,000, one standard deviation 219.
        assert!((95_000..97_000).contains(&ones), "{ones}");
    }
}
