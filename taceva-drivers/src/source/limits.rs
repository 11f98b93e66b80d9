//! How much foreign input is accepted; what is larger is refused before anything is allocated for it.

/// An image file.
pub(super) const IMAGE_BYTES: u64 = 256 << 20;
/// Pixels along one side of an image.
pub(super) const IMAGE_SIDE: u32 = 16_384;
/// A decoded image.
pub(super) const DECODED_BYTES: u64 = 256 << 20;
/// A table of times.
pub(super) const TABLE_BYTES: u64 = 64 << 20;
/// Frames of a folder.
pub(super) const FRAMES: usize = 1 << 20;
