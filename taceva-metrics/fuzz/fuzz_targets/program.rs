//! Fuzzes sequences of batches, merges and damaged states: `cargo +nightly fuzz run program`.

#![no_main]

#[path = "../../tests/metrics/support/program.rs"]
mod program;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    program::run(bytes);
});
