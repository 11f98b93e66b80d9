//! Tests that folders of labs become datasets, and datasets become files of other programs.

mod bad_forms;
mod bad_images;
mod bad_tables;
mod bags;
mod damage;
mod exported;
mod extended_maps;
mod jpeg_decoders;
mod lab;
mod presets;
mod recordings;
mod round_trip;
#[path = "../../dataset/tests/support.rs"]
mod support;
mod suspect_inputs;
mod tiff;
mod views;
