//! Limits of clips. A clip above a limit is rejected before memory is allocated.

/// Maximum number of frames of a clip: 38 hours at 30 frames per second. Each frame needs about 70 bytes while a clip is opened.
pub(crate) const FRAMES: u64 = 1 << 22;
/// Maximum size of a compressed packet, bytes.
pub(crate) const PACKET_BYTES: u64 = 64 << 20;
/// Maximum number of pixels along one side of a frame.
pub(crate) const SIDE: u32 = 16_384;
/// Maximum number of chunks of an AVI file, including sound and padding.
pub(crate) const CHUNKS: u64 = 1 << 23;
/// Maximum number of outer boxes of an MP4 file. A fragmented file has two for each fragment.
pub(crate) const OUTER_BOXES: u32 = 1 << 23;
/// Maximum number of boxes in another box.
pub(crate) const INNER_BOXES: u32 = 1 << 16;
/// Maximum size of the stream headers of an AVI file, or of a chunk that is read as a whole, bytes.
pub(crate) const HEADER_BYTES: u64 = 1 << 20;
/// Maximum size of the index at the end of an AVI file, bytes: 16 for each chunk.
pub(crate) const INDEX_BYTES: u64 = CHUNKS * 16;
/// Maximum total size of decoded frames that wait for an earlier frame, bytes: 16 luma planes of 16 million pixels. H.264 keeps at most 16 frames.
pub(crate) const HELD_BYTES: u64 = 256 << 20;
/// Maximum size of a decoded frame, bytes.
pub(crate) const FRAME_BYTES: u64 = 256 << 20;
/// Maximum memory of an external program, including its code and stacks, bytes.
pub(crate) const PROGRAM_BYTES: u64 = 4 << 30;
