//! How large clips may be. Beyond these a clip is refused before anything is allocated for it.

/// Frames of a clip: 38 hours of 30 a second. What is known of each takes some 70 bytes while a clip is opened.
pub(crate) const FRAMES: u64 = 1 << 22;
/// One packet as it is compressed.
pub(crate) const PACKET_BYTES: u64 = 64 << 20;
/// Pixels along one side of a frame.
pub(crate) const SIDE: u32 = 16_384;
/// Chunks of an AVI file, those of sound and padding included.
pub(crate) const CHUNKS: u64 = 1 << 23;
/// Boxes of an MP4 file that lie in no other: a file in fragments has two for each.
pub(crate) const OUTER_BOXES: u32 = 1 << 23;
/// Boxes that lie in another.
pub(crate) const INNER_BOXES: u32 = 1 << 16;
/// The description of an AVI file's streams, or the headers of one of its chunks that are read whole.
pub(crate) const HEADER_BYTES: u64 = 1 << 20;
/// The index at the end of an AVI file: 16 bytes a chunk.
pub(crate) const INDEX_BYTES: u64 = CHUNKS * 16;
/// Decoded frames that wait for an earlier one: 16 of 16 million pixels, which is as many as a standard admits.
pub(crate) const HELD_BYTES: u64 = 256 << 20;
/// A decoded frame.
pub(crate) const FRAME_BYTES: u64 = 256 << 20;
/// The memory of a program of others, its code and the stacks of its threads included.
pub(crate) const PROGRAM_BYTES: u64 = 4 << 30;
