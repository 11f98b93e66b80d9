//! Limits of files and requests. Files and requests above a limit are rejected before memory is allocated.

/// Maximum number of bytes that one call of `read` returns.
pub(crate) const READ_BYTES: u64 = 1 << 30;
/// Maximum size of the header of a NumPy array, bytes.
pub(crate) const NPY_HEADER_BYTES: u64 = 1 << 20;
/// Maximum nesting depth of a Python literal, and of the fields of a record.
pub(crate) const LITERAL_DEPTH: usize = 16;
/// Maximum number of axes. NumPy has at most 64, HDF5 at most 32.
pub(crate) const AXES: usize = 64;
/// Size of the blocks in which rows of column-major arrays are transposed, bytes.
pub(crate) const TURNED_BYTES: u64 = 64 << 20;
/// Maximum number of arrays of a file. The same limit holds for groups of a file and members of an archive.
pub(crate) const ARRAYS: u64 = 1 << 16;
/// Maximum size of one element (a fixed-length text or a record), bytes.
#[cfg(feature = "hdf5")]
pub(crate) const ELEMENT_BYTES: u64 = 64 << 20;
/// Maximum unpacked size of a chunk, bytes.
pub(crate) const CHUNK_BYTES: u64 = 256 << 20;
/// Maximum number of chunks that one call of `read` opens.
pub(crate) const CHUNKS: u64 = 1 << 16;
/// Maximum size of a metadata file of zarr, bytes.
pub(crate) const METADATA_BYTES: u64 = 16 << 20;
/// Maximum number of values of a pickle that are not elements of arrays.
pub(crate) const PICKLED_VALUES: u64 = 1 << 22;
/// Maximum number of operations of a pickle.
pub(crate) const PICKLE_STEPS: u64 = 1 << 25;
/// Maximum nesting depth of groups of a pickle.
pub(crate) const PICKLE_DEPTH: usize = 64;
/// Maximum size of the directory of an archive, bytes.
pub(crate) const DIRECTORY_BYTES: u64 = 64 << 20;
/// Maximum compression ratio that deflate can reach.
pub(crate) const DEFLATE_RATIO: u64 = 1_032;
/// Compression ratio above which a member of an archive is inflated only up to `INFLATED_BYTES`.
pub(crate) const USUAL_RATIO: u64 = 200;
/// Maximum inflated size of a member with a ratio above `USUAL_RATIO`, bytes. Reading any small file thus takes at most 300 MB of memory and 20 s.
pub(crate) const INFLATED_BYTES: u64 = 128 << 20;
/// Maximum size of members and variables of one file that are inflated as a whole and kept in memory, bytes.
pub(crate) const HELD_BYTES: u64 = 64 << 20;

/// Maximum unpacked size of content stored in `stored` bytes, bytes.
pub(crate) fn unpacked_bytes(stored: u64) -> u64 {
    stored.saturating_mul(USUAL_RATIO).max(INFLATED_BYTES)
}
