#![doc = include_str!("../README.md")]

mod canonical;
mod error;
mod history;
mod keys;
mod written;

pub mod json;
pub mod toml_text;

pub use error::SealError;
pub use history::{Edit, Opened, Version};
pub use written::digest_of_bytes;
