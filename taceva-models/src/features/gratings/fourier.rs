//! Discrete Fourier transform of sequences whose length is a power of two.

use std::f64::consts::TAU;

/// A complex number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Complex {
    pub(super) re: f64,
    pub(super) im: f64,
}

impl Complex {
    pub(super) fn power(self) -> f64 {
        self.re * self.re + self.im * self.im
    }

    pub(super) fn scaled(self, factor: f64) -> Complex {
        Complex {
            re: self.re * factor,
            im: self.im * factor,
        }
    }

    fn times(self, other: Complex) -> Complex {
        Complex {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }

    pub(super) fn plus(self, other: Complex) -> Complex {
        Complex {
            re: self.re + other.re,
            im: self.im + other.im,
        }
    }

    pub(super) fn minus(self, other: Complex) -> Complex {
        Complex {
            re: self.re - other.re,
            im: self.im - other.im,
        }
    }
}

/// Discrete Fourier transform of N values: X\[k\] = Σ x\[n\] exp(−2πi kn/N), summed over n. The algorithm is that of Cooley and Tukey (1965).
#[derive(Clone, Debug)]
pub(super) struct Fourier {
    /// Factors exp(−2πi k/N) for k from 0 to N/2 − 1.
    turns: Vec<Complex>,
}

impl Fourier {
    /// Prepares a transform of `length` values. `length` must be a power of two.
    pub(super) fn new(length: usize) -> Fourier {
        debug_assert!(length.is_power_of_two(), "{length}");
        let turns = (0..length / 2).map(|position| {
            let angle = -TAU * position as f64 / length as f64;
            let (im, re) = angle.sin_cos();
            Complex { re, im }
        });
        Fourier {
            turns: turns.collect(),
        }
    }

    /// Transforms `values` in place. The number of values must be the prepared length.
    pub(super) fn transform(&self, values: &mut [Complex]) {
        let length = values.len();
        if length < 2 {
            return;
        }
        let shift = usize::BITS - length.trailing_zeros();
        for position in 0..length {
            let mirrored = position.reverse_bits() >> shift;
            if position < mirrored {
                values.swap(position, mirrored);
            }
        }
        let mut half = 1;
        while half < length {
            let stride = length / (2 * half);
            for block in values.chunks_exact_mut(2 * half) {
                let (low, high) = block.split_at_mut(half);
                let turns = self.turns.iter().step_by(stride);
                for ((low, high), turn) in low.iter_mut().zip(high).zip(turns) {
                    let turned = high.times(*turn);
                    (*low, *high) = (low.plus(turned), low.minus(turned));
                }
            }
            half *= 2;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_sum_that_defines_it() {
        for length in [1_usize, 2, 8, 64] {
            let values: Vec<Complex> = (0..length)
                .map(|position| Complex {
                    re: f64::from(u32::try_from(position * position % 7).expect("small")),
                    im: f64::from(u32::try_from(position % 3).expect("small")),
                })
                .collect();
            let mut fast = values.clone();
            Fourier::new(length).transform(&mut fast);
            for (wave, found) in fast.iter().enumerate() {
                let mut sum = Complex::default();
                for (position, value) in values.iter().enumerate() {
                    let angle = -TAU * (wave * position) as f64 / length as f64;
                    let (im, re) = angle.sin_cos();
                    sum = sum.plus(value.times(Complex { re, im }));
                }
                // Each sum has at most 64 terms of size 7, each off by some 1e-14.
                assert!(sum.minus(*found).power().sqrt() < 1e-11, "{length} {wave}");
            }
        }
    }
}
