//! How large foreign input may be. Beyond these a file is refused before anything is allocated for it.

/// A map, a header or another TOML file.
pub const TOML_BYTES: u64 = 1 << 20;
/// The list of files that an import read.
pub const SOURCES_BYTES: u64 = 256 << 20;
/// A table as text; cells are found by 32-bit offsets.
pub const TABLE_BYTES: u64 = u32::MAX as u64 - 1;
/// Columns of a table.
pub const TABLE_COLUMNS: usize = 4_096;
/// An image file.
pub const IMAGE_BYTES: u64 = 256 << 20;
/// A pack that no further frame is appended to.
pub const PACK_BYTES: u64 = 1 << 30;
/// Pixels along one side of an image.
pub const IMAGE_SIDE: u32 = 16_384;
/// A decoded image.
pub const DECODED_BYTES: u64 = 256 << 20;
/// A decoded image whatever its file; a larger one may take [`DECODED_RATIO`] times its file. So several at once stay below 300 MiB where files are small.
const DECODED_LEAST: u64 = 32 << 20;
/// Bytes of a decoded image for each of its file.
const DECODED_RATIO: u64 = 200;

/// Bytes that an image may take once it is decoded, of a file of `stored` bytes.
pub fn decoded_bytes(stored: usize) -> u64 {
    let own = (stored as u64).saturating_mul(DECODED_RATIO);
    own.clamp(DECODED_LEAST, DECODED_BYTES)
}

/// The payload of one record of a journal.
pub const RECORD_BYTES: u32 = 1 << 20;
/// Rows of a dataset.
pub const ROWS: u64 = 1 << 28;
/// Files looked at when images that no row names are counted.
pub const WALKED_FILES: u64 = 1 << 20;
/// A JSON file, which takes several times as much in memory.
pub const JSON_BYTES: u64 = 256 << 20;
