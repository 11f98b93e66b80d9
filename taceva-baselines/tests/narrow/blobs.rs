//! Pictures of four by four pixels of a blob, and where it is.

use taceva_core::{
    Channel, Channels, FeatureShape, Features, FrameInfo, PixelFormat, Targets, TrainingSet,
};

pub(crate) const SHAPE: FeatureShape = FeatureShape {
    height: 4,
    width: 4,
    depth: 1,
};

/// Frames that these features could be of.
pub(crate) const FRAME: FrameInfo = FrameInfo {
    width: 8,
    height: 8,
    format: PixelFormat::Gray8,
};

/// Pictures, positions of the blob in sixths of a pixel.
#[derive(Clone)]
pub(crate) struct Recording {
    pub(crate) features: Features,
    pub(crate) channels: Channels,
    pub(crate) labels: Vec<f64>,
}

/// Even numbers in 0..1 from a linear congruential generator (Knuth's MMIX constants).
pub(crate) fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 32).expect("32 bits")) / 2_f64.powi(32)
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "features are kept in single precision"
)]
pub(crate) fn recording(samples: usize, seed: u64) -> Recording {
    let mut next = numbers(seed);
    let (mut values, mut labels) = (Vec::new(), Vec::new());
    for _ in 0..samples {
        let (y, x) = (3.0 * next(), 3.0 * next());
        for (row, column) in (0..4_u8).flat_map(|row| (0..4_u8).map(move |column| (row, column))) {
            let square = (f64::from(row) - y).powi(2) + (f64::from(column) - x).powi(2);
            values.push((0.2 + 0.5 * (-square / 2.0).exp() + 0.01 * next()) as f32);
        }
        labels.extend([6.0 * x, 6.0 * y]);
    }
    Recording {
        features: Features::new(SHAPE, values).expect("whole samples"),
        channels: Channels::new([Channel::PX, Channel::PY]).expect("distinct"),
        labels,
    }
}

impl Recording {
    pub(crate) fn set(&self) -> TrainingSet<'_> {
        TrainingSet {
            features: &self.features,
            targets: Targets {
                channels: &self.channels,
                values: &self.labels,
            },
            groups: None,
        }
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
