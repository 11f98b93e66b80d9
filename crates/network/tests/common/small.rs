//! Small training for tests. The labels of a picture are the sums of two of its halves.

use taceva_network::{
    Architecture, Augmentation, Body, Jitter, Labels, Picture, PlainLayer, Pooling, Recipe, Samples,
};

use crate::draws::singles;

pub(crate) const PICTURE: Picture = Picture {
    height: 12,
    width: 10,
    channels: 1,
};

pub(crate) fn architecture() -> Architecture {
    let layer = |channels| PlainLayer {
        channels,
        kernel: 3,
        stride: 2,
    };
    let layers = vec![layer(16), layer(32)];
    Architecture {
        input: PICTURE,
        body: Body::Plain {
            layers,
            pooling: Pooling::Flatten,
        },
        outputs: 2,
    }
}

pub(crate) fn recipe() -> Recipe {
    Recipe {
        epochs: 6,
        batch: 8,
        augmentation: Augmentation {
            brightness: 0.1,
            noise: 0.01,
            jitter: Jitter {
                pixels: 1,
                label_per_pixel: vec![[0.1, 0.0], [0.0, 0.1]],
            },
        },
        ..Recipe::default()
    }
}

/// Pictures whose labels are the sums of their upper half and of their left half, so a network can learn them.
pub(crate) fn sums(seed: u64, samples: usize) -> (Vec<f32>, Vec<f64>) {
    let pictures = singles(seed, samples * PICTURE.len());
    let labels = pictures.chunks_exact(PICTURE.len()).flat_map(|picture| {
        let rows = picture.chunks_exact(PICTURE.width);
        let upper: f32 = rows.clone().take(6).flatten().sum();
        let left: f32 = rows.flat_map(|row| &row[..5]).sum();
        [f64::from(upper), f64::from(left)]
    });
    let labels = labels.collect();
    (pictures, labels)
}

pub(crate) fn values<'a>((pictures, labels): &'a (Vec<f32>, Vec<f64>)) -> Samples<'a> {
    Samples {
        pictures,
        labels: Labels::Values(labels),
    }
}
