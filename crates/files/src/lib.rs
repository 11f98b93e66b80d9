#![doc = include_str!("../README.md")]

mod durable;

pub mod seal;

pub use durable::{parent_of, replace, sync_folder};
