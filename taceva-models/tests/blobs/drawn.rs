//! Pictures of a blob, drawn in any size.

use taceva_core::{
    Channel, Channels, FeatureShape, Features, FrameInfo, PixelFormat, Targets, TrainingSet,
};

/// Pictures, and the position of the blob in each.
#[derive(Clone)]
pub(crate) struct Recording {
    pub(crate) features: Features,
    pub(crate) channels: Channels,
    pub(crate) labels: Vec<f64>,
}

/// Uniform numbers in 0..1 from a linear congruential generator (Knuth's MMIX constants).
pub(crate) fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 32).expect("32 bits")) / 2_f64.powi(32)
    }
}

#[derive(Clone, Copy)]
/// Settings of the pictures to draw. Lengths are in pixels.
pub(crate) struct Blob {
    pub(crate) shape: FeatureShape,
    /// Least y and x of the blob's centre.
    pub(crate) from: f64,
    /// Range of y and x of the blob's centre, above `from`.
    pub(crate) reach: [f64; 2],
    /// Twice the square of the blob's standard deviation.
    pub(crate) spread: f64,
    /// Number of label units per pixel.
    pub(crate) scale: f64,
}

impl Blob {
    /// Size and format of the frames of these pictures.
    pub(crate) fn frame(&self) -> FrameInfo {
        let twice = |side: usize| 2 * u32::try_from(side).expect("small");
        FrameInfo {
            width: twice(self.shape.width),
            height: twice(self.shape.height),
            format: PixelFormat::Gray8,
        }
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "features are kept in single precision"
    )]
    pub(crate) fn recording(&self, samples: usize, seed: u64) -> Recording {
        let mut next = numbers(seed);
        let (mut values, mut labels) = (Vec::new(), Vec::new());
        let side = |pixels: usize| u8::try_from(pixels).expect("a small picture");
        let (rows, columns) = (side(self.shape.height), side(self.shape.width));
        for _ in 0..samples {
            let [y, x] = self.reach.map(|reach| self.from + reach * next());
            for (row, column) in
                (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)))
            {
                let square = (f64::from(row) - y).powi(2) + (f64::from(column) - x).powi(2);
                values.push((0.2 + 0.5 * (-square / self.spread).exp() + 0.01 * next()) as f32);
            }
            labels.extend([x, y].map(|place| self.scale * place));
        }
        Recording {
            features: Features::new(self.shape, values).expect("whole samples"),
            channels: Channels::new([Channel::PX, Channel::PY]).expect("distinct"),
            labels,
        }
    }
}

impl Recording {
    pub(crate) fn set(&self) -> TrainingSet<'_> {
        TrainingSet::new(&self.features, Targets::new(&self.channels, &self.labels))
    }

    pub(crate) fn select(&self, rows: &[usize]) -> Recording {
        Recording {
            features: self.features.select(rows),
            channels: self.channels.clone(),
            labels: rows
                .iter()
                .flat_map(|&row| self.labels[row * 2..row * 2 + 2].to_vec())
                .collect(),
        }
    }
}
