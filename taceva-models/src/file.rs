//! Model files: what is written, what is read back, and how a file gets to its place.

mod bytes;
mod disk;
mod distance;
mod read;
mod seal;

pub use self::disk::ModelFileError;
