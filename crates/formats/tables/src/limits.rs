//! Memory limits. Larger files are rejected before memory is allocated for them. Reading a file takes less than 512 MiB of memory, even if the file
//! states false sizes (`tests/hostile.rs`).

/// Maximum size of the metadata of a file, bytes: the footer of a Parquet file, or the summary of an MCAP file.
pub(crate) const DESCRIPTION_BYTES: u64 = 32 << 20;
/// Maximum size of a JSON file of LeRobot or of a JSON message, bytes. Parsing takes several times as much memory.
pub(crate) const JSON_BYTES: u64 = 16 << 20;
/// Maximum size of a Parquet page that is decoded as a whole, or of an MCAP chunk, packed or unpacked, bytes.
pub(crate) const PAGE_BYTES: u64 = 128 << 20;
/// Maximum size of a picture, or of another cell of bytes, in bytes.
pub(crate) const CELL_BYTES: u64 = 256 << 20;
/// Maximum memory of the cells of one request, bytes.
pub(crate) const COLUMN_BYTES: u64 = 320 << 20;
/// Maximum number of values in one row of a column of lists.
pub(crate) const ROW_LEVELS: u64 = 1 << 24;
/// Maximum number of rows of a table.
pub(crate) const ROWS: u64 = 1 << 28;
/// Maximum nesting depth of lists and structures.
pub(crate) const DEPTH: usize = 32;
/// Maximum number of columns, fields or topics.
pub(crate) const NAMES: usize = 1 << 16;
/// Maximum number of messages of one topic. The time and location of each message are kept in memory.
pub(crate) const MESSAGES: usize = 1 << 23;
/// Maximum number of list elements in one message that become cells.
pub(crate) const MESSAGE_CELLS: usize = 1 << 20;

/// Minimum limit of the unpacked size of a file, bytes. The limit of a larger file is a multiple of its stored size.
const UNPACKED_BYTES: u64 = 128 << 20;
const UNPACKED_RATIO: u64 = 200;
/// Minimum limit of the memory of the cells of one request, bytes. The limit of a larger file is a multiple of its stored size.
const LEAST_COLUMN_BYTES: u64 = 96 << 20;
const COLUMN_RATIO: u64 = 64;

/// Maximum unpacked size of content stored in `stored` bytes, bytes.
pub(crate) fn unpacked_bytes(stored: u64) -> u64 {
    stored.saturating_mul(UNPACKED_RATIO).max(UNPACKED_BYTES)
}

/// Maximum memory of the cells of one request, bytes, for a file of `stored` bytes.
pub(crate) fn column_bytes(stored: u64) -> u64 {
    let own = stored.saturating_mul(COLUMN_RATIO);
    own.clamp(LEAST_COLUMN_BYTES, COLUMN_BYTES)
}
