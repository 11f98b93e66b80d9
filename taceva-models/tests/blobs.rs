//! Pictures of a blob, with its position in pixels.

mod drawn;

use taceva_core::{FeatureShape, FrameInfo, PixelFormat};

pub(crate) use drawn::{Blob, Recording, numbers};

pub(crate) const SHAPE: FeatureShape = FeatureShape {
    height: 20,
    width: 24,
    depth: 1,
};

/// Size and format of the frames of these pictures.
pub(crate) const FRAME: FrameInfo = FrameInfo {
    width: 48,
    height: 40,
    format: PixelFormat::Gray8,
};

pub(crate) const BLOB: Blob = Blob {
    shape: SHAPE,
    from: 4.0,
    reach: [12.0, 16.0],
    spread: 18.0,
    scale: 1.0,
};

/// Pictures of four by four pixels, with the position of the blob in sixths of a pixel.
pub(crate) const SMALL: Blob = Blob {
    shape: FeatureShape {
        height: 4,
        width: 4,
        depth: 1,
    },
    from: 0.0,
    reach: [3.0, 3.0],
    spread: 2.0,
    scale: 6.0,
};

pub(crate) fn recording(samples: usize, seed: u64) -> Recording {
    BLOB.recording(samples, seed)
}
