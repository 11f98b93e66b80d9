#![doc = include_str!("../README.md")]

mod durable;
mod staging;
mod temporary_folder;

pub mod seal;

pub use durable::{parent_of, sync_folder};
#[doc(hidden)]
pub use staging::exchange;
pub use staging::{STAGED, Staged, clear_leftovers, replace, settle};
pub use temporary_folder::{TemporaryFolder, remove_before_exit};
