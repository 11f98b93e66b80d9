//! Brightness of a frame.

/// Brightness of a frame, summed in integers during rendering.
///
/// # Units
/// Digital numbers (DN) of an 8-bit camera, 0 to 255, for any frame format.
/// # Reference
/// Luma of ITU-R BT.601: (299 R + 587 G + 114 B) / 1000; gray counts as all three.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Luma {
    /// Σ 299 R + 587 G + 114 B over the pixels, in counts.
    weighted_sum: u64,
    pixels: u64,
    counts_per_dn: u64,
}

/// Weights of red, green and blue, in thousandths.
const WEIGHTS: [u64; 3] = [299, 587, 114];

impl Luma {
    pub(super) fn new(counts_per_dn: u64) -> Luma {
        Luma {
            weighted_sum: 0,
            pixels: 0,
            counts_per_dn,
        }
    }

    /// Adds a row of `pixels` pixels. `sums` has one sum per lane, and lane i contains colour i modulo 3.
    pub(super) fn add_row(&mut self, sums: &[u32], channels: usize, pixels: usize) {
        for (lane, sum) in sums.iter().enumerate() {
            let weight = if channels == 1 {
                WEIGHTS.iter().sum()
            } else {
                WEIGHTS[lane % WEIGHTS.len()]
            };
            self.weighted_sum += weight * u64::from(*sum);
        }
        self.pixels += pixels as u64;
    }

    /// Mean over the frame, in DN; 0 for an empty frame.
    ///
    /// A reduced frame is not rounded to whole DN. Its mean therefore equals the mean of the full-size frame within the noise.
    pub fn mean_dn(&self) -> f64 {
        let counts = self.pixels.max(1) * self.counts_per_dn.max(1) * 1000;
        self.weighted_sum as f64 / counts as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_weighed_and_gray_counts_whole() {
        let mut colour = Luma::new(1);
        colour.add_row(&[100, 0, 0, 0, 200, 0], 3, 2);
        assert!((colour.mean_dn() - (29.9 + 117.4) / 2.0).abs() < 1e-12);
        let mut gray = Luma::new(256);
        gray.add_row(&[256, 512], 1, 2);
        assert!((gray.mean_dn() - 1.5).abs() < 1e-12);
        assert_eq!(Luma::default().mean_dn().to_bits(), 0.0_f64.to_bits());
    }
}
