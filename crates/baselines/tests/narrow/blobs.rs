//! Pictures of four by four pixels of a blob, and where it is in sixths of a pixel.

#[path = "../../../../taceva-models/tests/blobs/drawn.rs"]
mod drawn;

use taceva_core::{FeatureShape, FrameInfo, PixelFormat};

pub(crate) use drawn::{Recording, numbers};

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

pub(crate) fn recording(samples: usize, seed: u64) -> Recording {
    let blob = drawn::Blob {
        shape: SHAPE,
        from: 0.0,
        reach: [3.0, 3.0],
        spread: 2.0,
        scale: 6.0,
    };
    blob.recording(samples, seed)
}
