//! Limits of input files. A larger file is rejected before memory is allocated for it.

/// Maximum size of an import map, header or other TOML file, bytes.
pub const TOML_BYTES: u64 = 1 << 20;
/// Maximum size of the list of imported source files, bytes.
pub const SOURCES_BYTES: u64 = 256 << 20;
/// Maximum size of a table as text, bytes; cells have 32-bit offsets.
pub const TABLE_BYTES: u64 = u32::MAX as u64 - 1;
/// Maximum number of columns of a table.
pub const TABLE_COLUMNS: usize = 4_096;
/// Maximum size of an image file, bytes.
pub const IMAGE_BYTES: u64 = 256 << 20;
/// Size of a pack above which no further frame is appended, bytes.
pub const PACK_BYTES: u64 = 1 << 30;
/// Maximum side of an image, pixels.
pub const IMAGE_SIDE: u32 = 16_384;
/// Maximum number of pixels of a depth map. A map in memory has 8 bytes for each.
pub const MAP_PIXELS: usize = 1 << 25;
/// Maximum size of a decoded image, bytes.
pub const DECODED_BYTES: u64 = 256 << 20;
/// Decoded size that is allowed for every image, bytes. An image with a larger decoded size is limited to [`DECODED_RATIO`] times its file size.
const DECODED_LEAST: u64 = 32 << 20;
/// Maximum ratio of decoded size to file size.
const DECODED_RATIO: u64 = 200;

/// Maximum decoded size of an image file of `stored` bytes.
pub fn decoded_bytes(stored: usize) -> u64 {
    let own = (stored as u64).saturating_mul(DECODED_RATIO);
    own.clamp(DECODED_LEAST, DECODED_BYTES)
}

/// Maximum payload of a journal record, bytes.
pub const RECORD_BYTES: u32 = 1 << 20;
/// Maximum number of rows of a dataset.
pub const ROWS: u64 = 1 << 28;
/// Maximum number of files visited when counting unused images.
pub const WALKED_FILES: u64 = 1 << 20;
/// Maximum size of a JSON file, bytes; parsing needs several times as much memory.
pub const JSON_BYTES: u64 = 256 << 20;
