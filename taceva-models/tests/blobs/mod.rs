//! Pictures of a blob, and where it is in pixels.

mod drawn;

use taceva_core::{FeatureShape, FrameInfo, PixelFormat};

pub(crate) use drawn::{Recording, numbers};

pub(crate) const SHAPE: FeatureShape = FeatureShape {
    height: 20,
    width: 24,
    depth: 1,
};

/// Frames that these features could be of.
pub(crate) const FRAME: FrameInfo = FrameInfo {
    width: 48,
    height: 40,
    format: PixelFormat::Gray8,
};

pub(crate) fn recording(samples: usize, seed: u64) -> Recording {
    let blob = drawn::Blob {
        shape: SHAPE,
        from: 4.0,
        reach: [12.0, 16.0],
        spread: 18.0,
        scale: 1.0,
    };
    blob.recording(samples, seed)
}
