//! Writes, reads and atomically replaces model files.

mod bytes;
mod disk;
mod distance;
mod read;
mod seal;

pub use self::disk::ModelFileError;
