//! Model files: what is written, what is read back, and how a file gets to its place.

mod bytes;
mod disk;
mod error;
mod limits;
mod read;
mod seal;
pub(crate) mod tensors;

pub use self::disk::ModelFileError;
pub use self::error::FormatError;
pub(crate) use self::limits::FORMAT;
pub(crate) use self::seal::is_sealed;
