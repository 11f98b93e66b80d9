//! Pictures of one blob on a noisy background, with its position and size.

use taceva_core::random::Draws;
use taceva_network::{Labels, Samples};

/// Labels of each picture: position and size of its blob, as shares of the side of the picture.
pub(crate) const LABELS: [&str; 3] = ["x", "y", "size"];

/// Standard deviation of the noise of each pixel, relative to the brightest blob. Blobs have brightness 0.5 to 1.
const NOISE: f64 = 0.05;

/// Pictures with their labels.
pub(crate) struct Blobs {
    /// Pixel values, shape `[samples, rows, columns]`.
    pub(crate) pictures: Vec<f32>,
    /// Labels, shape `[samples, labels]`.
    labels: Vec<f64>,
}

impl Blobs {
    /// Generates pictures of `side`² pixels. The same seed gives the same pictures.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "pixels of single precision"
    )]
    pub(crate) fn draw(seed: u64, count: usize, side: usize) -> Blobs {
        let (mut pictures, mut labels) = (Vec::new(), Vec::new());
        for sample in 0..count as u64 {
            let draws = Draws::new(seed).of(sample);
            let between = |at, low: f64, high: f64| low + (high - low) * draws.unit(at);
            let [x, y] = [0, 1].map(|at| between(at, 0.2, 0.8));
            let (size, height) = (between(2, 0.05, 0.2), between(3, 0.5, 1.0));
            labels.extend([x, y, size]);
            let noise = draws.of(1);
            for pixel in 0..side * side {
                let place = |at: usize| (at as f64 + 0.5) / side as f64;
                let (row, column) = (place(pixel / side), place(pixel % side));
                let distance = ((column - x).powi(2) + (row - y).powi(2)) / size.powi(2);
                let added = NOISE * noise.normal(pixel as u64);
                pictures.push((height * (-distance / 2.0).exp() + added) as f32);
            }
        }
        Blobs { pictures, labels }
    }

    pub(crate) fn samples(&self) -> Samples<'_> {
        Samples {
            pictures: &self.pictures,
            labels: Labels::Values(&self.labels),
        }
    }

    /// Coefficient of determination R² of the predictions `found`, one for each label, over all samples.
    ///
    /// # Shapes
    /// `found`: `[samples, label]`.
    pub(crate) fn determination(&self, found: &[f64]) -> [f64; LABELS.len()] {
        std::array::from_fn(|label| {
            let of = |values: &'_ [f64]| -> Vec<f64> {
                let values = values.iter().skip(label).step_by(LABELS.len());
                values.copied().collect()
            };
            let (truth, found) = (of(&self.labels), of(found));
            let mean = truth.iter().sum::<f64>() / truth.len() as f64;
            let squares = |from: &mut dyn Iterator<Item = f64>| -> f64 {
                let differences = truth.iter().zip(from);
                differences.map(|(t, v)| (t - v).powi(2)).sum()
            };
            let left = squares(&mut found.into_iter());
            1.0 - left / squares(&mut std::iter::repeat(mean))
        })
    }
}
