//! How much is accepted. Beyond these a file or a request is refused before anything is allocated for it.

/// Bytes that one call of `read` gives.
pub(crate) const READ_BYTES: u64 = 1 << 30;
/// The header of one array of NumPy.
pub(crate) const NPY_HEADER_BYTES: u64 = 1 << 20;
/// Nesting of a literal of Python, and of the fields of a record.
pub(crate) const LITERAL_DEPTH: usize = 16;
/// Axes of an array; NumPy has at most 64, HDF5 32.
pub(crate) const AXES: usize = 64;
/// Rows that lie column by column are turned in blocks of so many bytes.
pub(crate) const TURNED_BYTES: u64 = 64 << 20;
