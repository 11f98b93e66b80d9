//! Seals of text files: a digest of the content, and a history of accepted edits.

mod canonical;
mod digest;
mod entries;
mod error;
mod history;
mod keys;

pub mod json;
pub mod toml_text;

pub use digest::digest_of_bytes;
pub use error::SealError;
pub use history::{Edit, Opened};
