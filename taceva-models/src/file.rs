//! Model files: writing, reading and atomic replacement.

mod bytes;
mod disk;
mod distance;
mod read;
mod seal;

pub use self::disk::ModelFileError;
