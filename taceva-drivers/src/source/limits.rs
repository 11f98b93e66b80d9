//! Limits on the size and number of files from users, checked before memory is allocated.

/// Maximum size of an image file, bytes.
pub(super) const IMAGE_BYTES: u64 = 256 << 20;
/// Maximum side of an image, pixels.
pub(super) const IMAGE_SIDE: u32 = 16_384;
/// Maximum size of a decoded image, bytes.
pub(super) const DECODED_BYTES: u64 = 256 << 20;
/// Maximum size of a table of times, bytes.
pub(super) const TABLE_BYTES: u64 = 64 << 20;
/// Maximum number of frames in a folder.
pub(super) const FRAMES: usize = 1 << 20;
