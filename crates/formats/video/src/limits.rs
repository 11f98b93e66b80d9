//! Limits of clips. A clip that exceeds a limit is rejected before any allocation.

/// Frames of a clip: 38 hours at 30 frames per second. Each needs about 70 bytes while a clip is opened.
pub(crate) const FRAMES: u64 = 1 << 22;
/// Size of a compressed packet.
pub(crate) const PACKET_BYTES: u64 = 64 << 20;
/// Pixels along one side of a frame.
pub(crate) const SIDE: u32 = 16_384;
/// Chunks of an AVI file, including sound and padding.
pub(crate) const CHUNKS: u64 = 1 << 23;
/// Outer boxes of an MP4 file. A fragmented file has two for each fragment.
pub(crate) const OUTER_BOXES: u32 = 1 << 23;
/// Boxes in another box.
pub(crate) const INNER_BOXES: u32 = 1 << 16;
/// Size of the headers of an AVI file's streams, or of a chunk that is read whole.
pub(crate) const HEADER_BYTES: u64 = 1 << 20;
/// Size of the index at the end of an AVI file: 16 bytes for each chunk.
pub(crate) const INDEX_BYTES: u64 = CHUNKS * 16;
/// Size of decoded frames that wait for an earlier one: 16 frames of 16 million pixels, the maximum of a standard.
pub(crate) const HELD_BYTES: u64 = 256 << 20;
/// Size of a decoded frame.
pub(crate) const FRAME_BYTES: u64 = 256 << 20;
/// Memory of an external program, including its code and stacks.
pub(crate) const PROGRAM_BYTES: u64 = 4 << 30;
