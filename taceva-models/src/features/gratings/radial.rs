//! Power spectrum of a picture by spatial frequency, averaged over directions.

use taceva_core::{Frame, FrameInfo};

use super::fourier::{Complex, Fourier};
use crate::features::FeatureError;

/// Power spectrum of a picture: logarithms of the mean power in rings of equal width around spatial frequency 0.
///
/// The picture minus its mean is multiplied by a Hann window, and padded with zeros to a square. The side of the square is a power of two. Ring b of
/// B contains the waves with b/(2B) ≤ √(f_x² + f_y²) < (b + 1)/(2B). Their frequencies f_x to the right and f_y down are in cycles per pixel.
/// Rotating or shifting a grating does not change the rings of its waves.
///
/// # Shapes
/// One value per ring, from the lowest to the highest frequency.
#[derive(Clone, Debug)]
pub struct RadialSpectrum {
    info: FrameInfo,
    side: usize,
    fourier: Fourier,
    windows: [Vec<f64>; 2],
    /// Index of the ring of each Fourier coefficient, row by row. `None` for frequencies beyond the last ring.
    rings: Vec<Option<usize>>,
    counts: Vec<f64>,
}

impl RadialSpectrum {
    /// Number of rings of a spectrum.
    pub const RINGS: usize = 48;

    /// Prepares the spectra of pictures with the size and format `info`.
    pub fn new(info: FrameInfo) -> RadialSpectrum {
        let [width, height] = [info.width, info.height].map(|side| side as usize);
        let side = width.max(height).max(2 * RadialSpectrum::RINGS);
        let side = side.next_power_of_two();
        let rings: Vec<Option<usize>> = (0..side * side)
            .map(|place| ring([place % side, place / side], side))
            .collect();
        let mut counts = vec![0.0; RadialSpectrum::RINGS];
        for ring in rings.iter().flatten() {
            counts[*ring] += 1.0;
        }
        RadialSpectrum {
            info,
            side,
            fourier: Fourier::new(side),
            windows: [width, height].map(hann),
            rings,
            counts,
        }
    }

    /// Memory of one [`FourierPlane`], in bytes.
    pub fn plane_bytes(&self) -> u64 {
        (self.side * self.side * size_of::<Complex>()) as u64
    }

    /// Computes the Fourier coefficients of `frame`.
    ///
    /// # Errors
    /// [`FeatureError::Kind`] for a frame of another size or format.
    pub fn plane(&self, frame: &Frame) -> Result<FourierPlane, FeatureError> {
        if frame.info() != self.info {
            return Err(FeatureError::Kind {
                expected: self.info,
                found: frame.info(),
            });
        }
        Ok(FourierPlane {
            waves: self.waves(&luma(frame)),
        })
    }

    /// Power spectrum of a picture with the Fourier coefficients `plane`: the logarithm of the mean power in each ring.
    pub fn of(&self, plane: &FourierPlane) -> Vec<f64> {
        self.spectrum(plane.waves.iter().map(|wave| wave.power()))
    }

    /// Power spectrum of `plane` minus the mean of `count` planes, such as a constant background. `sum` is the sum of these planes.
    pub fn beyond(&self, plane: &FourierPlane, sum: &FourierPlane, count: f64) -> Vec<f64> {
        let waves = plane.waves.iter().zip(&sum.waves);
        self.spectrum(waves.map(|(wave, sum)| wave.minus(sum.scaled(1.0 / count)).power()))
    }

    fn spectrum(&self, powers_of_waves: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut powers = vec![0.0; self.counts.len()];
        for (power, ring) in powers_of_waves.zip(&self.rings) {
            if let Some(ring) = ring {
                powers[*ring] += power;
            }
        }
        let rings = powers.into_iter().zip(&self.counts);
        // A dark picture has no power; uses the smallest positive number instead of ln 0.
        rings
            .map(|(power, count)| (power / count).max(f64::MIN_POSITIVE).ln())
            .collect()
    }

    /// Fourier coefficients of the gray values `luma` after windowing. Coefficients of one horizontal frequency are adjacent.
    fn waves(&self, luma: &[f64]) -> Vec<Complex> {
        let [across, down] = &self.windows;
        let (side, width) = (self.side, across.len());
        let mut plane = vec![Complex::default(); side * side];
        if luma.is_empty() {
            return plane;
        }
        let mean = luma.iter().sum::<f64>() / luma.len() as f64;
        let mut line = vec![Complex::default(); side];
        for (row, (pixels, fade)) in luma.chunks_exact(width).zip(down).enumerate() {
            line.fill(Complex::default());
            for ((value, pixel), window) in line.iter_mut().zip(pixels).zip(across) {
                value.re = (pixel - mean) * window * fade;
            }
            self.fourier.transform(&mut line);
            for (wave, value) in line.iter().enumerate() {
                plane[wave * side + row] = *value;
            }
        }
        for column in plane.chunks_exact_mut(side) {
            self.fourier.transform(column);
        }
        plane
    }
}

/// Fourier coefficients of one picture. Adding the planes of two pictures gives the plane of their sum.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FourierPlane {
    waves: Vec<Complex>,
}

