//! Readout of one row: flicker, noise, rounding and clipping.

use super::noise::RowNoise;

/// Conversion of light to samples.
///
/// I′ = I (1 + e) + N(0, g I + s²). Here e is the flicker of the frame, g the gain of the shot noise and s the read noise. The result is
/// rounded to the nearest count, ties to even, and clipped to the range of the sample.
///
/// # Reference
/// The linear camera model of EMVA 1288 without dark current.
#[derive(Clone, Copy, Debug)]
pub(super) struct Readout {
    /// Factor 1 + e for the flicker e of the frame.
    pub(super) gain: f32,
    /// Gain g of the shot noise, DN.
    pub(super) shot: f32,
    /// Variance s² of the read noise, DN².
    pub(super) read_variance: f32,
    /// Counts per DN: 1 for 8 bits, 256 for 16 bits.
    pub(super) counts_per_dn: f32,
    /// Maximum count.
    pub(super) full_counts: f32,
}

/// Number of samples in one vector step: a multiple of three colours and of every vector width.
pub(super) const LANES: usize = 24;

/// Constant for rounding. The sum of a value from 0 to 2¹⁶ and this constant has the nearest integer in the low bits, ties to even.
const ROUND: f32 = 8_388_608.0;

impl Readout {
    /// Writes the samples of a row of `light` in DN, `BYTES` bytes each. Returns the sums of their counts by lane.
    #[inline(always)]
    pub(super) fn row<const BYTES: usize>(
        &self,
        light: &[f32],
        noise: RowNoise,
        into: &mut [u8],
    ) -> [u32; LANES] {
        let mut sums = [0_u32; LANES];
        let (lights, last_light) = light.as_chunks::<LANES>();
        let (normals, last_normal) = noise.normal.as_chunks::<LANES>();
        let split = lights.len() * LANES * BYTES;
        let (chunks, last) = into.split_at_mut(split);
        for ((light, normal), into) in lights
            .iter()
            .zip(normals)
            .zip(chunks.chunks_exact_mut(LANES * BYTES))
        {
            let mut counts = [0_u32; LANES];
            for lane in 0..LANES {
                counts[lane] = self.count(light[lane], noise.sign * normal[lane]);
            }
            for lane in 0..LANES {
                sums[lane] += counts[lane];
            }
            store::<BYTES>(&counts, into);
        }
        let mut counts = [0_u32; LANES];
        for ((count, light), normal) in counts.iter_mut().zip(last_light).zip(last_normal) {
            *count = self.count(*light, noise.sign * normal);
        }
        for (sum, count) in sums.iter_mut().zip(counts) {
            *sum += count;
        }
        store::<BYTES>(&counts[..last.len() / BYTES], last);
        sums
    }

    #[inline(always)]
    fn count(&self, light: f32, normal: f32) -> u32 {
        let light = self.gain * above_zero(light);
        let dn = light + normal * (self.shot * light + self.read_variance).sqrt();
        let counts = above_zero(dn * self.counts_per_dn);
        let counts = if counts < self.full_counts {
            counts
        } else {
            self.full_counts
        };
        (counts + ROUND).to_bits() & 0xffff
    }
}

/// Greater of `value` and 0, in one instruction. `f32::max` would also check for NaN.
#[inline(always)]
fn above_zero(value: f32) -> f32 {
    if value > 0.0 { value } else { 0.0 }
}

/// Writes the low `BYTES` bytes of each count, little-endian.
#[inline(always)]
fn store<const BYTES: usize>(counts: &[u32], into: &mut [u8]) {
    let (samples, _) = into.as_chunks_mut::<BYTES>();
    for (sample, count) in samples.iter_mut().zip(counts) {
        sample.copy_from_slice(&count.to_le_bytes()[..BYTES]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const QUIET: Readout = Readout {
        gain: 1.0,
        shot: 0.0,
        read_variance: 0.0,
        counts_per_dn: 1.0,
        full_counts: 255.0,
    };
    static NORMAL: [f32; 64] = [1.0; 64];

    fn noise(length: usize) -> RowNoise {
        RowNoise {
            normal: &NORMAL[..length],
            sign: 1.0,
        }
    }

    #[test]
    fn light_is_rounded_to_even_and_clipped() {
        let light = [-3.0, 0.49, 0.5, 1.5, 254.6, 300.0, f32::NAN];
        let mut row = [9; 7];
        QUIET.row::<1>(&light, noise(7), &mut row);
        assert_eq!(row, [0, 0, 0, 2, 255, 255, 0]);
    }

    #[test]
    fn sixteen_bit_counts_are_256_a_dn_and_little_endian() {
        let readout = Readout {
            counts_per_dn: 256.0,
            full_counts: 65_535.0,
            ..QUIET
        };
        let mut row = [0; 4];
        let sums = readout.row::<2>(&[1.0, 256.0], noise(2), &mut row);
        assert_eq!(row, [0, 1, 255, 255]);
        assert_eq!(sums[..3], [256, 65_535, 0]);
    }

    #[test]
    fn noise_grows_with_the_root_of_the_light() {
        let readout = Readout {
            shot: 0.25,
            read_variance: 4.0,
            ..QUIET
        };
        let mut row = [0; 2];
        readout.row::<1>(&[0.0, 48.0], noise(2), &mut row);
        assert_eq!(row, [2, 52]);
    }

    #[test]
    fn the_sums_by_lane_are_those_of_the_samples_whatever_the_length() {
        for length in [1, 23, 24, 25, 64] {
            let light: Vec<f32> = (0..length).map(|x: u16| f32::from(x) * 3.7).collect();
            let mut row = vec![0; light.len()];
            let sums = QUIET.row::<1>(&light, noise(light.len()), &mut row);
            for (lane, sum) in sums.iter().enumerate() {
                let expected: u32 = row
                    .iter()
                    .skip(lane)
                    .step_by(LANES)
                    .map(|x| u32::from(*x))
                    .sum();
                assert_eq!(*sum, expected, "{length} {lane}");
            }
        }
    }
}
