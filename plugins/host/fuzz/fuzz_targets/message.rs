//! Fuzzes messages between a host and its child: `cargo +nightly fuzz run message`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    taceva_host::read_any_message(bytes);
});
