//! Tests with files of other libraries and of this crate. Every value must equal the value that those libraries read back.

#[path = "../recordings/mod.rs"]
mod recordings;

mod arrow;
mod bags;
mod cut;
mod lerobot;
mod mcap;
mod nested;
mod older_lists;
mod parquet;
mod times;
mod writers;
