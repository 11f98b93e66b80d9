//! Power of each spatial frequency in a picture.

use std::f64::consts::TAU;

/// Pixels per side: a power of two.
pub(crate) const SIDE: usize = 128;
/// Rings of the spectrum.
const RINGS: usize = 40;

/// Logarithm of the power in rings of equal width, for a square picture under a Hann window.
pub(crate) fn radial_spectrum(picture: &[f64]) -> Vec<f64> {
    let mean = picture.iter().sum::<f64>() / picture.len() as f64;
    let window = |place: usize| 0.5 - 0.5 * (TAU * (place as f64 + 0.5) / SIDE as f64).cos();
    let mut real: Vec<f64> = picture
        .iter()
        .enumerate()
        .map(|(index, value)| (value - mean) * window(index % SIDE) * window(index / SIDE))
        .collect();
    let mut imaginary = vec![0.0; real.len()];
    let turns: Vec<(f64, f64)> = (0..SIDE / 2)
        .map(|turn| (-TAU * turn as f64 / SIDE as f64).sin_cos())
        .collect();
    for _ in 0..2 {
        for (real, imaginary) in real
            .chunks_exact_mut(SIDE)
            .zip(imaginary.chunks_exact_mut(SIDE))
        {
            transform(real, imaginary, &turns);
        }
        real = transposed(&real);
        imaginary = transposed(&imaginary);
    }
    let mut rings = [(0.0_f64, 0_u32); RINGS];
    let signed = |index: usize| index.min(SIDE - index) as f64;
    for (index, (re, im)) in real.iter().zip(&imaginary).enumerate() {
        let frequency = signed(index % SIDE).hypot(signed(index / SIDE)) / (0.5 * SIDE as f64);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small number that is not negative"
        )]
        let ring = (frequency * RINGS as f64) as usize;
        if let Some((power, count)) = rings.get_mut(ring) {
            *power += re * re + im * im;
            *count += 1;
        }
    }
    let powers = rings.iter().map(|(power, count)| power / f64::from(*count));
    powers
        .map(|power| (power + f64::MIN_POSITIVE).ln())
        .collect()
}

fn transposed(square: &[f64]) -> Vec<f64> {
    (0..square.len())
        .map(|index| square[index % SIDE * SIDE + index / SIDE])
        .collect()
}

/// Fast Fourier transform of Cooley and Tukey, in place. `turns` contains sine and cosine for fractions of half a turn, clockwise.
fn transform(real: &mut [f64], imaginary: &mut [f64], turns: &[(f64, f64)]) {
    let length = real.len();
    let shift = usize::BITS - length.trailing_zeros();
    for index in 0..length {
        let other = index.reverse_bits() >> shift;
        if index < other {
            real.swap(index, other);
            imaginary.swap(index, other);
        }
    }
    let mut half = 1;
    while half < length {
        for offset in 0..half {
            let (sin, cos) = turns[offset * (turns.len() / half)];
            for start in (offset..length).step_by(2 * half) {
                let (low, high) = (start, start + half);
                let re = real[high] * cos - imaginary[high] * sin;
                let im = real[high] * sin + imaginary[high] * cos;
                (real[high], imaginary[high]) = (real[low] - re, imaginary[low] - im);
                (real[low], imaginary[low]) = (real[low] + re, imaginary[low] + im);
            }
        }
        half *= 2;
    }
}
