#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod archive;
mod array_file;
mod block;
mod cache;
mod codec;
mod element;
mod error;
mod fields;
mod format;
#[cfg(feature = "hdf5")]
mod hdf5;
mod inflate;
mod limits;
mod literal;
mod matlab;
mod member_bytes;
mod npy;
mod npz;
mod order;
mod pattern;
mod pickle;
mod scalar;
mod source;
mod store;
mod values;
mod zarr;

pub use array_file::ArrayFile;
pub use element::{ArrayInfo, Element};
pub use error::{ArrayError, Problem};
pub use format::ArrayFormat;
#[cfg(feature = "hdf5")]
pub use hdf5::{Hdf5Writer, WrittenElement};
pub use values::{ArrayData, ArrayValues};
