//! How large foreign input may be. Beyond these a file is refused before anything is allocated for it.

/// A map, a header or another TOML file.
pub(crate) const TOML_BYTES: u64 = 1 << 20;
/// A table as text; cells are found by 32-bit offsets.
pub(crate) const TABLE_BYTES: u64 = u32::MAX as u64 - 1;
/// Columns of a table.
pub(crate) const TABLE_COLUMNS: usize = 4_096;
/// An image file.
pub(crate) const IMAGE_BYTES: u64 = 256 << 20;
/// A pack that no further frame is appended to.
pub(crate) const PACK_BYTES: u64 = 1 << 30;
/// Pixels along one side of an image.
pub(crate) const IMAGE_SIDE: u32 = 16_384;
/// A decoded image.
pub(crate) const DECODED_BYTES: u64 = 256 << 20;
/// The payload of one record of a journal.
pub(crate) const RECORD_BYTES: u32 = 1 << 20;
/// Rows of a dataset.
pub(crate) const ROWS: u64 = 1 << 28;
/// Files looked at when images that no row names are counted.
pub(crate) const WALKED_FILES: u64 = 1 << 20;
/// A JSON file, which takes several times as much in memory.
pub(crate) const JSON_BYTES: u64 = 256 << 20;
