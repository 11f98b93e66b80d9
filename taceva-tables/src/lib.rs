#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod cell;
mod error;
mod limits;
mod parquet;
mod path;
mod rows;
mod source;
mod unpack;

pub use cell::Cell;
pub use error::{Place, TableError};
pub use parquet::ParquetTable;
