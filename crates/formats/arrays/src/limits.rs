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
/// Arrays of one file, groups of one file, members of one archive.
pub(crate) const ARRAYS: u64 = 1 << 16;
/// One element: a fixed text, or a record.
#[cfg(feature = "hdf5")]
pub(crate) const ELEMENT_BYTES: u64 = 64 << 20;
/// A chunk once its filters are undone.
pub(crate) const CHUNK_BYTES: u64 = 256 << 20;
/// Chunks that one call of `read` looks into.
pub(crate) const CHUNKS: u64 = 1 << 16;
/// A file of metadata of zarr.
pub(crate) const METADATA_BYTES: u64 = 16 << 20;
/// Values of a pickle that are no elements of arrays.
pub(crate) const PICKLED_VALUES: u64 = 1 << 22;
/// Operations of a pickle.
pub(crate) const PICKLE_STEPS: u64 = 1 << 25;
/// Groups within groups of a pickle.
pub(crate) const PICKLE_DEPTH: usize = 64;
/// The directory of an archive.
pub(crate) const DIRECTORY_BYTES: u64 = 64 << 20;
/// What the form allows at most: no deflated byte becomes more.
pub(crate) const DEFLATE_RATIO: u64 = 1_032;
/// Above so many times its size a member is inflated only if it becomes no more than `INFLATED_BYTES`.
pub(crate) const USUAL_RATIO: u64 = 200;
/// See `USUAL_RATIO`; what a small file may become, so that none takes 300 MB or 20 s.
pub(crate) const INFLATED_BYTES: u64 = 128 << 20;
/// Members and variables that are inflated as a whole and held, all of one file together.
pub(crate) const HELD_BYTES: u64 = 64 << 20;

/// Bytes that `stored` ones may become once everything is unpacked.
pub(crate) fn unpacked_bytes(stored: u64) -> u64 {
    stored.saturating_mul(USUAL_RATIO).max(INFLATED_BYTES)
}
