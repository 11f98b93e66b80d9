#![doc = include_str!("../README.md")]

mod durable;
mod temporary_folder;

pub mod seal;

pub use durable::{parent_of, replace, sync_folder};
pub use temporary_folder::TemporaryFolder;
