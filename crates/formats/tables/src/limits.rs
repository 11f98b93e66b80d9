//! Memory limits. Larger files are rejected before memory is allocated for them. No file takes 512 MiB of memory, even if it states false sizes
//! (`tests/hostile.rs`).

/// Maximum metadata, bytes: the footer of a Parquet file, the summary of an MCAP file.
pub(crate) const DESCRIPTION_BYTES: u64 = 32 << 20;
/// Maximum JSON file of LeRobot or JSON message, bytes. It takes several times as much memory.
pub(crate) const JSON_BYTES: u64 = 16 << 20;
/// Maximum page of a Parquet file that is decoded as a whole, or chunk of an MCAP file, bytes, packed or unpacked.
pub(crate) const PAGE_BYTES: u64 = 128 << 20;
/// Maximum size of a picture, or of another cell of bytes.
pub(crate) const CELL_BYTES: u64 = 256 << 20;
/// Maximum memory of the cells of one request, bytes.
pub(crate) const COLUMN_BYTES: u64 = 320 << 20;
/// Maximum numbers in one row of a column of lists.
pub(crate) const ROW_LEVELS: u64 = 1 << 24;
/// Maximum rows of a table.
pub(crate) const ROWS: u64 = 1 << 28;
/// Maximum nesting of lists and structures.
pub(crate) const DEPTH: usize = 32;
/// Maximum columns, fields or topics.
pub(crate) const NAMES: usize = 1 << 16;
/// Maximum messages of one topic. The time and location of each are kept in memory.
pub(crate) const MESSAGES: usize = 1 << 23;
/// Maximum list elements that become cells, per message.
pub(crate) const MESSAGE_CELLS: usize = 1 << 20;

/// Unpacked size that any small file may reach, bytes. A larger file may reach a multiple of its stored size.
const UNPACKED_BYTES: u64 = 128 << 20;
const UNPACKED_RATIO: u64 = 200;
/// The same limit for the cells of one request.
const LEAST_COLUMN_BYTES: u64 = 96 << 20;
const COLUMN_RATIO: u64 = 64;

/// Maximum unpacked size of `stored` bytes.
pub(crate) fn unpacked_bytes(stored: u64) -> u64 {
    stored.saturating_mul(UNPACKED_RATIO).max(UNPACKED_BYTES)
}

/// Maximum memory of the cells of one request, for a file of `stored` bytes.
pub(crate) fn column_bytes(stored: u64) -> u64 {
    let own = stored.saturating_mul(COLUMN_RATIO);
    own.clamp(LEAST_COLUMN_BYTES, COLUMN_BYTES)
}