impl FourierPlane {
    /// Adds the coefficients of a picture of the same size. A plane without coefficients becomes a copy of `other`.
    pub fn add(&mut self, other: &FourierPlane) {
        if self.waves.is_empty() {
            self.waves = vec![Complex::default(); other.waves.len()];
        }
        for (sum, wave) in self.waves.iter_mut().zip(&other.waves) {
            *sum = sum.plus(*wave);
        }
    }
}

/// Index of the ring of the wave numbers `waves`, in cycles per `side` pixels. `None` beyond the last ring.
fn ring(waves: [usize; 2], side: usize) -> Option<usize> {
    let cycles = waves.map(|wave| wave.min(side - wave));
    // (2B f)² = (2B)² (k² + l²) / N², in integers.
    let scaled = 4 * RadialSpectrum::RINGS.pow(2) * (cycles[0].pow(2) + cycles[1].pow(2));
    let ring = (scaled / side.pow(2)).isqrt();
    (ring < RadialSpectrum::RINGS).then_some(ring)
}

/// Hann window of N = `length` values: w\[n\] = sin²(π (n + ½)/N). No value is 0.
fn hann(length: usize) -> Vec<f64> {
    let place = |position: usize| {
        let part = (position as f64 + 0.5) / length as f64;
        (std::f64::consts::PI * part).sin().powi(2)
    };
    (0..length).map(place).collect()
}

/// Gray values of a frame, in the units of its samples. For RGB, (299 R + 587 G + 114 B) / 1000.
fn luma(frame: &Frame) -> Vec<f64> {
    let samples: Vec<f64> = frame.samples().map(f64::from).collect();
    match frame.info().format.samples() {
        1 => samples,
        _ => {
            let pixels = samples.chunks_exact(3);
            let luma =
                |pixel: &[f64]| (299.0 * pixel[0] + 587.0 * pixel[1] + 114.0 * pixel[2]) / 1000.0;
            pixels.map(luma).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::PixelFormat;

    use super::*;

    const SIDE: u32 = 96;

    fn info() -> FrameInfo {
        FrameInfo {
            width: SIDE,
            height: SIDE,
            format: PixelFormat::Gray8,
        }
    }

    /// Test picture of parallel lines at `cycles` per pixel. The lines are rotated by `turn` degrees and shifted by `offset` pixels.
    fn lines(cycles: f64, turn: f64, offset: f64) -> Frame {
        let (sin, cos) = turn.to_radians().sin_cos();
        let pixel = |place: u32| {
            let (x, y) = (f64::from(place % SIDE), f64::from(place / SIDE));
            let wave = (std::f64::consts::TAU * cycles * (x * cos + y * sin + offset)).cos();
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "between 28 and 228"
            )]
            let value = (128.0 + 100.0 * wave).round() as u8;
            value
        };
        Frame::new(info(), (0..SIDE * SIDE).map(pixel).collect()).expect("its own length")
    }

    fn strongest(spectrum: &[f64]) -> usize {
        let order = |a: &usize, b: &usize| spectrum[*a].total_cmp(&spectrum[*b]);
        (0..spectrum.len()).max_by(order).expect("some rings")
    }

    #[test]
    fn lines_are_strongest_in_the_ring_of_their_fineness_whatever_their_direction() {
        let spectra = RadialSpectrum::new(info());
        for ring in [6_u32, 17, 40] {
            let cycles = (f64::from(ring) + 0.5) / 96.0;
            for (turn, offset) in [(0.0, 0.0), (31.0, 2.0), (90.0, 0.5), (160.0, 7.0)] {
                let plane = spectra.plane(&lines(cycles, turn, offset));
                let spectrum = spectra.of(&plane.expect("of its size"));
                assert_eq!(strongest(&spectrum), ring as usize, "{turn}");
            }
        }
    }

    #[test]
    fn a_picture_of_nothing_has_finite_logarithms_and_a_foreign_one_is_refused() {
        let spectra = RadialSpectrum::new(info());
        let dark = Frame::new(info(), vec![9; (SIDE * SIDE) as usize]).expect("its own length");
        let spectrum = spectra.of(&spectra.plane(&dark).expect("of its size"));
        assert!(spectrum.iter().all(|value| value.is_finite()));
        let other = FrameInfo {
            width: 1,
            height: 1,
            ..info()
        };
        let foreign = Frame::new(other, vec![0]).expect("its own length");
        assert!(spectra.plane(&foreign).is_err());
    }

    #[test]
    fn beyond_a_background_only_what_is_new_is_left() {
        let spectra = RadialSpectrum::new(info());
        let plane = |frame: &Frame| spectra.plane(frame).expect("of its size");
        let [background, grating] = [(9.5 / 96.0, 20.0), (30.5 / 96.0, 70.0)];
        let both: Vec<u8> = lines(background.0, background.1, 0.0)
            .bytes()
            .iter()
            .zip(lines(grating.0, grating.1, 0.0).bytes())
            .map(|(one, other)| one / 2 + other / 16)
            .collect();
        let alone = lines(background.0, background.1, 0.0);
        let alone = alone.bytes().iter().map(|one| one / 2).collect();
        let [both, alone] = [both, alone].map(|bytes| Frame::new(info(), bytes).expect("whole"));
        assert_eq!(strongest(&spectra.of(&plane(&both))), 9);
        let mut sum = FourierPlane::default();
        sum.add(&plane(&alone));
        sum.add(&plane(&alone));
        assert_eq!(strongest(&spectra.beyond(&plane(&both), &sum, 2.0)), 30);
    }
}
