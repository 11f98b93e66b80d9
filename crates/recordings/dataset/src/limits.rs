//! Limits of foreign input. A larger file is rejected before anything is allocated for it.

/// Maximum map, header or other TOML file, bytes.
pub const TOML_BYTES: u64 = 1 << 20;
/// Maximum list of the files that an import read, bytes.
pub const SOURCES_BYTES: u64 = 256 << 20;
/// Maximum table as text, bytes; cells are found by 32-bit offsets.
pub const TABLE_BYTES: u64 = u32::MAX as u64 - 1;
/// Maximum columns of a table.
pub const TABLE_COLUMNS: usize = 4_096;
/// Maximum image file, bytes.
pub const IMAGE_BYTES: u64 = 256 << 20;
/// Size of a pack from which no further frame is appended, bytes.
pub const PACK_BYTES: u64 = 1 << 30;
/// Maximum pixels along one side of an image.
pub const IMAGE_SIDE: u32 = 16_384;
/// Maximum decoded image, bytes.
pub const DECODED_BYTES: u64 = 256 << 20;
/// Decoded size that is allowed for every image, bytes. A larger image may take [`DECODED_RATIO`] times the size of its file.
const DECODED_LEAST: u64 = 32 << 20;
/// Maximum ratio of decoded size to file size.
const DECODED_RATIO: u64 = 200;

/// Maximum decoded size of an image file of `stored` bytes.
pub fn decoded_bytes(stored: usize) -> u64 {
    let own = (stored as u64).saturating_mul(DECODED_RATIO);
    own.clamp(DECODED_LEAST, DECODED_BYTES)
}

/// Maximum payload of one record of a journal, bytes.
pub const RECORD_BYTES: u32 = 1 << 20;
/// Maximum rows of a dataset.
pub const ROWS: u64 = 1 << 28;
/// Maximum files visited when unnamed images are counted.
pub const WALKED_FILES: u64 = 1 << 20;
/// Maximum JSON file, bytes; it takes several times as much in memory.
pub const JSON_BYTES: u64 = 256 << 20;
