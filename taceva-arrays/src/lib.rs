#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod array_file;
mod element;
mod error;
mod fields;
mod format;
mod limits;
mod literal;
mod npy;
mod order;
mod pattern;
mod scalar;
mod source;
mod store;
mod values;

pub use array_file::ArrayFile;
pub use element::{ArrayInfo, Element};
pub use error::{ArrayError, Problem};
pub use format::ArrayFormat;
pub use values::{ArrayData, ArrayValues};
