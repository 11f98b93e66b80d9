//! How much of a file is taken into memory at once. Beyond these a file is refused before anything is allocated for it. They are chosen so that no
//! file, whatever it announces, takes 512 MiB (`tests/hostile.rs`).

/// What describes a file: the footer of a Parquet file, the summary of an MCAP file.
pub(crate) const DESCRIPTION_BYTES: u64 = 32 << 20;
/// A JSON file of LeRobot or a message of JSON, which takes several times as much in memory.
pub(crate) const JSON_BYTES: u64 = 16 << 20;
/// A page of a Parquet file that is decoded as a whole, or a chunk of an MCAP file, compressed or not.
pub(crate) const PAGE_BYTES: u64 = 128 << 20;
/// A picture, or another cell of bytes.
pub(crate) const CELL_BYTES: u64 = 256 << 20;
/// The cells that a caller asks for at once, as they lie in memory.
pub(crate) const COLUMN_BYTES: u64 = 320 << 20;
/// Numbers in one row of a column of lists.
pub(crate) const ROW_LEVELS: u64 = 1 << 24;
/// Rows of a table.
pub(crate) const ROWS: u64 = 1 << 28;
/// How deep lists and structures may nest.
pub(crate) const DEPTH: usize = 32;
/// Columns, fields or topics.
pub(crate) const NAMES: usize = 1 << 16;
/// Messages of one topic, of which the time and the place are kept.
pub(crate) const MESSAGES: usize = 1 << 23;
/// Elements of lists in one message that become cells.
pub(crate) const MESSAGE_CELLS: usize = 1 << 20;

/// Bytes that a small file may become unpacked; a larger one may become so many times its stored size.
const UNPACKED_BYTES: u64 = 128 << 20;
const UNPACKED_RATIO: u64 = 200;
/// The same of cells that a caller asks for at once.
const LEAST_COLUMN_BYTES: u64 = 96 << 20;
const COLUMN_RATIO: u64 = 64;

/// Bytes that `stored` ones may become once they are unpacked.
pub(crate) fn unpacked_bytes(stored: u64) -> u64 {
    stored.saturating_mul(UNPACKED_RATIO).max(UNPACKED_BYTES)
}

/// Memory of the cells that a caller asks for at once, of a file of `stored` bytes.
pub(crate) fn column_bytes(stored: u64) -> u64 {
    let own = stored.saturating_mul(COLUMN_RATIO);
    own.clamp(LEAST_COLUMN_BYTES, COLUMN_BYTES)
}
